#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Cases at the ends of the range of numbers, with the program's defaults, on 1, 2 and 3 ranks: bodies of nanometres and of thousands
of kilometres, stiff ones that fall far, forces that vanish.
"""

import math
import unittest

from support import ProgramTest, parameter_text, read_history, read_modes, read_summary

RANKS = (1, 2, 3)


def box(size, cells, degree, stiffness, poisson, density):
    return {"Mesh/Type": "box", "Mesh/box/Size": size, "Mesh/box/Cells": cells, "Discretization/Degree": degree,
            "Material/Young's modulus": stiffness, "Material/Poisson's ratio": poisson, "Material/Density": density,
            "Output/Time between results": 1e6}


def beam(length, thickness, stiffness, density):
    """Modes of a beam."""
    return {**box(f"{length}, {thickness}, {thickness}", "20, 2, 2", 1, stiffness, 0.2, density),
            "Type": "modes", "Boundary conditions/Fixed": "x-min", "Modes/Number": 6}


EXPLICIT = {"Discretization/Mass": "diagonal scaling", "Time integration/Type": "central difference"}
FALLING_STEEL = {**box("1, 0.2, 0.2", "5, 1, 1", 2, 2.1e11, 0.3, 7850), "Loads/Gravity": "0; 0; -9.81",
                 "Time integration/Type": "generalized-alpha", "Time integration/End time": 5, "Time integration/Time step": 0.05}
LINEAR_STATICS = {**box("1, 0.125, 0.125", "6, 1, 1", 2, 1e7, 0.3, 1000), "Material/Type": "linear",
                  "Time integration/Type": "static", "Time integration/End time": 1, "Time integration/static/Load steps": 4,
                  "Time integration/static/Proportional loading": "false"}
# Rock, 2000 km long, whose end is pulled: its stable step is 28 s.
ROCK = {**box("2e6, 5e5, 5e5", "8, 2, 2", 1, 5e10, 0, 3000), **EXPLICIT, "Boundary conditions/Fixed": "x-min",
        "Boundary conditions/Traction": "x-max: 1e4; 0; 0", "Time integration/End time": 5000, "Time integration/Time step": 0}
VIBRATING_SUPPORT = {**box("0.1, 0.01, 0.01", "10, 1, 1", 1, 7e10, 0.3, 2700), **EXPLICIT, "Time integration/Time step": 5e-7,
                     "Boundary conditions/Displacement": "x-min: 1e-5 * sin(2 * pi * 20000 * t); 0; 0"}


class Extremes(ProgramTest):

    def run_entries(self, entries, name, ranks):
        """Runs a parameter file with these entries; returns the run and its
        output directory."""
        (self.folder / f"{name}.prm").write_text(parameter_text(entries), encoding="utf-8")
        output = self.folder / f"{name}_{ranks}"
        run = self.run_program(f"{name}.prm", "--output", output, ranks=ranks)
        self.assertEqual(read_summary(output)["status"], "done")
        return run, output

    def test_falling_steel(self):
        # The block must have fallen by g t^2 / 2, to 1e-9, with at most one
        # iteration for each step, as the rest is round-off.
        for ranks in RANKS:
            run, output = self.run_entries(FALLING_STEEL, "steel", ranks)
            rows = read_history(output)
            self.assertEqual(len(rows), 101)
            for row in rows:
                fallen = 0.5 * 9.81 * float(row["time"]) ** 2
                self.assertLessEqual(abs(float(row["max_displacement"]) - fallen), 1e-9 * fallen)
                self.assertLessEqual(int(row["newton_iterations"]), 1)
                self.assertLessEqual(int(row["parts"]), 1)
            # The message appears once.
            self.assertEqual(run.stdout.count("round-off ended Newton's iterations"), 1, run.stdout)

    def test_two_materials(self):
        # This beam, half steel and half rubber, swings on its soft end.
        for ranks in RANKS:
            output = self.run_case("two_materials", f"beam_{ranks}", "Boundary conditions/Fixed = right",
                                   "Time integration/End time = 0.4", "Output/Time between results = 10", ranks=ranks)
            self.assertEqual(read_summary(output)["status"], "done")
            self.assertEqual(float(read_history(output)[-1]["parts"]), 1)

    def test_linear_statics_that_end_without_forces(self):
        # Beam theory gives the deflection F L^3 / (3 E I), to which six
        # quadratic cells are close.
        deflection = 4 * 200 / (1e7 * 0.125 ** 2)
        conditions = "Boundary conditions/"
        # If the support moves, forces of cells that are crushed at it do not
        # count: further solves remove their rest.
        cases = (("unload", {conditions + "Fixed": "x-min", conditions + "Traction": "x-max: 0; 0; 200 * triangle(t, 0, 1)"}, deflection, 0.05, {1}),
                 ("carry", {conditions + "Displacement": "x-min: 0; 0; 0.1 * triangle(t, 0, 1)"}, 0.1, 1e-11, {2, 3}))
        for name, conditions, largest, tolerance, solves in cases:
            for ranks in RANKS:
                rows = read_history(self.run_entries({**LINEAR_STATICS, **conditions}, name, ranks)[1])
                self.assertEqual(len(rows), 5)
                self.assertLessEqual({int(row["newton_iterations"]) for row in rows[1:]}, solves)
                middle, last = (float(rows[k]["max_displacement"]) for k in (2, 4))
                self.assertAlmostEqual(middle, largest, delta=tolerance * largest)
                # The bound is the linear solver's tolerance, times the
                # amplification of residuals in a slender body.
                self.assertLessEqual(last, 1e-5 * largest)

    def test_long_explicit_steps(self):
        # A bar that is pulled suddenly stretches to twice its static length and
        # back, in 4 L / c. Cells of degree 1 smear the front of the wave, which
        # reduces the peak by 2.3, 1.5, 1.0 % with 8, 16, 32 of them: the power
        # 2/3 of their size.
        static = 1e4 * 2e6 / 5e10
        for ranks in RANKS:
            rows = read_history(self.run_entries(ROCK, "rock", ranks)[1])
            self.assertGreater(float(rows[1]["dt"]), 20)
            stretched = [float(row["max_displacement"]) for row in rows]
            self.assertAlmostEqual(max(stretched), 2 * static, delta=0.05 * static)
            first = stretched.index(max(stretched[:len(rows) // 3]))
            self.assertAlmostEqual(float(rows[first]["time"]), 2 * 2e6 / math.sqrt(5e10 / 3000), delta=60)

    def test_small_numbers(self):
        # The same beam is computed in nanometres and in metres.
        unit = 1e7 * math.sqrt(1e12 / 2200)
        metres = read_modes(self.run_entries(beam(1, 0.1, 1, 1), "metres", 1)[1])
        entries = beam(1e-7, 1e-8, 1e12, 2200)
        for ranks in RANKS:
            for small, large in zip(read_modes(self.run_entries(entries, "nanometres", ranks)[1]), metres, strict=True):
                ratio = float(small["frequency"]) / float(large["frequency"])
                # Residuals of 1e-6 are errors of 1e-12 in frequencies; files
                # have ten digits or more.
                self.assertAlmostEqual(ratio / unit, 1, delta=1e-9)

    def test_vibrating_support(self):
        # The first steps do not depend on how long the run is.
        for ranks in RANKS:
            short = read_history(self.run_entries({**VIBRATING_SUPPORT, "Time integration/End time": 5e-5}, "short", ranks)[1])
            long = read_history(self.run_entries({**VIBRATING_SUPPORT, "Time integration/End time": 5e-4}, "long", ranks)[1])
            largest = max(abs(float(row["reaction_x"])) for row in short)
            for one, other in zip(short, long):
                self.assertAlmostEqual(float(one["reaction_x"]), float(other["reaction_x"]), delta=1e-8 * largest)


if __name__ == "__main__":
    unittest.main()
