#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Motions agree with theory for any degree and mass. doc/dynamics.md has all
figures.

- bar_step_load: the front, a jump in theory, is some cells wide, here of 0.04 L, and widens on its way, which rounds the corner
  of the tip's motion: its peak is 2 p L / E to 2 %, and comes at 2 L / c to 2 % and one step, 0.5 %. Behind the front the
  stress oscillates by a fifth whatever the cells (Gibbs); what converges is its mean over the plateau: 2 p to 1 %, from 1.1 L /
  c to 2.9 L / c, where the front has gone by.
- spinning_bar: the elongation stays within 0.1 % of that of the closed solution for a whole revolution. Steps make no error;
  cells of degree 2 make 0.004 %.
- Numerical dissipation: a linear bar starts in its lowest mode and a saw-tooth, 100 steps of generalized-alpha with spectral
  radius 0.5 per period of that mode. After ten periods the energy is that of the same run without the saw-tooth, to the
  tolerance of the solver. The mode's amplitude, the root of its energy, has lost what the spectral radius at its frequency has
  it lose, 0.029 % (1 % would be too much); 0.01 % for the sine that it starts from, which is not quite the mode of the cells.
- Explicit steps above the stable one are refused, or end the run when the motion has grown; everything before is saved.
"""

import math
import re
import unittest

from support import ROOT, ProgramTest, parameter_text, read_history, read_summary

# Length 1 m, c = 1 m/s. Sides can only move along the bar, which makes it
# one-dimensional.
LINEAR_BAR = """
subsection Mesh
  subsection box
    set Size  = 1, 0.05, 0.05
    set Cells = 20, 1, 1
  end
end
subsection Discretization
  set Degree = 1
end
subsection Material
  set Type            = linear
  set Young's modulus = 1
  set Poisson's ratio = 0
  set Density         = 1
end
subsection Boundary conditions
  set Fixed        = x-min
  set Displacement = y-min: free; 0; free, y-max: free; 0; free, z-min: free; free; 0, z-max: free; free; 0
end
subsection Initial conditions
  set Displacement = 0.001 * sin(pi*x/2) * (1 + %SAW * cos(20*pi*x)); 0; 0
end
subsection Time integration
  set Type      = generalized-alpha
  set End time  = 40
  set Time step = 0.04
  subsection generalized-alpha
    set Spectral radius = 0.5
  end
end
subsection Linear solver
  set Tolerance = 1e-12
end
subsection Output
  set Steps between rows   = 1000
  set Time between results = 1000
