// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Writes numbers and units for people, by the rules of text.py.

const MINUS = '\u2212';
const THIN_SPACE = '\u202f';
const PREFIXES = [[1e9, 'G'], [1e6, 'M'], [1e3, 'k'], [1, ''], [1e-3, 'm'], [1e-6, 'µ'], [1e-9, 'n']];
const UNITS_WITH_PREFIX = new Set(['Pa', 'J', 'm', 'N', 'N m', 's', 'Hz', 'B']);
const SUPERSCRIPTS = '⁰¹²³⁴⁵⁶⁷⁸⁹';

function superscript(exponent) {
  const digits = [...String(Math.abs(exponent))].map((digit) => SUPERSCRIPTS[digit]).join('');
  return (exponent < 0 ? '⁻' : '') + digits;
}

/** A number without a unit, written with a power of ten if it would have many zeros otherwise. */
function plainNumber(value, digits = 4) {
  if (value === null || !Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  let text;
  if (value === 0) text = '0';
  else if (size >= 1e-3 && size < 1e6) {
    text = size >= 10 ** digits ? value.toFixed(0) : String(Number(value.toPrecision(digits)));
    if (size >= 1e4) text = text.replace(/\B(?=(\d{3})+$)/g, THIN_SPACE);
  } else {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    text = `${Number(mantissa)}${THIN_SPACE}×${THIN_SPACE}10${superscript(Number(exponent))}`;
  }
  return text.replace('-', MINUS);
}

/** The value times the factor, with enough decimals to tell the sorted values, times the factor, apart: to a hundredth of their
 * smallest distance. */
function withDecimals(value, values, factor) {
  const gaps = values.slice(1).map((one, k) => factor * (one - values[k])).filter((gap) => gap > 0);
  const gap = gaps.length ? Math.min(...gaps) : Math.abs(factor * value) / 10;
  const isEnough = (decimals) => values.every((one) => Math.abs(Number((factor * one).toFixed(decimals)) - factor * one) <= 0.01 * gap);
  const decimals = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10].find(isEnough) ?? 11;
  return (factor * value).toFixed(decimals).replace('-', MINUS);
}

/** The number of meaningful digits of a value that is known to a resolution; 0 if the value is smaller than that. */
function meaningfulDigits(value, resolution) {
  return Math.abs(value) < resolution ? 0 : Math.min(4, Math.floor(Math.log10(Math.abs(value) / resolution)) + 1);
}

/** A factor and a unit for numbers up to the size: 0.002 m are 2 mm. */
function withPrefix(size, unit) {
  const plain = { factor: 1, unit: unit === '-' ? '' : unit };
  if (!UNITS_WITH_PREFIX.has(unit) || !(size > 0) || !Number.isFinite(size)) return plain;
  const found = PREFIXES.find(([value]) => size >= 0.99999 * value);
  if (!found || (unit === 's' && found[0] > 1)) return plain;
  return { factor: 1 / found[0], unit: found[1] + unit };
}

/** A number with its unit. The prefix of the unit follows from the number. */
function quantity(value, unit, digits = 4) {
  if (value === null) return '–';
  const scale = withPrefix(Math.abs(value), unit);
  return plainNumber(value * scale.factor, digits) + (scale.unit ? `\u00a0${scale.unit}` : '');
}

/** Round numbers from low to high, about n of them. */
function roundTicks(low, high, n) {
  const raw = (high - low) / Math.max(n, 1);
  if (!(raw > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw * 0.999);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, k) => Number(((first + k) * step).toPrecision(12)));
}

/** The largest of 1, 2 or 5 times a power of ten that is not above the value. */
function roundDown(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return Number((power * [5, 2, 1].find((factor) => factor * power <= value * 1.0001)).toPrecision(3));
}

/** Makes an element with attributes and children; these may be texts. */
function element(name, attributes = {}, ...children) {
  const svg = ['svg', 'line', 'path', 'text', 'circle', 'g', 'rect', 'title'].includes(name);
  const made = svg ? document.createElementNS('http://www.w3.org/2000/svg', name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

const byId = (id) => document.getElementById(id);
