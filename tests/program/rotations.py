#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Large rotations in the ready cases agree with theory. doc/rotations.md has
all figures.

- elastica: deflection and shortening of Bernoulli's elastica (elliptic integrals) to 1 %. The body is 20 times as long as
  thick: shear and stretch, which the elastica has not, change its deflection by 0.1 to 0.4 %.
- ring: an end moment of 2 pi E I / L closes the ring to 1 % of L. A body as thick as that with so few cells lacks 0.6 %,
  less with smaller cells or a thinner body.
- bend_45: the tip of Bathe and Bolourchi's bend to 0.8 m, 1.5 % of the deflection: theirs is a result of beam
  elements, and finer meshes converge to a point 0.4 m from it.
- twisted_beam: the middle section makes half of the turns of the end, by symmetry.
- The end of a run with one rotation for each cell tells how far rotations differ inside of cells, and warns where bending is far:
  gravity_corotational turns by some 60 degrees over ten cells, so by some 0.05 rad from the centre of a cell to its points; the bracket
  hardly at all.
- p-multigrid on a thin plate of 20,000 unknowns takes 700 iterations: the log names the direct solver, after two such solves.
- crushed_cube: all nodes return to their places at rest but for a rigid motion, to 1e-6 of the cube's length.
"""

import math
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

from support import ProgramTest, read_history, read_summary

# For each load P L^2 / E I: the deflection w / L and the shortening u / L.
ELASTICA = {1: (0.30172, 0.05643), 2: (0.49346, 0.16064), 5: (0.71379, 0.38763), 10: (0.81061, 0.55500)}
BEND = (-13.4, -23.5, 53.4)


def distance_from_rest(directory):
    """The largest distance of a node from its position at rest in the last
    state, after the best rigid motion (Kabsch)."""
    reader = vtkHDFReader()
    reader.SetFileName(str(directory / "solution.vtkhdf"))
    reader.UpdateInformation()
    reader.UpdateTimeStep(reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())[-1])
    grid = reader.GetOutputDataObject(0)
    rest = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    now = rest + vtk_to_numpy(grid.GetPointData().GetArray("displacement"))
    rest, now = rest - rest.mean(axis=0), now - now.mean(axis=0)
    u, _, v = np.linalg.svd(now.T @ rest)
    u[:, 2] *= np.linalg.det(u @ v)
    return np.linalg.norm(now - rest @ (u @ v).T, axis=1).max()


class Rotations(ProgramTest):

    def history(self, case, *settings, **others):
        return read_history(self.run_case(case, case, *settings, **others))

    def check_elastica(self, **others):
        rows = self.history("elastica", "Discretization/Degree = 2", **others)
        for load, (w, u) in ELASTICA.items():
            self.assertAlmostEqual(-float(rows[load]["tip_z"]), w, delta=0.01 * w, msg=f"deflection under load {load}")
            self.assertAlmostEqual(-float(rows[load]["tip_x"]), u, delta=0.01 * u, msg=f"shortening under load {load}")

    def test_elastica(self):
        self.check_elastica()

    def test_elastica_two_ranks(self):
        self.check_elastica(ranks=2)

    def test_ring(self):
        last = self.history("ring")[-1]
        gap = math.hypot(float(last["tip_x"]) + 1, float(last["tip_y"]), float(last["tip_z"]))
        self.assertLess(gap, 0.01)

    def test_bend_45(self):
        last = self.history("bend_45")[-1]
        for component, expected in zip("xyz", BEND):
            self.assertAlmostEqual(float(last[f"tip_{component}"]), expected, delta=0.8, msg=component)

    def test_twisted_beam(self):
        for degree in (1, 2, 3):
            for rotation in ("cell centre", "quadrature points"):
                with self.subTest(degree=degree, rotation=rotation):
                    rows = read_history(self.run_case("twisted_beam", f"{degree} {rotation}", f"Discretization/Degree = {degree}",
                                                      f"Material/Rotation = {rotation}"))
                    self.assertEqual(float(rows[-1]["time"]), 2)
                    angles = {name: np.unwrap([math.atan2(0.05 + float(row[f"{name}_z"]), 0.05 + float(row[f"{name}_y"])) for row in rows])
                              for name in ("middle", "end")}
                    turns = {name: (a - a[0]) / (2 * math.pi) for name, a in angles.items()}
                    time = np.array([float(row["time"]) for row in rows])
                    # The end is prescribed; the middle follows to the tolerance of Newton's method.
                    self.assertLess(np.abs(turns["end"] - time).max(), 1e-12)
                    self.assertLess(np.abs(turns["middle"] - time / 2).max(), 1e-6)
                    self.assertEqual({int(row["inverted_cells"]) for row in rows}, {0})

    def test_crushed_cube(self):
        starts = {"flat": "0; 0; -z", "line": "0; -y; -z", "point": "-x; -y; -z"}
        for degree in (1, 2, 3):
            for name, displacement in starts.items():
                with self.subTest(degree=degree, start=name):
                    directory = self.run_case("crushed_cube", f"{degree} {name}", f"Discretization/Degree = {degree}",
                                              f"Initial conditions/Displacement = {displacement}", "Output/Time between results = 1000")
                    self.assertLessEqual(distance_from_rest(directory), 1e-6)

    def test_difference_inside_of_cells(self):
        def check(case, number, least, most, *settings, **others):
            directory = self.run_case(case, f"{case}{number}", *settings, **others)
            difference = read_summary(directory).get("largest_rotation_difference")
            warned = "Material/Rotation = quadrature points" in (directory / "log.txt").read_text(encoding="utf-8")
            if most is None:
                self.assertIsNone(difference)
            else:
                self.assertGreater(difference, least)
                self.assertLess(difference, most)
            self.assertEqual(warned, most is not None and least >= 0.005)
            return difference

        centre = "Material/Rotation = cell centre"
        one = check("gravity_corotational", 1, 0.05, 0.2, centre)
        two = check("gravity_corotational", 2, 0.05, 0.2, centre, ranks=2)
        self.assertAlmostEqual(one, two, delta=1e-6)
        check("gravity_corotational", 3, 0, None)
        check("gravity_corotational", 4, 0, None, centre, "Discretization/Degree = 1")
        check("bracket", 5, 0, 0.005)

    def test_slow_solver_says_why(self):
        plate = ("Mesh/box/Size = 1, 1, 0.004", "Mesh/box/Cells = 14, 14, 1", "Discretization/Degree = 3", "Material/Young's modulus = 2e11",
                 "Time integration/static/Load steps = 4", "Output/Probes = tip: 0 0 0")
        for solver, says_why, changes in (("p-multigrid", 1, 0), ("automatic", 0, 1), ("direct", 0, 0)):
            directory = self.run_case("gravity_linear", solver, *plate, f"Linear solver/Type = {solver}")
            log = (directory / "log.txt").read_text(encoding="utf-8")
            self.assertEqual(log.count("linear solves take more than 100 iterations: 100 % of the cells are flat"), says_why, log)
            self.assertEqual(log.count("what would help: 'Linear solver/Type = automatic'"), says_why)
            self.assertEqual(log.count("Linear solver: a sparse factorisation takes the place of p-multigrid"), changes)


if __name__ == "__main__":
    unittest.main()
