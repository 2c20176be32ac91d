#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Each ready case, shortened to two steps, and coarser where it is large: the files it leaves behind are complete.

- summary.json has all its keys, history.csv all its columns in their order, a row for the start and one for each step;
- VTK's own reader accepts the time series;
- parameters.prm, run again, gives the same history but for the wall time: it is the whole truth about the run, and a run on
  one rank is reproducible to the last digit;
- the file itself is short and begins with a comment.

Modes have frequencies in summary.json and columns in modes.csv instead of a
history.

To be given the case as argument: cases.py Cases.test_NAME
"""

import re
import unittest

from support import (CASES, COLUMNS, COLUMNS_AFTER_PROBES, MODES_COLUMNS, MODES_SUMMARY_KEYS, SUMMARY_KEYS, WALL_TIME_KEYS, ProgramTest,
                     read_history, read_modes, read_summary)

N_STEPS = 2
LOAD_STEPS = (f"Time integration/static/Load steps = {N_STEPS}",)
SHORTER = {
    "bar_step_load": ("Time integration/Time step = 8e-7", "Time integration/End time = 1.6e-6", "Output/Steps between rows = 1"),
    "bend_45": (*LOAD_STEPS, "Boundary conditions/Traction = tip: 0; 0; 200"),
    "bracket": (*LOAD_STEPS, "Mesh/gmsh/Element size = 0.01"),
    "clip": ("Time integration/End time = 1e-4",),
    "cantilever": ("Time integration/End time = 0.02",),
    "crushed_ring": ("Time integration/End time = 8e-3", "Discretization/Degree = 2"),
    "crushed_cube": ("Time integration/End time = 0.6",),
    "elastica": (*LOAD_STEPS, "Boundary conditions/Traction = x-max: 0; 0; -800"),
    "gravity_corotational": (*LOAD_STEPS, "Loads/Gravity = 0; 0; -1"),
    "gravity_linear": LOAD_STEPS,
    "gripper": ("Time integration/End time = 5e-3",),
    "gyroid": (*LOAD_STEPS, "Mesh/file/Element size = 2",),
    "lame_sphere": LOAD_STEPS,
    "machine_foundation": ("Time integration/End time = 0.02",),
    "plate_on_lines": ("Discretization/Degree = 2", "Modes/Number = 4"),
    "plate_modes": ("Mesh/box/Cells = 4, 4, 1", "Modes/Number = 6"),
    "ring": (*LOAD_STEPS, "Boundary conditions/Pressure = x-max: 1e6 * (z - 0.025)"),
    "shaken_mast": ("Time integration/End time = 0.02",),
    "rubber_block": ("Time integration/End time = 4e-4", "Mesh/box/Cells = 3, 3, 3"),
    "rubber_mount": (*LOAD_STEPS, "Mesh/file/Element size = 10"),
    "spinning_bar": ("Time integration/End time = 0.006283185307179586",),
    "spring": ("Time integration/End time = 0.012",),
    "stairs": ("Time integration/End time = 4e-3",),
    "thin_hoop": ("Time integration/End time = 4e-4", "Discretization/Degree = 2"),
    "trefoil": ("Time integration/End time = 0.02", "Discretization/Degree = 1"),
    "tuning_fork": ("Time integration/End time = 8e-5", "Output/Time between results = 0"),
    "tuning_fork_modes": ("Discretization/Degree = 1", "Modes/Number = 4"),
    "twisted_beam": (*LOAD_STEPS, "Time integration/End time = 0.1"),
    "two_materials": ("Time integration/End time = 0.01",),
}


class Cases(ProgramTest):

    def check_case(self, file):
        text = file.read_text(encoding="utf-8")
        self.assertTrue(text.startswith("# "), "the file must begin with a comment that says what it shows")
        self.assertLessEqual(text.count("\n"), 60)

        first = self.run_case(file.stem, "first", *SHORTER[file.stem])
        if "set Type = modes" in text:
            self.check_modes(first)
            return
        self.check_summary(read_summary(first), read_history(first))
        probes = re.findall(r"(\w+):", re.search(r"set Probes\s*=(.*)", text).group(1))
        section = re.search(r"subsection Contact\n(.*?)\n *set Motions|subsection Contact\n(.*?)\nend", text, re.DOTALL)
        obstacles = re.findall(r"(\w+): *(?:plane|box)", section[0]) if section else []
        self.check_columns(first, probes, obstacles)
        self.assertEqual([row["step"] for row in read_history(first)], [str(i) for i in range(N_STEPS + 1)])
        self.assertIn("Results are in", (first / "log.txt").read_text(encoding="utf-8"))
        self.check_vtkhdf(first)

        self.run_program(first / "parameters.prm", "--output", "second")
        rows = [read_history(self.folder / name) for name in ("first", "second")]
        for row in rows[0] + rows[1]:
            del row["wall_time"]
        self.assertEqual(*rows)

    def check_modes(self, first):
        summary, rows = read_summary(first), read_modes(first)
        self.assertEqual(list(summary), MODES_SUMMARY_KEYS)
        self.assertEqual((summary["status"], summary["modes"]), ("done", len(rows)))
        self.assertEqual(summary["frequencies"], [float(row["frequency"]) for row in rows])
        probes = list(rows[0])[len(MODES_COLUMNS):]
        self.assertEqual(list(rows[0])[:len(MODES_COLUMNS)], MODES_COLUMNS)
        self.assertGreater(len(probes), 0)
        self.check_vtkhdf(first)
        self.assertFalse((first / "history.csv").exists())
        self.run_program(first / "parameters.prm", "--output", "second")
        self.assertEqual(read_modes(self.folder / "second"), rows)

    def check_columns(self, directory, probes, obstacles):
        header = (directory / "history.csv").read_text(encoding="utf-8").splitlines()[0].split(",")
        self.assertGreater(len(probes), 0)
        self.assertEqual(header, COLUMNS + [f"{name}_{c}" for name in probes for c in "xyz"] + COLUMNS_AFTER_PROBES +
                         (["contact_energy", "friction_work"] if obstacles else []) + [f"{name}_contact_{c}" for name in obstacles for c in "xyz"])

    def check_summary(self, summary, rows):
        self.assertEqual([key for key in summary if key not in ("error_estimate", "largest_rotation_difference")], SUMMARY_KEYS)
        self.assertEqual(list(summary["wall_time"]), WALL_TIME_KEYS)
        self.assertEqual(summary["status"], "done")
        self.assertEqual(summary["steps"], N_STEPS)
        self.assertEqual(summary["dofs"], 3 * summary["nodes"])
        self.assertEqual(list(summary["final"]), list(rows[-1]))
        self.assertEqual(list(summary["final"].values()), [float(value) for value in rows[-1].values()])


for case in CASES:
    setattr(Cases, f"test_{case.stem}", lambda self, file=case: self.check_case(file))

if __name__ == "__main__":
    unittest.main()
