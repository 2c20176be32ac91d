// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The point of the body that was clicked: it is marked, its values are shown all the time, and its history is plotted.

class Kept {
  /** A click into the plot calls @p chosen(x). */
  constructor(place, surface, description, chosen) {
    Object.assign(this, { place, surface, description, chosen });
    this.point = null;
    this.hasHistory = description.kind === 'simulation' && description.view.states.length > 2;
  }

  /** Plots the history of an option at the kept point, over the states of the page. */
  show(states, option) {
    this.place.replaceChildren();
    this.plot = null;
    if (!this.point || !this.hasHistory || option.names) return;
    const { surface, point } = this;
    const at = surface.at(point, surface.restPlaces, 3).map((x) => plainNumber(x)).join(', ');
    const x = this.description.view.states.map((state) => state.time);
    const y = states.map((state) => surface.valueAt(point, option, state));
    const figure = element('figure', { class: 'chart', id: 'history-of-point' });
    this.place.append(figure);
    const label = this.description.isStatic ? 'load parameter t' : 'time';
    this.plot = new Plot(figure, { title: `At (${at}) m at rest: ${option.label}`, unit: option.unit, x_label: label, x_unit: 's', x,
      series: [{ label: option.label, y }], log: false, points: true }, this.chosen);
  }
}
