# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Several ways to recover stress at the nodes, in NumPy: the program's way and others. scripts/measure_stress compares them.

All of them compute stress from the displacement of a run with one material. Stress has six components in VTK's order.
"""

import math

import numpy as np

# Smallest ratio of the least to the largest eigenvalue of the normal equations that a fit may have, by degree, as in the
# program.
LEAST = {1: 2e-2, 2: 3e-3, 3: 3e-4}
LEAST_OF_LAYERS = {1: 2e-2, 2: 5e-4, 3: 5e-5}
ORDER = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]


def monomials(degree):
    return np.array([(a, b, s - a - b) for s in range(degree + 1) for a in range(s + 1) for b in range(s + 1 - a)])


def power(exponents, x):
    return np.prod(x[:, None, :] ** exponents, axis=2)


def derivatives(exponents, x):
    result = np.zeros((len(x), len(exponents), 3))
    for k in range(3):
        lower = exponents.copy()
        lower[:, k] = np.maximum(lower[:, k] - 1, 0)
        result[:, :, k] = exponents[:, k] * power(lower, x)
    return result


def stiffness_points(degree):
    """The points of the program's quadrature rule for the stiffness: 1, 4 or 14 points for degree 1, 2 or 3."""
    if degree == 1:
        return np.full((1, 3), 0.25)

    def vertex_points(t):
        return [[t + (1 - 4 * t) * (k == a) for a in range(4)] for k in range(4)]

    if degree == 2:
        return np.array(vertex_points((5 - math.sqrt(5)) / 20))[:, 1:]
    c = 0.045503704125649649492
    edges = [[c if a in (i, j) else 0.5 - c for a in range(4)] for i in range(4) for j in range(i)]
    return np.array(vertex_points(0.31088591926330060980) + vertex_points(0.092735250310891226402) + edges)[:, 1:]


