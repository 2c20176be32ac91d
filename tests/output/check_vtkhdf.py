#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Checks the time series of an output directory with VTK's own reader.

    check_vtkhdf.py DIRECTORY [--degree P] [--probes 'NAME: X Y Z, ...'] [--moved] [--killed] [--test-field]

For every step:
- cells are Lagrange tetrahedra (type 71) of one degree, of positive volume, and all finite data of cells and points are there;
- every node is at its parametric place, as VTK's own cell tells it, to 1e-6 of the cell's size; if log.txt tells of curved
  cells, those with an edge on the surface may be curved, but have each node nearer to its place than to that of any other; nodes are
  shared: no two are at the same place; the mesh is the same in all steps;
- the displacement that VTK's shape functions give at each probe is that of history.csv to 1e-12 relative;
- the time is one of history.csv's, in order; the first and the last are there.
Probes are those of --probes, else those of the directory's parameters.prm. Everything is read from another working
directory; with --moved, from a copy of the directory, too. With --killed, history.csv may be a step behind or ahead.
Where there is modes.csv, it takes the place of history.csv, and the number of the mode that of time.
With --test-field, the data are also compared with what the tests write.
"""
import argparse
import csv
import os
import re
import shutil
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

POINT_DATA = {"displacement", "velocity"}
CELL_DATA = {"region", "rotation_angle", "det_F", "von_mises", "rank"}
NODES = {4: 1, 10: 2, 20: 3}


def require(condition, message):
    if not condition:
        sys.exit(f"check_vtkhdf: {message}")


def read_steps(directory, file="solution.vtkhdf"):
    """Yields (time, grid) of each step."""
    reader = vtkHDFReader()
    reader.SetFileName(os.path.join(directory, file))
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    if times is None:
        # VTK reads a single step as a mesh without time.
        reader.Update()
        yield read_history(directory)[0]["time"], reader.GetOutputDataObject(0)
        return
    for time in times:
        require(reader.UpdateTimeStep(time) == 1, f"the step of time {time} cannot be read")
        yield time, reader.GetOutputDataObject(0)


def read_history(directory):
    modes = os.path.join(directory, "modes.csv")
    if os.path.exists(modes):
        with open(modes, newline="") as file:
            rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
        return [{"time": row["mode"], **row} for row in rows]
    with open(os.path.join(directory, "history.csv"), newline="") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def read_probes(text):
    return {name.strip(): np.array(place.split(), float) for name, place in (part.split(":") for part in text.split(",") if part.strip())}


def probes_of(directory):
    path = os.path.join(directory, "parameters.prm")
    if not os.path.exists(path):
        return {}
    with open(path) as file:
        found = re.search(r"^\s*set Probes\s*=([^#\n]*)", file.read(), re.MULTILINE)
    return read_probes(found.group(1)) if found else {}


def is_curved(directory):
    path = os.path.join(directory, "log.txt")
    if not os.path.exists(path):
        return False
    with open(path) as file:
        return re.search(r"^\s*[1-9]\d* curved cells of degree", file.read(), re.MULTILINE) is not None


class Mesh:
    """The mesh of a step, checked."""

    def __init__(self, grid, degree, curved):
        self.curved = curved
        require(grid.GetNumberOfCells() > 0, "no cells")
        require((vtk_to_numpy(grid.GetCellTypesArray()) == 71).all(), "not all cells are of type 71")
        self.points = vtk_to_numpy(grid.GetPoints().GetData()).copy()
        sizes = np.diff(vtk_to_numpy(grid.GetCells().GetOffsetsArray()))
        require((sizes == sizes[0]).all() and sizes[0] in NODES, f"cells of {set(sizes)} nodes")
        require(degree in (None, NODES[sizes[0]]), f"degree {NODES[sizes[0]]} instead of {degree}")
        self.cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, sizes[0]).copy()
        self.origins = self.points[self.cells[:, 0]]
        # The columns of the Jacobian are the edges from vertex 0.
        self.jacobians = (self.points[self.cells[:, 1:4]] - self.origins[:, None]).transpose(0, 2, 1)
        require((np.linalg.det(self.jacobians) > 0).all(), "cells of negative volume")
        self.check_places(grid.GetCell(0))
        used = np.unique(self.cells)
        require(used.size == len(self.points), "nodes without a cell")
        scale = np.ptp(self.points, axis=0).max()
        require(len(np.unique(np.round(self.points / (1e-9 * scale)), axis=0)) == used.size, "nodes are not shared")

    def check_places(self, cell):
        n = self.cells.shape[1]
        parametric = np.array([cell.GetParametricCoords()[i] for i in range(3 * n)]).reshape(n, 3)
        expected = self.origins[:, None] + np.einsum("cij,nj->cni", self.jacobians, parametric)
        size = np.linalg.norm(self.jacobians, axis=(1, 2))
        errors = (np.linalg.norm(self.points[self.cells] - expected, axis=2) / size[:, None]).max(axis=1)
        may_be_curved = self.has_edge_on_surface() if self.curved else np.zeros(len(errors), dtype=bool)
        # Half of the distance of nodes, which are a third of an edge apart,
        # relative to the norm of a matrix of three edges.
        allowed = np.where(may_be_curved, 0.5 / 3 / np.sqrt(3), 1e-6)
        require((errors < allowed).all(), f"a node is {(errors / allowed).max():.2e} of what is allowed away from its parametric place")

    def has_edge_on_surface(self):
        """Whether each cell has an edge on the surface: other cells are always
        straight."""
        vertices = np.sort(self.cells[:, :4], axis=1)
        faces = np.concatenate([np.delete(vertices, k, axis=1) for k in range(4)])
        found, counts = np.unique(faces, axis=0, return_counts=True)
        surface = found[counts == 1]
        require(counts.max() <= 2, "a face of more than two cells")
        n = len(self.points)
        edges_on_surface = np.unique(np.concatenate([surface[:, a] * n + surface[:, b] for a, b in ((0, 1), (0, 2), (1, 2))]))
        pairs = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
        return np.any([np.isin(vertices[:, a] * n + vertices[:, b], edges_on_surface) for a, b in pairs], axis=0)

    def centres(self):
        return self.points[self.cells[:, :4]].mean(axis=1)

    def locate(self, grid, x):
        """The cell that contains x, and the parametric coordinates of x in
        it."""
        xi = np.linalg.solve(self.jacobians, (x - self.origins)[..., None])[..., 0]
        depth = np.minimum(xi.min(axis=1), 1 - xi.sum(axis=1))
        cell = int(depth.argmax())
        if self.curved:
            for cell in np.argsort(-depth)[:50]:
                xi[cell] = self.solve(grid.GetCell(cell), cell, x, xi[cell])
                depth[cell] = min(xi[cell].min(), 1 - xi[cell].sum())
                if depth[cell] > -1e-7:
                    break
        require(depth[cell] > -1e-7, f"point {x} is outside of the mesh")
        return cell, xi[cell]

    def solve(self, vtk_cell, cell, x, xi):
        """The parametric coordinates in a curved cell by Newton's method with
        the straight cell's Jacobian, a contraction."""
        weights = np.zeros(self.cells.shape[1])
        for _ in range(100):
            vtk_cell.InterpolateFunctions(xi, weights)
            xi = xi + np.linalg.solve(self.jacobians[cell], x - weights @ self.points[self.cells[cell]])
        return np.where(np.isfinite(xi), xi, -1)


