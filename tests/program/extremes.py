#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Cases at the ends of the range of numbers, with the program's defaults, on 1, 2 and 3 ranks: bodies of nanometres and of thousands
of kilometres, stiff ones that fall far, forces that vanish.
"""

import math
import unittest

from support import ProgramTest, read_history, read_modes, read_summary

RANKS = (1, 2, 3)

# A steel block in free fall.
FALLING_STEEL = """
subsection Mesh
  set Type = box
  subsection box
    set Size  = 1, 0.2, 0.2
    set Cells = 5, 1, 1
  end
end
subsection Discretization
  set Degree = 2
end
subsection Material
  set Young's modulus = 2.1e11
  set Poisson's ratio = 0.3
  set Density         = 7850
end
subsection Loads
  set Gravity = 0; 0; -9.81
end
subsection Time integration
  set Type      = generalized-alpha
  set End time  = 5
  set Time step = 0.05
end
subsection Output
  set Time between results = 5
end
"""

# A linear beam, loaded and unloaded, or carried away and back by its support.
LINEAR_STATICS = """
subsection Mesh
  set Type = box
  subsection box
    set Size  = 1, 0.125, 0.125
    set Cells = 6, 1, 1
  end
end
subsection Material
  set Type            = linear
  set Young's modulus = 1e7
end
subsection Boundary conditions
  set {conditions}
end
subsection Time integration
  set Type     = static
  set End time = 1
  subsection static
    set Load steps           = 4
    set Proportional loading = false
  end
end
"""

# A bar of rock, 2000 km long, whose end is pulled: its stable step is 28 s.
ROCK = """
subsection Mesh
  set Type = box
  subsection box
    set Size  = 2e6, 5e5, 5e5
    set Cells = 8, 2, 2
  end
end
subsection Discretization
  set Degree = 1
  set Mass   = diagonal scaling
end
subsection Material
  set Young's modulus = 5e10
  set Poisson's ratio = 0
  set Density         = 3000
end
subsection Boundary conditions
  set Fixed    = x-min
  set Traction = x-max: 1e4; 0; 0
end
subsection Time integration
  set Type      = central difference
  set End time  = 5000
  set Time step = 0
end
"""

# Modes of a beam whose length is ten times its thickness.
BEAM = """
set Type = modes
subsection Mesh
  set Type = box
  subsection box
    set Size  = {length}, {thickness}, {thickness}
    set Cells = 20, 2, 2
  end
end
subsection Discretization
  set Degree = 1
end
subsection Material
  set Young's modulus = {stiffness}
  set Poisson's ratio = 0.2
  set Density         = {density}
end
subsection Boundary conditions
  set Fixed = x-min
end
subsection Modes
  set Number = 6
end
"""

# A bar whose support vibrates at 20 kHz.
VIBRATING_SUPPORT = """
subsection Mesh
  set Type = box
  subsection box
    set Size  = 0.1, 0.01, 0.01
    set Cells = 10, 1, 1
  end
end
subsection Discretization
  set Degree = 1
  set Mass   = diagonal scaling
end
subsection Material
  set Young's modulus = 7e10
  set Poisson's ratio = 0.3
  set Density         = 2700
end
subsection Boundary conditions
  set Displacement = x-min: 1e-5 * sin(2 * pi * 20000 * t); 0; 0
end
subsection Time integration
  set Type      = central difference
  set End time  = {end}
  set Time step = 5e-7
end
subsection Output
  set Time between results = 1e6
