// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The page as a whole: the plots, and the view with its controls.

const PHASES = 72;
const SEEN_AS_IT_IS = 0.05; // displacements of this part of the body's size are seen without magnification

const isStill = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

/** All options to colour the body: those of the fields, and the regions if there are several. */
function optionsOf(view, regions) {
  const options = view.fields.flatMap((field) => field.options.map((option) => ({ ...option, field: field.name, unit: field.unit })));
  const ids = [...new Set(regions)].sort((a, b) => a - b);
  if (ids.length > 1) {
    const indices = new Map(ids.map((id, i) => [id, i]));
    options.push({ name: 'region', label: 'region', names: ids.map(String), indices, unit: '-' });
  }
  return options;
}

class Report {
  constructor(description) {
    this.description = description;
    this.isModes = description.kind === 'modes';
    this.plots = new Map();
    for (const figure of document.querySelectorAll('[data-chart]')) {
      const chart = description.charts.find((one) => one.name === figure.dataset.chart);
      this.plots.set(chart.name, new Plot(figure, chart, (x) => this.goToTime(x)));
    }
  }

  /** Reads the data. The state that is shown first is read before all others. */
  async load() {
    const { view } = this.description;
    this.surface = new Surface(await readGeometry(view), view);
    this.states = new Array(view.states.length);
    const last = this.isModes ? this.firstElastic() : view.states.length - 1;
    this.state = last;
    this.states[last] = await readState(view, last);
    this.options = optionsOf(view, this.surface.regions);
    this.option = this.options.find((one) => one.name === (this.isModes ? 'displacement' : 'von_mises')) || this.options[0];
    this.view = new View(byId('canvas'), this.surface, view.obstacles, (place) => this.keep(this.view.pick(place)));
    this.view.onCamera = () => showAxes(byId('axes'), this.view.orbit.axes());
    this.kept = new Kept(byId('kept'), this.surface, this.description, (x) => this.goToTime(x));
    this.phase = Math.PI / 2;
    this.makeControls();
    this.view.resize();
    this.setWarp(this.firstWarp());
    for (let k = 0; k < this.states.length; ++k) {
      byId('loading').textContent = `reading ${this.isModes ? 'mode' : 'state'} ${k + 1} of ${this.states.length} …`;
      if (!this.states[k]) this.states[k] = await readState(view, k);
    }
    byId('loading').remove();
    // Now all states are read: the view is adapted to the places that the body reaches in them.
    this.setWarp(this.warp);
    this.makePlayer();
  }

  /** The index of the first mode that deforms the body. */
  firstElastic() {
    const frequencies = this.description.view.states.map((state) => state.frequency);
    return Math.max(0, frequencies.findIndex((frequency) => frequency > 1e-6 * Math.max(...frequencies)));
  }

  /** The least and the largest value of an option in all states of the page. */
  fullRange(name) {
    const ranges = this.description.view.states.map((state) => state.ranges[name]);
    return [Math.min(...ranges.map((range) => range[0])), Math.max(...ranges.map((range) => range[1]))];
  }

  size() {
    const [low, high] = this.description.view.bounds;
    return Math.hypot(...low.map((x, c) => high[c] - x));
  }

  firstWarp() {
    const largest = this.fullRange('displacement')[1];
    const { obstacles } = this.description.view;
    return largest === 0 || obstacles.length > 0 || (!this.isModes && largest >= SEEN_AS_IT_IS * this.size()) ? 1 : roundDown(0.1 * this.size() / largest);
  }

  /** The corners of a box that contains the body at rest and, with displacements multiplied by the warp, in all states that have been read (of modes: in
   * the mode that is shown). */
  reach() {
    const [low, high] = this.description.view.bounds.map((corner) => [...corner]);
    for (const state of this.isModes ? [this.states[this.state]] : this.states.filter(Boolean)) {
      this.surface.extend(low, high, state.displacement, this.warp);
      if (this.isModes) this.surface.extend(low, high, state.displacement, -this.warp);
    }
    return [low, high];
  }

  makePlayer() {
    const { states } = this.description.view;
    const first = states[0].time;
    const whole = states[states.length - 1].time - first || 1;
    const places = this.isModes ? Array.from({ length: PHASES + 1 }, (_, k) => k / PHASES) : states.map((state) => (state.time - first) / whole);
    const seconds = this.isModes ? 2 : Math.min(12, Math.max(3, states.length / 20));
    this.player = new Player({ slider: byId('time'), button: byId('play'), speed: byId('speed') }, places, seconds, this.isModes ? 0 : 0.08, (place) => {
      if (this.isModes) this.phase = 2 * Math.PI * place / PHASES;
      else this.state = place;
      this.show();
    });
    this.player.go(this.isModes ? PHASES / 4 : this.state);
  }

  /** Draws the state, and everything on the page that depends on it. */
  show() {
    const state = this.states[this.state];
    this.surface.displace(state, this.warp * (this.isModes ? Math.sin(this.phase) : 1));
    this.values = this.surface.valuesOf(this.option, state);
    this.showColours();
    this.view.placeObstacles(this.state);
    this.view.update();
    this.showTime();
    this.showPoint();
  }

  showColours() {
    const [low, high] = this.range();
    this.surface.colour(this.values, low, high);
    const bands = byId('bands').checked && !this.option.names;
    // The row of colours depends on the limits only: it is not made again for each state.
    const key = [this.option.name, low, high, bands].join();
    if (key === this.rowKey) return;
    this.rowKey = key;
    const row = colourRow(this.option, low, high, bands);
    this.view.setColours(row, bands || Boolean(this.option.names));
    showLegend(byId('legend'), this.option, low, high, row, bands);
  }

