#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""scripts/export: written files are read back by VTK's, PyVista's and meshio's readers where these exist, and compared with the run's own
numbers in history.csv and in the time series as VTK reads it."""

import csv
import importlib.util
import json
import shutil
import struct
import unittest
import xml.etree.ElementTree as xml

import h5py
import matplotlib
import numpy as np
import pyvista as pv
from meshio.xdmf import TimeSeriesReader
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger
from vtkmodules.vtkIOGeometry import vtkGLTFReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from scripts_support import LONG, ScriptTest, State, state_of, times_of
from commands import is_ours
from support import limit_files, read_history, read_modes

SINGLE = 1e-6  # relative; single precision has 6e-8, and sums of some thousand numbers lose a digit
# A rule for tetrahedra, points and weights, that is exact for polynomials of degree 3, as the volume of quadratic cells requires.
KEAST = [((1 / 4,) * 3, -4 / 30)] + [((a, b, c), 9 / 120) for a, b, c in ((1 / 6,) * 3, (1 / 2, 1 / 6, 1 / 6), (1 / 6, 1 / 2, 1 / 6), (1 / 6, 1 / 6, 1 / 2))]


def volume(state):
    """The volume of the displaced body, by the derivatives of VTK's own cells."""
    total, places = 0, state.displaced()
    for i, nodes in enumerate(state.cells):
        cell, derivatives = state.grid.GetCell(i), np.zeros(3 * len(nodes))
        for point, weight in KEAST:
            cell.InterpolateDerivs(point, derivatives)
            total += weight * np.linalg.det(derivatives.reshape(3, -1) @ places[nodes])
    return total


def enclosed(points, triangles):
    a, b, c = (points[triangles[:, i]].astype(float) for i in range(3))
    return (a * np.cross(b, c)).sum() / 6