end
"""


class Extremes(ProgramTest):

    def run_text(self, text, name, ranks):
        """Runs a parameter file of this content; returns the run and its output directory."""
        (self.folder / f"{name}.prm").write_text(text, encoding="utf-8")
        output = self.folder / f"{name}_{ranks}"
        run = self.run_program(f"{name}.prm", "--output", output, ranks=ranks)
        self.assertEqual(read_summary(output)["status"], "done")
        return run, output

    def test_falling_steel(self):
        # It must be where g t^2 / 2 is, to 1e-9, with one iteration a step at most: what is left is round-off.
        for ranks in RANKS:
            run, output = self.run_text(FALLING_STEEL, "steel", ranks)
            rows = read_history(output)
            self.assertEqual(len(rows), 101)
            for row in rows:
                fallen = 0.5 * 9.81 * float(row["time"]) ** 2
                self.assertLessEqual(abs(float(row["max_displacement"]) - fallen), 1e-9 * fallen)
                self.assertLessEqual(int(row["newton_iterations"]), 1)
                self.assertLessEqual(int(row["parts"]), 1)
            # Said once.
            self.assertEqual(run.stdout.count("round-off ended Newton's iterations"), 1, run.stdout)

    def test_two_materials(self):
        # A beam, half steel and half rubber, that swings on its soft end.
        for ranks in RANKS:
            output = self.run_case("two_materials", f"beam_{ranks}", "Boundary conditions/Fixed = right",
                                   "Time integration/End time = 0.4", "Output/Time between results = 10", ranks=ranks)
            self.assertEqual(read_summary(output)["status"], "done")
            self.assertEqual(float(read_history(output)[-1]["parts"]), 1)

    def test_linear_statics_that_end_without_forces(self):
        # Of beam theory: F L^3 / (3 E I), to which six quadratic cells come close.
        deflection = 4 * 200 / (1e7 * 0.125 ** 2)
        cases = (("unload", "Fixed = x-min\n  set Traction = x-max: 0; 0; 200 * triangle(t, 0, 1)", deflection, 0.05),
                 ("carry", "Displacement = x-min: 0; 0; 0.1 * triangle(t, 0, 1)", 0.1, 1e-5))
        for name, conditions, largest, tolerance in cases:
            for ranks in RANKS:
                rows = read_history(self.run_text(LINEAR_STATICS.format(conditions=conditions), name, ranks)[1])
                self.assertEqual([row["newton_iterations"] for row in rows[1:]], 4 * ["1"])
                middle, last = (float(rows[k]["max_displacement"]) for k in (2, 4))
                self.assertAlmostEqual(middle, largest, delta=tolerance * largest)
                # The linear solver's tolerance, times what a slender body may make of a residual.
                self.assertLessEqual(last, 1e-5 * largest)

    def test_long_explicit_steps(self):
        # A bar that is pulled at once goes to twice its static length and back, in 4 L / c; a little less far, as eight cells of
        # degree 1 round off the wave's front.
        static = 1e4 * 2e6 / 5e10
        for ranks in RANKS:
            rows = read_history(self.run_text(ROCK, "rock", ranks)[1])
            self.assertGreater(float(rows[1]["dt"]), 20)
            stretched = [float(row["max_displacement"]) for row in rows]
            self.assertAlmostEqual(max(stretched), 2 * static, delta=0.05 * static)
            first = stretched.index(max(stretched[:len(rows) // 3]))
            self.assertAlmostEqual(float(rows[first]["time"]), 2 * 2e6 / math.sqrt(5e10 / 3000), delta=60)

    def test_small_numbers(self):
        # The same beam in nanometres and in metres.
        unit = 1e7 * math.sqrt(1e12 / 2200)
        metres = read_modes(self.run_text(BEAM.format(length=1, thickness=0.1, stiffness=1, density=1), "metres", 1)[1])
        text = BEAM.format(length=1e-7, thickness=1e-8, stiffness=1e12, density=2200)
        for ranks in RANKS:
            for small, large in zip(read_modes(self.run_text(text, "nanometres", ranks)[1]), metres, strict=True):
                ratio = float(small["frequency"]) / float(large["frequency"])
                # Residuals of 1e-6 are errors of 1e-12 in frequencies; numbers have ten digits or more.
                self.assertAlmostEqual(ratio / unit, 1, delta=1e-9)

    def test_vibrating_support(self):
        # What happens first does not depend on how long the run is.
        for ranks in RANKS:
            short = read_history(self.run_text(VIBRATING_SUPPORT.format(end=5e-5), "short", ranks)[1])
            long = read_history(self.run_text(VIBRATING_SUPPORT.format(end=5e-4), "long", ranks)[1])
            largest = max(abs(float(row["reaction_x"])) for row in short)
            for one, other in zip(short, long):
                self.assertAlmostEqual(float(one["reaction_x"]), float(other["reaction_x"]), delta=1e-8 * largest)


if __name__ == "__main__":
    unittest.main()
