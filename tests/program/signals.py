#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Signals and limits of time: one that ends a run leaves it saved, and one that
requests a checkpoint does not end it."""

import os
import re
import resource
import shutil
import signal
import subprocess
import time
import unittest

from support import ProgramTest, parameter_text, read_history, read_summary
from checkpoints import BEAM, Run, rows_without_time

# The set-up of this case takes some time, so that signals come during it.
LARGE = {**BEAM, "Mesh/box/Cells": "40, 8, 8", "Time integration/Time step": "0.02"}
# The steps of this case take half a second and more.
SLOW = {**BEAM, "Mesh/box/Cells": "20, 4, 4", "Time integration/End time": "10", "Time integration/Time step": "0.01", "Linear solver/Type": "jacobi"}


class Signals(ProgramTest):

    def test_signals(self):
        """A stopped run tells so once on the terminal and once in its log, and
        its restart gives the results of an undisturbed run."""
        reference = Run(self.folder / "reference", "generalized-alpha", 1)
        self.assertEqual(reference.finish()[0], 0)
        for number, ranks in ((signal.SIGTERM, 1), (signal.SIGINT, 1), (signal.SIGHUP, 1), (signal.SIGXCPU, 1), (signal.SIGTERM, 2)):
            with self.subTest(number=number, ranks=ranks):
                run = Run(self.folder / f"{number}_{ranks}", "generalized-alpha", 1)
                process = run.start(ranks=ranks)
                history = run.output / "history.csv"
                while not history.exists() or history.read_text(encoding="utf-8").count("\n") < 8:
                    time.sleep(0.005)
                start = time.monotonic()
                os.kill(run.processes()[-1], number)
                out, errors = process.communicate(timeout=60)
                self.assertLess(time.monotonic() - start, 10)
                self.assertEqual(process.returncode, 4, errors)
                lines = [line for line in errors.splitlines() if "corotet" in line and "stopped" in line]
                self.assertEqual(len(lines), 1, errors)
                reason = "the limit of CPU time (SIGXCPU)" if number == signal.SIGXCPU else signal.Signals(number).name
                said = rf"step \d+ \(t = .* s\): {re.escape(reason)}; the run is saved, --restart goes on"
                self.assertRegex(lines[0], said)
                self.assertNotIn("the run is saved", out)
                self.assertEqual(len(re.findall(said, (run.output / "log.txt").read_text(encoding="utf-8"))), 1)
                self.assertEqual(read_summary(run.output)["status"], "stopped")
                if ranks == 1:
                    self.assertEqual(run.finish("--restart")[0], 0)
                    self.assertEqual(rows_without_time(run.output), rows_without_time(reference.output))

    def test_save_request_and_time_limit(self):
        run = Run(self.folder / "asked", "generalized-alpha", 1, {"Checkpoint/Steps between checkpoints": "0", "Checkpoint/Keep": "100"})
        process = run.start()
        while not (run.output / "history.csv").exists():
            time.sleep(0.005)
        process.send_signal(signal.SIGUSR1)
        self.assertEqual(process.wait(60), 0)
        process.communicate()
        self.assertEqual(len(list((run.output / "checkpoint").glob("*.json"))), 1)

        # The limit is over when steps begin, so each run makes one step.
        limited = Run(self.folder / "limited", "generalized-alpha", 1, {"Checkpoint/Wall time limit": "0.05"})
        for _ in range(200):
            status, _, errors = limited.finish("--restart")
            if status == 0:
                break
            self.assertEqual(status, 4)
            self.assertIn("the wall time limit; the run is saved", errors)
        self.assertEqual(status, 0)
        self.assertEqual(rows_without_time(limited.output), rows_without_time(run.output))

    def start(self, entries, *arguments, **others):
        """Starts the program itself, with pipes for its output."""
        (self.folder / "case.prm").write_text(parameter_text(entries), encoding="utf-8")
        return subprocess.Popen([os.environ["COROTET_PROGRAM"], "case.prm", *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, **others)

    def signal_within_step(self, *numbers):
        """Sends signals within the first step, each when the one before has
        arrived. Returns status and errors."""
        process = self.start(SLOW, "--set", "Output/Overwrite = true")
        while not (self.folder / "run" / "history.csv").exists() or len(read_history(self.folder / "run")) < 1:
            time.sleep(0.002)
        for number in numbers:
            process.send_signal(number)
            time.sleep(0.01)
        _, errors = process.communicate(timeout=60)
        return process.returncode, errors

    def test_second_signal(self):
        """Launchers may send SIGTERM more than once, which must not lose the
        step; a second Ctrl-C ends the program at once."""
        status, errors = self.signal_within_step(signal.SIGTERM, signal.SIGTERM)
        self.assertEqual(status, 4, errors)
        self.assertIn("SIGTERM; the run is saved", errors)
        self.assertEqual(read_summary(self.folder / "run")["status"], "stopped")
        self.assertEqual(self.signal_within_step(signal.SIGINT, signal.SIGINT)[0], -signal.SIGINT)

    def test_long_step(self):
        """A step that would take minutes is given up; the restarted run makes
        it."""
        entries = {**BEAM, "Time integration/Type": "static", "Discretization/Degree": "3", "Mesh/box/Size": "10, 0.1, 0.1",
                   "Mesh/box/Cells": "200, 2, 2", "Material/Young's modulus": "1e9", "Linear solver/Type": "jacobi", "Linear solver/Maximum iterations": "1000000"}
        process = self.start(entries)
        while not (self.folder / "run" / "history.csv").exists() or len(read_history(self.folder / "run")) < 1:
            time.sleep(0.01)
        start = time.monotonic()
        process.send_signal(signal.SIGTERM)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4, errors)
        self.assertIn("step 0 (t = 0 s): SIGTERM; the run is saved", errors)
        self.assertGreater(time.monotonic() - start, 5)
        self.assertEqual(read_summary(self.folder / "run")["status"], "stopped")
        self.assertEqual(len(read_history(self.folder / "run")), 1)
        other = self.start({**entries, "Linear solver/Type": "automatic"}, "--restart")
        self.assertEqual((other.communicate(timeout=60)[1], other.returncode), ("", 0))
        self.assertEqual([row["step"] for row in read_history(self.folder / "run")], ["0", "1"])

    def test_hangup_that_is_ignored(self):
        """A run that ignores SIGHUP, as with nohup, goes on: MPI's libraries
        handle that signal themselves, which must not change this."""
        for ignored in (True, False):
            with self.subTest(ignored=ignored):
                process = self.start({**BEAM, "Time integration/End time": "0.4"}, "--set", "Output/Overwrite = true",
                                     preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN if ignored else signal.SIG_DFL))
                # Signals are sent from the first line of output on, while the
                # body is made, and then during the steps.
                process.stdout.readline()
                process.send_signal(signal.SIGHUP)
                while process.poll() is None and ignored:
                    process.send_signal(signal.SIGHUP)
                    time.sleep(0.01)
                _, errors = process.communicate(timeout=60)
                if ignored:
                    self.assertEqual((process.returncode, errors), (0, ""))
                else:
                    self.assertIn(process.returncode, (4, -signal.SIGHUP))

    def test_closed_pipe(self):
        """If the reader of the log ends, the run goes on to its end; a signal
        still ends it with all results saved."""
        for number, status in ((None, 0), (signal.SIGINT, 4)):
            with self.subTest(number=number):
                entries = {**BEAM, "Newton/Log every solve": "true", **({"Time integration/End time": "1e4"} if number else {})}
                shutil.rmtree(self.folder / "run", ignore_errors=True)
                process = self.start(entries)
                process.stdout.readline()
                process.stdout.close()
                history = self.folder / "run" / "history.csv"
                while number and (not history.exists() or history.read_text(encoding="utf-8").count("\n") < 8):
                    time.sleep(0.005)
                if number:
                    process.send_signal(number)
                self.assertEqual((process.wait(60), "the run is saved" in process.stderr.read()), (status, bool(number)))
                process.stderr.close()
                self.assertEqual(read_summary(self.folder / "run")["status"], "stopped" if number else "done")

    def test_limit_of_cpu_time(self):
        """At the soft limit of CPU time, as set by "ulimit -S -t", a run is
        saved."""
        process = self.start({**BEAM, "Time integration/End time": "1e4"},
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (1, resource.getrlimit(resource.RLIMIT_CPU)[1])))
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4, errors)
        self.assertIn("the limit of CPU time (SIGXCPU); the run is saved", errors)

    def test_save_request_without_steps(self):
        """During the set-up, and while modes are computed, there is nothing to
        save: a request to save does not end the program."""
        for kind, entries in (("simulation", {"Time integration/End time": "0.02"}), ("modes", {"Modes/Number": "1", "Loads/Gravity": "0; 0; 0"})):
            with self.subTest(kind=kind):
                process = self.start({**LARGE, "Type": kind, **entries}, "--set", "Output/Overwrite = true")
                # Requests are sent from the first line of output on.
                process.stdout.readline()
                while process.poll() is None:
                    process.send_signal(signal.SIGUSR1)
                    time.sleep(0.01)
                _, errors = process.communicate()
                self.assertEqual((process.returncode, errors), (0, ""))


if __name__ == "__main__":
    unittest.main()