def interpolate(grid, mesh, x, values):
    """Interpolates values of nodes at x with VTK's own shape functions."""
    cell, xi = mesh.locate(grid, x)
    weights = np.zeros(mesh.cells.shape[1])
    grid.GetCell(cell).InterpolateFunctions(xi, weights)
    return weights @ values[mesh.cells[cell]]


def check_test_field(time, mesh, point_data, cell_data):
    """Checks the fields that tests/output/support.cc makes. The tolerance is
    the round-off of numbers of order one."""
    x, y, z = mesh.points.T
    field = np.stack([time * np.sin(3 * x + y), time * np.cos(2 * y - z), time * x * y + time**2 * z], axis=1)
    np.testing.assert_allclose(point_data["displacement"], field, rtol=0, atol=1e-14)
    np.testing.assert_allclose(point_data["velocity"], 2 * field, rtol=0, atol=2e-14)
    centres = mesh.centres()
    for i, name in enumerate(["rotation_angle", "det_F", "von_mises"]):
        np.testing.assert_allclose(cell_data[name], time + centres[:, i], rtol=0, atol=1e-14)
    # The regions meet at x = 0.5, and distorted vertices do not cross that
    # plane.
    right = mesh.points[mesh.cells[:, :4], 0].max(axis=1) > 0.6
    require(set(cell_data["region"][right]) == {8} and 7 in cell_data["region"], "wrong regions")


