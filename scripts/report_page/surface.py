# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The surface of a mesh. Its faces are patches of the degree of the cells. They are cut into triangles, which share vertices where the body is
smooth.

Points of a face whose barycentric coordinates are multiples of 1/s form a lattice. They are numbered by (i, j), the shares of the second and of the
third corner times s, i running first. The nodes of a face of degree p are the lattice with s = p.
"""

import numpy as np

MAX_TRIANGLES = 50_000
CREASE = 30  # [degrees]: if the normals of two faces differ by more, the line between them is an edge of the body

# Corners of a tetrahedron's faces, seen from outside in the mathematically positive sense.
FACES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))


def lattice(s):
    return [(i, j) for j in range(s + 1) for i in range(s + 1 - j)]


def nodes_of_cell(degree):
    """Barycentric coordinates, times the degree, of the nodes of VTK's Lagrange tetrahedron."""
    corners = np.eye(4, dtype=int) * degree
    nodes = list(corners)
    for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)):
        nodes += [(corners[a] * (degree - k) + corners[b] * k) // degree for k in range(1, degree)]
    if degree == 3:
        nodes += [(corners[a] + corners[b] + corners[c]) // 3 for a, b, c in ((0, 1, 3), (1, 2, 3), (0, 2, 3), (0, 1, 2))]
    return [tuple(int(k) for k in node) for node in nodes]


def nodes_of_faces(degree):
    """A row for each face of a cell: the numbers of its nodes in the cell, in the lattice's order."""
    nodes, table = nodes_of_cell(degree), []
    for a, b, c in FACES:
        table.append([])
        for i, j in lattice(degree):
            place = [0, 0, 0, 0]
            place[a], place[b], place[c] = degree - i - j, i, j
            table[-1].append(nodes.index(tuple(place)))
    return np.array(table)


def monomials(points, degree):
    """Monomials up to the degree at points with two coordinates, and their derivatives by the first and by the second one: points x monomials."""
    x, y = np.asarray(points, float).T
    exponents = lattice(degree)
    value = np.stack([x**i * y**j for i, j in exponents], axis=1)
    d_x = np.stack([i * x**max(i - 1, 0) * y**j for i, j in exponents], axis=1)
    d_y = np.stack([j * x**i * y**max(j - 1, 0) for i, j in exponents], axis=1)
    return value, d_x, d_y


def shape_functions(points, degree):
    """The shape functions of a face's nodes at points with coordinates (share of corner 2, share of corner 3): values and both derivatives, each
    points x nodes."""
    inverse = np.linalg.inv(monomials(np.array(lattice(degree)) / degree, degree)[0])
    return [m @ inverse for m in monomials(points, degree)]


def outer_faces(cells, degree):
    """The faces that belong to one cell only: their nodes (faces x nodes), and their cells."""
    corners = np.sort(cells[:, :4][:, FACES].reshape(-1, 3), axis=1)
    n = int(cells.max()) + 1
    pair = corners[:, 0] * n + corners[:, 1]
    order = np.lexsort((corners[:, 2], pair))
    same = (pair[order][1:] == pair[order][:-1]) & (corners[order, 2][1:] == corners[order, 2][:-1])
    single = np.ones(len(order), bool)
    single[1:] &= ~same
    single[:-1] &= ~same
    found = np.sort(order[single])
    owner, face = found // 4, found % 4
    return cells[owner[:, None], nodes_of_faces(degree)[face]], owner


def split_triangles(s):
    """The triangles of a face that is cut into s parts along each edge; vertices are numbers in the lattice."""
    number = {point: k for k, point in enumerate(lattice(s))}
    result = [(number[i, j], number[i + 1, j], number[i, j + 1]) for i, j in lattice(s) if i + j < s]
    result += [(number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]) for i, j in lattice(s) if i + j + 1 < s]
    return np.array(result)


def lattice_edges(s):
    """The points of each of the three edges from corner to corner, as numbers in the lattice."""
    number = {point: k for k, point in enumerate(lattice(s))}
    return np.array([[number[k, 0] for k in range(s + 1)], [number[s - k, k] for k in range(s + 1)], [number[0, s - k] for k in range(s + 1)]])


def edge_normals(points, faces, degree):
    """Unit normals of each face at the midpoints of its three edges."""
    _, d_x, d_y = shape_functions([(0.5, 0), (0.5, 0.5), (0, 0.5)], degree)
    x = points[faces]
    normals = np.cross(np.einsum("en,fni->fei", d_x, x), np.einsum("en,fni->fei", d_y, x))
    lengths = np.linalg.norm(normals, axis=2, keepdims=True)
    return normals / np.where(lengths > 0, lengths, 1)


class Surface:
    """The surface as patches, cut into s parts along each edge. The rows of the argument `faces` are the nodes of the patches, `regions` their
    regions.

    nodes, node_regions: the nodes on the surface, as numbers in the file, and their regions; a node in several regions is repeated for each
    faces: the nodes of the patches, as indices into `nodes`
    vertex_faces, vertex_places: for each vertex, a patch that it is in, and its number in the lattice of that patch
    triangles, cell_edges, outline: vertices of the triangles, of pieces of the edges of cells, and of pieces of the edges of the body
    """

    def __init__(self, points, faces, regions, degree, s):
        self.degree, self.s = degree, s
        self.number_nodes(faces, regions)
        self.rest = points[self.nodes]
        n_places = len(lattice(s))
        copies = np.arange(len(faces) * n_places).reshape(len(faces), n_places)
        along = copies[:, lattice_edges(s)]  # faces x edges x points
        first, second, is_outline = self.pair_edges(points, faces, regions)
        joined = first[~is_outline & (second >= 0)], second[~is_outline & (second >= 0)]
        edges = along.reshape(-1, s + 1)
        label = np.arange(copies.size)
        self.join(label, edges[joined[0]], edges[joined[1]], faces[:, [0, degree, -1]], joined)
        kept, vertex = np.unique(label, return_inverse=True)
        self.vertex_faces, self.vertex_places = kept // n_places, kept % n_places
        self.triangles = vertex[copies[:, split_triangles(s)]].reshape(-1, 3)
        self.cell_edges = self.pieces(vertex[edges[first]])
        self.outline = self.pieces(vertex[edges[first[is_outline]]])

    def number_nodes(self, faces, regions):
        kinds, region = np.unique(regions, return_inverse=True)
        key = faces * len(kinds) + region[:, None]
        found, number = np.unique(key, return_inverse=True)
        self.nodes, self.node_regions = found // len(kinds), kinds[found % len(kinds)]
        self.faces = number.reshape(faces.shape)

    def pair_edges(self, points, faces, regions):
        """Finds the edges of the surface. Returns for each the edge of a face that it is (3 face + edge), the edge of the other face that it is (-1:
        none, or several), and whether the body has an edge there, so that the surface is not smooth."""
        corners = faces[:, [0, self.degree, -1]]
        ends = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
        order = np.lexsort(ends.T)
        new = np.ones(len(order), bool)
        new[1:] = (ends[order][1:] != ends[order][:-1]).any(axis=1)
        start = np.flatnonzero(new)
        count = np.diff(np.append(start, len(order)))
        first = order[start]
        second = np.where(count == 2, order[np.minimum(start + 1, len(order) - 1)], -1)
        normals = edge_normals(points, faces, self.degree).reshape(-1, 3)
        turned = np.einsum("ei,ei->e", normals[first], normals[second]) < np.cos(np.radians(CREASE))
        region = np.repeat(regions, 3)
        return first, second, (count != 2) | turned | (region[first] != region[second])

    @staticmethod
    def join(label, ours, theirs, corners, joined):
        """Gives points of smooth edges the same label in both faces. Labels are made smaller in rounds until they no longer differ."""
        begin = corners.reshape(-1)  # the node where each edge begins: edge e of a face begins at its corner e
        reversed_ = begin[joined[0]] != begin[joined[1]]
        theirs = np.where(reversed_[:, None], theirs[:, ::-1], theirs).ravel()
        ours = ours.ravel()
        while True:
            smaller = np.minimum(label[ours], label[theirs])
            if (label[ours] == label[theirs]).all():
                return
            np.minimum.at(label, ours, smaller)
            np.minimum.at(label, theirs, smaller)

    @staticmethod
    def pieces(edges):
        return np.stack([edges[:, :-1], edges[:, 1:]], axis=2).reshape(-1, 2)

    def weights(self):
        """Values of the shape functions of a patch at the points of the lattice: points x nodes."""
        return shape_functions(np.array(lattice(self.s)) / self.s, self.degree)[0]

    def at_vertices(self, values):
        """Interpolates values from the nodes to the vertices, as the page does."""
        return np.einsum("vn,vn...->v...", self.weights()[self.vertex_places], values[self.faces[self.vertex_faces]])

    def area(self):
        """The area of all triangles at rest [m^2]."""
        x = self.at_vertices(self.rest)[self.triangles]
        return np.linalg.norm(np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]), axis=1).sum() / 2


