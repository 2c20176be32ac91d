#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Type = modes: results on one and two ranks, and those of a failed
computation.

Eigenvalues are exact to the square of the tolerance of the residuals, 1e-8: on one and two ranks they agree to 1e-10, whatever
the order of sums. The frequency of a rigid body mode is round-off, which must be far below that of the first other mode.
"""

import itertools
import operator
import unittest

import h5py
import numpy as np

from support import MODES_COLUMNS, ROOT, ProgramTest, parameter_text, read_modes, read_summary

SMALLER = ("Mesh/box/Cells = 4, 4, 1", "Output/Probes =")
CUBES = {"Type": "modes", "Mesh/Type": "file", "Mesh/file/File": "cubes.msh", "Discretization/Degree": "2",
         "Boundary conditions/Fixed": "bottom"}


def mesh_of_cubes(number):
    """A mesh of cubes with sides of 1, at distances of 2 along x, of 24
    tetrahedra each: pyramids on its sides, in quarters."""
    corners = list(itertools.product((0, 1), repeat=3))
    sides = list(itertools.product(range(3), (0, 1)))
    places = [*corners, (0.5, 0.5, 0.5), *([end if a == axis else 0.5 for a in range(3)] for axis, end in sides)]
    nodes = [(2 * cube + x, y, z) for cube in range(number) for x, y, z in places]
    # A quarter of a side has its middle and two neighbouring corners, which
    # differ in one number.
    quarters = [(side, 10 + i, j + 1, k + 1) for i, side in enumerate(sides) for j, a in enumerate(corners) for k, b in enumerate(corners)
                if j < k and a[side[0]] == b[side[0]] == side[1] and sum(map(abs, map(operator.sub, a, b))) == 1]
    # Seen from the last vertex of a cell, its other vertices are ordered
    # counterclockwise.
    quarters = [(side, a, b, c) if np.linalg.det(np.subtract([places[n - 1] for n in (a, b, c)], places[8])) < 0 else (side, a, c, b)
                for side, a, b, c in quarters]
    elements = [(4, 1, [n + len(places) * cube for n in (*quarter, 9)]) for cube in range(number) for _, *quarter in quarters]
    elements += [(2, 2, [n + len(places) * cube for n in quarter]) for cube in range(number) for side, *quarter in quarters if side == (2, 0)]
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '3 1 "cubes"', '2 2 "bottom"', "$EndPhysicalNames",
                      "$Nodes", str(len(nodes)), *(" ".join(map(str, (i, *node))) for i, node in enumerate(nodes, 1)), "$EndNodes",
                      "$Elements", str(len(elements)),
                      *(" ".join(map(str, (i, kind, 2, name, 1, *vertices))) for i, (kind, name, vertices) in enumerate(elements, 1)), "$EndElements", ""])


class Modes(ProgramTest):

    def test_ranks(self):
        one = self.run_case("plate_modes", "one", *SMALLER)
        two = self.run_case("plate_modes", "two", *SMALLER, ranks=2)
        self.assertEqual((read_summary(one)["ranks"], read_summary(two)["ranks"]), (1, 2))
        rows = [read_modes(directory) for directory in (one, two)]
        self.assertEqual(list(rows[1][0]), MODES_COLUMNS)
        frequencies = [[float(row["frequency"]) for row in table] for table in rows]
        self.assertEqual([len(table) for table in rows], [10, 10])
        for table in frequencies:
            self.assertLess(max(table[:3]), 1e-9 * table[3])
        for first, second in zip(frequencies[0][3:], frequencies[1][3:]):
            self.assertAlmostEqual(first, second, delta=1e-10 * first)
        self.check_vtkhdf(one)
        self.check_vtkhdf(two)
        # The fourth mode has a frequency of its own, so its stress has the
        # error of the residual, 1e-8.
        first, second = (self.stresses(directory)[3] for directory in (one, two))
        self.assertLess(abs(first - second).max(), 1e-6 * first.max())

    @staticmethod
    def stresses(directory):
        """A row of stresses of cells for each mode, sorted, as the order of
        cells depends on ranks."""
        with h5py.File(directory / "solution.vtkhdf") as file:
            n_modes = file["VTKHDF/Steps"].attrs["NSteps"]
            return np.sort(np.reshape(file["VTKHDF/CellData/von_mises"], (int(n_modes), -1)))

    def test_loads_are_left_out(self):
        # The log says that loads have no effect, and frequencies are those
        # without loads.
        free = self.run_case("plate_modes", "free", *SMALLER)
        loaded = self.run_case("plate_modes", "loaded", *SMALLER, "Loads/Gravity = 0; 0; -10")
        self.assertEqual(read_modes(free), read_modes(loaded))
        self.assertNotIn("left out", (free / "log.txt").read_text(encoding="utf-8"))
        self.assertEqual((loaded / "log.txt").read_text(encoding="utf-8").count("loads are left out"), 1)

    def test_failed_computation(self):
        settings = ("Linear solver/Type = jacobi", "Linear solver/Maximum iterations = 3")
        for ranks in (1, 2):
            overrides = [word for setting in (*SMALLER, *settings) for word in ("--set", setting)]
            run = self.run_program(ROOT / "parameters" / "plate_modes.prm", *overrides, "--output", f"failed_{ranks}", status=2, ranks=ranks)
            self.assertEqual(run.stderr.count("corotet: error: the linear solver stopped after 3 iterations"), 1, run.stderr)
            summary = read_summary(self.folder / f"failed_{ranks}")
            self.assertEqual((summary["status"], summary["modes"], summary["frequencies"]), ("failed", 0, []))
            self.assertIn(summary["message"], run.stderr)

    def test_equal_bodies(self):
        # A cube bends to two sides alike, so six cubes have the lowest
        # frequency twelve times, of which only some modes are requested.
        (self.folder / "cubes.prm").write_text(parameter_text(CUBES), encoding="utf-8")
        lowest = None
        for cubes, number in ((1, 1), (6, 4), (7, 3)):
            (self.folder / "cubes.msh").write_text(mesh_of_cubes(cubes), encoding="utf-8")
            output = f"{number} of {cubes}"
            self.run_program("cubes.prm", "--set", f"Modes/Number = {number}", "--output", output)
            frequencies = [float(row["frequency"]) for row in read_modes(self.folder / output)]
            self.assertEqual(len(frequencies), number)
            lowest = lowest or frequencies[0]
            for frequency in frequencies:
                self.assertAlmostEqual(frequency, lowest, delta=1e-10 * lowest)

    def test_springs_as_soft_as_round_off(self):
        """A steel bar on springs that are 1e-17 times as stiff: frequencies of
        its rigid motions are round-off, which a warning tells; with a ratio of
        1e-10 they are not."""
        bar = {"Type": "modes", "Mesh/box/Size": "1, 0.1, 0.1", "Mesh/box/Cells": "4, 1, 1", "Material/Young's modulus": "2e11",
               "Material/Density": "7800", "Modes/Number": "8"}
        for stiffness, n_warned in ((20, 0), (2e-6, 6)):
            (self.folder / "bar.prm").write_text(parameter_text({**bar, "Supports/Elastic": f"x-min: {stiffness}; {stiffness}; {stiffness}"}), encoding="utf-8")
            run = self.run_program("bar.prm", "--output", f"on {stiffness}")
            self.assertEqual(run.stdout.count("as little as round-off: its frequency may be wrong"), n_warned)

    def test_probe_on_a_curved_surface(self):
        """A point of a sphere, which lies outside of straight cells, is moved
        to them, as in simulations."""
        (self.folder / "ball.geo").write_text('SetFactory("OpenCASCADE"); Sphere(1) = {0, 0, 0, 1}; Mesh.MeshSizeMax = 0.6;\n'
                                              'Physical Volume("ball") = {1}; Physical Surface("skin") = {1};\n', encoding="utf-8")
        (self.folder / "ball.prm").write_text(parameter_text({
            "Type": "modes", "Mesh/Type": "file", "Mesh/file/File": "ball.geo", "Discretization/Degree": "1",
            "Output/Probes": "tip: 0.57735 0.57735 0.57735", "Modes/Number": "7"}), encoding="utf-8")
        for kind in ("simulation", "modes"):
            run = self.run_program("ball.prm", "--validate", "--set", f"Type = {kind}")
            self.assertRegex(run.stdout, r"Output/Probes: 'tip' is \S+ m outside the body: taken at \(")

    def test_overwrite(self):
        # Results of modes are replaced by those of a simulation, without
        # remains.
        directory = self.run_case("plate_modes", "results", *SMALLER)
        self.run_case("gravity_linear", "results", "Output/Overwrite = true", "Time integration/static/Load steps = 1")
        self.assertFalse((directory / "modes.csv").exists())


if __name__ == "__main__":
    unittest.main()
