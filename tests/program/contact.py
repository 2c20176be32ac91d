#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Contact with obstacles that move, and friction: restarts at each step repeat the run to the last digit, several ranks give the same
motion, and what the user may get wrong in the columns of contact is refused."""

import shutil
import unittest

from support import ProgramTest, parameter_text, read_history, read_summary, run_on
from checkpoints import rows_without_time

# A soft block falls on a belt that takes it along, against a wall.
CASE = {"Mesh/Type": "box", "Mesh/box/Size": "0.4, 0.2, 0.2", "Mesh/box/Cells": "4, 2, 2", "Discretization/Degree": "2",
        "Material/Young's modulus": "1e5", "Material/Poisson's ratio": "0.3", "Loads/Gravity": "0; 0; -9.81",
        "Contact/Obstacles": "belt: plane 0 0 -0.002 0 0 1, wall: box 0.41 -1 -1 1 1 1, ball: not sphere 0.2 0.1 0.1 0.5",
        "Contact/Motions": "belt: 0.5 * t; 0; 0.01 * sin(50 * t)", "Contact/Friction": "belt: 0.4, wall: 0.2", "Contact/Slip velocity": "0.01",
        "Time integration/End time": "0.125", "Time integration/Time step": "0.00390625", "Checkpoint/Steps between checkpoints": "1",
        "Checkpoint/Keep": "40", "Output/Probes": "tip: 0.4 0.1 0.1", "Output/Time between results": "0"}
EXPLICIT = {"Time integration/Type": "central difference", "Time integration/Time step": "0.000244140625", "Output/Steps between rows": "20",
            "Checkpoint/Steps between checkpoints": "60"}
FROZEN = {"Newton/Tangent": "frozen rotation", "Material/Type": "linear"}


class Contact(ProgramTest):

    def run_entries(self, entries, *arguments, **others):
        (self.folder / "case.prm").write_text(parameter_text(entries), encoding="utf-8")
        return self.run_program("case.prm", *arguments, **others)

    def test_restarts(self):
        """From each checkpoint that is left, the run goes on as if it had not been stopped."""
        for more in ({}, EXPLICIT, FROZEN):
            with self.subTest(more=more):
                shutil.rmtree(self.folder / "run", ignore_errors=True)
                shutil.rmtree(self.folder / "whole", ignore_errors=True)
                self.run_entries({**CASE, **more}, "--output", "whole")
                whole = rows_without_time(self.folder / "whole")
                self.assertLess(float(whole[-1]["friction_work"]), 0)
                self.assertGreater(max(float(row["contact_energy"]) for row in whole), 0)
                self.assertLess(min(float(row["wall_contact_x"]) for row in whole), 0)
                for end in ("0.03125", "0.0625", "0.09375"):
                    self.run_entries({**CASE, **more}, "--output", "run", "--set", f"Time integration/End time = {end}",
                                     *(["--restart"] if (self.folder / "run").exists() else []))
                self.run_entries({**CASE, **more}, "--output", "run", "--restart")
                self.assertEqual(rows_without_time(self.folder / "run")[-1] if more is EXPLICIT else rows_without_time(self.folder / "run"),
                                 whole[-1] if more is EXPLICIT else whole)
                self.assertEqual(read_summary(self.folder / "run")["status"], "done")

    def test_ranks(self):
        """Iterative solvers end within their tolerance, explicit steps within round-off, which contact that opens and closes makes larger."""
        strict = {"Linear solver/Tolerance": "1e-11", "Newton/Residual tolerance": "1e-10", "Newton/Increment tolerance": "1e-10"}
        for more, delta in (({**strict}, 1e-7), (EXPLICIT, 1e-9)):
            histories = {}
            for ranks in (1, 2, 3):
                (self.folder / "case.prm").write_text(parameter_text({**CASE, **more, "Time integration/End time": "0.06"}), encoding="utf-8")
                run = run_on(ranks, ["case.prm", "--output", self.folder / f"on_{ranks}", "--quiet"], self.folder, 120)
                self.assertEqual(run.returncode, 0, run.stderr)
                histories[ranks] = read_history(self.folder / f"on_{ranks}")
                shutil.rmtree(self.folder / f"on_{ranks}")
            for ranks in (2, 3):
                self.assertEqual(len(histories[ranks]), len(histories[1]))
                for name in ("tip_x", "tip_z", "contact_energy", "friction_work", "belt_contact_x", "belt_contact_z", "wall_contact_x"):
                    size = max(abs(float(row[name])) for row in histories[1])
                    for row, other in zip(histories[1], histories[ranks]):
                        self.assertAlmostEqual(float(row[name]), float(other[name]), delta=delta * size, msg=f"{name} {ranks} {row['time']}")

    def test_columns(self):
        """Names of obstacles make columns, which no probe may have; statics has no friction, and its log says so."""
        run = self.run_entries({**CASE, "Output/Probes": "belt_contact: 0.4 0.1 0.1"}, status=1)
        self.assertRegex(run.stderr, "'belt_contact' cannot be a probe's name; columns of obstacles end with _contact")
        alone = {**CASE, "Contact/Obstacles": "", "Contact/Motions": "", "Contact/Friction": "", "Contact/Boundaries": "x-min",
                 "Time integration/End time": "0.00390625"}
        self.run_entries(alone, "--output", "alone")
        log = (self.folder / "alone" / "log.txt").read_text(encoding="utf-8")
        for entry, choice in (("Boundaries", "Obstacles"), ("Slip velocity", "Friction")):
            self.assertIn(f"no effect, as \"Contact/{choice}\" is '': Contact/{entry}\n", log)
        pressed = {**CASE, "Time integration/Type": "static", "Boundary conditions/Fixed": "x-min", "Contact/Motions": "wall: -0.02 * t / 0.125; 0; 0"}
        self.run_entries(pressed, "--output", "pressed")
        last = read_history(self.folder / "pressed")[-1]
        self.assertLess(float(last["wall_contact_x"]), 0)
        self.assertAlmostEqual(float(last["reaction_x"]) + sum(float(last[f"{name}_contact_x"]) for name in ("belt", "wall", "ball")), 0,
                               delta=1e-6 * float(last["reaction_x"]))
        self.assertEqual(float(last["friction_work"]), 0)
        self.assertRegex((self.folder / "pressed" / "log.txt").read_text(encoding="utf-8"), "Contact/Friction of obstacle 'belt'")


if __name__ == "__main__":
    unittest.main()