def roughened(points, triangles):
    """Moves points off the surface by small distances, at random but always the same. VTK's decimation removes points from flat parts first, where
    fields may still vary; on a rough surface it removes points everywhere."""
    x = points[triangles]
    lengths = np.linalg.norm(x - np.roll(x, -1, axis=1), axis=2)
    shortest = np.full(len(points), np.inf)
    np.minimum.at(shortest, triangles, lengths)
    np.minimum.at(shortest, np.roll(triangles, -1, axis=1), lengths)
    crossed = np.cross(x[:, 1] - x[:, 0], x[:, 2] - x[:, 0])
    normals = np.stack([np.bincount(triangles.ravel(), np.repeat(crossed[:, c], 3), len(points)) for c in range(3)], axis=1)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    height = np.minimum(0.1 * shortest, 0.02 * np.median(lengths))
    return points + np.random.default_rng(0).uniform(-1, 1, len(points))[:, None] * height[:, None] * normals


def decimated(points, triangles, regions, target):
    """Thins the triangles, region by region. They keep some of the points; points at the ends of regions and of holes stay. Returns triangles and
    their regions."""
    found = [decimated_region(points, triangles[regions == region], 1 - target / len(triangles)) for region in np.unique(regions)]
    counts = [len(rows) for rows in found]
    return np.concatenate(found), np.repeat(np.unique(regions), counts)


