// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The point of the drawn surface that a ray meets first.

/**
 * Finds the point by Moeller and Trumbore's test for each triangle. @p origin and @p direction of the ray are arrays of three numbers;
 * @p visible(x, y, z) tells whether a place is drawn. Returns the triangle, the shares of its second and third vertex in the point, and
 * whether the triangle is seen from inside; or nothing if the ray meets no triangle.
 */
function meet(positions, triangles, origin, direction, visible) {
  const [ox, oy, oz] = origin;
  const [dx, dy, dz] = direction;
  let best = null;
  let nearest = Infinity;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ax = positions[a], ay = positions[a + 1], az = positions[a + 2];
    const ux = positions[b] - ax, uy = positions[b + 1] - ay, uz = positions[b + 2] - az;
    const vx = positions[c] - ax, vy = positions[c + 1] - ay, vz = positions[c + 2] - az;
    const px = dy * vz - dz * vy, py = dz * vx - dx * vz, pz = dx * vy - dy * vx;
    const determinant = ux * px + uy * py + uz * pz;
    if (determinant === 0) continue;
    const sx = ox - ax, sy = oy - ay, sz = oz - az;
    const second = (sx * px + sy * py + sz * pz) / determinant;
    if (!(second >= 0 && second <= 1)) continue;
    const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
    const third = (dx * qx + dy * qy + dz * qz) / determinant;
    if (!(third >= 0 && second + third <= 1)) continue;
    const distance = (vx * qx + vy * qy + vz * qz) / determinant;
    if (distance < 0 || distance >= nearest) continue;
    if (!visible(ox + distance * dx, oy + distance * dy, oz + distance * dz)) continue;
    nearest = distance;
    best = { triangle: t / 3, second, third, isInside: determinant < 0 };
  }
  return best;
}
