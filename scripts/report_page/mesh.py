# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Reads the time series in solution.vtkhdf, and computes the quality of its mesh."""

import h5py
import numpy as np

from results import BadPart, check_parts

from .run import ReportError

DEGREES = {4: 1, 10: 2, 20: 3}  # by the number of nodes of a cell


class TimeSeries:
    """The content of solution.vtkhdf and of the files that it refers to."""

    def __init__(self, folder):
        self.path = folder / "solution.vtkhdf"
        if not self.path.exists():
            raise ReportError(f"{folder} has no states: {self.path.name} is missing")
        self.file = self.guarded(lambda: h5py.File(self.path, "r", locking=False), self.path)
        self.check_sources(folder)
        self.guarded(self.read_mesh, self.path)
        if len(self.times) == 0:
            raise ReportError(f"{folder} has no states yet")

    @staticmethod
    def guarded(read, path):
        """Calls read(); errors of HDF5 are reported as a damaged file."""
        try:
            return read()
        except (OSError, KeyError, ValueError, RuntimeError, IndexError) as error:
            raise ReportError(f"{path} is damaged or incomplete: {str(error).splitlines()[0][:200]}") from error

    def check_sources(self, folder):
        """Raises ReportError unless all files in the folder solution, and all files that have a part of the states, can be opened."""
        for path in sorted((folder / "solution").glob("*.h5")):
            self.guarded(lambda path=path: h5py.File(path, "r", locking=False).close(), path)
        data = self.guarded(lambda: self.file["VTKHDF/PointData/displacement"], self.path)
        try:
            check_parts(self.path, data)
        except BadPart as error:
            if error.reason:
                raise ReportError(f"{error.path} is damaged or incomplete: {error.reason}") from error
            raise ReportError(f"{error.path} is missing, to which {error.referrer.name} refers") from error

    def read_mesh(self):
        root = self.file["VTKHDF"]
        self.points = root["Points"][:]
        offsets = root["Offsets"][:]
        n = int(offsets[1] - offsets[0])
        if n not in DEGREES or not (np.diff(offsets) == n).all():
            raise ValueError("its cells are not tetrahedra of one degree from 1 to 3")
        self.degree = DEGREES[n]
        self.cells = root["Connectivity"][:].reshape(-1, n)
        if self.cells.min() < 0 or self.cells.max() >= len(self.points):
            raise ValueError("its cells have nodes that it lacks")
        self.regions = root["CellData/region"][:len(self.cells)]
        steps = root["Steps"]
        self.times = steps["Values"][:]
        self.offsets = {kind: {name: steps[f"{kind}Offsets/{name}"][:] for name in root[kind] if name in steps[f"{kind}Offsets"]}
                        for kind in ("PointData", "CellData")}

    def has(self, kind, name):
        return name in self.offsets[kind]

    def values(self, kind, name, state):
        """The values of an array in a state, at all nodes (PointData) or of all cells (CellData)."""
        n = len(self.points) if kind == "PointData" else len(self.cells)

        def read():
            first = int(self.offsets[kind][name][state])
            values = self.file[f"VTKHDF/{kind}/{name}"][first:first + n]
            if len(values) != n:
                raise ValueError(f"{name} of state {state} is incomplete")
            return values

        return self.guarded(read, self.path)


class Quality:
    """The quality of each cell, measured at the straight tetrahedron through its vertices: the smallest dihedral angle [degrees], the aspect
    ratio (longest edge over 2 sqrt(6) times the radius of the inscribed sphere, 1 for a regular tetrahedron) and the volume [m^3]."""

    def __init__(self, points, cells):
        x = points[cells[:, :4]]
        # The faces opposite to each vertex. Their normals all point outwards, or all inwards.
        faces = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))
        normals = [np.cross(x[:, b] - x[:, a], x[:, c] - x[:, a]) for a, b, c in faces]
        areas = [np.linalg.norm(normal, axis=1) / 2 for normal in normals]
        self.volumes = np.abs(np.einsum("ci,ci->c", x[:, 1] - x[:, 0], np.cross(x[:, 2] - x[:, 0], x[:, 3] - x[:, 0]))) / 6
        edges = [np.linalg.norm(x[:, a] - x[:, b], axis=1) for a in range(4) for b in range(a)]
        with np.errstate(divide="ignore", invalid="ignore"):
            cosines = [-np.einsum("ci,ci->c", normals[a], normals[b]) / (4 * areas[a] * areas[b]) for a in range(4) for b in range(a)]
            self.angles = np.degrees(np.arccos(np.clip(np.max(cosines, axis=0), -1, 1)))
            self.aspects = np.max(edges, axis=0) / (2 * np.sqrt(6) * 3 * self.volumes / np.sum(areas, axis=0))
