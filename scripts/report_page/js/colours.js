// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Colour maps: viridis for ordinary values, Moreland's cool to warm for values above and below a middle, and hues for names.

const MAPS = {
  sequential: '440154 48186a 472d7b 424086 3b528b 33638d 2c728e 26828e 21918c 1fa088 28ae80 3fbc73 5ec962 84d44b addc30 d8e219 fde725',
  diverging: '3b4cc0 4e68d8 6282ea 779af7 8db0fe a3c2fe b9d0f9 ccd9ed dddcdc ecd3c5 f5c4ac f7b093 f4987a eb7d62 dd5f4b ca3b37 b40426',
};
const HUES = ['56b4e9', 'e69f00', '009e73', 'cc79a7', 'f0e442', '0072b2', 'd55e00', '999999'];
const SMOOTH = 256;
const BANDS = 10;

const channels = (hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16));
const TABLES = Object.fromEntries(Object.entries(MAPS).map(([name, text]) => [name, text.split(' ').map(channels)]));

/** The colour of a map at a share, from 0 for its first colour to 1 for its last one. */
function mapped(name, share) {
  const table = TABLES[name];
  const place = Math.max(0, Math.min(1, share)) * (table.length - 1);
  const below = Math.min(Math.floor(place), table.length - 2);
  return [0, 1, 2].map((c) => Math.round(table[below][c] + (place - below) * (table[below + 1][c] - table[below][c])));
}

/** The colours from low to high, each [r, g, b]. If the middle of a signed option lies between low and high, values at equal distances above
 * and below it have colours of equal strength. */
function colourRow(option, low, high, bands) {
  if (option.names) return option.names.map((_, i) => channels(HUES[i % HUES.length]));
  const n = bands ? BANDS : SMOOTH;
  const { middle } = option;
  const isDiverging = option.signed && low < middle && middle < high;
  const most = Math.max(high - middle, middle - low);
  return Array.from({ length: n }, (_, i) => {
    const share = (i + 0.5) / n;
    return isDiverging ? mapped('diverging', 0.5 + (low + share * (high - low) - middle) / (2 * most)) : mapped('sequential', share);
  });
}

/** A row of colours as a background in CSS. */
function gradientOf(row, bands) {
  const css = (rgb) => `rgb(${rgb.join(' ')})`;
  if (!bands) return `linear-gradient(to right, ${row.filter((_, i) => i % 15 === 0).map(css).join(', ')})`;
  return `linear-gradient(to right, ${row.map((rgb, i) => `${css(rgb)} ${100 * i / row.length}% ${100 * (i + 1) / row.length}%`).join(', ')})`;
}

/** The colour that has a name in style.css. */
const themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
