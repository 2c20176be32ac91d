#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Meshes in files that VTK has written, in all its formats, degrees 1 to 3;
files without a mesh, or damaged ones, are refused."""

import itertools
import os
import subprocess
import sys
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_LAGRANGE_TETRAHEDRON, VTK_QUADRATIC_TETRA, VTK_TETRA, VTK_TRIANGLE, vtkCellArray, vtkUnstructuredGrid
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from support import ROOT, ProgramTest, limit_files, parameter_text

sys.path.insert(0, str(ROOT / "scripts"))

from lagrange import tetrahedron_nodes  # pylint: disable=wrong-import-position

KUHN = [[(0, 0, 0), *np.cumsum(np.eye(3, dtype=int)[list(order)], axis=0).tolist()] for order in itertools.permutations(range(3))]


def two_cubes(degree, kind):
    """Two unit cubes side by side in x, of six tetrahedra of VTK's type @p kind each: numbers 7 and 9; on x = 0, two triangles: number 4."""
    nodes = tetrahedron_nodes(degree)
    cells = []
    for cube in range(2):
        for corners in KUHN:
            corners = np.array(corners) + (cube, 0, 0)
            if np.linalg.det(corners[1:] - corners[0]) < 0:
                corners = corners[[0, 2, 1, 3]]
            cells.append(nodes @ corners)  # times the degree
    triangles = degree * np.array([[(0, 0, 0), (0, 1, 0), (0, 1, 1)], [(0, 0, 0), (0, 1, 1), (0, 0, 1)]])
    places = np.concatenate([*cells, *triangles])
    points, numbers = np.unique(places, axis=0, return_inverse=True)
    n = len(nodes)
    sizes = [n] * 12 + [3] * 2
    grid = vtkUnstructuredGrid()
    vtk_points = vtkPoints()
    vtk_points.SetDataTypeToDouble()
    vtk_points.SetData(numpy_to_vtk(points / degree, deep=True))
    grid.SetPoints(vtk_points)
    array = vtkCellArray()
    array.SetData(numpy_to_vtkIdTypeArray(np.concatenate([[0], np.cumsum(sizes)]), deep=True),
                  numpy_to_vtkIdTypeArray(numbers.ravel().astype(np.int64), deep=True))
    grid.SetCells(numpy_to_vtk(np.array([kind] * 12 + [VTK_TRIANGLE] * 2, dtype=np.uint8), deep=True), array)
    material = numpy_to_vtk(np.array([7] * 6 + [9] * 6 + [4] * 2, dtype=np.int32), deep=True)
    material.SetName("Material")
    grid.GetCellData().AddArray(material)
    return grid


def write(grid, path, settings):
    """Writes a grid with VTK's writer; settings are names of its functions, and
    their arguments."""
    writer = vtkXMLUnstructuredGridWriter() if path.suffix == ".vtu" else vtkUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(str(path))
    for name, *arguments in settings:
        getattr(writer, name)(*arguments)
    assert writer.Write() == 1


# Names of files, and settings of the writer.
FORMS = {"text_4.vtk": [("SetFileTypeToASCII",), ("SetFileVersion", 42)], "bytes_4.vtk": [("SetFileTypeToBinary",), ("SetFileVersion", 42)],
         "text_5.vtk": [("SetFileTypeToASCII",), ("SetFileVersion", 51)], "bytes_5.vtk": [("SetFileTypeToBinary",), ("SetFileVersion", 51)],
         "text.vtu": [("SetDataModeToAscii",)], "base64.vtu": [("SetDataModeToBinary",)], "appended.vtu": [("SetDataModeToAppended",)],
         "raw.vtu": [("SetDataModeToAppended",), ("EncodeAppendedDataOff",)], "plain.vtu": [("SetDataModeToAppended",), ("SetCompressorTypeToNone",)],
         "lz4.vtu": [("SetCompressorTypeToLZ4",)], "big.vtu": [("SetByteOrderToBigEndian",), ("SetDataModeToAppended",)],
         "long.vtu": [("SetHeaderTypeToUInt64",), ("SetDataModeToBinary",)]}


