#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""How many messages a rank sends, and how many sums over all ranks it takes part in, in each step and in each iteration: with 3 and with 8
ranks. message_counter.cc counts; two runs of different length show what one step or one iteration takes.
"""

import os
import unittest

from support import ProgramTest, parameter_text, read_summary, run_on

BODY = {"Mesh/Type": "box", "Mesh/box/Size": "8, 1, 1", "Mesh/box/Cells": "32, 3, 3", "Discretization/Degree": "2", "Material/Type": "corotational",
        "Material/Young's modulus": "1e7", "Boundary conditions/Fixed": "x-min", "Loads/Gravity": "0; 0; -1", "Output/Overwrite": "true",
        "Output/Time between results": "100", "Linear solver/Type": "p-multigrid"}
EXPLICIT = {**BODY, "Discretization/Mass": "diagonal scaling", "Time integration/Type": "central difference",
            "Time integration/Time step": "1e-5", "Time integration/End time": "1e-4"}
IMPLICIT = {**BODY, "Time integration/Type": "generalized-alpha", "Time integration/Time step": "1e-2", "Time integration/End time": "0.1"}
STATIC = {**BODY, "Material/Type": "linear", "Time integration/Type": "static", "Newton/Residual tolerance": "0.1"}
# The body is long, so the ranks' parts lie in a row.
MOST_NEIGHBOURS = 2


class Messages(ProgramTest):

    def count(self, ranks, case):
        """The calls of each kind for each rank, and the summary."""
        (self.folder / "case.prm").write_text(parameter_text(case), encoding="utf-8")
        counts = self.folder / "messages"
        run = run_on(ranks, ["case.prm", "--output", self.folder / "results", "--quiet"], self.folder, 120,
                     LD_PRELOAD=os.environ["COROTET_MESSAGE_COUNTER"], COROTET_TEST_MESSAGES=counts, ASAN_OPTIONS="verify_asan_link_order=0")
        self.assertEqual(run.returncode, 0, run.stderr)
        of_ranks = []
        for rank in range(ranks):
            lines = (self.folder / f"messages{rank}").read_text(encoding="utf-8").splitlines()
            of_ranks.append({kind: int(calls) for kind, calls, _ in map(str.split, lines)})
        return of_ranks, read_summary(self.folder / "results")

    def each(self, ranks, short, long, number):
        """The calls of each kind for each unit of number(summary), the most of
        any rank."""
        (few, first), (many, second) = self.count(ranks, short), self.count(ranks, long)
        n = number(second) - number(first)
        self.assertGreater(n, 4)
        return {kind: max((b[kind] - a[kind]) / n for a, b in zip(few, many)) for kind in few[0]}

    def check_steps(self, case, limits):
        end = float(case["Time integration/End time"])
        for ranks in (3, 8):
            found = self.each(ranks, case, {**case, "Time integration/End time": str(3 * end)}, lambda summary: summary["steps"])
            print(f"{ranks} ranks, each step: {found}")
            for kind, most in limits.items():
                self.assertLessEqual(found[kind], most, f"{kind} on {ranks} ranks")

    def test_explicit_steps(self):
        # Each rank receives displacements of ghosts and sends forces.
        nothing = {"reductions": 0, "gathers": 0, "exchanges": 0, "barriers": 0}
        self.check_steps({**EXPLICIT, "Output/Steps between rows": "1000"}, {"messages": 2 * MOST_NEIGHBOURS, **nothing})

    def test_rows_of_the_history(self):
        # The reductions and the gather are those for the work of the step,
        # other columns of the row, whether a support moves, probes, and whether
        # a signal has come.
        self.check_steps(EXPLICIT, {"messages": 4 * MOST_NEIGHBOURS, "reductions": 5, "gathers": 1, "exchanges": 0, "barriers": 0})

    def test_states(self):
        # Each state also has a row. A state needs more messages: for the file,
        # the positions in its tables, whether all ranks have written and the
        # file was renamed, whether the index was written, and ghost values for
        # results of cells.
        row = {**EXPLICIT, "Output/Time between results": "0"}
        without = self.each(3, EXPLICIT, {**EXPLICIT, "Time integration/End time": "3e-4"}, lambda summary: summary["steps"])
        for ranks in (3, 8):
            found = self.each(ranks, row, {**row, "Time integration/End time": "3e-4"}, lambda summary: summary["steps"])
            print(f"{ranks} ranks, each step with a state: {found}, without: {without}")
            for kind, most in {"reductions": 1, "gathers": 4, "exchanges": 5, "barriers": 0}.items():
                self.assertLessEqual(found[kind] - without[kind], most, kind)

    def check_iterations(self, case, messages):
        # Conjugate gradients have two sums; rank 0 gathers the unknowns of the
        # last level and scatters the result.
        for ranks in (3, 8):
            found = self.each(ranks, {**case, "Linear solver/Tolerance": "1e-2"}, {**case, "Linear solver/Tolerance": "1e-11"},
                              lambda summary: summary["final"]["linear_iterations"])
            print(f"{ranks} ranks, each iteration: {found}")
            self.assertLessEqual(found["messages"], messages * MOST_NEIGHBOURS)
            self.assertEqual((found["reductions"], found["gathers"], found["exchanges"], found["barriers"]), (2, 2, 0, 0))

    def test_linear_iterations(self):
        self.check_iterations(STATIC, 20)

    def test_iterations_of_aggregation(self):
        # Messages to each neighbour: the operator has two. The level has two in
        # the smoother that starts from zero, one for the residual, three in the
        # other smoother, and one in each direction for the unknowns of
        # aggregates.
        self.check_iterations({**STATIC, "Discretization/Degree": "1", "Linear solver/p-multigrid/Coarse solver": "aggregation"}, 10)

    def test_implicit_steps(self):
        # Flexible conjugate gradients have two sums, too. The other sums are
        # those of two iterations of Newton's method, with residuals before,
        # after the first and after the second iteration (2 sums),
        # linearizations (1), norms of increments and of right hand sides (4);
        # and those of the row.
        for ranks in (3, 8):
            few, first = self.count(ranks, {**IMPLICIT, "Time integration/End time": "0.1"})
            many, second = self.count(ranks, {**IMPLICIT, "Time integration/End time": "0.2"})
            steps = second["steps"] - first["steps"]
            gathers = max(b["gathers"] - a["gathers"] for a, b in zip(few, many))
            reductions = max(b["reductions"] - a["reductions"] for a, b in zip(few, many))
            # There are a gather and a scatter in each iteration, as above, and
            # one gather in each step.
            iterations = (gathers - steps) / 2
            others = (reductions - 2 * iterations) / steps
            print(f"{ranks} ranks, each step: {iterations / steps} iterations, {others} other reductions")
            self.assertGreater(iterations, 5 * steps)
            self.assertLessEqual(others, 19)
            self.assertEqual(max(b["exchanges"] - a["exchanges"] for a, b in zip(few, many)), 0)


if __name__ == "__main__":
    unittest.main()
