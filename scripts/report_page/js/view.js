// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The scene: the surface with its colours, edges, the body at rest, the clip plane. It is drawn only when something has changed.

class View {
  /** Throws if the browser has no WebGL. */
  constructor(canvas, surface, obstacles, clicked) {
    Object.assign(this, { canvas, surface });
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, stencil: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.localClippingEnabled = true;
    this.renderer.autoClearStencil = true;
    this.scene = new THREE.Scene();
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
    const light = new THREE.DirectionalLight(0xffffff, 0.42);
    light.position.set(0.4, 0.6, 1);
    this.camera.add(light);
    this.scene.add(this.camera, new THREE.AmbientLight(0xffffff, 0.62));
    this.plane = new THREE.Plane(new THREE.Vector3(-1, 0, 0), 0);
    this.makeBody();
    this.makeLines();
    this.makeCap();
    this.makeObstacles(obstacles);
    this.onCamera = () => {};
    this.orbit = new Orbit(canvas, this.camera, () => { this.onCamera(); this.draw(); }, clicked);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.applyTheme());
    this.applyTheme();
  }

  makeBody() {
    const { surface } = this;
    const geometry = new THREE.BufferGeometry();
    const attribute = (array, size) => {
      const made = new THREE.BufferAttribute(array, size);
      made.setUsage?.(THREE.DynamicDrawUsage);
      return made;
    };
    geometry.setAttribute('position', attribute(surface.places, 3));
    geometry.setAttribute('normal', attribute(surface.normals, 3));
    // A vertex has its place in the row of colours as a texture coordinate, so that between vertices the values are interpolated, and not the colours.
    geometry.setAttribute('uv', attribute(surface.colours, 2));
    geometry.setIndex(new THREE.BufferAttribute(surface.triangles, 1));
    this.material = new THREE.MeshPhongMaterial({ specular: 0x0c0c0c, shininess: 20, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1,
      polygonOffsetUnits: 1 });
    this.body = new THREE.Mesh(geometry, this.material);
    // three.js must not leave out bodies that it takes to be out of sight: the bounds for that would have to be computed for each state.
    this.body.frustumCulled = false;
    this.scene.add(this.body);
  }

  lines(positions, index, opacity) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', positions);
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    const made = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ transparent: opacity < 1, opacity }));
    made.frustumCulled = false;
    this.scene.add(made);
    return made;
  }

  makeLines() {
    const { surface } = this;
    const moved = this.body.geometry.getAttribute('position');
    this.edges = this.lines(moved, surface.cellEdges, 0.45);
    this.edges.visible = false;
    // A body without edges, such as a ball, is outlined by the edges of its cells.
    const index = surface.outline.length > 0 ? surface.outline : surface.cellEdges;
    this.outline = this.lines(new THREE.BufferAttribute(surface.restPlaces, 3), index, surface.outline.length > 0 ? 0.8 : 0.25);
    this.marker = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial({ size: 9 * this.renderer.getPixelRatio(), sizeAttenuation: false,
      depthTest: false }));
    this.marker.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3), 3));
    this.marker.frustumCulled = false;
    this.marker.visible = false;
    this.marker.renderOrder = 9;
    this.scene.add(this.marker);
  }

  /** Makes the cap, which fills the cut. In each pixel, the stencil counts back faces less front faces of the clipped body: where the plane is inside
   * of the body the count is not zero, and there the cap is drawn. */
  makeCap() {
    const counter = (side, operation) => {
      const material = new THREE.MeshBasicMaterial({ side, depthWrite: false, depthTest: false, colorWrite: false, stencilWrite: true,
        stencilFunc: THREE.AlwaysStencilFunc, stencilFail: operation, stencilZFail: operation, stencilZPass: operation, clippingPlanes: [this.plane] });
      const made = new THREE.Mesh(this.body.geometry, material);
      made.frustumCulled = false;
      made.renderOrder = 1;
      return made;
    };
    this.cap = new THREE.Mesh(new THREE.PlaneBufferGeometry(1, 1), new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, stencilWrite: true, stencilRef: 0,
      stencilFunc: THREE.NotEqualStencilFunc, stencilFail: THREE.ReplaceStencilOp, stencilZFail: THREE.ReplaceStencilOp,
      stencilZPass: THREE.ReplaceStencilOp }));
    this.cap.renderOrder = 2;
    this.body.renderOrder = 3;
    this.clipped = new THREE.Group();
    this.clipped.add(counter(THREE.BackSide, THREE.IncrementWrapStencilOp), counter(THREE.FrontSide, THREE.DecrementWrapStencilOp));
    this.clipped.visible = this.cap.visible = false;
    this.scene.add(this.clipped, this.cap);
  }

  /** Makes the obstacles, each of {points, triangles, isHollow, moves}. One looks through those that the body is inside of. */
  makeObstacles(obstacles) {
    this.obstacles = new THREE.Group();
    for (const { points, triangles, isHollow, moves } of obstacles) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(points.flat()), 3));
      geometry.setIndex(triangles.flat());
      const material = new THREE.MeshPhongMaterial({ side: THREE.DoubleSide, flatShading: true, specular: 0x000000, transparent: isHollow,
        opacity: isHollow ? 0.2 : 1, depthWrite: !isHollow });
      const made = new THREE.Mesh(geometry, material);
      made.frustumCulled = false;
      // Transparent ones are drawn after all others.
      made.renderOrder = isHollow ? 8 : 4;
      made.moves = moves;
      this.obstacles.add(made);
    }
    this.scene.add(this.obstacles);
  }

  /** Moves the obstacles to where they are in a state of the page. */
  placeObstacles(state) {
    for (const obstacle of this.obstacles.children) obstacle.position.fromArray(obstacle.moves[state]);
  }

  /** Cuts away the part of the body with larger coordinates than @p place along the axis (0, 1, 2), or with smaller ones if flipped. If the axis is null,
   * nothing is cut away. */
  clip(axis, place, flipped) {
    const isOn = axis !== null;
    this.clipped.visible = this.cap.visible = isOn;
    for (const object of [this.body, this.edges]) object.material.clippingPlanes = isOn ? [this.plane] : [];
    if (isOn) {
      const normal = new THREE.Vector3().setComponent(axis, flipped ? 1 : -1);
      this.plane.set(normal, flipped ? -place : place);
      this.cap.position.copy(this.orbit.home.middle).setComponent(axis, place);
      this.cap.scale.setScalar(8 * this.orbit.home.radius);
      this.cap.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
    }
    this.isClipped = isOn;
    this.draw();
  }

  /** Sets the row of colours from low to high. With @p sharp, colours jump, as for bands and names. */
  setColours(row, sharp) {
    const data = new Uint8Array(row.flatMap((rgb) => [...rgb, 255]));
    this.material.map?.dispose();
    const texture = new THREE.DataTexture(data, row.length, 1, THREE.RGBAFormat);
    texture.magFilter = texture.minFilter = sharp ? THREE.NearestFilter : THREE.LinearFilter;
    texture.needsUpdate = true;
    this.material.map = texture;
    this.material.needsUpdate = true;
    this.draw();
  }

  /** Sends the places, normals and colours that the surface has computed to the graphics card. */
  update() {
    for (const attribute of Object.values(this.body.geometry.attributes)) attribute.needsUpdate = true;
    this.draw();
  }

  mark(place) {
    this.marker.visible = place !== null;
    if (place) {
      this.marker.geometry.getAttribute('position').array.set(place);
      this.marker.geometry.getAttribute('position').needsUpdate = true;
    }
    this.draw();
  }

  applyTheme() {
    this.edges.material.color.set(themeColour('lines'));
    this.outline.material.color.set(themeColour('at-rest'));
    this.cap.material.color.set(themeColour('body'));
    this.marker.material.color.set(themeColour('bad'));
    for (const obstacle of this.obstacles.children) obstacle.material.color.set(themeColour('obstacle'));
    this.draw();
  }

  /** The point of the surface under a place of the page in pixels, or nothing. */
  pick(place) {
    const box = this.canvas.getBoundingClientRect();
    const x = 2 * (place.x - box.left) / box.width - 1;
    const y = 1 - 2 * (place.y - box.top) / box.height;
    const origin = new THREE.Vector3(x, y, -1).unproject(this.camera);
    const direction = this.orbit.axes().z.negate();
    const { plane, isClipped } = this;
    const visible = isClipped
      ? (px, py, pz) => plane.normal.x * px + plane.normal.y * py + plane.normal.z * pz + plane.constant >= 0
      : () => true;
    const found = meet(this.surface.places, this.surface.triangles, origin.toArray(), direction.toArray(), visible);
    // A triangle that is seen from inside lies behind the cap, which has no values.
    return isClipped && found?.isInside ? null : found;
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.renderer.setSize(clientWidth, clientHeight, false);
    if (this.orbit.home) this.orbit.apply();
  }

  draw() {
    if (this.requested || !this.orbit?.home) return;
    this.requested = requestAnimationFrame(() => {
      this.requested = 0;
      this.renderer.render(this.scene, this.camera);
      this.frames = (this.frames || 0) + 1;
    });
  }
}
