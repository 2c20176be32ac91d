#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Stress in the results: at nodes, at quadrature points, at probes, and the estimate of its error.

A block of linear elasticity is sheared in two load steps;
tests/output/check_stress.py checks its files. A bar under tension has the same
stress everywhere, which all results must show. Two ranks differ by the linear
solver's error, 1e-12.
"""

import subprocess
import sys
import unittest

from support import ROOT, ProgramTest, read_history, read_summary

BLOCK = """
subsection Mesh
  subsection box
    set Size  = 2, 1, 1
    set Cells = 4, 2, 2
  end
end
subsection Discretization
  set Degree = 2
end
subsection Material
  set Type            = linear
  set Young's modulus = 1000
  set Poisson's ratio = 0.3
end
subsection Boundary conditions
  set Fixed    = x-min
  set Traction = x-max: 1; 0; -2
end
subsection Time integration
  set Type = static
  subsection static
    set Load steps = 2
  end
end
subsection Linear solver
  set Tolerance = 1e-12
end
subsection Output
  set Stress        = both
  set Stress probes = side: 2 0.5 0.5, inside: 0.7 0.4 0.3
end
"""
COMPONENTS = "stress_xx stress_yy stress_zz stress_xy stress_yz stress_xz von_mises".split()
COLUMNS = [f"{probe}_{name}" for probe in ("side", "inside") for name in COMPONENTS]


class Stress(ProgramTest):

    def run_block(self, output, *settings, **others):
        (self.folder / "block.prm").write_text(BLOCK, encoding="utf-8")
        overrides = [word for setting in settings for word in ("--set", setting)]
        self.run_program("block.prm", *overrides, "--output", output, **others)
        return self.folder / output

    def check_stress(self, directory):
        check = subprocess.run([sys.executable, ROOT / "tests" / "output" / "check_stress.py", directory, "1000", "0.3"],
                               capture_output=True, text=True, check=False)
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)

    def test_ranks(self):
        one = self.run_block("one")
        two = self.run_block("two", ranks=2)
        for directory in (one, two):
            self.check_stress(directory)
            self.check_vtkhdf(directory)
        rows = [read_history(directory)[-1] for directory in (one, two)]
        self.assertEqual(list(rows[0])[-14:], COLUMNS)
        size = max(abs(float(rows[0][name])) for name in COLUMNS)
        for name in COLUMNS:
            self.assertAlmostEqual(float(rows[0][name]), float(rows[1][name]), delta=1e-9 * size, msg=name)
        errors = [read_summary(directory)["error_estimate"] for directory in (one, two)]
        for key, value in errors[0].items():
            self.assertAlmostEqual(errors[1][key], value, delta=1e-9 * value)

    def test_tension(self):
        # The sides are free to contract: sigma_xx = 3 and nothing else, of
        # degree 0, so exact everywhere.
        bar = self.run_block("bar", "Boundary conditions/Fixed =", "Boundary conditions/Traction = x-max: 3; 0; 0",
                             "Boundary conditions/Displacement = x-min: 0; free; free, y-min: free; 0; free, z-min: free; free; 0")
        self.check_stress(bar)
        row = read_history(bar)[-1]
        for probe in ("side", "inside"):
            for name, expected in zip(COMPONENTS, (3, 0, 0, 0, 0, 0, 3)):
                self.assertAlmostEqual(float(row[f"{probe}_{name}"]), expected, delta=1e-9)
        self.assertLess(read_summary(bar)["error_estimate"]["relative"], 1e-9)

    def test_only_what_is_asked_for(self):
        plain = self.run_block("plain", "Output/Stress = none", "Output/Stress probes =")
        self.assertFalse((plain / "stress_points.vtkhdf").exists())
        self.assertNotIn("error_estimate", read_summary(plain))
        self.assertEqual(list(read_history(plain)[-1])[-1], "rejected_steps")
        points = self.run_block("points", "Output/Stress = quadrature points", "Output/Stress probes =")
        self.assertTrue((points / "stress_points.vtkhdf").exists())
        self.assertNotIn("error_estimate", read_summary(points))
        # Old results of all kinds are recognised, and replaced.
        again = self.run_block("points", "Output/Stress = nodes", "Output/Overwrite = true")
        self.assertFalse((again / "stress_points").exists())
        self.assertIn("error_estimate", read_summary(again))

    def test_corotational_steps(self):
        # Every state of a motion with large rotations has stress, also if
        # results are rarer than steps.
        case = self.run_case("cantilever", "case", "Time integration/End time = 0.04", "Discretization/Degree = 1", "Output/Stress = both",
                             "Output/Time between results = 0.02")
        self.check_vtkhdf(case)
        names = {"solution", "stress_points"}
        steps = [sorted(file.name for file in (case / name).glob("step_*")) for name in names]
        self.assertEqual(*steps)
        self.assertEqual(len(steps[0]), 3)


if __name__ == "__main__":
    unittest.main()
