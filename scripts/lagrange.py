# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Cuts Lagrange tetrahedra, with nodes in VTK's order, into small straight pieces: their surface into triangles, their inside into
tetrahedra. Needs NumPy."""

import itertools

import numpy as np

EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
FACES = ((0, 1, 3), (1, 2, 3), (0, 2, 3), (0, 1, 2))
OUTWARD_FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))


def tetrahedron_nodes(degree):
    """Barycentric coordinates, times the degree, of the nodes of a tetrahedron."""
    unit = np.eye(4, dtype=int)
    nodes = [degree * unit[i] for i in range(4)]
    nodes += [(degree - k) * unit[a] + k * unit[b] for a, b in EDGES for k in range(1, degree)]
    if degree == 3:
        nodes += [unit[a] + unit[b] + unit[c] for a, b, c in FACES]
    return np.array(nodes)


def shape_functions(nodes, degree, at):
    """Values of the shape functions of the nodes (barycentric coordinates times the degree) at the points @p at (barycentric coordinates): a
    row for each point."""
    result = np.ones((len(at), len(nodes)))
    for j, node in enumerate(nodes):
        for i, n in enumerate(node):
            for m in range(n):
                result[:, j] *= (degree * at[:, i] - m) / (n - m)
    return result


def triangle_lattice(n):
    """Cuts a triangle into n^2 triangles, with n parts along each edge. Returns their vertices (barycentric coordinates times n) and the
    triangles."""
    points = [(n - j - k, j, k) for k in range(n + 1) for j in range(n + 1 - k)]
    number = {point: i for i, point in enumerate(points)}
    triangles = []
    for i, j, k in points:
        if i > 0:
            triangles.append((number[i, j, k], number[i - 1, j + 1, k], number[i - 1, j, k + 1]))
        if i > 1:
            triangles.append((number[i - 1, j + 1, k], number[i - 2, j + 1, k + 1], number[i - 1, j, k + 1]))
    return np.array(points), np.array(triangles)


def tetrahedron_lattice(n):
    """Cuts a tetrahedron into n^3 tetrahedra of the same volume (Kuhn's), with n parts along each edge. Returns their vertices (barycentric
    coordinates times n) and the tetrahedra."""
    points = [(n - a, a - b, b - c, c) for a in range(n + 1) for b in range(a + 1) for c in range(b + 1)]
    number = {point: i for i, point in enumerate(points)}
    tetrahedra = []
    for corner in itertools.product(range(n), repeat=3):
        for order in itertools.permutations(range(3)):
            corners = np.array(corner) + np.array([[int(i in order[:k]) for i in range(3)] for k in range(4)])
            keys = [(n - a, a - b, b - c, c) for a, b, c in corners.tolist()]
            if all(key in number for key in keys):
                sign = np.linalg.det(np.array(keys))
                tetrahedra.append([number[key] for key in (keys if sign > 0 else [keys[1], keys[0], keys[2], keys[3]])])
    return np.array(points), np.array(tetrahedra)


class Pieces:
    """Curved faces or cells, cut into small straight pieces. The vertices of these are combinations of nodes: `at` interpolates values from
    nodes to vertices.

    `simplices` has the vertices of each straight piece, `owners` the cell that it belongs to.
    """

    def __init__(self, corners, nodes, reference_nodes, degree, lattice, owners):
        points, simplices = lattice
        n_cuts = points[0].sum()
        self.shapes = shape_functions(reference_nodes, degree, points / n_cuts)
        # Neighbours share vertices: a vertex is known by the corners that it lies between, and by its place between these.
        n_corners = points.shape[1]
        names = np.broadcast_to(corners[:, None, :], (len(corners), len(points), n_corners)) * (points > 0) + (points > 0) - 1
        order = np.argsort(names, axis=2, kind="stable")
        names = np.take_along_axis(names, order, axis=2)
        shares = np.take_along_axis(np.broadcast_to(points, names.shape), order, axis=2)
        keys = np.concatenate([names, shares], axis=2).reshape(-1, 2 * n_corners)
        first, vertices = unique_rows(keys)
        self.piece, self.place = np.divmod(first, len(points))
        self.nodes = nodes
        self.simplices = vertices.reshape(len(corners), len(points))[:, simplices].reshape(-1, n_corners)
        self.owners = np.repeat(owners, len(simplices))
        self.pieces = np.repeat(np.arange(len(corners)), len(simplices))

    def at(self, values):
        """Values at the vertices, interpolated from values at the nodes."""
        chosen = values[self.nodes[self.piece]]
        return np.einsum("vn,vn...->v...", self.shapes[self.place], chosen)


def unique_rows(rows):
    """Finds sets of equal rows of integers, which must be -1 or more. Returns the index of the first row of each set, and for each row the
    number of its set."""
    widths = [max(int(column.max()) + 2, 2).bit_length() for column in rows.T]
    words, used = [np.zeros(len(rows), dtype=np.uint64)], 0
    for column, width in zip(rows.T, widths):
        if used + width > 64:
            words.append(np.zeros(len(rows), dtype=np.uint64))
            used = 0
        words[-1] |= (column + 1).astype(np.uint64) << np.uint64(used)
        used += width
    order = np.lexsort(words)
    new = np.ones(len(rows), dtype=bool)
    new[1:] = np.any([word[order][1:] != word[order][:-1] for word in words], axis=0)
    numbers = np.empty(len(rows), dtype=np.int64)
    numbers[order] = np.cumsum(new) - 1
    return order[new], numbers


class Surface(Pieces):
    """The surface of a body, that is all faces that belong to one cell only, as triangles that are counter-clockwise seen from outside. Each
    face is cut into subdivisions^2 triangles; if subdivisions is the degree, the vertices are the nodes."""

    def __init__(self, cells, degree, subdivisions):
        reference = tetrahedron_nodes(degree)
        faces = np.concatenate([cells[:, list(face)] for face in OUTWARD_FACES])
        first, number = unique_rows(np.sort(faces, axis=1))
        alone = np.flatnonzero(np.bincount(number)[number] == 1)
        cell, side = alone % len(cells), alone // len(cells)
        triangle_nodes, _ = triangle_lattice(degree)
        # For each side of a cell, the numbers of its nodes in the cell, in the order of the lattice.
        index = {tuple(node): i for i, node in enumerate(reference.tolist())}
        local = np.zeros((4, len(triangle_nodes)), dtype=int)
        for s, face in enumerate(OUTWARD_FACES):
            for i, node in enumerate(triangle_nodes):
                coordinates = [0] * 4
                for corner, share in zip(face, node.tolist()):
                    coordinates[corner] = share
                local[s, i] = index[tuple(coordinates)]
        nodes = np.take_along_axis(cells[cell], local[side], axis=1)
        super().__init__(faces[alone], nodes, triangle_nodes, degree, triangle_lattice(subdivisions), cell)

    def lines(self, points, angle=None):
        """Lines to draw, as pairs of vertices: the edges of all faces, or with an angle [degrees] only the edges where the surface is folded
        by more than the angle."""
        sides = np.sort(self.simplices[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        triangle = np.repeat(np.arange(len(self.simplices)), 3)
        order = np.lexsort(sides.T)
        sides, triangle = sides[order], triangle[order]
        pairs = np.flatnonzero((sides[1:] == sides[:-1]).all(axis=1))
        one, other = triangle[pairs], triangle[pairs + 1]
        if angle is None:
            return sides[pairs[self.pieces[one] != self.pieces[other]]]
        normals = unit_normals(points, self.simplices)
        return sides[pairs[(normals[one] * normals[other]).sum(axis=1) < np.cos(np.radians(angle))]]


def inside(cells, degree, subdivisions):
    """The inside of cells as small straight tetrahedra, subdivisions^3 for each cell."""
    return Pieces(cells[:, :4], cells, tetrahedron_nodes(degree), degree, tetrahedron_lattice(subdivisions), np.arange(len(cells)))


def unit_normals(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    return normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
