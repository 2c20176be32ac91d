#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes the closed surfaces of triangles that are shipped with corotet, trefoil.stl and gyroid.stl, as binary STL files.

    scripts/toolchain python3 meshes/make_surfaces.py [--folder meshes]
"""

import argparse
import pathlib
import struct

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy


def write_stl(path, corners):
    """Writes triangles: (n, 3, 3)."""
    records = np.zeros(len(corners), dtype=[("normal", "<3f4"), ("corners", "<9f4"), ("attribute", "<u2")])
    records["corners"] = np.asarray(corners, dtype=np.float32).reshape(-1, 9)
    path.write_bytes(b"A closed surface, made for corotet".ljust(80) + struct.pack("<I", len(corners)) + records.tobytes())


def trefoil(n_along, n_around, radius):
    """The triangles of a tube of that radius around a trefoil knot, in cm."""
    s = np.linspace(0, 2 * np.pi, n_along, endpoint=False)
    centre = np.array([np.sin(s) + 2 * np.sin(2 * s), np.cos(s) - 2 * np.cos(2 * s), -np.sin(3 * s)]).T
    tangent = np.array([np.cos(s) + 4 * np.cos(2 * s), -np.sin(s) + 4 * np.sin(2 * s), -3 * np.cos(3 * s)]).T
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]

    def across(vector, t):
        vector = vector - t * (vector @ t)
        return vector / np.linalg.norm(vector)

    # A frame that does not turn about the tube, and what is left of a turn at its end.
    normal = np.zeros_like(tangent)
    normal[0] = across(np.array([0, 0, 1.0]), tangent[0])
    for i in range(1, n_along):
        normal[i] = across(normal[i - 1], tangent[i])
    last = across(normal[-1], tangent[0])
    twist = np.arctan2(np.cross(last, normal[0]) @ tangent[0], last @ normal[0])
    binormal = np.cross(tangent, normal)
    angles = np.linspace(0, 2 * np.pi, n_around, endpoint=False)[None, :] + (twist * np.arange(n_along) / n_along)[:, None]
    points = centre[:, None, :] + radius * (np.cos(angles)[:, :, None] * normal[:, None, :] + np.sin(angles)[:, :, None] * binormal[:, None, :])
    triangles = []
    for i in range(n_along):
        for j in range(n_around):
            a, b = points[i, j], points[i, (j + 1) % n_around]
            c, d = points[(i + 1) % n_along, (j + 1) % n_around], points[(i + 1) % n_along, j]
            triangles += [(a, b, c), (a, c, d)]
    return np.array(triangles)


def gyroid(n, half_thickness):
    """The triangles of a block of 20 mm around a gyroid wall with one period, on a grid of n^3 points, in mm."""
    x = np.linspace(-1.1, 1.1, n)
    grid = np.meshgrid(x, x, x, indexing="ij")
    a, b, c = (np.pi * coordinate for coordinate in grid)
    wall = half_thickness - np.abs(np.sin(a) * np.cos(b) + np.sin(b) * np.cos(c) + np.sin(c) * np.cos(a))
    # Positive inside of both, and nearly a distance there.
    inside = np.minimum(wall, 4 * (1 - np.max(np.abs(grid), axis=0)))
    image = vtk.vtkImageData()
    image.SetDimensions(n, n, n)
    image.SetOrigin(-11, -11, -11)
    image.SetSpacing(*3 * [10 * (x[1] - x[0])])
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(inside.transpose(2, 1, 0)).ravel(), deep=1))
    contour = vtk.vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0.0)
    largest = vtk.vtkPolyDataConnectivityFilter()
    largest.SetInputConnection(contour.GetOutputPort())
    largest.SetExtractionModeToLargestRegion()
    largest.Update()
    surface = largest.GetOutput()
    points = vtk_to_numpy(surface.GetPoints().GetData())
    return points[vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent)
    options = parser.parse_args()
    for name, triangles in (("trefoil", trefoil(100, 12, 0.4)), ("gyroid", gyroid(24, 0.5))):
        write_stl(options.folder / f"{name}.stl", triangles)
        print(f"{name}.stl: {len(triangles)} triangles")


if __name__ == "__main__":
    main()
