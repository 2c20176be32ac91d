// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The drawn surface of a state. Places and values at the vertices are interpolated from the nodes of the patches.

class Surface {
  /** @p geometry is that of readGeometry(), @p description that of encode.py. */
  constructor(geometry, description) {
    Object.assign(this, geometry);
    this.n = description.nodes;
    this.nVertices = this.vertexFaces.length;
    this.prepareWeights(description);
    this.restPlaces = new Float32Array(3 * this.nVertices);
    const rest = this.rest;
    this.eachVertex((v, nodes, weights) => {
      for (let c = 0; c < 3; ++c) {
        let sum = 0;
        for (let k = 0; k < nodes.length; ++k) sum += weights[k] * rest[3 * nodes[k] + c];
        this.restPlaces[3 * v + c] = sum;
      }
    });
    this.places = new Float32Array(this.restPlaces);
    this.normals = new Float32Array(3 * this.nVertices);
    this.colours = new Float32Array(2 * this.nVertices).fill(0.5);
  }

  /** Finds for each vertex the nodes that it depends on, and their weights: the nodes of its patch whose shape functions are not zero at
   * the vertex. */
  prepareWeights({ places, nodesOfFace }) {
    const ofPlace = Array.from({ length: places }, (_, place) => {
      const all = this.weights.subarray(place * nodesOfFace, (place + 1) * nodesOfFace);
      const kept = [...all.keys()].filter((k) => Math.abs(all[k]) > 1e-6);
      return { kept, weights: kept.map((k) => all[k]) };
    });
    this.starts = new Uint32Array(this.nVertices + 1);
    for (let v = 0; v < this.nVertices; ++v) this.starts[v + 1] = this.starts[v] + ofPlace[this.vertexPlaces[v]].kept.length;
    this.nodeList = new Uint32Array(this.starts[this.nVertices]);
    this.weightList = new Float32Array(this.nodeList.length);
    for (let v = 0, i = 0; v < this.nVertices; ++v) {
      const { kept, weights } = ofPlace[this.vertexPlaces[v]];
      kept.forEach((k, j) => {
        this.nodeList[i] = this.faces[this.vertexFaces[v] * nodesOfFace + k];
        this.weightList[i++] = weights[j];
      });
    }
  }

  eachVertex(visit) {
    for (let v = 0; v < this.nVertices; ++v) {
      visit(v, this.nodeList.subarray(this.starts[v], this.starts[v + 1]), this.weightList.subarray(this.starts[v], this.starts[v + 1]));
    }
  }

  /** Adds a component of a state's field, times the factor, at all vertices to every stride-th number of @p out, from the offset on. */
  add(field, component, factor, out, offset, stride) {
    const { values, unit } = field;
    const first = component * this.n;
    const { starts, nodeList, weightList, nVertices } = this;
    for (let v = 0, i = 0; v < nVertices; ++v) {
      let sum = 0;
      for (const end = starts[v + 1]; i < end; ++i) sum += weightList[i] * values[first + nodeList[i]];
      out[offset + stride * v] += factor * unit * sum;
    }
  }

  /** Moves the vertices to their places at rest plus the factor times the displacement of the state. */
  displace(state, factor) {
    this.places.set(this.restPlaces);
    if (factor !== 0) for (let c = 0; c < 3; ++c) this.add(state.displacement, c, factor, this.places, c, 3);
    this.computeNormals();
  }

  /** Enlarges the box with these corners so that it contains all nodes at their places at rest plus the factor times the displacement. */
  extend(low, high, displacement, factor) {
    const { n, rest } = this;
    for (let c = 0; c < 3; ++c) {
      for (let k = 0; k < n; ++k) {
        const x = rest[3 * k + c] + factor * displacement.unit * displacement.values[c * n + k];
        if (x < low[c]) low[c] = x;
        else if (x > high[c]) high[c] = x;
      }
    }
  }

