#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""scripts/report for folders without a run, or with an incomplete one: a
message in one line and no file, or a page that tells what is missing."""

import fcntl
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import ROOT, ProgramTest, limit_files

RUN = ("Time integration/End time = 0.04", "Discretization/Degree = 1")


class ReportMistakes(ProgramTest):

    run_of_all = None  # the folder of the run that all tests copy

    def setUp(self):
        super().setUp()
        if not ReportMistakes.run_of_all:
            ReportMistakes.run_of_all = tempfile.TemporaryDirectory()
            self.run_case("cantilever", pathlib.Path(self.run_of_all.name) / "run", *RUN)
            self.addClassCleanup(self.run_of_all.cleanup)
        shutil.copytree(pathlib.Path(self.run_of_all.name) / "run", self.folder / "run")

    def report(self, *words, status=0, **others):
        before = self.files()
        run = subprocess.run([sys.executable, "-B", ROOT / "scripts" / "report", *words], cwd=self.folder, capture_output=True, text=True, check=False, **others)
        self.assertEqual(run.returncode, status, run.stdout + run.stderr)
        if status:
            self.assertEqual(self.files(), before, "something was written")
            self.assertEqual((run.stdout, len(run.stderr.splitlines())), ("", 1), run.stderr)
            self.assertRegex(run.stderr, "^report: error: ")
        return run.stdout + run.stderr

    def files(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))

    def copy(self, name):
        shutil.copytree(self.folder / "run", self.folder / name)
        return self.folder / name

    def page(self, name):
        """The status that the page of a copy shows: its kind and its words."""
        self.report(name)
        text = (self.folder / name / "report.html").read_text(encoding="utf-8")
        return re.search(r'<p class="([a-z ]+)"[^>]* id="status" data-state="([a-z]+)">(.*?)</p>', text).groups()

    def test_no_run(self):
        (self.folder / "foreign").mkdir()
        (self.folder / "foreign" / "history.csv").write_text("step,time\n0,0\n")
        (self.folder / "file").write_text("")
        (self.copy("no_states") / "history.csv").unlink()
        (self.copy("no_rows") / "history.csv").write_text("")
        (self.copy("no_series") / "solution.vtkhdf").unlink()
        shutil.rmtree(self.copy("no_files") / "solution")
        self.assertIn("no_where does not exist", self.report("no_where", status=1))
        self.assertIn("file is a file; allowed is a folder of results", self.report("file", status=1))
        self.assertIn("foreign is no folder of results of corotet", self.report("foreign", status=1))
        self.assertIn("no_states has no states", self.report("no_states", status=1))
        self.assertIn("no_rows has no states", self.report("no_rows", status=1))
        self.assertIn("no_series has no states: solution.vtkhdf is missing", self.report("no_series", status=1))
        self.assertIn("step_000000.h5 is missing, to which solution.vtkhdf refers", self.report("no_files", status=1))
        self.assertIn("nowhere/page.html cannot be written: the folder nowhere does not exist", self.report("run", "--out", "nowhere/page.html", status=1))

    def test_files_that_are_there(self):
        """Pages of runs are replaced, other files only with --overwrite, and an
        old page stays if the new one cannot be written completely."""
        file = self.folder / "run" / "history.csv"
        history = file.read_bytes()
        self.assertIn("run/history.csv exists and is no page of a run; --overwrite replaces it", self.report("run", "--out", "run/history.csv", status=1))
        self.assertEqual(file.read_bytes(), history)
        self.assertIn("run/solution cannot be written: it is a folder", self.report("run", "--out", "run/solution", status=1))
        page = self.folder / "page.html"
        page.write_text("of someone else")
        self.report("run", "--out", "page.html", "--overwrite")
        self.report("run", "--out", "page.html")
        before = page.read_bytes()
        self.assertIn(b"<!DOCTYPE html>", before[:20])
        self.assertEqual(self.report("run", "--out", "page.html", status=3, preexec_fn=limit_files), "report: error: page.html: File too large\n")
        self.assertEqual(page.read_bytes(), before)

    def test_damaged_files(self):
        for name, file, damage, message in (
                ("summary", "summary.json", lambda data: data[:40], "summary.json is damaged"),
                ("history", "history.csv", lambda data: data.replace(b"\n2,", b"\n2,x"), "history.csv is damaged: column time has what is not a number"),
                ("rows", "history.csv", lambda data: data.replace(b"\n2,", b"\n"), "history.csv is damaged: row 3 has"),
                ("parameters", "parameters.prm", lambda data: data + b"end\n", "parameters.prm is damaged: an 'end' too many"),
                ("series", "solution.vtkhdf", lambda data: data[:2000], "solution.vtkhdf is damaged or incomplete"),
                ("mesh", "solution/mesh.h5", lambda data: data[:len(data) // 2], "solution/mesh.h5 is damaged or incomplete"),
                ("state", "solution/step_000002.h5", lambda data: data[:len(data) // 2], "solution/step_000002.h5 is damaged or incomplete"),
                ("no_state", "solution/step_000002.h5", None, "solution/step_000002.h5 is missing")):
            with self.subTest(name=name):
                path = self.copy(name) / file
                data = path.read_bytes()
                path.unlink()
                if damage:
                    path.write_bytes(damage(data))
                self.assertIn(message, self.report(name, status=1))

    def test_missing_part_of_a_long_run(self):
        """The first states of a long run are in files to which another file
        than solution.vtkhdf refers."""
        self.run_case("cantilever", "long", *RUN, "Time integration/End time = 0.4")
        (self.folder / "long" / "solution" / "step_000005.h5").unlink()
        self.assertIn("step_000005.h5 is missing, to which block_000000.h5 refers", self.report("long", status=1))

    def test_runs_without_a_good_end(self):
        summary = json.loads((self.folder / "run" / "summary.json").read_text())
        self.assertEqual(self.page("run")[:2], ("status", "done"))
        (self.copy("failed") / "summary.json").write_text(json.dumps(summary | {"status": "failed", "message": "Newton <did> not converge"}))
        kind, state, text = self.page("failed")
        self.assertEqual((kind, state), ("notice failed", "failed"))
        self.assertIn("The computation failed: Newton &lt;did&gt; not converge. It reached t = 0.04 s, step 4.", text)
        (self.copy("stopped") / "summary.json").write_text(json.dumps(summary | {"status": "stopped", "message": "by a signal"}))
        self.assertEqual(self.page("stopped")[:2], ("notice open", "stopped"))
        # A row that is being written does not count yet.
        killed = self.copy("killed")
        (killed / "summary.json").unlink()
        with open(killed / "history.csv", "a", encoding="utf-8") as file:
            file.write("5,0.05,0.0")
        kind, state, text = self.page("killed")
        self.assertEqual((kind, state), ("notice open", "killed"))
        self.assertIn("It reached t = 0.04 s, step 4.", text)
        # A run that is still writing keeps the folder locked.
        with open(killed / ".corotet", "rb") as mark:
            fcntl.flock(mark, fcntl.LOCK_EX)
            kind, state, text = self.page("killed")
        self.assertEqual((kind, state), ("notice open", "running"))
        self.assertIn("The run is under way.", text)

    def test_checks_that_are_missed(self):
        (self.folder / "run" / "verification.csv").write_text("case,quantity,computed,reference,error,tolerance,pass\n"
                                                              "x,a,1,1,+0 %,1 %,yes\nx,b,2,1,+100 %,1 %,no\n")
        self.report("run")
        text = (self.folder / "run" / "report.html").read_text(encoding="utf-8")
        self.assertIn('<p class="notice failed">1 check of 2 missed.</p>', text)
        self.assertEqual(re.findall(r'<span class="(\w+)">', text), ["pass", "miss"])

    def test_texts_of_others(self):
        """Content of a log or a name is shown as text, whatever it looks
        like."""
        self.copy("<b>&")
        with open(self.folder / "<b>&" / "log.txt", "a", encoding="utf-8") as file:
            file.write("warning: </script><script>alert(1)</script>\n")
        self.report("<b>&", "--out", "page.html")
        text = (self.folder / "page.html").read_text(encoding="utf-8")
        self.assertIn("<h1>&lt;b&gt;&amp;</h1>", text)
        self.assertNotIn("<script>alert", text)
        self.assertIn("&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;", text)

    def test_without_the_program(self):
        """A copy of the scripts alone, without a program beside it or in the
        path, does not know the defaults, and tells so."""
        shutil.copytree(ROOT / "scripts", self.folder / "scripts", ignore=shutil.ignore_patterns("__pycache__"))
        run = subprocess.run([sys.executable, "-B", self.folder / "scripts" / "report", "run", "--out", "page.html"], cwd=self.folder,
                             env={"PATH": "/usr/bin:/bin"}, capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("What differs from the defaults is not known here", (self.folder / "page.html").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