end
"""

IMPLICIT_BAR = {"Mesh/box/Size": "1, 0.1, 0.1", "Mesh/box/Cells": "10, 1, 1", "Discretization/Degree": "2", "Material/Type": "linear",
                "Material/Young's modulus": "1e6", "Material/Density": "1000", "Boundary conditions/Fixed": "x-min", "Loads/Gravity": "0; 0; -1",
                "Time integration/Type": "Newmark", "Time integration/Newmark/Beta": "0.1666", "Time integration/Time step": "0.02",
                "Time integration/End time": "4"}


class Dynamics(ProgramTest):

    def columns(self, directory, *names):
        rows = read_history(directory)
        return [[float(row[name]) for row in rows] for name in names]

    def check_bar(self, degree, *settings, **others):
        directory = self.run_case("bar_step_load", f"{degree} {settings[0]}", "Mesh/box/Cells = 25, 1, 1",
                                  "Time integration/End time = 6e-4", "Output/Time between results = 1",
                                  f"Discretization/Degree = {degree}", *settings, **others)
        time, tip, reaction = self.columns(directory, "time", "tip_x", "reaction_x")
        peak = max(tip)
        self.assertAlmostEqual(peak, 1e-3, delta=2e-5)
        self.assertAlmostEqual(time[tip.index(peak)], 4e-4, delta=1e-5)
        stress = [-r / 4e-4 for t, r in zip(time, reaction) if 2.2e-4 < t < 5.8e-4]
        self.assertAlmostEqual(sum(stress) / len(stress), 2e8, delta=2e6)

    def test_bar_implicit(self):
        for degree in (1, 2, 3):
            with self.subTest(degree=degree):
                self.check_bar(degree, "Time integration/Type = Newmark", "Discretization/Mass = consistent",
                               "Time integration/Time step = 2e-6", "Output/Steps between rows = 1")

    def test_bar_explicit(self):
        for degree in (1, 2, 3):
            with self.subTest(degree=degree):
                self.check_bar(degree, "Discretization/Mass = diagonal scaling")

    def test_bar_explicit_two_ranks(self):
        self.check_bar(2, "Discretization/Mass = diagonal scaling", ranks=2)

    def test_spinning_bar(self):
        expected = math.tan(0.3) / 0.3 - 1
        for degree in (2, 3):
            with self.subTest(degree=degree):
                rows = read_history(self.run_case("spinning_bar", f"{degree}", f"Discretization/Degree = {degree}"))
                self.assertEqual(rows[-1]["step"], "200")
                for row in rows:
                    difference = [float(row[f"right_{c}"]) - float(row[f"left_{c}"]) for c in "xyz"]
                    elongation = math.hypot(2 + difference[0], *difference[1:]) / 2 - 1
                    self.assertAlmostEqual(elongation, expected, delta=1e-3 * expected)
                # The bar has made a whole revolution, less the lag of steps of
                # theta = pi / 100: theta^2 / 12 of the angle.
                angle = math.atan2(difference[1], 2 + difference[0])
                self.assertAlmostEqual(angle, -2 * math.pi * (math.pi / 100)**2 / 12, delta=1e-4)

    def test_numerical_dissipation(self):
        energies = []
        for saw in (0, 1):
            (self.folder / "bar.prm").write_text(LINEAR_BAR.replace("%SAW", str(saw)), encoding="utf-8")
            self.run_program("bar.prm", "--output", f"saw {saw}")
            kinetic, elastic = self.columns(self.folder / f"saw {saw}", "kinetic_energy", "elastic_energy")
            energies.append([k + e for k, e in zip(kinetic, elastic)])
        (mode_first, mode_last), (both_first, both_last) = energies
        self.assertGreater(both_first, 100 * mode_first)
        self.assertLess(abs(both_last - mode_last), 1e-10 * mode_last)
        self.assertAlmostEqual(1 - math.sqrt(mode_last / mode_first), 2.9e-4, delta=1e-4)

    def unstable_bar(self, step):
        text = (ROOT / "parameters" / "bar_step_load.prm").read_text(encoding="utf-8")
        text, count = re.subn(r"set Time step = 0\n", f"set Time step = {step!r}\n", text)
        self.assertEqual(count, 1)
        (self.folder / "bar.prm").write_text(text, encoding="utf-8")
        return text[:text.index("set Time step")].count("\n") + 1

    def test_unstable_step(self):
        line = self.unstable_bar(1e-6)
        run = self.run_program("bar.prm", "--output", "refused", status=1)
        match = re.fullmatch(r"corotet: error: (\S*)bar\.prm:(\d+): Time integration/Time step: found a step of 1e-06 s at t = 0, which is "
                             r"unstable; allowed: up to the stable step, (\S+) s, or 0 for the program's choice\n", run.stderr)
        self.assertIsNotNone(match, run.stderr)
        self.assertEqual(int(match.group(2)), line)
        stable = float(match.group(3))
        self.assertFalse((self.folder / "refused" / "history.csv").exists())

        self.unstable_bar(1.05 * stable)
        run = self.run_program("bar.prm", "--set", "Time integration/central difference/Refuse unstable steps = false",
                               "--output", "unstable", status=2)
        self.assertIn("the motion is unstable", run.stderr)
        directory = self.folder / "unstable"
        summary = read_summary(directory)
        self.assertEqual(summary["status"], "failed")
        self.assertIn("the motion is unstable", summary["message"])
        self.assertIn("let 'Time step', 'Steps between estimates' or 'Safety factor' be smaller", summary["message"])
        # The last row is that of the last good step.
        kinetic, work = self.columns(directory, "kinetic_energy", "external_work")
        self.assertGreater(len(kinetic), 2)
        self.assertEqual(summary["final"]["step"], float(read_history(directory)[-1]["step"]))
        self.assertLess(kinetic[-1], 100 * max(map(abs, work)))
        self.check_vtkhdf(directory)


    def test_unstable_implicit_step(self):
        """With beta just below 1/6 and steps far above the stable one,
        Newmark's method is unstable: the growth is noticed, as with explicit
        steps."""
        (self.folder / "bar.prm").write_text(parameter_text(IMPLICIT_BAR), encoding="utf-8")
        run = self.run_program("bar.prm", "--output", "grown", status=2)
        summary = read_summary(self.folder / "grown")
        self.assertRegex(summary["message"], "the motion is unstable: the energy is .* J, and .* J have been put in; the time step is too long")
        self.assertIn(summary["message"], run.stderr)
        self.assertEqual(summary["status"], "failed")
        # The last row is that of the last good step.
        kinetic, elastic, work = self.columns(self.folder / "grown", "kinetic_energy", "elastic_energy", "external_work")
        self.assertLess(abs(kinetic[-1]) + elastic[-1], 1e4 * max(map(abs, work)))
        self.run_program("bar.prm", "--output", "stable", "--set", "Time integration/Newmark/Beta = 0.25")

    def test_steps_held_at_the_smallest(self):
        """Steps that would have to be shorter for their error are counted, and
        there is a warning."""
        (self.folder / "bar.prm").write_text(parameter_text({
            "Mesh/box/Size": "1, 0.1, 0.1", "Mesh/box/Cells": "4, 1, 1", "Material/Young's modulus": "1e7", "Boundary conditions/Fixed": "x-min",
            "Loads/Gravity": "0; 0; -10", "Time integration/Type": "Newmark", "Time integration/Time step": "0.05",
            "Time integration/Adaptive step/Enabled": "true"}), encoding="utf-8")
        for smallest, warnings in (("1e-12", 0), ("0.05", 1)):
            run = self.run_program("bar.prm", "--set", f"Time integration/Adaptive step/Smallest step = {smallest}", "--output", smallest)
            found = re.findall(r"warning: (\d+) steps are less accurate than \"Adaptive step/Target error\"", run.stdout)
            self.assertEqual(len(found), warnings)
            for n_steps in found:
                self.assertGreater(int(n_steps), 5)


if __name__ == "__main__":
    unittest.main()