  /** The values of an option at the vertices. */
  valuesOf(option, state) {
    const values = new Float32Array(this.nVertices);
    if (option.names) {
      for (let v = 0; v < this.nVertices; ++v) values[v] = option.indices.get(this.regions[this.nodeList[this.starts[v]]]);
      return values;
    }
    const field = state[option.field];
    if (option.component >= 0) {
      this.add(field, option.component, 1, values, 0, 1);
      return values;
    }
    const parts = new Float32Array(3 * this.nVertices);
    for (let c = 0; c < 3; ++c) this.add(field, c, 1, parts, c, 3);
    for (let v = 0; v < this.nVertices; ++v) values[v] = Math.hypot(parts[3 * v], parts[3 * v + 1], parts[3 * v + 2]);
    return values;
  }

  /** Computes the place of each vertex in the row of colours: 0 for the value low, 1 for the value high. */
  colour(values, low, high) {
    const scale = high > low ? 1 / (high - low) : 0;
    for (let v = 0; v < this.nVertices; ++v) this.colours[2 * v] = scale ? Math.max(0, Math.min(1, (values[v] - low) * scale)) : 0.5;
  }

  /** Computes the normals at the vertices: means of the normals of their triangles, weighted with the areas. */
  computeNormals() {
    const { triangles, places, normals } = this;
    normals.fill(0);
    for (let t = 0; t < triangles.length; t += 3) {
      const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
      const ux = places[b] - places[a], uy = places[b + 1] - places[a + 1], uz = places[b + 2] - places[a + 2];
      const vx = places[c] - places[a], vy = places[c + 1] - places[a + 1], vz = places[c + 2] - places[a + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      normals[a] += x; normals[a + 1] += y; normals[a + 2] += z;
      normals[b] += x; normals[b + 1] += y; normals[b + 2] += z;
      normals[c] += x; normals[c + 1] += y; normals[c + 2] += z;
    }
    for (let v = 0; v < normals.length; v += 3) {
      const length = Math.hypot(normals[v], normals[v + 1], normals[v + 2]) || 1;
      normals[v] /= length;
      normals[v + 1] /= length;
      normals[v + 2] /= length;
    }
  }

  /** Interpolates numbers at the vertices (components side by side) to a point of a triangle, as meet() returns it. */
  at(point, numbers, components) {
    const [a, b, c] = this.triangles.subarray(3 * point.triangle, 3 * point.triangle + 3);
    return Array.from({ length: components }, (_, i) => (1 - point.second - point.third) * numbers[components * a + i]
      + point.second * numbers[components * b + i] + point.third * numbers[components * c + i]);
  }

  /** The value of an option in a state at such a point, computed from the nodes that the triangle depends on alone. */
  valueAt(point, option, state) {
    if (option.names) return option.indices.get(this.regions[this.nodeList[this.starts[this.triangles[3 * point.triangle]]]]);
    const shares = [1 - point.second - point.third, point.second, point.third];
    const components = option.component >= 0 ? [option.component] : [0, 1, 2];
    const { values, unit } = state[option.field];
    const found = components.map((component) => shares.reduce((sum, share, corner) => {
      const v = this.triangles[3 * point.triangle + corner];
      let own = 0;
      for (let i = this.starts[v]; i < this.starts[v + 1]; ++i) own += this.weightList[i] * values[component * this.n + this.nodeList[i]];
      return sum + share * own * unit;
    }, 0));
    return option.component >= 0 ? found[0] : Math.hypot(...found);
  }

  /** The area of all triangles as they are drawn. */
  area() {
    let sum = 0;
    const { triangles, places } = this;
    const side = (a, b) => [0, 1, 2].map((c) => places[3 * b + c] - places[3 * a + c]);
    for (let t = 0; t < triangles.length; t += 3) {
      const [ux, uy, uz] = side(triangles[t], triangles[t + 1]);
      const [vx, vy, vz] = side(triangles[t], triangles[t + 2]);
      sum += Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
    }
    return sum;
  }
}