class VtkFiles(ProgramTest):

    def volumes(self, file):
        """The volumes of regions and areas of boundaries by name, from `corotet
        mesh`; and the number of cells."""
        lines = self.run_program("mesh", file).stdout.splitlines()
        result, part = {}, None
        for line in lines:
            if line.startswith(("Regions", "Boundaries")):
                part = line.split(":")[0]
            elif part and line.startswith("  "):
                result[line.split()[0]] = float(line.split()[1])
        return result, int(lines[0].split()[0])

    def test_forms(self):
        for i, (name, settings) in enumerate(FORMS.items()):
            degree, kind = ((1, VTK_TETRA), (2, VTK_QUADRATIC_TETRA))[i // 2 % 2]
            with self.subTest(name, degree=degree):
                file = self.folder / name
                write(two_cubes(degree, kind), file, settings)
                self.assertEqual(self.volumes(file), ({"7": 1, "9": 1, "4": 1}, 12))

    def test_lagrange(self):
        """Straight cells with Lagrange nodes in their places are recognised as
        straight."""
        for degree in 1, 2, 3:
            with self.subTest(degree=degree):
                file = self.folder / f"lagrange_{degree}.vtu"
                write(two_cubes(degree, VTK_LAGRANGE_TETRAHEDRON), file, [])
                self.assertEqual(self.volumes(file), ({"7": 1, "9": 1, "4": 1}, 12))
                self.assertNotIn("curved", self.run_program("mesh", file).stdout)

    def test_zero(self):
        """0 is a number like others; without numbers there is one region, and
        triangles have no meaning."""
        for numbers, expected in ((0, 1, 5), {"0": 1, "1": 1, "5": 1}), ((1, 2, 0), {"1": 1, "2": 1, "0": 1}), (None, {"0": 2}):
            with self.subTest(numbers=numbers):
                grid = two_cubes(1, VTK_TETRA)
                grid.GetCellData().Initialize()
                if numbers:
                    array = numpy_to_vtk(np.repeat(np.array(numbers, dtype=np.int32), (6, 6, 2)), deep=True)
                    array.SetName("region")
                    grid.GetCellData().AddArray(array)
                write(grid, self.folder / "zero.vtu", [])
                self.assertEqual(self.volumes(self.folder / "zero.vtu"), (expected, 12))

    def numbered(self, *arrays):
        """The line of the log about numbers, for a file whose cells have these
        data: names, and values of the cubes and the triangles."""
        grid = two_cubes(1, VTK_TETRA)
        grid.GetCellData().Initialize()
        for name, values in arrays:
            array = numpy_to_vtk(np.repeat(np.array(values), (6, 6, 2)), deep=True)
            array.SetName(name)
            grid.GetCellData().AddArray(array)
        file = self.folder / "numbers.vtu"
        write(grid, file, [])
        return file

    def test_names_of_data(self):
        """The log tells which data of cells give the numbers, and which others
        might have been meant."""
        for arrays, volumes, remark in (
            ([("Material", (7, 9, 4))], {"7": 1, "9": 1, "4": 1}, "regions and boundaries are numbered by the data of cells 'Material'"),
            ([("part", (7, 9, 4)), ("Region", (1., 2., 3.)), ("my id", (1, 2, 3)), ("stress", (1.5, 2., 3.))], {"1": 1, "2": 1, "3": 1},
             "regions and boundaries are numbered by the data of cells 'Region'; passed over: 'part', 'my id'"),
            ([("Region_Id", (1, 2, 3))], {"0": 2},
             "no data of cells have a name by which they number regions and boundaries; passed over: 'Region_Id'"),
            ([("cell_tags", (-3, -4, -9))], {"3": 1, "4": 1, "9": 1},
             "regions and boundaries are numbered by the data of cells 'cell_tags', by MED's families without their sign"),
            ([("cell_tags", (-3, 0, -9))], {"3": 1, "0": 1, "9": 1}, "by MED's families without their sign")):
            with self.subTest(remark):
                file = self.numbered(*arrays)
                self.assertEqual(self.volumes(file), (volumes, 12))
                self.assertIn(remark + "\n", self.run_program("mesh", file).stdout)

    def test_wrong_numbers(self):
        """Data whose name is one of numbers, but whose values are not, are
        reported."""
        for name, values, found in (("region", (-1, 4, 9), "-1"), ("region", (1, 2**31, 9), "2147483648"), ("Material", (1.5, 4., 9.), "1.5"),
                                    ("cell_tags", (-3, 4, -9), "-3"), ("part", (1., float("nan"), 9.), "nan")):
            with self.subTest(name, found=found):
                self.refuse(self.numbered((name, values)), f"VTK: the data of cells '{name}' would number regions and boundaries: found {found}; "
                            "allowed are whole numbers from 0 to 2147483647")

    def test_any_name(self):
        for name in "text_4.vtk", "raw.vtu":
            write(two_cubes(1, VTK_TETRA), self.folder / name, FORMS[name])
            (self.folder / name).rename(self.folder / "a part")
            self.assertEqual(self.volumes(self.folder / "a part")[1], 12)

    def test_own_export(self):
        """The output of `export --to vtu` for a run is a mesh again."""
        self.run_program(self.case(), "--output", "out")
        subprocess.run([sys.executable, ROOT / "scripts" / "export", "out", "--to", "vtu", "--out", "body.pvd"], cwd=self.folder, check=True,
                       capture_output=True)
        files = sorted(self.folder.glob("**/*.vtu"))
        self.assertTrue(files)
        report = self.run_program("mesh", files[0]).stdout
        self.assertIn("40 cells", report)
        self.assertIn("volume 2", report)

    def case(self):
        file = self.folder / "case.prm"
        file.write_text(parameter_text({"Mesh/Type": "box", "Mesh/box/Size": "2, 1, 1", "Mesh/box/Cells": "2, 2, 2", "Discretization/Degree": 3,
                                        "Material/Young's modulus": "1e5", "Boundary conditions/Fixed": "x-min",
                                        "Loads/Body force": "0; 0; -10", "Time integration/Type": "static"}), encoding="utf-8")
        return file

    def refuse(self, file, expected=None):
        run = self.run_program("mesh", file, status=1)
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertIn(f"{file}: ", run.stderr)
        if expected:
            self.assertIn(expected, run.stderr)

    def test_cut_off(self):
        for name, settings in FORMS.items():
            file = self.folder / name
            grid = two_cubes(2, VTK_QUADRATIC_TETRA)
            # Legacy files have data behind the cells, which this removes.
            grid.GetCellData().Initialize()
            write(grid, file, settings)
            content = file.read_bytes()
            for part in 0.3, 0.95:
                with self.subTest(name, part=part):
                    cut = self.folder / ("cut" + file.suffix)
                    cut.write_bytes(content[:round(part * len(content))])
                    self.refuse(cut)

    def test_no_meshes(self):
        file = self.folder / "hexahedra.vtk"
        file.write_text("# vtk DataFile Version 3.0\ncube\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
                        "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\nCELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n", encoding="ascii")
        self.refuse(file, "VTK: found 1 vtkHexahedron of 8 points; allowed are tetrahedra")
        file = self.folder / "surface.vtk"
        file.write_text("# vtk DataFile Version 3.0\ntriangle\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n",
                        encoding="ascii")
        self.refuse(file, "VTK: ")
        file = self.folder / "point.vtk"
        file.write_text("# vtk DataFile Version 3.0\nwrong\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\nCELLS 1 5\n"
                        "4 0 1 2 3\nCELL_TYPES 1\n10\n", encoding="ascii")
        self.refuse(file, "a cell has a point that is none of 3")
        file = self.folder / "huge.vtu"
        file.write_text('<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid><Piece NumberOfPoints="1000000000000" NumberOfCells="1">'
                        '</Piece></UnstructuredGrid></VTKFile>', encoding="ascii")
        self.refuse(file)

    def test_full_disk(self):
        """A full disk is reported for the program, with the status for errors
        of the machine."""
        write(two_cubes(3, VTK_LAGRANGE_TETRAHEDRON), self.folder / "part.vtu", [])
        run = subprocess.run([sys.executable, "-B", ROOT / "scripts" / "read_vtk", "part.vtu", "part.msh"], cwd=self.folder, capture_output=True, text=True,
                             check=False, preexec_fn=limit_files)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (3, "part.msh: File too large\n", ""))

    def test_no_python(self):
        """Without Python files of VTK cannot be read; the message tells what is
        missing."""
        write(two_cubes(1, VTK_TETRA), self.folder / "part.vtu", [])
        run = subprocess.run([os.environ["COROTET_PROGRAM"], "mesh", "part.vtu"], cwd=self.folder, capture_output=True, text=True, check=False,
                             env={**os.environ, "PATH": str(self.folder)})
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertIn("Python, which reads files of VTK, is missing", run.stderr)


if __name__ == "__main__":
    unittest.main()
