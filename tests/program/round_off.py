#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Runs that the arithmetic's precision once stopped, with the program's defaults, on 1, 2 and 3 ranks.

A steel block in free fall must be where g t^2 / 2 is, to 1e-9, with one iteration a step at most; a beam, half steel and half
rubber, that swings on its soft end must get past the time at which round-off stopped it, 0.395 s. (Later the steel crushes the
rubber, which takes far shorter steps.)
"""

import unittest

from support import ProgramTest, read_history, read_summary

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


class RoundOff(ProgramTest):

    def test_falling_steel(self):
        (self.folder / "steel.prm").write_text(FALLING_STEEL, encoding="utf-8")
        for ranks in (1, 2, 3):
            output = f"steel_{ranks}"
            run = self.run_program("steel.prm", "--output", output, ranks=ranks)
            rows = read_history(self.folder / output)
            self.assertEqual(len(rows), 101)
            for row in rows:
                fallen = 0.5 * 9.81 * float(row["time"]) ** 2
                self.assertLessEqual(abs(float(row["max_displacement"]) - fallen), 1e-9 * fallen)
                self.assertLessEqual(int(row["newton_iterations"]), 1)
                self.assertLessEqual(int(row["parts"]), 1)
            # Said once.
            self.assertEqual(run.stdout.count("round-off ended Newton's iterations"), 1, run.stdout)

    def test_two_materials(self):
        for ranks in (1, 2):
            output = self.run_case("two_materials", f"beam_{ranks}", "Boundary conditions/Fixed = right",
                                   "Time integration/End time = 0.4", "Output/Time between results = 10", ranks=ranks)
            self.assertEqual(read_summary(output)["status"], "done")
            self.assertEqual(float(read_history(output)[-1]["parts"]), 1)


if __name__ == "__main__":
    unittest.main()