class Recovery:
    """Recovers stress at the nodes. points, cells, displacement: places of the nodes, nodes of the cells and displacement at the
    nodes, as VTK has them; parametric: reference coordinates of the nodes of a cell; lame: lambda and mu."""

    def __init__(self, points, cells, displacement, parametric, lame):
        self.points, self.cells, self.displacement, self.lame = points, cells, displacement, lame
        self.degree = {4: 1, 10: 2, 20: 3}[cells.shape[1]]
        self.parametric = np.round(parametric * self.degree) / self.degree
        self.barycentric = np.column_stack([1 - self.parametric.sum(axis=1), self.parametric])
        self.exponents = monomials(self.degree)
        self.inverse = np.linalg.inv(power(self.exponents, self.parametric))
        self.places, self.stresses = self.raw(stiffness_points(self.degree))
        self.around = [[] for _ in points]
        for c, vertices in enumerate(cells[:, :4]):
            for v in vertices:
                self.around[v].append(c)
        self.vertices = [v for v, around in enumerate(self.around) if around]
        self.is_surface = self.find_surface()

    def raw(self, xi):
        """Positions of the points xi (reference coordinates) in all cells, and the raw stress of the displacement there."""
        values = power(self.exponents, xi) @ self.inverse
        gradients = np.einsum("qmk,mi->qik", derivatives(self.exponents, xi), self.inverse)
        jacobian = np.einsum("cia,qik->cqak", self.points[self.cells], gradients)
        grad_u = np.einsum("cia,qik->cqak", self.displacement[self.cells], gradients) @ np.linalg.inv(jacobian)
        trace = np.trace(grad_u, axis1=2, axis2=3)
        stress = [self.lame[1] * (grad_u[..., a, b] + grad_u[..., b, a]) + (a == b) * self.lame[0] * trace for a, b in ORDER]
        return np.einsum("cia,qi->cqa", self.points[self.cells], values), np.stack(stress, axis=-1)

    def find_surface(self):
        faces = {}
        for c, vertices in enumerate(self.cells[:, :4]):
            for k in range(4):
                faces.setdefault(tuple(sorted(np.delete(vertices, k))), []).append((c, k))
        result = np.zeros(len(self.points), dtype=bool)
        for sides in faces.values():
            if len(sides) == 1:
                c, k = sides[0]
                result[self.cells[c, self.barycentric[:, k] < 1e-9]] = True
        return result

    def raw_mean(self):
        """At each node, the plain mean of the raw stress of its cells there."""
        stress = self.raw(self.parametric)[1]
        sums, counts = np.zeros((len(self.points), 6)), np.zeros(len(self.points))
        np.add.at(sums, self.cells, stress)
        np.add.at(counts, self.cells, 1)
        return sums / counts[:, None]

    def layers(self, vertex, n):
        cells = self.around[vertex]
        for _ in range(n - 1):
            cells = sorted({c for v in np.unique(self.cells[cells, :4]) for c in self.around[v]})
        return cells

    def fit(self, vertex, n_layers=1, degree=None, decay=0, before=()):
        """Fits a polynomial to the raw stress around a vertex, less the polynomials in @p before. Returns its centre, scale,
        exponents and coefficients. If a polynomial of full degree is badly determined, the degree is one less."""
        least = 0 if degree is not None else (LEAST if n_layers == 1 else LEAST_OF_LAYERS)[self.degree]
        cells = self.layers(vertex, n_layers)
        corners = self.points[self.cells[cells, :4].ravel()]
        centre = corners.mean(axis=0)
        scale = np.linalg.inv(np.linalg.cholesky((corners - centre).T @ (corners - centre) / len(corners)))
        x, stress = self.places[cells].reshape(-1, 3), self.stresses[cells].reshape(-1, 6)
        stress = stress - sum(evaluate(one, x) for one in before)
        weights = (0.5 + np.linalg.norm((x - self.points[vertex]) @ scale.T, axis=1)) ** -decay
        lower = monomials(self.degree if degree is None else degree)
        basis = power(lower, (x - centre) @ scale.T)
        normal = (basis * weights[:, None]).T @ basis
        eigenvalues = np.linalg.eigvalsh(normal)
        if eigenvalues[0] < least * eigenvalues[-1]:
            return self.fit(vertex, 1, self.degree - 1, decay, before)
        return centre, scale, lower, np.linalg.solve(normal, (basis * weights[:, None]).T @ stress)

    def recovered(self, at_surface, inner_first=False):
        """Stress at the nodes, from polynomials of the vertices around them. at_surface(vertex) gives the polynomials of a
        vertex at the surface, whose sum counts. inner_first: nodes that belong to patches of inner vertices take only the
        polynomials of these."""
        sums, weights = np.zeros((3, len(self.points), 6)), np.zeros((3, len(self.points)))
        for v in self.vertices:
            fits = [] if self.is_surface[v] else [self.fit(v)]
            is_inner = len(fits) > 0 and len(fits[0][2]) == len(self.exponents)
            if not is_inner:
                fits = at_surface(v)
            nodes, barycentric = self.cells[self.around[v]], self.barycentric
            shares = np.array([barycentric[:, list(row[:4]).index(v)] for row in nodes])
            nodes, first = np.unique(nodes, return_index=True)
            own = np.where(shares.ravel()[first] > 1e-8, shares.ravel()[first], 0)
            values = sum(evaluate(one, self.points[nodes]) for one in fits)
            is_preferred = is_inner or not inner_first
            for rank, weight in enumerate((own * is_preferred, np.ones(len(own)) * is_preferred, own)):
                sums[rank, nodes] += weight[:, None] * values
                weights[rank, nodes] += weight
        rank, node = np.argmax(weights > 0, axis=0), np.arange(len(self.points))
        return sums[rank, node] / weights[rank, node][:, None]

    def candidates(self):
        """All ways to recover stress: {name: stress at the nodes}. The last is the way of the program."""
        p = self.degree

        def two_steps(v):
            wide = self.fit(v, 2, decay=0 if p == 1 else 4)
            return [wide] if p == 1 else [wide, self.fit(v, 1, p - 1, 2, [wide])]

        return {
            "mean of the raw stress": self.raw_mean(),
            "one-sided patches": self.recovered(lambda v: [self.fit(v)]),
            "inner patches first": self.recovered(lambda v: [self.fit(v)], True),
            "one-sided of degree p - 1": self.recovered(lambda v: [self.fit(v, degree=max(p - 1, 0))]),
            "two layers": self.recovered(lambda v: [self.fit(v, 2)], p == 1),
            "two layers, weights r^-4": self.recovered(lambda v: [self.fit(v, 2, decay=4)], p == 1),
            "two layers, weights r^-8": self.recovered(lambda v: [self.fit(v, 2, decay=8)], p == 1),
            "two layers and the rest": self.recovered(two_steps, p == 1),
        }


def evaluate(fit, x):
    centre, scale, exponents, coefficients = fit
    return power(exponents, (x - centre) @ scale.T) @ coefficients
