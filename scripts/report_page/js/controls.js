// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Methods of Report for the controls below the view and for the keys.

const CONTROLS = {
  makeControls() {
    byId('field').append(...this.options.map((option) => element('option', { value: option.name }, option.label)));
    byId('field').value = this.option.name;
    byId('field').addEventListener('change', () => {
      this.option = this.options.find((option) => option.name === byId('field').value);
      byId('range').disabled = Boolean(this.option.names);
      this.fillOwnRange();
      this.show();
      this.kept.show(this.states, this.option);
      this.showTime();
    });
    this.makeRangeControls();
    byId('warp').addEventListener('input', () => {
      const warp = byId('warp').valueAsNumber;
      if (warp >= 0 && Number.isFinite(warp)) this.setWarp(warp);
    });
    byId('true-scale').addEventListener('click', () => this.setWarp(1));
    for (const id of ['clip', 'clip-place']) byId(id).addEventListener('input', () => this.showClip());
    byId('clip-flip').setAttribute('aria-pressed', 'false');
    byId('clip-flip').addEventListener('click', () => {
      byId('clip-flip').setAttribute('aria-pressed', byId('clip-flip').getAttribute('aria-pressed') !== 'true');
      this.showClip();
    });
    byId('obstacles-label').hidden = this.view.obstacles.children.length === 0;
    for (const [id, object] of [['outline', this.view.outline], ['edges', this.view.edges], ['obstacles', this.view.obstacles]]) {
      byId(id).addEventListener('change', () => { object.visible = byId(id).checked; this.view.draw(); });
    }
    // The edges of a thinned surface are not the edges of cells, so they are not offered.
    byId('edges-label').hidden = this.description.view.isThinned;
    for (const button of document.querySelectorAll('[data-look]')) button.addEventListener('click', () => this.view.orbit.look(button.dataset.look));
    for (const button of document.querySelectorAll('[data-mode]')) button.addEventListener('click', () => this.chooseMode(Number(button.dataset.mode)));
    this.showMode();
    this.listenToPointer();
    document.addEventListener('keydown', (event) => this.key(event));
  },

  makeRangeControls() {
    if (this.isModes) byId('range').querySelector('[value=state]').remove();
    byId('range').addEventListener('change', () => {
      byId('own').hidden = byId('range').value !== 'own';
      this.fillOwnRange();
      this.show();
    });
    for (const id of ['low', 'high']) byId(id).addEventListener('input', () => this.show());
    byId('bands').addEventListener('change', () => this.show());
    this.fillOwnRange();
  },

  /** Fills the fields for a range of one's own with the range of all states, to begin with. */
  fillOwnRange() {
    if (this.option.names) return;
    const [low, high] = this.fullRange(this.option.name);
    this.ownScale = withPrefix(Math.max(Math.abs(low), Math.abs(high)), this.option.unit);
    byId('low').value = Number((low * this.ownScale.factor).toPrecision(4));
    byId('high').value = Number((high * this.ownScale.factor).toPrecision(4));
    byId('own-unit').textContent = this.ownScale.unit;
  },

  chooseMode(index) {
    const k = this.description.view.states.findIndex((state) => state.index === index);
    if (k < 0 || !this.player) return;
    this.state = k;
    this.showMode();
    this.kept.point = null;
    this.setWarp(this.warp);
    if (!isStill()) this.player.play();
  },

  showMode() {
    const { index } = this.description.view.states[this.state];
    for (const button of document.querySelectorAll('[data-mode]')) button.setAttribute('aria-pressed', Number(button.dataset.mode) === index);
  },

  listenToPointer() {
    const canvas = byId('canvas');
    let place = null;
    canvas.addEventListener('pointermove', (event) => {
      if (event.buttons || event.pointerType === 'touch') return;
      if (!place) {
        requestAnimationFrame(() => {
          if (place && place !== 'gone') this.hovered = this.view.pick(place);
          place = null;
          this.showPoint();
        });
      }
      place = { x: event.clientX, y: event.clientY };
    });
    canvas.addEventListener('pointerleave', () => {
      if (place) place = 'gone';
      this.hovered = null;
      this.showPoint();
    });
  },

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { target } = event;
    const isInView = target === byId('canvas');
    const hasOwnKeys = target.matches('input:not([type=checkbox]), select, textarea, button, summary, a, .chart svg');
    const isSlider = target === byId('time');
    if (event.key === ' ' && (!hasOwnKeys || isSlider) && !target.matches('[type=checkbox]')) {
      event.preventDefault();
      this.player?.toggle();
      return;
    }
    if ((isInView && this.keyInView(event)) || (!hasOwnKeys && this.keyOfTime(event))) event.preventDefault();
  },

  keyOfTime(event) {
    if (!this.player || event.shiftKey) return false;
    const end = this.player.places.length - 1;
    const by = { ArrowLeft: -1, ArrowRight: 1, Home: -end, End: end }[event.key];
    if (by) this.player.step(by);
    return Boolean(by);
  },

  keyInView(event) {
    const { orbit } = this.view;
    const turns = { ArrowLeft: [-0.12, 0], ArrowRight: [0.12, 0], ArrowUp: [0, 0.12], ArrowDown: [0, -0.12] };
    if (turns[event.key] && event.shiftKey) {
      orbit.turn(...turns[event.key]);
      return true;
    }
    const act = { '+': () => orbit.zoomBy(1.25), '=': () => orbit.zoomBy(1.25), '-': () => orbit.zoomBy(0.8), r: () => orbit.look('slanted'),
      m: () => this.keepLargest(), x: () => orbit.look('x'), y: () => orbit.look('y'), z: () => orbit.look('z'), Escape: () => this.keep(null) };
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    act[name]?.();
    return Boolean(act[name]);
  },
};

Object.assign(Report.prototype, CONTROLS);
