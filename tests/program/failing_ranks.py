#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Whatever fails on one rank, or on all: the program ends with one message and
the right exit status.

failing_files.cc lets the n-th operation on files and all later ones fail, on a chosen rank, as on a disk that is full from then on.
Hanging is failing: each run has a minute.
"""

import os
import re
import shutil
import subprocess
import unittest

from support import ROOT, ProgramTest, launcher, read_summary, run_on

# Two steps of a beam with results of all kinds; the factorisation is on rank 0.
SETTINGS = ("Mesh/box/Cells = 6, 1, 1", "Discretization/Degree = 2", "Time integration/End time = 0.02", "Output/Stress = both",
            "Linear solver/Type = p-multigrid")
STUDY = ("Discretization/Degree = 1", "Time integration/End time = 0.01", "Mesh/box/Cells = 2, 1, 1", "Type = convergence study",
         "Convergence study/Degrees = 1", "Convergence study/Refinements = 0, 1", "Convergence study/Quantities = tip_z",
         "Convergence study/Reference = none", "Convergence study/Pictures = false")
# mpirun may write other words before the message in the same line.
MESSAGE = re.compile("corotet: error: (.*)")


class FailingRanks(ProgramTest):

    def start(self, arguments, ranks, **environment):
        """The exit status and the messages of a run."""
        run = run_on(ranks, arguments, self.folder, 60, **environment)
        return run.returncode, MESSAGE.findall(run.stderr), run.stderr

    def check(self, run, status, text=""):
        self.assertEqual((run[0], len(run[1])), (status, 1), run[2])
        self.assertIn(text, run[1][0])

    def test_exceptions_on_some_ranks_only(self):
        # The messages of each kind of error; where all ranks throw, only rank 0
        # writes.
        kinds = {"input": (1, "Section/Entry: of rank {}"), "computation": (2, "of rank {}"), "machine": (3, "of rank {}"),
                 "memory": (3, "memory is too short"), "bug": (3, "internal: of rank {}"), "number": (3, "internal: ")}
        for kind, ranks, rank in (("machine", 2, 0), ("machine", 2, 1), ("machine", 2, "all"), ("machine", 3, 2), ("input", 2, 1),
                                  ("computation", 3, 0), ("memory", 2, 1), ("bug", 2, 1), ("bug", 3, "all"), ("number", 2, 0)):
            with self.subTest(kind=kind, ranks=ranks, rank=rank):
                command = [*launcher(ranks), os.environ["COROTET_LONELY_ERROR"], str(rank), kind]
                run = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=60, check=False)
                status, text = kinds[kind]
                self.check((run.returncode, MESSAGE.findall(run.stderr), run.stderr), status, text.format(0 if rank == "all" else rank))

    def fail_everywhere(self, settings, ranks, rank, n_runs):
        """Lets @p n_runs operations, evenly from the first to the last, be the
        first that fails."""
        preload = {"LD_PRELOAD": os.environ["COROTET_FAILING_FILES"], "COROTET_TEST_RANK": rank, "COROTET_TEST_FILES": "/results",
                   "ASAN_OPTIONS": "verify_asan_link_order=0"}
        directory = self.folder / "results"
        overrides = [word for setting in settings for word in ("--set", setting)]
        command = [ROOT / "parameters" / "cantilever.prm", *overrides, "--output", directory, "--quiet"]
        count = self.folder / "count"
        shutil.rmtree(directory, ignore_errors=True)
        run = self.start(command, ranks, COROTET_TEST_FROM=10**6, COROTET_TEST_MODE="from", COROTET_TEST_COUNT=count, **preload)
        self.assertEqual(run[0], 0, run[2])
        n = int(count.read_text(encoding="utf-8"))
        self.assertGreater(n, 10)
        for first in sorted({1 + (n - 1) * i // (n_runs - 1) for i in range(n_runs)}):
            with self.subTest(ranks=ranks, rank=rank, first=first, of=n):
                shutil.rmtree(directory, ignore_errors=True)
                run = self.start(command, ranks, COROTET_TEST_FROM=first, COROTET_TEST_MODE="from", **preload)
                # If all results exist already, failing to write the last lines
                # of the log is no error.
                if run[0] == 0:
                    self.assertGreater(first, 0.9 * n)
                    self.assertEqual(read_summary(directory)["status"], "done")
                else:
                    self.check(run, 3)

    def test_operations_on_files(self):
        for ranks, rank in ((1, "all"), (2, 0), (2, 1), (2, "all"), (3, 1)):
            self.fail_everywhere(SETTINGS, ranks, rank, 7)

    def test_operations_on_files_of_a_study(self):
        for ranks, rank in ((2, 0), (2, "all")):
            self.fail_everywhere(STUDY, ranks, rank, 5)

    def test_files_that_cannot_be_read(self):
        # Rank 0 reads for all ranks: it does not matter if others cannot read.
        (self.folder / "table.csv").write_text("0, 0\n1, 1\n", encoding="utf-8")
        (self.folder / "case.prm").write_text("subsection Tables\n  set Linear = f: table.csv\nend\n", encoding="utf-8")
        program = ["case.prm", "--validate", "--quiet"]
        for file in ("case.prm", "table.csv"):
            for ranks, rank, expected in ((2, 0, 3), (2, 1, 0), (2, "all", 3), (3, 2, 0)):
                with self.subTest(file=file, ranks=ranks, rank=rank):
                    run = self.start(program, ranks, LD_PRELOAD=os.environ["COROTET_FAILING_FILES"], COROTET_TEST_RANK=rank,
                                     COROTET_TEST_FILES=file, COROTET_TEST_FROM=1, COROTET_TEST_MODE="from", ASAN_OPTIONS="verify_asan_link_order=0")
                    if expected == 0:
                        self.assertEqual(run[:2], (0, []), run[2])
                    else:
                        self.check(run, expected, file + ": ")


if __name__ == "__main__":
    unittest.main()
