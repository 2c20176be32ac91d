#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Linear elasticity takes rotation for strain, corotational elasticity does not.

A rotation by phi has the linear strain cos(phi) - 1 in its plane, for which a linear body makes up by growing by about
1 / cos(phi) twice. The same beam, bent under its weight, so grows with linear elasticity and keeps its volume with the
corotational one, but for its small strains. README.md says by how much, in as many digits as are compared.
"""

import unittest

from support import ProgramTest, read_history, read_summary


class Gravity(ProgramTest):

    def growth(self, case):
        directory = self.run_case(case, case)
        rows, summary = read_history(directory), read_summary(directory)
        # The history's volume at rest is that of the mesh.
        self.assertAlmostEqual(float(rows[0]["volume"]), 0.04, delta=1e-15)
        self.assertAlmostEqual(summary["mesh_volume"], 0.04, delta=1e-15)
        return summary["final"]["volume"] / summary["mesh_volume"] - 1

    def test_linear(self):
        self.assertAlmostEqual(self.growth("gravity_linear"), 0.42, delta=0.005)

    def test_corotational(self):
        self.assertAlmostEqual(self.growth("gravity_corotational"), -0.0011, delta=0.00005)


if __name__ == "__main__":
    unittest.main()
