#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""scripts/plot draws columns of history.csv, and scripts/draw_study those of
study.csv."""

import csv
import re
import subprocess
import sys
import unittest

import matplotlib.image

from support import ROOT, ProgramTest, limit_files

CASE = ("Time integration/End time = 0.03", "Discretization/Degree = 1")


class Plot(ProgramTest):

    def plot(self, *words, status=0, **others):
        run = subprocess.run([sys.executable, "-B", ROOT / "scripts" / "plot", *words], cwd=self.folder, capture_output=True, text=True, check=False, **others)
        self.assertEqual((run.returncode, len(run.stderr.splitlines())), (status, 1 if status else 0), run.stderr)
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
        # Each picture has the colours of its first three, or two, lines.
        for picture, n_lines in zip(pictures, (3, 2)):
            for colour in ((0x1f, 0x77, 0xb4), (0xff, 0x7f, 0x0e), (0x2c, 0xa0, 0x2c))[:n_lines]:
                is_line = abs(picture[:, :, :3] * 255 - colour).max(axis=2) < 1
                self.assertGreater(is_line.sum(), 20, colour)

    def test_runs_with_other_columns(self):
        for name, probe in (("one", "tip"), ("other", "end")):
            self.run_case("cantilever", name, *CASE, f"Output/Probes = {probe}: 1 0.05 0.05")
        self.plot("one", "other", "tip_z", "end_z", "--out", "both.png")
        self.assertIn("no column 'middle_z' in any history.csv", self.plot("one", "other", "middle_z", status=1).stderr)

    def test_legend(self):
        """Runs with the same name are distinguished by their paths."""
        for folder in ("a/run", "b/run", "other"):
            self.run_case("cantilever", folder, *CASE)
        for runs, names in ((("a/run", "b/run"), {"a/run", "b/run"}), (("a/run", "other"), {"run", "other"})):
            self.plot(*runs, "dt", "--out", "both.svg")
            texts = re.findall("<!-- (.*?) -->", (self.folder / "both.svg").read_text())
            self.assertEqual({text.removeprefix("dt, ") for text in texts if text.startswith("dt, ")}, names)

    def test_mistakes(self):
        self.run_case("cantilever", "one", *CASE)
        for name in ("empty", "modes", "study", "begun"):
            (self.folder / name).mkdir()
        for name, table in (("modes", "modes.csv"), ("study", "study.csv")):
            (self.folder / name / table).touch()
        (self.folder / "begun" / "history.csv").write_text("time,dt\n", encoding="utf-8")
        for words, message in ((("one", "kinetic_enrgy"), "is it kinetic_energy"), (("one",), "no column; there are: step, time"),
                               (("nothing", "time"), "no folder of results: found nothing, time"), (("empty", "time"), "empty/history.csv cannot be read"),
                               (("one", "dt", "--out", "plot.gif"), "allowed are .png, .pdf and .svg"),
                               (("one", "dt", "--out", "nowhere/plot.png"), "nowhere/plot.png cannot be written"),
                               (("one", "dt", "--size", "0", "0"), "found the size 0 x 0; allowed are 1.5 to 50 inches"),
                               (("one", "dt", "--size", "nan", "1"), "argument --size: found nan; allowed are numbers from"),
                               (("one", "step", "dt", "tip_z", "volume", "kinetic_energy", "--size", "2", "50"), "diagrams of 50 inches; allowed are 200 together"),
                               (("one", "dt", "--x", "tip"), "found --x tip, which are tip_x, tip_y, tip_z; allowed is one column"),
                               (("modes", "frequency"), "modes has the results of modes, which are none over time; scripts/report shows them"),
                               (("study", "dofs"), "study has the results of a convergence study, which are none over time; scripts/draw_study draws it"),
                               (("begun", "dt"), "begun/history.csv has no rows"),
                               (("one", "dt", "--range", "5000", "6000"), "has no rows in --range 5000 6000; its time goes from 0 to "),
                               (("one", "dt", "--range", "2", "1"), "found --range 2 1; the first must be the lower one"),
                               (("one", "dt", "--colour", "red"), "unrecognized arguments: --colour red")):
            with self.subTest(words=words):
                self.assertIn(message, self.plot(*words, status=1).stderr)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["begun", "empty", "modes", "one", "study"])

    def test_files_that_are_there(self):
        """The script replaces its own files, other files only with --overwrite,
        and an old file stays if the new one cannot be written completely."""
        self.run_case("cantilever", "one", *CASE)
        for name in ("plot.png", "plot.pdf", "plot.svg"):
            with self.subTest(name=name):
                file = self.folder / name
                file.write_text("of someone else")
                message = self.plot("one", "dt", "--out", name, status=1).stderr
                self.assertIn(f"{name} exists and was not made by this program; --overwrite replaces it", message)
                self.assertEqual(file.read_text(), "of someone else")
                self.plot("one", "dt", "--out", name, "--overwrite")
                self.plot("one", "dt", "tip_z", "--out", name)
                before = file.read_bytes()
                self.assertEqual(self.plot("one", "dt", "--out", name, status=3, preexec_fn=limit_files).stderr, f"plot: error: {name}: File too large\n")
                self.assertEqual(file.read_bytes(), before)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["one", "plot.pdf", "plot.png", "plot.svg"])

    def test_nothing_for_a_logarithm(self):
        self.run_case("cantilever", "one", *CASE)
        self.plot("one", "rejected_steps", "--log")


class DrawStudy(ProgramTest):

    def draw(self, status=0, **others):
        run = subprocess.run([sys.executable, "-B", ROOT / "scripts" / "draw_study", "study"], cwd=self.folder, capture_output=True, text=True, check=False,
                             **others)
        self.assertEqual((run.returncode, len(run.stderr.splitlines())), (status, 1 if status else 0), run.stderr)
        return run.stderr

    def pictures(self):
        return {path.name: path.read_bytes() for path in (self.folder / "study").glob("study_*")}

    def write(self, **errors):
        """Writes a table of two runs with these errors; the second run has
        cells of half the size."""
        (self.folder / "study").mkdir()
        with open(self.folder / "study" / "study.csv", "w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow(["degree", "refinements", "status", "h", "dofs", "wall_time", *(f"{name}_error" for name in errors)])
            for i in range(2):
                table.writerow([1, i, "done", 1 / 2**i, 10 * 8**i, 1 + i, *(pair[i] for pair in errors.values())])

    def test_names(self):
        """Names of files have norms in small letters; quantities keep their
        letters, as two may differ in capitals only."""
        self.write(L2=(1, 0.25), tip_z=(1, 0.5), TIP_z=(1, 0.125))
        self.draw()
        names = [f"study_{name}_over_{abscissa}.{ending}" for name in ("l2", "tip_z", "TIP_z") for abscissa in ("h", "dofs", "wall_time")
                 for ending in ("svg", "png")]
        pictures = self.pictures()
        self.assertEqual(sorted(pictures), sorted(names))
        self.assertNotEqual(pictures["study_tip_z_over_h.png"], pictures["study_TIP_z_over_h.png"])

    def test_errors_of_zero(self):
        """Errors of zero have no place on a logarithmic scale: there is no
        picture and no message."""
        self.write(L2=(0, 0), tip_z=(0, 0.5))
        self.draw()
        self.assertEqual({name.split("_over_")[0] for name in self.pictures()}, {"study_tip_z"})

    def test_mistakes(self):
        self.assertIn("draw_study: error: study has no results of a convergence study: there is no study.csv", self.draw(status=1))
        self.write(L2=(1, 0.25))
        self.draw()
        before = self.pictures()
        self.assertIn("File too large", self.draw(status=3, preexec_fn=limit_files))
        self.assertEqual(self.pictures(), before)
        (self.folder / "study" / "study.csv").write_text("degree,status\n1,done\n")
        self.assertIn("study/study.csv is damaged: refinements", self.draw(status=1))


if __name__ == "__main__":
    unittest.main()