def arrays(data, names, n):
    found = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    require(names <= set(found), f"{names - set(found)} is missing")
    for name in names:
        require(len(found[name]) == n and np.isfinite(found[name]).all(), f"{name} has wrong values")
    return found


def check_times(times, rows, killed):
    history = [row["time"] for row in rows]
    if killed:
        # The process may have been killed between writing the two files of a
        # step.
        require(abs(len(times) - len(history)) <= 1, f"{len(times)} steps, but {len(history)} rows in the history")
        n = min(len(times), len(history))
        require(times[:n] == history[:n], "times differ from the history's")
        return
    require(set(times) <= set(history), "times that the history does not have")
    require(times == sorted(times) and len(set(times)) == len(times), "times are not increasing")
    require(times[0] == history[0], "the first state is missing")
    require(times[-1] == history[-1], "the last state is missing")


def check(directory, options):
    rows = {row["time"]: row for row in read_history(directory)}
    probes = read_probes(options.probes) if options.probes is not None else probes_of(directory)
    mesh, times = None, []
    for time, grid in read_steps(directory):
        times.append(time)
        if mesh is None:
            mesh = Mesh(grid, options.degree, is_curved(directory))
        require((vtk_to_numpy(grid.GetPoints().GetData()) == mesh.points).all(), "the mesh changes")
        require((vtk_to_numpy(grid.GetCells().GetConnectivityArray()) == mesh.cells.ravel()).all(), "the mesh changes")
        point_data = arrays(grid.GetPointData(), POINT_DATA, len(mesh.points))
        cell_data = arrays(grid.GetCellData(), CELL_DATA, len(mesh.cells))
        for name, x in probes.items():
            if time not in rows:
                continue
            expected = np.array([rows[time][f"{name}_{c}"] for c in "xyz"])
            error = np.linalg.norm(interpolate(grid, mesh, x, point_data["displacement"]) - expected)
            require(error <= 1e-12 * np.linalg.norm(expected), f"probe {name} at time {time} is off by {error:.2e} of {expected}")
        if options.test_field:
            check_test_field(time, mesh, point_data, cell_data)
    check_times(times, list(rows.values()), options.killed)
    return f"{len(times)} steps, {len(mesh.cells)} cells of degree {NODES[mesh.cells.shape[1]]}, {len(probes)} probes"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directory")
    parser.add_argument("--degree", type=int)
    parser.add_argument("--probes")
    for flag in ("--moved", "--killed", "--test-field"):
        parser.add_argument(flag, action="store_true")
    options = parser.parse_args()
    directory = os.path.abspath(options.directory)
    os.chdir("/")
    result = check(directory, options)
    if options.moved:
        with tempfile.TemporaryDirectory() as elsewhere:
            moved = os.path.join(elsewhere, "moved")
            shutil.copytree(directory, moved)
            # The original must not be read, so it is hidden.
            hidden = directory + ".hidden"
            os.rename(directory, hidden)
            try:
                check(moved, options)
            finally:
                os.rename(hidden, directory)
    print(f"{directory}: {result}: good")


if __name__ == "__main__":
    main()
