#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Bodies with few supports, or with nearly all nodes fixed: springs that appear
and vanish, few free nodes, cells without thickness. Problems with a solution
are solved, and those without one give no result.
"""

import math
import re
import unittest

from support import ROOT, ProgramTest, parameter_text, read_history, read_summary

# A cube of 1000 kg.
CUBE = {"Mesh/box/Size": "1, 1, 1", "Mesh/box/Cells": "3, 3, 3", "Loads/Gravity": "0; 0; -9.81", "Time integration/Type": "static"}
SPRINGS = "Supports/Elastic"


def springs(stiffness):
    """Springs on the bottom, in all directions."""
    return {SPRINGS: f"z-min: {stiffness}; {stiffness}; {stiffness}"}


class Statics(ProgramTest):

    def run_cube(self, entries, *arguments, **others):
        (self.folder / "cube.prm").write_text(parameter_text({**CUBE, **entries}), encoding="utf-8")
        return self.run_program("cube.prm", "--output", "out", "--set", "Output/Overwrite = true", *arguments, **others)

    def test_springs_from_zero(self):
        """The springs have no stiffness at the start, but no load step ends
        there."""
        for steps in (1, 4):
            self.run_cube({**springs("1e5 * t"), "Material/Type": "linear", "Material/Young's modulus": "1e9"},
                          "--set", f"Time integration/static/Load steps = {steps}", "--set", "Output/Probes = bottom: 0.5 0.5 0")
            rows = read_history(self.folder / "out")
            # Weight and springs grow in proportion: 9810 N on 1e5 N/m, except
            # for the bending of the bottom.
            for row in rows[1:]:
                self.assertAlmostEqual(float(row["bottom_z"]), -0.0981, delta=1e-5)

    def test_springs_that_vanish(self):
        """Nothing holds the body at the end, so there is no solution, however
        large the displacement."""
        for solver in ("automatic", "direct", "jacobi"):
            with self.subTest(solver):
                run = self.run_cube(springs("1e6 * (1 - t)"), "--set", "Time integration/static/Load steps = 2", "--set", "Linear solver/Type = " + solver,
                                    "--set", "Time integration/Maximum halvings = 1", status=2)
                self.assertRegex(run.stderr, "^corotet: error: step 2 .*\n$")
                self.assertEqual(read_summary(self.folder / "out")["status"], "failed")
                # Recorded states were held: halfway to the end the springs
                # still have a quarter of their stiffness or more.
                self.assertLess(float(read_history(self.folder / "out")[-1]["max_displacement"]), 0.1)

    def test_initial_velocity(self):
        """Nothing moves in statics, so an initial velocity causes a warning."""
        for velocity, warned in (("0; 0; 1", 1), ("0; 0; 0", 0)):
            out = self.run_cube({"Boundary conditions/Fixed": "z-min"}, "--set", f"Initial conditions/Velocity = {velocity}").stdout
            self.assertEqual(out.count("warning: Initial conditions/Velocity: has no effect in statics, where nothing moves"), warned)

    def test_nothing_acts(self):
        """Without any action the log has a warning, in statics and in
        dynamics."""
        warning = "warning: the displacement is zero everywhere"
        for kind in ("static", "generalized-alpha"):
            for gravity, warned in (("0; 0; 0", 1), ("0; 0; -1e-6", 0)):
                with self.subTest(kind, gravity=gravity):
                    out = self.run_cube({"Boundary conditions/Fixed": "z-min", "Time integration/Type": kind,
                                         "Loads/Gravity": gravity}).stdout
                    self.assertEqual(out.count(warning), warned)
        # A body that has come back to its position has moved, so there is no
        # warning.
        out = self.run_cube({"Boundary conditions/Displacement": "z-min: 0; 0; pulse(t, 0.2, 0.7)", "Time integration/Type": "static",
                             "Time integration/static/Load steps": "4", "Time integration/static/Proportional loading": "false"}).stdout
        self.assertEqual(out.count(warning), 0)

    def test_preconditioner_of_another_shape(self):
        """ The guess is a plate bent to a quarter of a circle. One iteration is
        not enough there, so load steps are halved; no solve goes on for long
        with the preconditioner of another shape, which took up to 4,835
        iterations.
        """
        radius, middle = 2 / math.pi, 0.005
        bent = (f"({radius} - (z - {middle}))*sin(x/{radius}) - x; 0; "
                f"{radius} - ({radius} - (z - {middle}))*cos(x/{radius}) - (z - {middle})")
        run = self.run_cube({"Mesh/box/Size": "1, 1, 0.01", "Mesh/box/Cells": "20, 20, 1", "Boundary conditions/Fixed": "x-min",
                             "Initial conditions/Displacement": bent, "Newton/Tangent": "frozen rotation", "Newton/Maximum iterations": "1",
                             "Newton/Log every solve": "true", "Linear solver/Type": "p-multigrid",
                             "Linear solver/Maximum iterations": "20000"}, status=2)
        iterations = [int(n) for n in re.findall(r"Newton 1 iterations, linear (\d+)", run.stdout)]
        self.assertGreater(len(iterations), 2)
        self.assertLess(max(iterations), 100)

    def test_fixed_on_all_sides(self):
        """Few unknowns are free, and none at vertices of a single cuboid: the
        middle sinks, by less than in a body that is held at two ends."""
        fixed = {"Boundary conditions/Fixed": "x-min, x-max, y-min, y-max, z-min, z-max", "Mesh/box/Cells": "1, 1, 1"}
        largest = 1000 * 9.81 / 1e7 / 8
        for degree in (2, 3):
            for kind in ("static", "generalized-alpha"):
                with self.subTest(degree=degree, kind=kind):
                    self.run_cube({**fixed, "Discretization/Degree": degree, "Material/Young's modulus": "1e7", "Time integration/Type": kind,
                                   "Time integration/End time": "0.05"})
                    self.assertLess(float(read_history(self.folder / "out")[-1]["max_displacement"]), largest)
                    self.assertEqual(read_summary(self.folder / "out")["status"], "done")

    def test_thin_cells_that_are_crushed(self):
        """Bodies crushed to a plane, a line or a point recover, as they have
        rotations and stiffness from the first step on."""
        for number, displacement in enumerate(("0; 0; -z", "0; -y; -z", "-x; -y; -z")):
            with self.subTest(displacement):
                output = self.run_case("crushed_cube", f"crushed_{number}", "Mesh/box/Size = 1, 1, 0.05", f"Initial conditions/Displacement = {displacement}",
                                       "Output/Probes =", "Time integration/End time = 1.5")
                rows = read_history(output)
                self.assertEqual(len(rows), 6)
                self.assertEqual(float(rows[0]["volume"]), 0)
                self.assertLess(float(rows[-1]["elastic_energy"]), 0.5 * float(rows[0]["elastic_energy"]))

    def test_forces_that_are_not_finite(self):
        """An exact solution that inverts cells has no stress there: the step
        fails, and no solver works with values that are not numbers."""
        (self.folder / "folded.prm").write_text(parameter_text({
            "Mesh/box/Size": "1, 1, 1", "Mesh/box/Cells": "3, 3, 3", "Discretization/Degree": "3", "Material/Type": "neo-Hookean",
            "Exact solution/Displacement": "0.6*t*sin(3*y+z); 0.6*t*sin(2*z+x); 0.6*t*sin(3*x-y)", "Time integration/Type": "static"}), encoding="utf-8")
        run = self.run_program("folded.prm", "--output", "out", status=2)
        self.assertRegex(run.stderr, "the forces are not finite where Newton's method starts; the step has been halved 8 times\n$")

    def test_nearly_incompressible_under_pressure(self):
        """Exact tangents are factorised themselves: with factors of the frozen
        matrix, which has no volume change, solves take 11,716 iterations."""
        self.run_cube({"Mesh/box/Cells": "5, 5, 5", "Discretization/Degree": "2", "Loads/Gravity": "0; 0; 0", "Material/Type": "corotational",
                       "Material/Rotation": "quadrature points", "Material/Young's modulus": "1e6", "Material/Poisson's ratio": "0.4999",
                       "Boundary conditions/Fixed": "z-min", "Boundary conditions/Pressure": "z-max: 3e5", "Time integration/static/Load steps": "1"})
        self.assertLess(int(read_history(self.folder / "out")[-1]["linear_iterations"]), 1000)

    def test_plate_under_pressure_in_one_step(self):
        """The first increment is a hundred times as large as the plate. Line
        searches from there fail, and each one after a full increment fails in
        the same way: the attempt ends with the second of them, after 9
        iterations instead of 18, and halves of the step are fast."""
        run = self.run_cube({"Mesh/box/Size": "1, 1, 0.01", "Mesh/box/Cells": "8, 8, 1", "Discretization/Degree": "2", "Loads/Gravity": "0; 0; 0",
                             "Material/Type": "corotational", "Material/Rotation": "quadrature points", "Material/Young's modulus": "1e6",
                             "Boundary conditions/Fixed": "x-min, x-max, y-min, y-max", "Boundary conditions/Pressure": "z-min: 1e4",
                             "Time integration/static/Load steps": "1"})
        attempts = re.findall(r"^t = \S+: Newton (\d+) iterations", run.stdout, re.MULTILINE)
        self.assertEqual(len(attempts), 3)
        self.assertLessEqual(max(map(int, attempts)), 12)
        self.assertIn("Newton's method gets no further along its directions", run.stdout)


if __name__ == "__main__":
    unittest.main()
