// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The parts that are drawn over the view: the legend, the axes, and the values under the pointer.

/** Fills the legend: the option's name and unit, the colours and the numbers from low to high. */
function showLegend(place, option, low, high, row, bands) {
  if (option.names) {
    const swatches = option.names.map((name, i) => {
      const swatch = element('i');
      swatch.style.background = `rgb(${row[i].join(' ')})`;
      return element('span', {}, swatch, name);
    });
    place.replaceChildren(element('div', {}, option.label), element('div', { class: 'swatches' }, ...swatches));
    return;
  }
  const scale = withPrefix(Math.max(Math.abs(low), Math.abs(high)), option.unit);
  const bar = element('div', { class: 'bar' });
  bar.style.background = gradientOf(row, bands);
  const ticks = element('div', { class: 'ticks' });
  const share = (value) => (high > low ? 100 * (value - low) / (high - low) : 50);
  // The ticks are the ends, where round-off is shown as 0, and round numbers between them where there is room.
  const shown = (value) => (Math.abs(value) < 1e-6 * Math.max(Math.abs(low), Math.abs(high)) ? 0 : value);
  const between = roundTicks(low, high, 3).filter((value) => share(value) > 22 && share(value) < 78);
  for (const value of high > low ? [low, ...between, high] : [low]) {
    const tick = element('span', { 'data-value': value }, plainNumber(shown(value) * scale.factor));
    tick.style.left = `${share(value)}%`;
    ticks.append(tick);
  }
  place.replaceChildren(element('div', {}, option.label + (scale.unit ? ` [${scale.unit}]` : '')), bar, ticks);
}

/** Draws the three axes as the camera sees them. */
function showAxes(svg, { x, y, z }) {
  const axes = ['x', 'y', 'z'].map((name) => ({ name, right: x[name], up: y[name], near: z[name] }));
  axes.sort((a, b) => a.near - b.near);
  svg.replaceChildren(...axes.flatMap(({ name, right, up }) => [
    element('line', { x1: 0, y1: 0, x2: 24 * right, y2: -24 * up }),
    element('text', { x: 32 * right, y: -32 * up }, Math.hypot(right, up) > 0.2 ? name : ''),
  ]));
}

/** Shows rows, each of a name and numbers, beside the body. Without rows, nothing is shown. */
function showReadout(place, rows) {
  place.hidden = !rows;
  if (!rows) return;
  place.replaceChildren(element('table', {}, ...rows.map(([name, ...texts]) => element('tr', {}, element('th', { scope: 'row' }, name),
    ...texts.map((text) => element('td', texts.length === 1 ? { colspan: 3 } : {}, text))))));
}
