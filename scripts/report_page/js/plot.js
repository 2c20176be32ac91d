// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A plot of curves. It shows the values at a cursor, which the pointer or keys move, and a mark at the time of the view. Curves can be hidden.

const PLOT = { height: 230, left: 58, right: 12, top: 10, bottom: 34 };

class Plot {
  /** @p chart is a chart as charts.py makes it. A click calls @p chosen(x). */
  constructor(figure, chart, chosen) {
    Object.assign(this, { figure, chart, chosen });
    this.series = chart.series.map((one, i) => ({ ...one, x: one.x || chart.x, colour: `var(--series-${i % 6})`, isShown: true }));
    const largest = Math.max(...this.series.flatMap((one) => one.y.map((y) => Math.abs(y || 0))), 0);
    this.scale = chart.log ? { factor: 1, unit: '' } : withPrefix(largest, chart.unit);
    this.xScale = withPrefix(Math.max(...this.series.flatMap((one) => one.x.map((x) => Math.abs(x || 0)))), chart.log ? '-' : chart.x_unit);
    this.svg = element('svg', { role: 'img', tabindex: 0, 'aria-label': this.summary() });
    this.keyline = element('div', { class: 'keyline' });
    const unit = this.scale.unit;
    figure.replaceChildren(element('figcaption', {}, chart.title + (unit ? ` [${unit}]` : '')), this.svg, this.keyline);
    this.makeKeys();
    this.listen();
    new ResizeObserver(() => this.draw()).observe(figure);
  }

  summary() {
    const parts = this.series.map((one) => {
      const finite = one.y.filter((y) => y !== null);
      if (!finite.length) return one.label;
      const [low, high] = [Math.min(...finite), Math.max(...finite)].map((y) => quantity(y, this.chart.unit));
      return `${one.label} from ${low} to ${high}`;
    });
    return `${this.chart.title} over ${this.chart.x_label}: ${parts.join('; ')}`;
  }

  makeKeys() {
    this.at = element('span', { class: 'at' });
    this.keyline.append(...this.series.map((one) => {
      const line = element('i');
      line.style.borderColor = one.colour;
      one.value = element('span');
      const button = element('button', { type: 'button', 'aria-pressed': 'true' }, line, one.label + this.slope(one), one.value);
      button.addEventListener('click', () => {
        one.isShown = !one.isShown;
        button.setAttribute('aria-pressed', one.isShown);
        this.draw();
      });
      return button;
    }), this.at);
  }

  /** The slope between the last two points of a logarithmic curve, as a text. Over the size of cells, it is the order of convergence. */
  slope(one) {
    const n = one.x.length;
    if (!this.chart.log || n < 2) return '';
    const slope = Math.log(one.y[n - 1] / one.y[n - 2]) / Math.log(one.x[n - 1] / one.x[n - 2]);
    return `, slope ${slope.toFixed(2).replace('-', MINUS)}`;
  }

  listen() {
    const { svg } = this;
    svg.addEventListener('pointermove', (event) => this.point(event.clientX - svg.getBoundingClientRect().left));
    svg.addEventListener('pointerleave', () => this.setCursor(null));
    svg.addEventListener('click', () => { if (this.cursor !== null && this.cursor !== undefined) this.chosen(this.cursor); });
    svg.addEventListener('blur', () => this.setCursor(null));
    svg.addEventListener('keydown', (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      const all = this.abscissas();
      if (event.key === 'Enter' && this.cursor !== null) this.chosen(this.cursor);
      if (!by || !all.length) return;
      event.preventDefault();
      event.stopPropagation();
      const now = all.indexOf(this.cursor);
      this.setCursor(all[Math.max(0, Math.min(all.length - 1, now < 0 ? (by > 0 ? 0 : all.length - 1) : now + by))]);
    });
  }

  abscissas() {
    return [...new Set(this.series.filter((one) => one.isShown).flatMap((one) => one.x))].sort((a, b) => a - b);
  }

  /** Moves the cursor to the abscissa nearest to the pointer. */
  point(pixel) {
    const all = this.abscissas();
    if (!all.length || !this.toX) return;
    this.setCursor(all.reduce((best, x) => (Math.abs(this.toX(x) - pixel) < Math.abs(this.toX(best) - pixel) ? x : best)));
  }

  setCursor(x) {
    this.cursor = x;
    this.cursorLine?.remove();
    for (const one of this.series) {
      const i = x === null || !one.isShown ? -1 : one.x.indexOf(x);
      one.value.textContent = i < 0 ? '' : `\u00a0${plainNumber(one.y[i] === null ? null : one.y[i] * this.scale.factor, 5)}`;
    }
    this.at.textContent = x === null ? '' : `at ${this.chart.x_label.replace(/,.*/, '')} ${plainNumber(x * this.xScale.factor, 5)} ${this.xScale.unit}`;
    if (x !== null && this.toX) {
      this.cursorLine = this.line('cursor', this.toX(x), PLOT.top, this.toX(x), PLOT.height - PLOT.bottom);
      this.svg.append(this.cursorLine);
    }
  }

