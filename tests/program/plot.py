#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""scripts/plot: columns of history.csv as a picture."""

import subprocess
import sys
import unittest

import matplotlib.image

from support import ROOT, ProgramTest

CASE = ("Time integration/End time = 0.03", "Discretization/Degree = 1")


class Plot(ProgramTest):

    def plot(self, *words, status=0):
        run = subprocess.run([sys.executable, "-B", ROOT / "scripts" / "plot", *words], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, status, run.stderr)
        return run

    def test_runs_and_columns(self):
        self.run_case("cantilever", "one", *CASE)
        self.run_case("cantilever", "other", *CASE, "Material/Density = 500")
        with open(self.folder / "other" / "history.csv", "a", encoding="utf-8") as file:
            file.write("4,0.04,0.0")
        # Energies and reactions have a diagram each.
        self.plot("one", "kinetic_energy", "elastic_energy", "reaction", "--size", "4", "2", "--out", "one.png")
        self.plot("one", "other", "tip_z", "--log", "--size", "4", "2", "--range", "0.01", "0.03", "--out", "both.png")
        pictures = [matplotlib.image.imread(self.folder / name) for name in ("one.png", "both.png")]
        self.assertEqual([picture.shape[:2] for picture in pictures], [(600, 600), (300, 600)])
        # The colours of the first three lines, and of the first two.
        for picture, n_lines in zip(pictures, (3, 2)):
            for colour in ((0x1f, 0x77, 0xb4), (0xff, 0x7f, 0x0e), (0x2c, 0xa0, 0x2c))[:n_lines]:
                is_line = abs(picture[:, :, :3] * 255 - colour).max(axis=2) < 1
                self.assertGreater(is_line.sum(), 20, colour)

    def test_runs_with_other_columns(self):
        for name, probe in (("one", "tip"), ("other", "end")):
            self.run_case("cantilever", name, *CASE, f"Output/Probes = {probe}: 1 0.05 0.05")
        self.plot("one", "other", "tip_z", "end_z", "--out", "both.png")
        self.assertIn("no column 'middle_z' in any history.csv", self.plot("one", "other", "middle_z", status=1).stderr)

    def test_mistakes(self):
        self.run_case("cantilever", "one", *CASE)
        (self.folder / "empty").mkdir()
        for words, message in ((("one", "kinetic_enrgy"), "is it kinetic_energy"), (("one",), "no column; there are: step, time"),
                               (("nothing", "time"), "no folder of results: found nothing, time"), (("empty", "time"), "empty/history.csv cannot be read"),
                               (("one", "dt", "--out", "plot.gif"), "allowed are .png, .pdf and .svg"),
                               (("one", "dt", "--out", "nowhere/plot.png"), "nowhere/plot.png cannot be written")):
            run = self.plot(*words, status=1)
            self.assertIn(message, run.stderr)
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["empty", "one"])


if __name__ == "__main__":
    unittest.main()