def area(points, triangles):
    a, b, c = (points[triangles[:, i]].astype(float) for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


class Glb:
    """A binary glTF file whose structure is checked while it is read."""

    def __init__(self, test, path):
        content = path.read_bytes()
        magic, version, length = struct.unpack_from("<4sII", content)
        test.assertEqual((magic, version, length), (b"glTF", 2, len(content)))
        n_json, kind = struct.unpack_from("<I4s", content, 12)
        test.assertEqual((kind, n_json % 4), (b"JSON", 0))
        self.json = json.loads(content[20 : 20 + n_json])
        n_binary, kind = struct.unpack_from("<I4s", content, 20 + n_json)
        test.assertEqual((kind, 28 + n_json + n_binary), (b"BIN\0", len(content)))
        test.assertEqual(self.json["buffers"], [{"byteLength": n_binary}])
        self.binary = content[28 + n_json :]
        for i, accessor in enumerate(self.json["accessors"]):
            data = self.read(i)
            if "min" in accessor:
                test.assertEqual((np.atleast_1d(data.min(axis=0)).tolist(), np.atleast_1d(data.max(axis=0)).tolist()), (accessor["min"], accessor["max"]))
        self.primitive = self.json["meshes"][0]["primitives"][0]
        # The format requires bounds of positions.
        for attributes in [self.primitive["attributes"], *self.primitive.get("targets", [])]:
            test.assertIn("min", self.json["accessors"][attributes["POSITION"]])
        self.base = {name: self.read(i) for name, i in self.primitive["attributes"].items()}
        self.targets = [{name: self.read(i) for name, i in target.items()} for target in self.primitive.get("targets", [])]
        self.triangles = self.read(self.primitive["indices"]).reshape(-1, 3)
        test.assertLess(self.triangles.max(), len(self.base["POSITION"]))

    def read(self, number):
        accessor = self.json["accessors"][number]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind = {5126: np.float32, 5125: np.uint32}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        data = np.frombuffer(self.binary, kind, accessor["count"] * width, view["byteOffset"])
        assert data.nbytes == view["byteLength"]
        return data if width == 1 else data.reshape(-1, width)

    def animation(self, number):
        """The times of an animation, and a row of weights for each time."""
        sampler = self.json["animations"][number]["samplers"][0]
        times = self.read(sampler["input"])
        return times, self.read(sampler["output"]).reshape(len(times), -1)


class Export(ScriptTest):
    script = "export"

    def history(self):
        return [{name: float(value) for name, value in row.items()} for row in read_history(self.runs / "beam")]

    def test_vtu(self):
        """Lagrange tetrahedra of the run's degree with the same numbers, bit by bit; their volume is that of history.csv to round-off."""
        for run in ("beam", "plate"):
            self.start(self.runs / run, "--to", "vtu")
            entries = xml.parse(self.folder / f"{run}.pvd").getroot().find("Collection")
            self.assertEqual([float(entry.get("timestep")) for entry in entries], times_of(self.runs / run).tolist())
            self.assertGreaterEqual(len(entries), 5)
            for i, entry in enumerate(entries):
                reader = vtkXMLUnstructuredGridReader()
                reader.SetFileName(str(self.folder / entry.get("file")))
                reader.Update()
                found, expected = State(reader.GetOutput()), state_of(self.runs / run, i)
                self.assertEqual(set(vtk_to_numpy(reader.GetOutput().GetCellTypesArray())), {71})
                self.assertEqual(vtk_to_numpy(reader.GetOutput().GetFieldData().GetArray("TimeValue")).tolist(), [float(entry.get("timestep"))])
                for one, other in ((found.points, expected.points), (found.cells, expected.cells)):
                    np.testing.assert_array_equal(one, other)
                for one, other in ((found.point_data, expected.point_data), (found.cell_data, expected.cell_data)):
                    self.assertEqual(set(one), set(other))
                    for name, values in other.items():
                        self.assertEqual((one[name].dtype, one[name].tobytes()), (values.dtype, values.tobytes()), name)
            if run == "beam":
                self.assertAlmostEqual(volume(found) / self.history()[-1]["volume"], 1, delta=1e-12)
        self.start(self.runs / "beam", "--to", "vtu", "--times", 0.3, "--field", "stress", "--out", "one.vtu")
        one = State(pv.read(self.folder / "one.vtu"))
        self.assertEqual((list(one.point_data), list(one.cell_data)), (["stress"], []))

    def test_csv(self):
        """The table has all digits of the numbers."""
        self.start(self.runs / "beam", "--to", "csv")
        for i, row in enumerate(self.history()):
            with open(self.folder / f"beam_{i:04d}.csv", newline="", encoding="utf-8") as file:
                names, *rows = csv.reader(file)
            table = dict(zip(names, np.array(rows, float).T))
            state = state_of(self.runs / "beam", i)
            np.testing.assert_array_equal(np.stack([table[name] for name in "xyz"], axis=1), state.points)
            for name in ("stress", "strain"):
                np.testing.assert_array_equal(np.stack([table[f"{name}_{part}"] for part in ("xx", "yy", "zz", "xy", "yz", "xz")], axis=1), state.point_data[name])
            np.testing.assert_array_equal(table["von_mises"], state.point_data["von_mises"])
            displacement = np.stack([table[f"displacement_{part}"] for part in "xyz"], axis=1)
            # Another program computes the root of the sum of three squares, so the last digit may differ.
            self.assertAlmostEqual(np.linalg.norm(displacement, axis=1).max(), row["max_displacement"], delta=1e-15)

    def test_stl(self):
        """The surface is closed and faces outwards; for a box at rest it has the exact volume and area; otherwise the error of the volume
        decreases with the square of the size of triangles, as for chords of curves."""
        self.start(self.runs / "beam", "--to", "stl", "--times", 0, "--out", "rest.stl")
        mesh = pv.read(self.folder / "rest.stl").clean()
        self.assertAlmostEqual(enclosed(mesh.points, mesh.regular_faces) / 0.01, 1, delta=SINGLE)
        self.assertAlmostEqual(area(mesh.points, mesh.regular_faces) / 0.42, 1, delta=SINGLE)
        errors = []
        for n in (1, 2, 4):
            self.start(self.runs / "beam", "--to", "stl", "--times", 0.3, "--out", "bent.stl", "--subdivisions", n)
            mesh = pv.read(self.folder / "bent.stl").clean()
            errors.append(1 - enclosed(mesh.points, mesh.regular_faces) / self.history()[-1]["volume"])
            sides = mesh.regular_faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
            # Each edge occurs once in each direction.
            self.assertEqual(len(np.unique(sides, axis=0)), len(sides))
            self.assertEqual(set(map(tuple, sides.tolist())), {(b, a) for a, b in sides.tolist()})
            # 6 x 1 x 1 cuboids have 26 squares outside, each of two triangles.
            self.assertEqual(len(mesh.regular_faces), 52 * n**2)
        for coarse, fine in zip(errors, errors[1:]):
            self.assertAlmostEqual(coarse / fine, 4, delta=0.5)

    def test_obj(self):
        """The displaced nodes of the surface, to the nine digits that are written, in colours of the field from violet to yellow."""
        self.start(self.runs / "beam", "--to", "obj", "--field", "displacement", "--times", 0, 0.3)
        lines = [line.split() for line in (self.folder / "beam_0001.obj").read_text().splitlines()]
        rows = np.array([line[1:] for line in lines if line[0] == "v"], float)
        triangles = np.array([line[1:] for line in lines if line[0] == "f"], int) - 1
        state = state_of(self.runs / "beam", -1)
        nodes, places = rows[:, :3], state.displaced()
        nearest = np.abs(nodes[:, None] - places[None]).max(axis=2)
        self.assertLess(nearest.min(axis=1).max(), 1e-9)
        self.assertEqual(len(np.unique(nearest.argmin(axis=1))), len(nodes))
        self.assertGreater(enclosed(nodes, triangles), 0.0099)
        sizes = np.linalg.norm(state.point_data["displacement"], axis=1)[nearest.argmin(axis=1)]
        for value, colour in ((sizes.min(), 0.0), (sizes.max(), 1.0)):
            expected = matplotlib.colormaps["viridis"](colour)[:3]
            np.testing.assert_allclose(rows[np.isclose(sizes, value)][0, 3:], expected, atol=1e-8)
        # Values of cells jump from triangle to triangle, which then have vertices of their own: here the cells at one end are another
        # region.
        parts = self.run_case("cantilever", "parts", "Time integration/End time = 0.01", "Mesh/box/Cells = 6, 1, 1", "Discretization/Degree = 2",
                              "Selections/Regions = end: box 0.5 -1 -1 2 1 1")
        self.start(parts, "--to", "obj", "--field", "region", "--times", 0, "--warp", 0, "--out", "parts.obj")
        lines = [line.split() for line in (self.folder / "parts.obj").read_text().splitlines()]
        rows = np.array([line[1:] for line in lines if line[0] == "v"], float).reshape(-1, 3, 6)
        self.assertEqual([line[1:] for line in lines if line[0] == "f"], [[str(3 * i + k) for k in (1, 2, 3)] for i in range(len(rows))])
        self.assertEqual(len(rows), len(triangles))
        is_end = rows[:, :, 0].mean(axis=1) > 0.5
        np.testing.assert_allclose(rows[is_end][:, :, 3:], np.broadcast_to(matplotlib.colormaps["viridis"](1.0)[:3], (is_end.sum(), 3, 3)), atol=1e-8)
        np.testing.assert_allclose(rows[~is_end][:, :, 3:], np.broadcast_to(matplotlib.colormaps["viridis"](0.0)[:3], ((~is_end).sum(), 3, 3)), atol=1e-8)

    def test_gltf(self):
        """Each state is a morph target with full weight at its time, with the run's largest displacement and volume."""
        self.start(self.runs / "beam", "--to", "gltf", "--field", "displacement")
        file, times = Glb(self, self.folder / "beam.glb"), times_of(self.runs / "beam")
        self.assertEqual(len(file.targets), len(times))
        keys, weights = file.animation(0)
        np.testing.assert_array_equal(keys, times.astype(np.float32))
        np.testing.assert_array_equal(weights, np.eye(len(times)))
        for row, target in zip(self.history(), file.targets):
            self.assertAlmostEqual(np.linalg.norm(target["POSITION"], axis=1).max(), row["max_displacement"], delta=SINGLE * row["max_displacement"])
            # Triangles are straight, two for each edge of a cell: test_stl checks how that error decreases.
            places = file.base["POSITION"] + target["POSITION"]
            self.assertAlmostEqual(enclosed(places, file.triangles) / row["volume"], 1, delta=1e-3)
            normals = file.base["NORMAL"] + target["NORMAL"]
            np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=SINGLE)
        # The sides of the box at rest are flat, as vertices at its edges are repeated for each side.
        self.assertTrue((np.sort(abs(file.base["NORMAL"]), axis=1) == (0, 0, 1)).all())
        # Colours are intensities: the largest displacement is yellow, and that of the support violet.
        colours = file.base["COLOR_0"] + file.targets[-1]["COLOR_0"]
        # The mesh has the colours of the largest values of all states, which are those of the last state here.
        np.testing.assert_allclose(colours, file.base["COLOR_0"], atol=SINGLE)
        self.assertGreater(abs(file.targets[0]["COLOR_0"]).max(), 0.5)
        tip = np.linalg.norm(file.targets[-1]["POSITION"], axis=1).argmax()
        for vertex, colour in ((tip, 1.0), (file.base["POSITION"][:, 0].argmin(), 0.0)):
            expected = ((np.array(matplotlib.colormaps["viridis"](colour)[:3]) + 0.055) / 1.055) ** 2.4
            np.testing.assert_allclose(colours[vertex], expected, atol=2e-3)

    def test_times_of_gltf(self):
        """Times begin at zero with the first state: the format has no negative times, and single precision could not tell the times of
        this run apart. States have different times even where they are equal after rounding."""
        late = self.runs / "late"
        if not late.exists():
            shutil.copytree(self.runs / "beam", late)
        for times in (1e6 + 1e-3 * np.arange(11), -1 + 0.1 * np.arange(11)):
            with h5py.File(late / "solution.vtkhdf", "r+") as file:
                file["VTKHDF/Steps/Values"][...] = times
            self.start(late, "--to", "gltf", "--out", "late.glb")
            file = Glb(self, self.folder / "late.glb")
            np.testing.assert_allclose(file.animation(0)[0], times - times[0], rtol=SINGLE, atol=1e-9)
            self.assertEqual(file.json["meshes"][0]["extras"]["times"], times.tolist())
        with h5py.File(late / "solution.vtkhdf", "r+") as file:
            file["VTKHDF/Steps/Values"][...] = np.append(1 + 1e-12 * np.arange(10), 2)
        self.start(late, "--to", "gltf", "--out", "late.glb")
        keys = Glb(self, self.folder / "late.glb").animation(0)[0]
        self.assertTrue((np.diff(keys) > 0).all() and keys[0] == 0 and keys[-1] == 1, keys)

    def test_gltf_by_vtk(self):
        """VTK's reader accepts the file, and gives the run's displaced body at a time of the run."""
        self.start(self.runs / "beam", "--to", "gltf")
        # That reader has no colours of morph targets, and warns for each.
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
        reader = vtkGLTFReader()
        reader.SetFileName(str(self.folder / "beam.glb"))
        reader.UpdateInformation()
        reader.SetFrameRate(100)
        reader.EnableAnimation(0)
        reader.UpdateInformation()
        reader.UpdateTimeStep(0.15)
        block = reader.GetOutputDataObject(0)
        while block.IsA("vtkMultiBlockDataSet"):
            block = block.GetBlock(0)
        # The y axis of the file is the run's z axis.
        x, y, z = vtk_to_numpy(block.GetPoints().GetData()).T
        places = state_of(self.runs / "beam", 5).displaced()
        for found, expected in zip((x, -z, y), places.T):
            np.testing.assert_allclose((found.min(), found.max()), (expected.min(), expected.max()), atol=1e-6)

    def test_gltf_of_modes(self):
        """Each mode is a target with its own animation, named by its frequency; one state without --field is a plain mesh."""
        self.start(self.runs / "plate", "--to", "gltf", "--warp", 1, "--seconds", 2)
        file, modes = Glb(self, self.folder / "plate.glb"), read_modes(self.runs / "plate")
        names = [f"mode {i}: {float(mode['frequency']):.5g} Hz" for i, mode in enumerate(modes, start=1)]
        self.assertEqual([animation["name"] for animation in file.json["animations"]], names)
        for i, target in enumerate(file.targets):
            keys, weights = file.animation(i)
            self.assertEqual((keys[0], keys[-1]), (0, 2))
            np.testing.assert_allclose(weights, np.outer(np.sin(np.pi * keys), np.arange(len(modes)) == i), atol=SINGLE)
            state = state_of(self.runs / "plate", i)
            # Only nodes on the sides of the plate are compared, as nodes inside may move farther.
            shape = state.point_data["displacement"][np.isclose(state.points / (10, 10, 1), (0.5, 0.5, 0), atol=0.499).all(axis=1) == 0]
            self.assertAlmostEqual(np.linalg.norm(target["POSITION"], axis=1).max() / np.linalg.norm(shape, axis=1).max(), 1, delta=SINGLE)
        self.start(self.runs / "beam", "--to", "gltf", "--times", 0.15, 0.3, "--split")
        for name in ("beam_0000.glb", "beam_0001.glb"):
            file = Glb(self, self.folder / name)
            self.assertEqual((file.targets, "animations" in file.json), ([], False))

    def test_xdmf(self):
        """meshio reads the same numbers, bit by bit."""
        self.start(self.runs / "beam", "--to", "xdmf")
        with TimeSeriesReader(self.folder / "beam.xdmf") as reader:
            points, cells = reader.read_points_cells()
            self.assertEqual((reader.num_steps, cells[0].type), (11, "tetra10"))
            for i, time in enumerate(times_of(self.runs / "beam")):
                found_time, point_data, cell_data = reader.read_data(i)
                state = state_of(self.runs / "beam", i)
                self.assertEqual(found_time, time)
                np.testing.assert_array_equal(points, state.points)
                np.testing.assert_array_equal(cells[0].data, state.cells)
                for name in ("displacement", "velocity", "von_mises"):
                    np.testing.assert_array_equal(point_data[name], state.point_data[name])
                np.testing.assert_array_equal(point_data["stress_xz"], state.point_data["stress"][:, 5])
                np.testing.assert_array_equal(cell_data["det_F"][0], state.cell_data["det_F"])
                np.testing.assert_array_equal(cell_data["cells_von_mises"][0], state.cell_data["von_mises"])

    def test_xdmf_of_cubic_cells(self):
        """The nodes of each cubic cell make 27 straight tetrahedra: all nodes are used, no tetrahedron is inverted, and with the
        displaced nodes their volume is that of the curved cells to 1 %, the error of chords of 10 degrees."""
        self.start(self.runs / "sphere", "--to", "xdmf")
        state = state_of(self.runs / "sphere", -1)
        with TimeSeriesReader(self.folder / "sphere.xdmf") as reader:
            points, cells = reader.read_points_cells()
            _, point_data, cell_data = reader.read_data(reader.num_steps - 1)
        self.assertEqual(cells[0].data.shape, (27 * len(state.cells), 4))
        self.assertEqual(len(np.unique(cells[0].data)), len(state.points))
        rest, displaced = (np.linalg.det(places[:, 1:] - places[:, :1]) / 6 for places in (points[cells[0].data],
                                                                                     (points + point_data["displacement"])[cells[0].data]))
        self.assertGreater(rest.min(), 0)
        expected = float(read_history(self.runs / "sphere")[-1]["volume"])
        self.assertAlmostEqual(displaced.sum() / expected, 1, delta=1e-2)
        np.testing.assert_array_equal(cell_data["det_F"][0], np.repeat(state.cell_data["det_F"], 27))

    def test_usd(self):
        if importlib.util.find_spec("pxr") is None:
            self.check_mistakes([((self.runs / "beam", "--to", "usd"), "USD needs the Python package pxr")])
            return
        from pxr import Usd, UsdGeom
        self.start(self.runs / "beam", "--to", "usd", "--out", "beam.usda")
        stage = Usd.Stage.Open(str(self.folder / "beam.usda"))
        points = UsdGeom.Mesh(stage.GetDefaultPrim()).GetPointsAttr()
        np.testing.assert_allclose(np.array(points.GetTimeSamples()) / stage.GetTimeCodesPerSecond(), times_of(self.runs / "beam"), atol=1e-12)
        last = np.array(points.Get(points.GetTimeSamples()[-1]))
        np.testing.assert_allclose(np.ptp(last, axis=0), np.ptp(state_of(self.runs / "beam", -1).displaced(), axis=0), rtol=SINGLE)

    def test_values_that_are_no_numbers(self):
        """They are refused in any state, as colours and their limits would be wrong."""
        shutil.copytree(self.runs / "beam", self.folder / "broken")
        with h5py.File(self.folder / "broken" / "solution.vtkhdf", "r+") as file:
            file["VTKHDF/CellData/det_F"][-1] = np.nan
        self.check_mistakes([(("broken", "--to", form, "--field", "det_F", "--times", *times), "det_F is not finite in the states asked for")
                             for form in ("gltf", "obj") for times in (("0", "0.3"), ("0.3",))])
        self.start("broken", "--to", "gltf", "--field", "det_F", "--times", "0", "--out", "start.glb")
        self.assertTrue((self.folder / "start.glb").exists())

    def test_mistakes(self):
        beam = self.runs / "beam"
        (self.folder / "empty").mkdir()
        (self.folder / "foreign.stl").write_text("a shape of someone else")
        self.check_mistakes((
            (("empty", "--to", "stl"), "empty is not a folder of results: there is no solution.vtkhdf"),
            ((beam, "--to", "step"), "argument --to: invalid choice: 'step'"), ((beam,), "the following arguments are required: --to"),
            ((beam, "--to", "csv", "--field", "stres"), "is it stress? There are: "),
            ((beam, "--to", "gltf", "--field", "displacment"), "is it displacement? There are: "),
            ((beam, "--to", "gltf", "--field", "det_F", "region"), "gltf has colours of one field, found det_F, region"),
            ((beam, "--to", "stl", "--times", "1"), "1 is outside of the run, whose times are from 0 to 0.3"),
            ((beam, "--to", "stl", "--out", "beam.obj"), "found 'beam.obj'; of stl names end with .stl"),
            ((beam, "--to", "vtu", "--out", "beam.vtu"), "found 'beam.vtu' for 11 states; several go into a .pvd"),
            ((beam, "--to", "stl", "--subdivisions", "0"), "found --subdivisions 0; allowed are 1 to 16"),
            ((beam, "--to", "stl", "--out", "nowhere/beam.stl"), "the folder nowhere does not exist"),
            ((beam, "--to", "stl", "--times", "0", "--out", "foreign.stl"), "foreign.stl exists and was not made by this program"),
            ((beam, "--to", "stl", "--times", "0", "--out", "empty.stl", "--warp", "much"), "found --warp much; allowed are numbers and auto"),
            *(((beam, "--to", "stl", "--warp", factor), f"found --warp {factor}; allowed are numbers and auto") for factor in ("nan", "inf", "1e400")),
            ((beam, "--to", "stl", "--warp", "1e45"), "the displaced body is not finite at 0.03, with displacements multiplied by 1e+45"),
            ((beam, "--to", "gltf", "--split", "--seconds", "2"), "found --seconds with --split; files of one state have no animation"),
            ((beam, "--to", "gltf", "--seconds", "nan"), "argument --seconds: found nan; allowed are numbers from"),
            *(((beam, "--to", *words), f"{words[1]} has no effect with --to {words[0]}; allowed with {formats}") for *words, formats in (
                ("stl", "--field", "stress", "gltf, usd, vtu, obj, xdmf, csv"), ("stl", "--split", "gltf"), ("obj", "--seconds", "3", "gltf, usd"),
                ("vtu", "--subdivisions", "2", "gltf, usd, obj, stl"), ("csv", "--warp", "2", "gltf, usd, obj, stl"))),
            ((beam, "--to", "csv", "--times", "nan"), "found the time 'nan'; allowed are numbers"),
            ((beam, "--to", "csv", "--field", "stress", "region"), "csv has what is at nodes; found region, which cells have"),
            ((beam, "--to", "csv", "--times", "-1e-2:0.1"), "-0.01 is outside of the run, whose times are from 0 to 0.3"),
            ((beam, "--to", "csv", "--times", "0.1:0.11"), "found the times 0.1:0.11; there is no state between, the nearest is at 0.09 and 0.12"),
            ((beam, "--to", "csv", "--times", "0:0.3:99999999999"), "found the times 0:0.3:99999999999; allowed are up to 100000")))

    def test_times_between(self):
        """FROM:TO selects the states between, ends included, and not the nearest ones outside."""
        self.start(self.runs / "beam", "--to", "csv", "--times", "0.04:0.15", "--field", "displacement")
        names = [path.name for path in self.folder.glob("*.csv")]
        self.assertEqual(sorted(names), [f"beam_{i:04d}.csv" for i in range(4)])
        # A negative value is not taken for an option, however it is written.
        for factor in ("-1e-3", "-0.001", "-.001"):
            self.start(self.runs / "beam", "--to", "stl", "--times", "0.3", "--warp", factor)

    def test_missing_part(self):
        """In a long run, states are in files that other files than solution.vtkhdf refer to: if one is missing or damaged, that is an
        error and not a state of zeros."""
        run = self.run_case("cantilever", "long", *LONG)
        path = run / "solution" / "step_000005.h5"
        with h5py.File(run / "solution.vtkhdf") as file:
            self.assertNotIn(f"solution/{path.name}", {source.file_name for source in file["VTKHDF/PointData/displacement"].virtual_sources()})
        data = path.read_bytes()
        for damaged, message in ((b"", "the file is missing"), (data[:1000], "")):
            path.unlink(missing_ok=True)
            if damaged:
                path.write_bytes(damaged)
            self.check_mistakes([(("long", "--to", "csv", "--times", "0.05"), f"long/solution.vtkhdf is damaged: solution/{path.name}: {message}")])

    def test_beside_the_results(self):
        """States are never written into the folder of the run, though names are those of the run, nor into that of another run."""
        shutil.copytree(self.runs / "beam", self.folder / "beam")
        before = sorted((self.folder / "beam").rglob("*"))
        self.start("beam", "--to", "vtu")
        self.assertEqual(sorted((self.folder / "beam").rglob("*")), before)
        self.assertEqual(len(list((self.folder / "beam_vtu").iterdir())), 11)
        (self.folder / "beam").rename(self.folder / "other_vtu")
        (self.folder / "file_vtu").write_text("a file")
        self.check_mistakes(((("other_vtu", "--to", "vtu", "--out", "other.pvd"), "other_vtu has results of a run, no states for others"),
                             (("other_vtu", "--to", "vtu", "--out", "file.pvd"), "file_vtu cannot be a folder for the states: it is a file")))

    def test_full_disk(self):
        """On a full disk there are status 3, one line, and no incomplete files."""
        for kind in ("gltf", "vtu", "stl", "obj", "xdmf", "csv"):
            with self.subTest(kind=kind):
                self.start(self.runs / "beam", "--to", kind, status=3, preexec_fn=limit_files)
                self.assertEqual(list(self.folder.iterdir()), [])

    def test_own_files(self):
        """The script recognises files that it has written, so that they can be replaced."""
        for kind in ("gltf", "vtu", "stl", "obj", "xdmf", "csv", "csv"):
            self.start(self.runs / "beam", "--to", kind, "--times", 0, 0.3)
        files = [path for path in self.folder.rglob("*") if path.is_file()]
        self.assertEqual(len(files), 1 + 3 + 2 + 2 + 2 + 2)
        self.assertEqual([path for path in files if not is_ours(path)], [])
        # Files of a longer series that would look like a part of the new one are removed, but no files of others.
        (self.folder / "beam_0012.obj").write_text("of someone else")
        for kind in ("vtu", "stl", "obj", "csv"):
            for n in (4, 3):
                self.start(self.runs / "beam", "--to", kind, "--times", f"0:0.3:{n}")
        endings = [path.name for path in self.folder.rglob("beam_0*") if path.suffix != ".glb"]
        self.assertEqual(sorted(endings), sorted([f"beam_{i:04d}.{kind}" for kind in ("vtu", "stl", "obj", "csv") for i in range(3)] + ["beam_0012.obj"]))
        # No temporary files are left.
        self.assertEqual([path.name for path in self.folder.iterdir() if path.name.startswith(".")], [])


if __name__ == "__main__":
    unittest.main()
