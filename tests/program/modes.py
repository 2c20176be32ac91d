#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Type = modes: results on one and two ranks, and of a computation that fails.

Eigenvalues are exact to the square of the tolerance of the residuals, 1e-8: on one and two ranks they agree to 1e-10, whatever
the order of sums. The frequency of a rigid body mode is round-off, which must be far below that of the first other mode.
"""

import unittest

import h5py
import numpy as np

from support import MODES_COLUMNS, ROOT, ProgramTest, read_modes, read_summary

SMALLER = ("Mesh/box/Cells = 4, 4, 1", "Output/Probes =")


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
        # The stress of the fourth mode, which has a frequency of its own: its error is that of the residual, 1e-8.
        first, second = (self.stresses(directory)[3] for directory in (one, two))
        self.assertLess(abs(first - second).max(), 1e-6 * first.max())

    @staticmethod
    def stresses(directory):
        """A row for each mode: the cells' stresses, by size, as ranks number cells in their own way."""
        with h5py.File(directory / "solution.vtkhdf") as file:
            n_modes = file["VTKHDF/Steps"].attrs["NSteps"]
            return np.sort(np.reshape(file["VTKHDF/CellData/von_mises"], (int(n_modes), -1)))

    def test_loads_are_left_out(self):
        # The log says so, and frequencies are those without the loads.
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

    def test_overwrite(self):
        # Results of modes are replaced by those of a simulation, and nothing is left of them.
        directory = self.run_case("plate_modes", "results", *SMALLER)
        self.run_case("gravity_linear", "results", "Output/Overwrite = true", "Time integration/static/Load steps = 1")
        self.assertFalse((directory / "modes.csv").exists())


if __name__ == "__main__":
    unittest.main()