  /** Marks the time that the view shows by a line. */
  setMark(x) {
    this.mark = x;
    this.markLine?.remove();
    if (x === undefined || !this.toX || x < this.range.x[0] || x > this.range.x[1]) return;
    this.markLine = this.line('mark', this.toX(x), PLOT.top, this.toX(x), PLOT.height - PLOT.bottom);
    this.svg.append(this.markLine);
  }

  line(name, x1, y1, x2, y2) {
    return element('line', { class: name, x1, y1, x2, y2 });
  }

  /** The range of both axes: from the least to the largest number of the curves that are shown, with a little room. */
  findRange() {
    const shown = this.series.filter((one) => one.isShown);
    const wider = ([low, high], v) => (v === null ? [low, high] : [Math.min(low, v), Math.max(high, v)]);
    const span = (values) => values.reduce(wider, [Infinity, -Infinity]);
    const x = span(shown.flatMap((one) => one.x));
    const y = span(shown.flatMap((one) => one.y));
    if (this.chart.log) return { x: [x[0] / 1.25, x[1] * 1.25], y: [y[0] / 1.5, y[1] * 1.5] };
    const room = y[1] > y[0] ? 0.04 * (y[1] - y[0]) : Math.max(1e-3 * Math.abs(y[0]), 1e-30);
    return { x: x[1] > x[0] ? x : [x[0] - 0.5, x[1] + 0.5], y: [y[0] - room, y[1] + room] };
  }

  draw() {
    const width = this.figure.clientWidth;
    if (!width) return;
    const { left, right, top, bottom, height } = PLOT;
    this.svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.svg.replaceChildren();
    if (!this.series.some((one) => one.isShown)) return;
    this.range = this.findRange();
    const warp = this.chart.log ? Math.log : (v) => v;
    const along = ([low, high], from, to) => (v) => from + (to - from) * (warp(v) - warp(low)) / (warp(high) - warp(low));
    this.toX = along(this.range.x, left, width - right);
    this.toY = along(this.range.y, height - bottom, top);
    this.drawAxes(width);
    for (const one of this.series) if (one.isShown) this.drawCurve(one);
    this.setMark(this.mark);
  }

  ticks(range, n, factor) {
    if (!this.chart.log) return roundTicks(range[0] * factor, range[1] * factor, n).map((value) => [value / factor, plainNumber(value)]);
    const [low, high] = range.map(Math.log10);
    const factors = high - low < 1.3 ? [1, 2, 5] : high - low < 2.5 ? [1, 3] : [1];
    const step = Math.max(1, Math.ceil((high - low) / n));
    const found = [];
    for (let p = Math.floor(low); p <= high; ++p) {
      for (const f of p % step === 0 ? factors : []) {
        const value = f * 10 ** p;
        if (value >= range[0] && value <= range[1]) found.push([value, f === 1 && Math.abs(p) > 2 ? `10${superscript(p)}` : plainNumber(value, 1)]);
      }
    }
    return found;
  }

  drawAxes(width) {
    const { left, right, top, bottom, height } = PLOT;
    for (const [value, text] of this.ticks(this.range.y, 5, this.scale.factor)) {
      const y = this.toY(value);
      this.svg.append(this.line('grid', left, y, width - right, y), element('text', { x: left - 6, y: y + 4, 'text-anchor': 'end' }, text));
    }
    const n = Math.max(2, Math.floor(width / 90));
    for (const [value, text] of this.ticks(this.range.x, n, this.xScale.factor)) {
      const x = this.toX(value);
      this.svg.append(this.line('grid', x, top, x, height - bottom), element('text', { x, y: height - bottom + 14, 'text-anchor': 'middle' }, text));
    }
    const unit = this.chart.log ? this.chart.x_unit.replace('-', '') : this.xScale.unit;
    this.svg.append(this.line('axis', left, height - bottom, width - right, height - bottom),
      element('text', { x: (left + width - right) / 2, y: height - 4, 'text-anchor': 'middle' }, this.chart.x_label + (unit ? ` [${unit}]` : '')));
  }

  drawCurve(one) {
    const parts = [];
    let isDrawing = false;
    one.x.forEach((x, i) => {
      if (one.y[i] === null) { isDrawing = false; return; }
      parts.push(`${isDrawing ? 'L' : 'M'}${this.toX(x).toFixed(1)} ${this.toY(one.y[i]).toFixed(1)}`);
      isDrawing = true;
    });
    this.svg.append(element('path', { class: 'curve', d: parts.join(''), style: `stroke: ${one.colour}` }));
    if (this.chart.points && one.x.length < 60) {
      one.x.forEach((x, i) => {
        if (one.y[i] !== null) this.svg.append(element('circle', { cx: this.toX(x), cy: this.toY(one.y[i]), r: 2.5, style: `fill: ${one.colour}` }));
      });
    }
  }
}
