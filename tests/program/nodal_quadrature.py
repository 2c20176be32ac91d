#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The quadratic element with bubbles and its diagonal mass, from the parameter file to the results.

The mesh of the cantilever has 12 x 2 x 2 boxes with five cells each. Bubbles
add nodes on all faces and in all cells, which files for VTK leave out. The beam
falls as with the consistent mass on the same cells; the additional functions
make it softer, by about the error of the coarse mesh. Two ranks agree with one
as in ranks.py.
"""

import unittest

from support import ProgramTest, read_history, read_summary

SETTINGS = ("Discretization/Degree = 2", "Time integration/Type = Newmark", "Time integration/End time = 0.1",
            "Linear solver/Type = jacobi")
BUBBLES = "Discretization/Mass = nodal quadrature"
N_CELLS, N_FACES = 12 * 2 * 2 * 5, 12 * 2 * 2 * 10 + 2 * (2 * 2 + 2 * 12 * 2)


class NodalQuadrature(ProgramTest):

    def tips(self, output, *settings, **others):
        directory = self.run_case("cantilever", output, *SETTINGS, *settings, **others)
        self.check_vtkhdf(directory)
        return [float(row["tip_z"]) for row in read_history(directory)], read_summary(directory)

    def test_dynamics(self):
        for number, placement in enumerate(("cell centre", "quadrature points")):
            rotation = f"Material/Rotation = {placement}"
            plain, summary = self.tips(f"plain_{number}", rotation)
            found, with_bubbles = self.tips(f"bubbles_{number}", rotation, BUBBLES)
            self.assertEqual(with_bubbles["nodes"], summary["nodes"] + N_CELLS + N_FACES)
            # Lumping keeps the total mass, to the round-off of sums over 240
            # cells.
            self.assertAlmostEqual(with_bubbles["total_mass"], 10, delta=1e-12)
            difference = max(abs(a - b) for a, b in zip(found, plain))
            print(f"{placement}: tip at {found[-1]:.6f} m, without bubbles at {plain[-1]:.6f} m, largest difference {difference:.2e} m")
            self.assertLess(plain[-1], -0.05)
            self.assertLess(difference, 0.005 * abs(plain[-1]))

    def test_two_ranks(self):
        settings = (BUBBLES, "Time integration/End time = 0.03", "Linear solver/Tolerance = 1e-11", "Newton/Residual tolerance = 1e-10",
                    "Newton/Increment tolerance = 1e-10")
        one, _ = self.tips("one", *settings)
        two, summary = self.tips("two", *settings, ranks=2)
        self.assertEqual(summary["ranks"], 2)
        self.assertEqual(len(one), len(two))
        for a, b in zip(one, two):
            self.assertLessEqual(abs(a - b), 1e-8 * abs(one[-1]))


if __name__ == "__main__":
    unittest.main()
