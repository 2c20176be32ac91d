// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A slider with buttons to play, to stop and to step. play() runs through the places of the slider in so many seconds, again and again.

const ICONS = { play: 'M4 2.5v11l9-5.5z', stop: 'M3.5 2.5h3v11h-3zM9.5 2.5h3v11h-3z' };

class Player {
  /** @p places are times of the slider's places, as shares of the whole from 0 to 1; @p rest is the share of time that play() stays at the end;
   * @p shown(place) draws a place. */
  constructor({ slider, button, speed }, places, seconds, rest, shown) {
    Object.assign(this, { slider, button, speed, places, seconds, rest, shown });
    slider.max = places.length - 1;
    slider.disabled = button.disabled = places.length < 2;
    slider.addEventListener('input', () => { this.stop(); this.go(Number(slider.value)); });
    button.addEventListener('click', () => this.toggle());
  }

  get place() {
    return Number(this.slider.value);
  }

  go(place) {
    const last = this.places.length - 1;
    this.slider.value = Math.max(0, Math.min(last, place));
    this.shown(this.place);
  }

  step(by) {
    this.stop();
    this.go(this.place + by);
  }

  toggle() {
    if (this.isPlaying) this.stop();
    else this.play();
  }

  play() {
    if (this.isPlaying || this.places.length < 2) return;
    this.setPlaying(true);
    const isAtEnd = this.place === this.places.length - 1;
    this.share = isAtEnd ? 0 : this.places[this.place];
    this.last = performance.now();
    const frame = (now) => {
      if (!this.isPlaying) return;
      this.share += (now - this.last) / 1000 * Number(this.speed.value) / this.seconds;
      this.last = now;
      if (this.share > 1 + this.rest) this.share = this.rest ? 0 : this.share % 1;
      let place = this.places.findIndex((share) => share > this.share + 1e-9) - 1;
      if (place < 0) place = this.places.length - 1;
      if (place !== this.place) this.go(place);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  stop() {
    if (this.isPlaying) this.setPlaying(false);
  }

  setPlaying(isPlaying) {
    this.isPlaying = isPlaying;
    this.button.setAttribute('aria-label', isPlaying ? 'Stop' : 'Play');
    this.button.querySelector('path').setAttribute('d', isPlaying ? ICONS.stop : ICONS.play);
  }
}