def decimated_region(points, triangles, reduction):
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkDecimatePro

    used, number = np.unique(triangles, return_inverse=True)
    number = number.reshape(-1, 3)
    places, cells, body, names = vtkPoints(), vtkCellArray(), vtkPolyData(), numpy_to_vtk(used.astype(np.int64), deep=True)
    places.SetData(numpy_to_vtk(roughened(points[used], number), deep=True))
    cells.ImportLegacyFormat(numpy_to_vtkIdTypeArray(np.insert(number, 0, 3, axis=1).astype(np.int64).ravel(), deep=True))
    body.SetPoints(places)
    body.SetPolys(cells)
    names.SetName("node")
    body.GetPointData().AddArray(names)
    decimate = vtkDecimatePro()
    decimate.SetInputData(body)
    decimate.SetTargetReduction(reduction)
    decimate.SetFeatureAngle(CREASE)
    decimate.PreserveTopologyOff()
    decimate.SplittingOff()
    decimate.BoundaryVertexDeletionOff()
    decimate.Update()
    result = decimate.GetOutput()
    kept = vtk_to_numpy(result.GetPointData().GetArray("node"))
    return kept[vtk_to_numpy(result.GetPolys().GetConnectivityArray()).reshape(-1, 3)]


def extract(points, cells, regions, degree, max_triangles=MAX_TRIANGLES):
    """The surface of a mesh, thinned if it has too many triangles, and the number of triangles before that."""
    faces, owner = outer_faces(cells, degree)
    regions = regions[owner]
    # Faces of degree 2 and 3 are cut into twice as many parts along an edge as their degree, if these are not too many triangles.
    parts = next((s for s in (2 * degree, degree) if degree > 1 and s * s * len(faces) <= max_triangles), degree)
    n_triangles = parts * parts * len(faces)
    if n_triangles <= max_triangles:
        return Surface(points, faces, regions, degree, parts), n_triangles
    triangles = faces[:, split_triangles(degree)].reshape(-1, 3)
    thin, thin_regions = decimated(points, triangles, np.repeat(regions, degree**2), max_triangles)
    return Surface(points, thin, thin_regions, 1, 1), n_triangles
