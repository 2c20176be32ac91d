// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A camera that can be turned around a body, with z upwards, in parallel projection.

const LOOKS = {
  slanted: [-62 * Math.PI / 180, 24 * Math.PI / 180],
  x: [0, 0],
  y: [-Math.PI / 2, 0],
  z: [-Math.PI / 2, Math.PI / 2],
};

class Orbit {
  /** @p moved is called after each change of the camera; @p clicked is called with the place in pixels after a click or tap that
   * was no drag. */
  constructor(canvas, camera, moved, clicked) {
    Object.assign(this, { canvas, camera, moved, clicked });
    this.target = new THREE.Vector3();
    this.zoom = 1;
    this.pointers = new Map();
    this.look('slanted');
    canvas.addEventListener('pointerdown', (event) => this.press(event));
    canvas.addEventListener('pointermove', (event) => this.drag(event));
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, (event) => this.release(event));
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
  }

  /** Sets the box that reset() shows as a whole; its corners are arrays of three numbers. */
  setHome(low, high) {
    const middle = new THREE.Vector3(...low.map((x, c) => (x + high[c]) / 2));
    this.home = { low, high, middle, radius: Math.hypot(...low.map((x, c) => high[c] - x)) / 2 };
  }

  get isAtHome() {
    return !this.home || (this.zoom === 1 && this.target.equals(this.home.middle));
  }

  reset() {
    this.target.copy(this.home.middle);
    this.zoom = 1;
    this.frame();
    this.apply();
  }

  /** Computes half of the width and of the height of the box, as the camera sees it. */
  frame() {
    const { x, y } = this.axes();
    const sides = this.home.low.map((v, c) => (this.home.high[c] - v) / 2);
    const extent = (axis) => axis.toArray().reduce((sum, a, c) => sum + Math.abs(a) * sides[c], 0);
    this.half = [extent(x), extent(y)].map((size) => Math.max(1.12 * size, 0.05 * this.home.radius));
  }

  look(name) {
    [this.azimuth, this.elevation] = LOOKS[name];
    if (this.home) this.reset();
  }

  /** Turns the camera around the body by angles [radians], to the right and upwards. */
  turn(right, up) {
    this.azimuth += right;
    this.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.elevation + up));
    this.apply();
  }

  /** Moves the camera so that the body moves by so many pixels. */
  move(right, down) {
    const scale = (this.camera.top - this.camera.bottom) / this.canvas.clientHeight;
    const { x, y } = this.axes();
    this.target.addScaledVector(x, -right * scale).addScaledVector(y, down * scale);
    this.apply();
  }

  /** Zooms by a factor. The point of the body at the place (in pixels; by default the middle) stays there. */
  zoomBy(factor, place) {
    const before = this.camera.top;
    this.zoom = Math.max(0.2, Math.min(500, this.zoom * factor));
    this.apply();
    if (!place) return;
    const box = this.canvas.getBoundingClientRect();
    const share = (before / this.camera.top - 1);
    this.move(-(place.x - box.left - box.width / 2) * share, -(place.y - box.top - box.height / 2) * share);
  }

  /** Unit vectors x to the right, y upwards and z towards the camera. */
  axes() {
    const [c, s] = [Math.cos(this.azimuth), Math.sin(this.azimuth)];
    const [d, t] = [Math.cos(this.elevation), Math.sin(this.elevation)];
    return { x: new THREE.Vector3(-s, c, 0), y: new THREE.Vector3(-c * t, -s * t, d), z: new THREE.Vector3(c * d, s * d, t) };
  }

  apply() {
    const { x, y, z } = this.axes();
    const { camera } = this;
    const aspect = this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1);
    const half = Math.max(this.half[1], this.half[0] / aspect) / this.zoom;
    const reach = 20 * this.home.radius;
    camera.top = half;
    camera.bottom = -half;
    camera.right = half * aspect;
    camera.left = -half * aspect;
    // The range of depth is so long that nothing is cut off, even if the body moves far.
    camera.near = 0;
    camera.far = 2 * reach;
    camera.position.copy(this.target).addScaledVector(z, reach);
    camera.quaternion.setFromRotationMatrix(new THREE.Matrix4().makeBasis(x, y, z));
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    this.moved();
  }

  press(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.path = this.pointers.size > 1 ? Infinity : 0;
  }

  drag(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
    this.path += Math.abs(dx) + Math.abs(dy);
    const other = [...this.pointers].find(([id]) => id !== event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (other) {
      const distance = (p) => Math.hypot(p.x - other[1].x, p.y - other[1].y);
      this.move(dx / 2, dy / 2);
      this.zoomBy(Math.max(distance({ x: event.clientX, y: event.clientY }), 1) / Math.max(distance(last), 1));
    } else if (event.shiftKey || event.buttons & 6) this.move(dx, dy);
    else if (this.path > 3) this.turn(-dx * 0.008, dy * 0.008);
  }

  release(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    if (event.type === 'pointerup' && event.button === 0 && this.path <= 3) this.clicked({ x: event.clientX, y: event.clientY });
  }

  wheel(event) {
    // The wheel scrolls the page, and does not zoom, until the reader has clicked the view.
    if (document.activeElement !== this.canvas && !event.ctrlKey) return;
    event.preventDefault();
    this.zoomBy(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.04 : 0.0015)), { x: event.clientX, y: event.clientY });
  }
}