  /** The values of the first and of the last colour. */
  range() {
    const { option } = this;
    if (option.names) return [-0.5, option.names.length - 0.5];
    const kind = byId('range').value;
    if (kind === 'own') {
      const scale = this.ownScale.factor;
      const [low, high] = [byId('low'), byId('high')].map((input) => input.valueAsNumber / scale);
      return Number.isFinite(low) && high > low ? [low, high] : this.fullRange(option.name);
    }
    return kind === 'state' || this.isModes ? this.description.view.states[this.state].ranges[option.name] : this.fullRange(option.name);
  }

  showTime() {
    const { view } = this.description;
    const state = view.states[this.state];
    if (this.isModes) {
      const mode = `mode ${state.time}, ${quantity(state.frequency, 'Hz', 5)}`;
      byId('clock').textContent = `${mode} · drawn × ${plainNumber(this.warp)}`;
      byId('now').textContent = `phase ${Math.round(this.phase * 180 / Math.PI)}°`;
      return;
    }
    // All times have the same unit, one that suits the whole run.
    const times = view.states.map((one) => one.time);
    const scale = withPrefix(Math.max(...times.map(Math.abs)), 's');
    const time = `${withDecimals(state.time, times, scale.factor)}\u00a0${scale.unit}`;
    byId('clock').textContent = `t = ${time}${this.warp === 1 ? '' : ` · drawn × ${plainNumber(this.warp)}`}`;
    byId('now').textContent = `t = ${time}`;
    byId('time').setAttribute('aria-valuetext', `${time}, state ${this.state + 1} of ${view.states.length}`);
    for (const plot of this.plots.values()) plot.setMark(state.time);
    this.kept.plot?.setMark(state.time);
  }

  goToTime(time) {
    if (!this.player || this.isModes) return;
    const times = this.description.view.states.map((state) => state.time);
    this.player.stop();
    this.player.go(times.reduce((best, t, k) => (Math.abs(t - time) < Math.abs(times[best] - time) ? k : best), 0));
  }

  setWarp(warp) {
    this.warp = warp;
    byId('warp').value = warp;
    const { orbit } = this.view;
    const { isAtHome } = orbit;
    orbit.setHome(...this.reach());
    if (isAtHome) orbit.reset();
    this.showClip();
    this.show();
  }

  showClip() {
    const axis = byId('clip').value === '' ? null : Number(byId('clip').value);
    byId('clip-settings').hidden = axis === null;
    if (axis !== this.clipAxis) {
      this.clipAxis = axis;
      // At first the part of the body that is nearer to the camera is cut away.
      if (axis !== null) this.isNearBelow = this.view.orbit.axes().z.getComponent(axis) < 0;
    }
    if (axis === null) { this.view.clip(null); return; }
    const [low, high] = this.reach();
    const isOther = byId('clip-flip').getAttribute('aria-pressed') === 'true';
    // The plane moves from a little before to a little behind the body, so that at both ends all of the body is on one side.
    const share = -0.002 + 1.004 * Number(byId('clip-place').value) / 1000;
    this.view.clip(axis, low[axis] + (high[axis] - low[axis]) * share, this.isNearBelow !== isOther);
  }

  /** Keeps a point that was clicked: its values are shown all the time. Without a point, none is kept any more. */
  keep(point) {
    this.kept.point = point;
    this.hovered = null;
    this.kept.show(this.states, this.option);
    this.showTime();
    this.showPoint();
  }

  /** Keeps the point with the largest value of the state. */
  keepLargest() {
    let best = 0;
    for (let v = 1; v < this.values.length; ++v) if (this.values[v] > this.values[best]) best = v;
    const place = this.surface.triangles.indexOf(best);
    this.keep({ triangle: Math.floor(place / 3), second: place % 3 === 1 ? 1 : 0, third: place % 3 === 2 ? 1 : 0 });
  }

  /** Shows the values at the point under the pointer, or else at the kept point. */
  showPoint() {
    const { surface, kept } = this;
    this.view.mark(kept.point ? surface.at(kept.point, surface.places, 3) : null);
    const point = this.hovered || kept.point;
    if (!point) { showReadout(byId('readout'), null); return; }
    const state = this.states[this.state];
    const byName = (name) => this.options.find((one) => one.name === name);
    const place = surface.at(point, surface.restPlaces, 3);
    const moved = ['x', 'y', 'z'].map((c) => surface.valueAt(point, byName(`displacement_${c}`), state));
    const rows = [this.vectorRow('at rest', place, 1e-6 * this.size()), this.vectorRow('displacement', moved, state.displacement.unit)];
    for (const option of new Set([byName('displacement'), this.option, byName('von_mises')].filter(Boolean))) {
      const value = surface.valueAt(point, option, state);
      const digits = option.names ? 0 : meaningfulDigits(value, state[option.field].unit);
      rows.push([option.label, option.names ? option.names[value] : quantity(digits ? value : 0, option.unit, digits || 1)]);
    }
    showReadout(byId('readout'), rows);
  }

  /** A row of the readout for a vector: the name with the unit, and three numbers in that unit. */
  vectorRow(name, numbers, resolution) {
    const scale = withPrefix(Math.max(...numbers.map(Math.abs), resolution), 'm');
    return [`${name} [${scale.unit}]`, ...numbers.map((x) => {
      const digits = meaningfulDigits(x, resolution);
      return digits ? plainNumber(x * scale.factor, digits) : '0';
    })];
  }
}
