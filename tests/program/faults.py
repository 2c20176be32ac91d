#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Every operation on files, and every large allocation, of a short run with output and checkpoints fails once, or the process is
killed there: the run ends with status 3 and one line (or by the kill), or the failure did not matter; and --restart gives the
history and the time series of the undisturbed run.

failing_files.cc makes the failures. As a script: faults.py --all tries every operation on one and two ranks, some minutes for each
kind of failure; the test takes some of them.
"""

import argparse
import collections
import os
import re
import shutil
import signal
import subprocess
import sys
import unittest

from support import ProgramTest, parameter_text, read_summary, run_on
from checkpoints import IMPLICIT, different, results_of, rows_without_time

CASE = {**IMPLICIT, "Mesh/box/Cells": "2, 1, 1", "Discretization/Degree": "1", "Time integration/End time": "0.16",
        "Checkpoint/Steps between checkpoints": "3", "Output/Directory": ""}
# The fields of this case are large enough for their allocations to be counted.
MEMORY_CASE = {**CASE, "Mesh/box/Cells": "12, 4, 4", "Discretization/Degree": "2", "Time integration/End time": "0.08"}
MODES = ("once", "from", "kill", "memory")
MESSAGE = re.compile(r"corotet: error: (.*)")


class Faults(ProgramTest):

    def start(self, ranks, *arguments, **environment):
        arguments = ["case.prm", "--output", str(self.folder / "results"), "--quiet", *arguments]
        try:
            run = run_on(ranks, arguments, self.folder, 60, **environment)
        except subprocess.TimeoutExpired:
            self.fail(f"a run hangs: {environment}")
        return run.returncode, run.stderr

    def prepare(self, mode, ranks):
        """Makes the undisturbed run. Returns the settings of the failing library and the number of operations."""
        case = MEMORY_CASE if mode == "memory" else CASE
        (self.folder / "case.prm").write_text(parameter_text({name: value for name, value in case.items() if value}), encoding="utf-8")
        preload = {"LD_PRELOAD": os.environ["COROTET_FAILING_FILES"], "COROTET_TEST_RANK": "all" if ranks == 1 else ranks - 1, "COROTET_TEST_FILES": "/results",
                   "COROTET_TEST_MODE": mode, "ASAN_OPTIONS": "verify_asan_link_order=0"}
        count = self.folder / "count"
        results = self.folder / "results"
        shutil.rmtree(results, ignore_errors=True)
        status, errors = self.start(ranks, COROTET_TEST_FROM=10**9, COROTET_TEST_COUNT=count, **preload)
        self.assertEqual(status, 0, errors)
        n = int(count.read_text(encoding="utf-8"))
        self.assertGreater(n, 10)
        return preload, n, rows_without_time(results), results_of(results)

    def try_one(self, preload, ranks, number, history, series):
        """Makes the run with that failure; returns its outcome."""
        results = self.folder / "results"
        shutil.rmtree(results, ignore_errors=True)
        status, errors = self.start(ranks, COROTET_TEST_FROM=number, **preload)
        killed = preload["COROTET_TEST_MODE"] == "kill"
        if status == 0:
            ending = "unharmed"
            self.assertEqual(MESSAGE.findall(errors), [], errors)
            self.assertEqual(read_summary(results)["status"], "done")
        elif killed:
            ending = "killed"
            if ranks == 1:
                self.assertEqual(status, -signal.SIGKILL, errors)
        else:
            ending = "status 3"
            self.assertEqual((status, len(MESSAGE.findall(errors))), (3, 1), errors)
        status, errors = self.start(ranks, "--restart", "--set", "Output/Overwrite = true")
        self.assertEqual(status, 0, errors)
        self.assertTrue(rows_without_time(results) == history, "another history after the restart")
        self.assertEqual(different(results_of(results), series), [])
        return ending

    def sample(self, mode, ranks, n_tries):
        preload, n, history, series = self.prepare(mode, ranks)
        endings = collections.Counter()
        for number in sorted({1 + (n - 1) * i // max(1, n_tries - 1) for i in range(n_tries)}):
            with self.subTest(mode=mode, ranks=ranks, number=number, of=n):
                endings[self.try_one(preload, ranks, number, history, series)] += 1
        return n, endings

    def test_some(self):
        for mode in MODES:
            self.sample(mode, 1, 9)
            self.sample(mode, 2, 3)

    def test_no_locks(self):
        """File systems of clusters may have no locks: the run warns and goes
        on."""
        (self.folder / "case.prm").write_text(parameter_text({name: value for name, value in CASE.items() if value}), encoding="utf-8")
        status, errors = self.start(1, LD_PRELOAD=os.environ["COROTET_FAILING_FILES"], COROTET_TEST_RANK="all", COROTET_TEST_FROM=10**9,
                                    COROTET_TEST_FILES="/results", COROTET_TEST_MODE="no locks", ASAN_OPTIONS="verify_asan_link_order=0")
        self.assertEqual(status, 0, errors)
        self.assertIn("results' cannot be locked (No locks available): let no other run write there",
                      (self.folder / "results" / "log.txt").read_text(encoding="utf-8"))

    def test_old_checkpoint_stays(self):
        """An old checkpoint that cannot be removed does not end the run."""
        settings = {**CASE, "Checkpoint/Keep": "1"}
        (self.folder / "case.prm").write_text(parameter_text({name: value for name, value in settings.items() if value}), encoding="utf-8")
        environment = {"LD_PRELOAD": os.environ["COROTET_FAILING_FILES"], "COROTET_TEST_RANK": "all", "COROTET_TEST_MODE": "once",
                       "COROTET_TEST_FILES": "/checkpoint/step_000003.json", "ASAN_OPTIONS": "verify_asan_link_order=0"}
        count = self.folder / "count"
        results = self.folder / "results"
        self.start(1, COROTET_TEST_FROM=10**9, COROTET_TEST_COUNT=count, **environment)
        old = results / "checkpoint" / "step_000003.json"
        self.assertFalse(old.exists())
        shutil.rmtree(results)
        # The last operation on the old checkpoint removes it.
        status, errors = self.start(1, COROTET_TEST_FROM=int(count.read_text(encoding="utf-8")), **environment)
        self.assertEqual(status, 0, errors)
        self.assertIn("step_000003.json: an old checkpoint cannot be removed: Permission denied",
                      (results / "log.txt").read_text(encoding="utf-8"))
        self.assertFalse(old.exists())

    def test_failed_step(self):
        """If a step fails, and then a file cannot be written, both are
        reported, so that a user who makes room on the disk knows of the
        step."""
        case = {**CASE, "Newton/Maximum iterations": "1", "Loads/Gravity": "0; 0; -1e12"}
        (self.folder / "case.prm").write_text(parameter_text({name: value for name, value in case.items() if value}), encoding="utf-8")
        for ranks in (1, 2):
            status, errors = self.start(ranks, LD_PRELOAD=os.environ["COROTET_FAILING_FILES"], COROTET_TEST_RANK="all", COROTET_TEST_FROM=1,
                                        COROTET_TEST_FILES="/results/summary.json", COROTET_TEST_MODE="from",
                                        ASAN_OPTIONS="verify_asan_link_order=0")
            messages = MESSAGE.findall(errors)
            self.assertEqual((status, len(messages)), (3, 1), errors)
            self.assertRegex(messages[0], r"^step 1 \(t = 0\): Newton's method did not converge .*; and then: .*summary\.json.*cannot be written")
            shutil.rmtree(self.folder / "results")


def try_all(modes, ranks):
    test = Faults()
    test.setUp()
    failed = False
    for mode in modes:
        for n_ranks in ranks:
            preload, n, history, series = test.prepare(mode, n_ranks)
            endings = collections.Counter()
            for number in range(1, n + 1):
                try:
                    endings[test.try_one(preload, n_ranks, number, history, series)] += 1
                except AssertionError as error:
                    failed = True
                    endings["LOSS"] += 1
                    print(f"{mode}, {n_ranks} ranks, {number} of {n}: {str(error)[:600]}", flush=True)
            print(f"{mode:6} {n_ranks} ranks: {n} faults: " + ", ".join(f"{count} {ending}" for ending, count in sorted(endings.items())),
                  flush=True)
    test.doCleanups()
    return 1 if failed else 0


if __name__ == "__main__":
    if "--all" in sys.argv:
        parser = argparse.ArgumentParser(description=__doc__)
        parser.add_argument("--all", action="store_true")
        parser.add_argument("--modes", nargs="+", default=MODES, choices=MODES)
        parser.add_argument("--ranks", nargs="+", type=int, default=[1, 2])
        options = parser.parse_args()
        sys.exit(try_all(options.modes, options.ranks))
    unittest.main()
