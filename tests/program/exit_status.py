#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Exit statuses 1, 2 and 3, their messages, and the files that remain (for
status 1 for wrong input see also tests/errors)."""

import hashlib
import os
import subprocess
import unittest

from support import ROOT, ProgramTest, read_history, read_summary

SMALL = ("Mesh/box/Cells = 4, 1, 1", "Discretization/Degree = 1")


def fingerprint(directory):
    """The content and time of change of all files below @p directory."""
    return {file: (file.stat().st_mtime_ns, hashlib.sha256(file.read_bytes()).hexdigest())
            for file in directory.rglob("*") if file.is_file()}


class ExitStatus(ProgramTest):

    def run_small(self, *settings, **others):
        overrides = [word for setting in (*SMALL, *settings) for word in ("--set", setting)]
        arguments = [ROOT / "parameters" / "cantilever.prm", *overrides]
        return self.run_program(*arguments, "--output", others.pop("output", "results"), *others.pop("words", ()), **others)

    def check_message(self, run, *parts):
        self.assertEqual(run.stderr.count("\n"), 1, run.stderr)
        self.assertTrue(run.stderr.startswith("corotet: error: "), run.stderr)
        for part in parts:
            self.assertIn(part, run.stderr)

    def test_failed_computation(self):
        # After two ordinary steps gravity becomes as strong as on a neutron
        # star: eight iterations are not enough. This also happens at the end of
        # a part of the step, where the last digit of t matters, so the record
        # has to tell the time at which loads were evaluated.
        run = self.run_small("Loads/Gravity = 0; 0; if(t < 0.025, -9.81, -1e12)", "Newton/Maximum iterations = 8",
                             "Time integration/End time = 0.1", "Time integration/Type = backward Euler", status=2)
        self.check_message(run, "step 3", "Newton's method", "halved 8 times")
        directory = self.folder / "results"
        self.assertEqual([row["step"] for row in read_history(directory)], ["0", "1", "2", "3"])
        self.check_vtkhdf(directory)
        summary = read_summary(directory)
        self.assertEqual((summary["status"], summary["steps"]), ("failed", 3))
        self.assertIn(summary["message"], run.stderr)
        self.assertEqual((directory / "log.txt").read_text(encoding="utf-8").splitlines()[-1], f"error: {summary['message']}")
        self.assertEqual(summary["final"]["step"], 3)
        # The part of the third step that succeeded is there.
        self.assertGreater(summary["final"]["time"], 0.02)
        self.assertLess(summary["final"]["time"], 0.025)

    def test_load_that_is_not_finite(self):
        # The formula is not finite in the middle of the run only, where no
        # check before the start evaluates it: the message names it.
        run = self.run_small("Loads/Gravity = 0; 0; if(t > 0.033 && t < 0.066, sqrt(-1), 1)", "Time integration/Maximum halvings = 0",
                             "Time integration/Type = Newmark", "Time integration/Time step = 0.01", "Time integration/End time = 0.1", status=2)
        self.check_message(run, "step 4", "Loads/Gravity", "not finite")
        self.assertEqual(read_summary(self.folder / "results")["steps"], 3)

    def test_springs_of_the_first_load_step(self):
        # The springs are right at the start, but not where statics begins.
        settings = ("Time integration/Type = static", "Time integration/static/Load steps = 1", "Time integration/End time = 0.04",
                    "Supports/Elastic = z-max: 0.02 - t; 0; 0")
        for words in ((), ("--validate",)):
            run = self.run_small(*settings, status=1, words=words)
            self.check_message(run, "Supports/Elastic: found the value -0.02 at")
            self.assertFalse((self.folder / "results").exists())

    def test_loads_at_the_start_of_statics(self):
        # No state is solved for at the start, but the work of the loads begins there.
        settings = ("Time integration/Type = static", "Time integration/End time = 0.04", "Boundary conditions/Traction = z-max: 1/t; 0; 0")
        for words in ((), ("--validate",)):
            run = self.run_small(*settings, status=1, words=words)
            self.check_message(run, "Boundary conditions/Traction: ")
            self.assertIn("at t = 0", run.stderr)
            self.assertFalse((self.folder / "results").exists())

    def test_supports_that_disagree_on_the_way(self):
        # This motion vanishes at the times that are checked before the start,
        # but not between.
        run = self.run_small("Boundary conditions/Displacement = z-max: 0; 0.01*sin(2*pi*t/0.04); 0", "Time integration/End time = 0.04",
                             "Time integration/Maximum halvings = 0", status=2)
        self.check_message(run, "step 1 (t = 0): Boundary conditions/")
        summary = read_summary(self.folder / "results")
        self.assertEqual((summary["status"], summary["steps"]), ("failed", 0))

    def test_failed_check(self):
        # The run is complete, and the comparison tells what is wrong, on one
        # rank and on two.
        checks = ("Verification/Source = none", "Verification/Tolerance reason = none", "Time integration/End time = 0.02",
                  "Verification/Checks = right: last time = 0.02 +- 1e-9 %; wrong: last abs(step) + 1/4 where time > 0 = 2.5 +- 5 %")
        for ranks in (1, 2):
            directory = f"ranks_{ranks}"
            run = self.run_small(*checks, status=2, ranks=ranks, output=directory)
            self.assertEqual(run.stderr.count("corotet: error: 1 of 2 checks failed; see ranks_"), 1, run.stderr)
            self.assertEqual((self.folder / directory / "verification.csv").read_text(encoding="utf-8"),
                             "case,quantity,computed,reference,error,tolerance,pass\n"
                             "cantilever,right,0.02,0.02,+0 %,1e-9 %,yes\n"
                             "cantilever,wrong,2.25,2.5,-10 %,5 %,no\n")
            self.assertEqual(read_summary(self.folder / directory)["status"], "done")
        self.run_small("Output/Overwrite = true", "Time integration/End time = 0.01", output="ranks_1")
        self.assertFalse((self.folder / "ranks_1" / "verification.csv").exists())

    def test_failed_computation_on_two_ranks(self):
        run = self.run_small("Newton/Maximum iterations = 1", "Loads/Gravity = 0; 0; -1e12", status=2, ranks=2)
        # The message comes once, not once per rank; mpirun adds words of its
        # own.
        self.assertEqual(run.stderr.count("corotet: error: "), 1, run.stderr)
        self.assertEqual(read_summary(self.folder / "results")["status"], "failed")

    def test_directory_that_cannot_be_made(self):
        # Not even root can make a folder there.
        run = self.run_small(output="/proc/corotet", status=3)
        self.check_message(run, "/proc/corotet")

    def run_without_rights(self, *arguments):
        """Runs the program as a user who owns none of the files, as root may
        read all."""
        user = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}
        return subprocess.run([os.environ["COROTET_PROGRAM"], *arguments], cwd=self.folder, capture_output=True, text=True, check=False, **user)

    def test_files_that_must_not_be_read(self):
        """Parameter files, included files and meshes without permission; and
        files in folders without permission."""
        self.folder.chmod(0o755)
        (self.folder / "locked").mkdir()
        for name in ("closed.prm", "closed.json", "closed.msh", "locked/a.prm", "locked/a.msh"):
            (self.folder / name).write_text("", encoding="utf-8")
            (self.folder / name).chmod(0)
        (self.folder / "locked").chmod(0)
        self.addCleanup((self.folder / "locked").chmod, 0o700)
        for name, includes in (("one.prm", "closed.prm"), ("two.prm", "locked/a.prm")):
            (self.folder / name).write_text(f"# a comment\ninclude {includes}\n", encoding="utf-8")
        for arguments, place in ((("closed.prm",), "closed.prm"), (("closed.json", "--validate"), "closed.json"), (("locked/a.prm",), "locked/a.prm"),
                                 (("one.prm",), "one.prm:2: closed.prm"), (("two.prm",), "two.prm:2: locked/a.prm"),
                                 (("mesh", "closed.msh"), "closed.msh"), (("mesh", "locked/a.msh"), "locked/a.msh")):
            with self.subTest(arguments=arguments):
                run = self.run_without_rights(*arguments)
                self.assertEqual((run.returncode, run.stderr), (3, f"corotet: error: {place}: cannot be read (permission?)\n"))

    def test_directory_in_use(self):
        short = "Time integration/End time = 0.02"
        self.run_small(short)
        before = fingerprint(self.folder)
        run = self.run_small(short, status=1)
        self.check_message(run, "results")
        self.assertEqual(fingerprint(self.folder), before)

        # Nor are they replaced if the input is wrong.
        for words in ((), ("--validate",)):
            run = self.run_small("Output/Overwrite = true", "Output/Time between results = 1e-12", "Time integration/Type = central difference",
                                 "Time integration/Time step = 0", words=words, status=1)
            self.check_message(run, "Output/Time between results: found 1e-12, which makes")
        self.assertEqual(fingerprint(self.folder), before)

        # On request results are replaced, but nothing else is.
        self.run_small(short, "Output/Overwrite = true")
        self.assertNotEqual(fingerprint(self.folder), before)
        (self.folder / "results" / "letter.txt").write_text("not a result", encoding="utf-8")
        before = fingerprint(self.folder)
        run = self.run_small(short, "Output/Overwrite = true", status=1)
        self.check_message(run, "letter.txt")
        self.assertEqual(fingerprint(self.folder), before)


if __name__ == "__main__":
    unittest.main()
