// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Reads the blocks that encode.py has put into the page: bytes, deflated and in base64.

async function bytesOf(id) {
  const place = byId(id);
  const text = atob(place.textContent);
  // The text is large, and is no longer needed in the page.
  place.remove();
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/** Reads the arrays that all states share: {name: array}. */
async function readGeometry(view) {
  const types = { Float32Array, Uint32Array, Int32Array };
  const buffer = await bytesOf('geometry');
  const arrays = {};
  let start = 0;
  for (const [name, type, count] of view.arrays) {
    arrays[name] = new types[type](buffer, start, count);
    start += 4 * count;
  }
  return arrays;
}

/** Reads the fields of a state: {name: {values, components, unit}}. Values are 16-bit numbers, in multiples of the unit: for each
 * component the values at all nodes. */
async function readState(view, k) {
  const bytes = new Uint8Array(await bytesOf(`state-${k}`));
  const n = view.nodes;
  const fields = {};
  let start = 0;
  view.fields.forEach((field, f) => {
    const count = n * field.components;
    const values = new Int16Array(count);
    let sum = 0;
    for (let i = 0; i < count; ++i) {
      if (i % n === 0) sum = 0;
      sum = (sum + bytes[start + i] + 256 * bytes[start + count + i]) & 0xffff;
      values[i] = sum;
    }
    start += 2 * count;
    fields[field.name] = { values, components: field.components, unit: view.states[k].units[f] };
  });
  return fields;
}
