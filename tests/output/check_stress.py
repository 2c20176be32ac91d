#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Checks stress at nodes and at quadrature points with VTK's own reader and shape functions.

    check_stress.py DIRECTORY YOUNGS_MODULUS POISSONS_RATIO

For results of linear elasticity with one material and 'Output/Stress = both'. For every step:
- both time series have the same times; stress_points.vtkhdf has vertices only, each of them with its own point;
- displacement and strain at each of these points are those that VTK's shape functions make of the displacement in
  solution.vtkhdf at that place;
- at nodes and points stress is the law's of the strain, von Mises' equivalent and the principal values are those of the stress;
- in the last step the squares of the cells' estimated errors sum up to that of summary.json.
Tolerances are round-off, relative to the largest value of the kind.
"""
import json
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from check_vtkhdf import Mesh, arrays, read_steps, require

POINT_DATA = {"displacement", "stress", "strain", "von_mises", "principal_stress"}
# VTK's order of the components of a symmetric tensor.
ORDER = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]


def tensors(columns):
    result = np.zeros((len(columns), 3, 3))
    for k, (a, b) in enumerate(ORDER):
        result[:, a, b] = result[:, b, a] = columns[:, k]
    return result


def require_equal(name, found, expected, tolerance):
    size = abs(expected).max()
    error = abs(found - expected).max()
    require(error <= tolerance * size, f"{name} is off by {error:.2e} of {size:.2e}")


def check_tables(data, youngs_modulus, nu):
    stress, strain = tensors(data["stress"]), tensors(data["strain"])
    mu = youngs_modulus / (2 * (1 + nu))
    lame = 2 * mu * nu / (1 - 2 * nu)
    trace = np.trace(strain, axis1=1, axis2=2)
    require_equal("stress", stress, 2 * mu * strain + lame * trace[:, None, None] * np.eye(3), 1e-13)
    deviator = stress - np.trace(stress, axis1=1, axis2=2)[:, None, None] * np.eye(3) / 3
    require_equal("von_mises", data["von_mises"], np.sqrt(1.5 * (deviator**2).sum(axis=(1, 2))), 1e-13)
    require_equal("principal_stress", data["principal_stress"], np.linalg.eigvalsh(stress)[:, ::-1], 1e-13)


def shape_functions(cell, n, xi):
    weights = np.zeros(n)
    cell.InterpolateFunctions(xi, weights)
    return weights


def shape_gradients(cell, n, xi):
    """The derivatives of shape functions by xi; these differences are exact for
    polynomials of degree 4."""
    result = np.zeros((n, 3))
    h = 0.1
    for k in range(3):
        e = h * np.eye(3)[k]
        value = {s: shape_functions(cell, n, xi + s * e) for s in (-2, -1, 1, 2)}
        result[:, k] = (8 * (value[1] - value[-1]) - (value[2] - value[-2])) / (12 * h)
    return result


def check_points(grid, mesh, displacement, points, data):
    n = mesh.cells.shape[1]
    found_u, found_strain = [], []
    for x in points:
        index, xi = mesh.locate(grid, x)
        cell = grid.GetCell(index)
        u = displacement[mesh.cells[index]]
        found_u.append(shape_functions(cell, n, xi) @ u)
        gradient = u.T @ shape_gradients(cell, n, xi) @ np.linalg.inv(mesh.jacobians[index])
        found_strain.append((gradient + gradient.T) / 2)
    require_equal("displacement at points", data["displacement"], np.array(found_u), 1e-12)
    require_equal("strain at points", tensors(data["strain"]), np.array(found_strain), 1e-11)


def check(directory, youngs_modulus, nu):
    times = []
    for (time, grid), (points_time, points_grid) in zip(read_steps(directory), read_steps(directory, "stress_points.vtkhdf"), strict=True):
        require(time == points_time, f"times {time} and {points_time} differ")
        times.append(time)
        mesh = Mesh(grid, None, False)
        nodal = arrays(grid.GetPointData(), POINT_DATA, len(mesh.points))
        errors = arrays(grid.GetCellData(), {"error_estimate"}, len(mesh.cells))["error_estimate"]
        points = vtk_to_numpy(points_grid.GetPoints().GetData())
        data = arrays(points_grid.GetPointData(), POINT_DATA, len(points))
        require((vtk_to_numpy(points_grid.GetCellTypesArray()) == 1).all(), "not all points are vertices")
        require((vtk_to_numpy(points_grid.GetCells().GetConnectivityArray()) == np.arange(len(points))).all(), "points are not in order")
        require(len(points) % len(mesh.cells) == 0, "cells do not have the same number of points")
        if abs(nodal["displacement"]).max() == 0:
            continue
        check_tables(nodal, youngs_modulus, nu)
        check_tables(data, youngs_modulus, nu)
        check_points(grid, mesh, nodal["displacement"], points, data)
    with open(os.path.join(directory, "summary.json")) as file:
        estimate = json.load(file)["error_estimate"]
    require(list(estimate) == ["energy_norm", "relative"], f"keys are {list(estimate)}")
    require_equal("error_estimate", np.array([np.linalg.norm(errors)]), np.array([estimate["energy_norm"]]), 1e-13)
    require(0 < estimate["relative"] < 1, f"relative error {estimate['relative']}")
    return f"{len(times)} steps, {len(points)} points"


if __name__ == "__main__":
    folder = os.path.abspath(sys.argv[1])
    print(f"{folder}: {check(folder, *map(float, sys.argv[2:]))}: good")
