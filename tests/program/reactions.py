#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Forces and moments of single supports (Output/Reactions)."""

import csv
import shutil
import unittest

from support import ProgramTest, parameter_text, read_history, read_summary

BEAM = {"Mesh/box/Size": "1, 0.2, 0.1", "Mesh/box/Cells": "4, 1, 1", "Material/Density": "1000", "Boundary conditions/Fixed": "x-min"}
STATIC = {**BEAM, "Time integration/Type": "static", "Loads/Gravity": "0; 0; -10"}
DYNAMIC = {**BEAM, "Time integration/End time": "0.05", "Time integration/Time step": "0.005", "Loads/Gravity": "0; 0; -10",
           "Damping/Mass coefficient": "0.5"}
CLAMP = {"Output/Reactions": "clamp: x-min"}


def vector(row, name):
    return [float(row[f"{name}_{c}"]) for c in "xyz"]


class Reactions(ProgramTest):

    def run_entries(self, entries, *arguments, **others):
        (self.folder / "beam.prm").write_text(parameter_text(entries), encoding="utf-8")
        return self.run_program("beam.prm", "--output", "out", *(() if "--restart" in arguments else ("--set", "Output/Overwrite = true")), *arguments,
                                **others)

    def last_row(self):
        return read_history(self.folder / "out")[-1]

    def assert_close(self, found, expected, tolerance):
        for a, b in zip(found, expected):
            self.assertAlmostEqual(a, b, delta=tolerance)

    def test_equilibrium(self):
        """In linear elasticity at rest forces and moments of loads and supports
        cancel for any mesh, to the solver's 1e-8."""
        # The weight is 200 N in the middle, and 100 N act along y on the end
        # face of 0.02 m^2.
        loads = {"Material/Type": "linear", "Boundary conditions/Traction": "x-max: 0; 5000; 0", "Newton/Residual tolerance": "1e-12"}
        for degree in (1, 2, 3):
            for ranks in (1, 2):
                with self.subTest(degree=degree, ranks=ranks):
                    self.run_entries({**STATIC, **loads, **CLAMP, "Discretization/Degree": degree}, ranks=ranks)
                    row = self.last_row()
                    self.assert_close(vector(row, "clamp_reaction"), (0, -100, 200), 1e-5)
                    # The moments of loads are (0.5, 0.1, 0.05) x (0, 0, -200)
                    # and (1, 0.1, 0.05) x (0, 100, 0).
                    self.assert_close(vector(row, "clamp_reaction_moment"), (20 + 5, -100, -100), 1e-5)

    def test_several(self):
        """A body held at two ends: their reactions sum to the total reaction,
        and an edge of an end has less than the end."""
        entries = {**STATIC, "Boundary conditions/Fixed": "x-min, x-max", "Output/Probes": "tip: 0.5 0.1 0.05",
                   "Output/Reactions": "left: x-min, right: x-max, edge: x-min & z-min, corner: x-min & z-min & y-min"}
        self.run_entries(entries)
        row = self.last_row()
        left, right, edge, corner = (vector(row, f"{name}_reaction")[2] for name in ("left", "right", "edge", "corner"))
        self.assertAlmostEqual(left + right, 200, delta=1e-4)
        self.assertAlmostEqual(left + right, vector(row, "reaction")[2], delta=1e-9)
        # The mesh is not symmetric, so both ends differ a little.
        self.assertAlmostEqual(left, 100, delta=1)
        self.assertLess(abs(corner), abs(edge))
        self.assertLess(abs(edge), 200)
        with open(self.folder / "out" / "history.csv", newline="", encoding="utf-8") as file:
            names = next(csv.reader(file))
        self.assertEqual(names[-24:], [f"{name}_{what}_{c}" for name in ("left", "right", "edge", "corner") for what in ("reaction", "reaction_moment")
                                       for c in "xyz"])
        self.assertEqual(len(set(names)), len(names))
        self.assertEqual(read_summary(self.folder / "out")["final"]["left_reaction_z"], left)

    def test_motion(self):
        """All supports together have the total reaction, in every row, with
        inertia and damping; a rank without a node of a support adds nothing."""
        for method in ("generalized-alpha", "implicit midpoint", "Newmark", "central difference"):
            entries = {**DYNAMIC, **CLAMP, "Time integration/Type": method,
                       "Boundary conditions/Displacement": "x-max: free; free; 0.02*t^2"}
            entries["Output/Reactions"] += ", end: x-max"
            if method == "central difference":
                entries |= {"Time integration/Time step": "0", "Output/Steps between rows": "20", "Discretization/Mass": "diagonal scaling"}
            found = []
            for ranks in (1, 2):
                with self.subTest(method=method, ranks=ranks):
                    self.run_entries(entries, ranks=ranks)
                    rows = read_history(self.folder / "out")
                    self.assertGreater(len(rows), 3)
                    for row in rows:
                        both = [a + b for a, b in zip(vector(row, "clamp_reaction"), vector(row, "end_reaction"))]
                        # The sums have another order.
                        self.assert_close(both, vector(row, "reaction"), 1e-9 * max(map(abs, both)))
                    found.append([vector(rows[-1], f"{name}_reaction{what}") for name in ("clamp", "end") for what in ("", "_moment")])
            for one, two in zip(*found):
                self.assert_close(one, two, 1e-5 * max(map(abs, one)))

    def test_springs(self):
        """A beam that is clamped at one end rests on springs at the other: forces and moments of both carry the weight of 200 N, and the springs have
        stiffness times area times their displacement. Springs on a place where the displacement is given count with it."""
        springs = {"Material/Type": "linear", "Supports/Elastic": "x-max: 0; 0; 1e5", "Newton/Residual tolerance": "1e-12",
                   "Output/Reactions": "clamp: x-min, rest: x-max"}
        for ranks in (1, 2):
            self.run_entries({**STATIC, **springs}, ranks=ranks)
            row = self.last_row()
            both = [a + b for a, b in zip(vector(row, "clamp_reaction"), vector(row, "rest_reaction"))]
            self.assert_close(both, (0, 0, 200), 1e-5)
            self.assertGreater(vector(row, "rest_reaction")[2], 10)
            moments = [a + b for a, b in zip(vector(row, "clamp_reaction_moment"), vector(row, "rest_reaction_moment"))]
            # Springs act where the points have moved to, which linear elasticity leaves out.
            self.assert_close(moments, (20, -100, 0), 1e-2)
            self.assert_close(vector(row, "reaction"), vector(row, "clamp_reaction"), 1e-12)
        held = {**STATIC, **springs, "Boundary conditions/Displacement": "x-max: 0; 0; 1e-3"}
        self.run_entries(held)
        row = self.last_row()
        # The springs pull by 1e5 N/m^3 x 0.02 m^2 x 1e-3 m.
        self.assertAlmostEqual(vector(row, "reaction")[2] - vector(row, "clamp_reaction")[2] - vector(row, "rest_reaction")[2], 2, delta=1e-6)

    def test_dashpots(self):
        """A body that slides freely is stopped by dashpots alone: their impulse is its momentum. The sum over the steps is that of the middle of steps, or
        for central differences the trapezoidal rule, with which their momentum changes."""
        sliding = {**BEAM, "Boundary conditions/Fixed": "", "Initial conditions/Velocity": "1; 0; 0", "Supports/Dashpots": "x-min: 1e3; 0; 0",
                   "Time integration/Type": "implicit midpoint", "Time integration/End time": "0.1", "Time integration/Time step": "0.005",
                   "Output/Reactions": "stop: x-min", "Newton/Residual tolerance": "1e-12"}
        explicit = {"Time integration/Type": "central difference", "Time integration/Time step": "0", "Discretization/Mass": "diagonal scaling"}
        for more in ({}, explicit, {**explicit, "Discretization/Mass": "consistent"}):
            with self.subTest(more=more):
                self.run_entries({**sliding, **more})
                rows = read_history(self.folder / "out")
                forces, steps = [vector(row, "stop_reaction")[0] for row in rows], [float(row["dt"]) for row in rows]
                impulse = sum(dt * (0.5 * (a + b) if more else b) for dt, a, b in zip(steps[1:], forces, forces[1:]))
                self.assertLess(impulse, -1)
                # Each step is solved to 1e-12 of its forces.
                self.assertAlmostEqual(impulse, vector(rows[-1], "momentum")[0] - vector(rows[0], "momentum")[0], delta=1e-8)

    def test_restart(self):
        """A restarted run has the same columns to the last digit, and a change
        of Output/Reactions is refused."""
        entries = {**DYNAMIC, **CLAMP, "Checkpoint/Steps between checkpoints": "4", "Checkpoint/Keep": "10"}
        self.run_entries(entries)
        names = [f"clamp_{what}_{c}" for what in ("reaction", "reaction_moment") for c in "xyz"]
        whole = [[row[name] for name in names] for row in read_history(self.folder / "out")]
        for path in (self.folder / "out" / "checkpoint").iterdir():
            if not path.name.startswith("step_") or "4" not in path.name:
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        self.run_entries(entries, "--restart")
        self.assertEqual([[row[name] for name in names] for row in read_history(self.folder / "out")], whole)
        run = self.run_entries({**entries, "Output/Reactions": ""}, "--restart", status=1)
        self.assertIn("Output/Reactions", run.stderr)

    def test_study(self):
        """Reactions are quantities of studies, too."""
        self.run_entries({**STATIC, **CLAMP, "Material/Type": "linear", "Type": "convergence study", "Convergence study/Degrees": "1, 2",
                          "Convergence study/Refinements": "0", "Convergence study/Reference": "none", "Convergence study/Pictures": "false",
                          "Convergence study/Quantities": "clamp_reaction_z: 200"})
        with open(self.folder / "out" / "study.csv", newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                self.assertAlmostEqual(float(row["clamp_reaction_z"]), 200, delta=1e-4)

    def test_wrong(self):
        for reactions, message in (
                ("x-min", "found 'x-min'; allowed: a list of NAME: PLACE, separated by commas, each place as in Boundary conditions/Fixed"),
                ("a: x-min, a: x-min", "two supports are called 'a'; each name must be used once"),
                ("1: x-min", "'1' cannot be a support's name; letters, digits and _ are allowed, no digit first"),
                ("a: x-max", "nothing is fixed or prescribed at 'x-max', and no springs or dashpots act there; allowed are places with one of these"),
                ("a: x-min & x-max", "boundaries have no node in common: found 'x-max & x-min'; allowed are those that meet in an edge or a corner")):
            with self.subTest(reactions):
                run = self.run_entries({**STATIC, "Output/Reactions": reactions}, "--validate", status=1)
                self.assertRegex(run.stderr, r"beam\.prm:\d+: Output/Reactions: ")
                self.assertIn(message, run.stderr.replace("x-min & x-max", "x-max & x-min"))
        run = self.run_entries({**STATIC, "Output/Reactions": "a: side"}, "--validate", status=1)
        self.assertIn("side", run.stderr)
        run = self.run_entries({**STATIC, "Output/Probes": "a_reaction: 1 0 0"}, "--validate", status=1)
        self.assertIn("'a_reaction' cannot be a probe's name; columns of supports end with _reaction", run.stderr)

    def test_modes(self):
        """Mode shapes have no size, and nothing acts: the log says that there
        are no reactions."""
        run = self.run_entries({**BEAM, **CLAMP, "Type": "modes"}, "--validate")
        self.assertIn('no effect on modes: "Output/Reactions"', run.stdout)


if __name__ == "__main__":
    unittest.main()
