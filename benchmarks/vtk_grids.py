# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Meshes for VTK's writers."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkUnstructuredGrid


def vtk_points(positions):
    """VTK's points for an array of (n, 3) numbers."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    return points


def tetrahedra_grid(positions, tetrahedra):
    """VTK's grid for arrays of (n, 3) positions and (m, 4) node numbers."""
    grid = vtkUnstructuredGrid()
    grid.SetPoints(vtk_points(positions))
    cells = vtkCellArray()
    cells.SetData(*(numpy_to_vtkIdTypeArray(array, deep=True) for array in (np.arange(0, tetrahedra.size + 1, 4), tetrahedra.ravel())))
    grid.SetCells(VTK_TETRA, cells)
    return grid
