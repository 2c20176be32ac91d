#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Restarts with changed tables and times, and in folders that links lead to. A refused restart changes no file; a run that failed at its
start, or that is repeated from its own parameters, finds its results and its files again.
"""

import hashlib
import os
import re
import shutil
import subprocess
import unittest

from support import ROOT, ProgramTest, limit_files, parameter_text, read_history, read_summary, run_on
from checkpoints import BEAM, rows_without_time

SHORT = {**BEAM, "Discretization/Degree": "1", "Mesh/box/Cells": "4, 1, 1", "Time integration/End time": "0.2", "Time integration/Time step": "0.02",
         "Checkpoint/Steps between checkpoints": "4"}


def contents(directory):
    """Fingerprints of all files below a directory, except the lock, which names the last process."""
    return {str(file.relative_to(directory)): hashlib.sha256(file.read_bytes()).hexdigest() for file in directory.rglob("*") if file.is_file() and file.name != ".corotet"}


class Restarts(ProgramTest):

    def run_entries(self, entries, *arguments, **others):
        (self.folder / "case.prm").write_text(parameter_text(entries), encoding="utf-8")
        return self.run_program("case.prm", *arguments, **others)

    def check_refused(self, before, run, message):
        self.assertRegex(run.stderr, f"^corotet: error: [^\n]*{message}[^\n]*\n$")
        self.assertEqual(contents(self.folder / "run"), before)

    def test_tables(self):
        """Rows of tables are loads: changed ones are refused, and rows added at the end make a longer run."""
        table = self.folder / "rise.csv"
        for kind, other in (("Linear", "Cubic"), ("Cubic", "Linear")):
            with self.subTest(kind=kind):
                shutil.rmtree(self.folder / "run", ignore_errors=True)
                entries = {**SHORT, "Loads/Gravity": "0; 0; -10 * rise(t)", f"Tables/{kind}": "rise: rise.csv", f"Tables/{other}": "hold: hold.csv"}
                (self.folder / "hold.csv").write_text("0, 1\n9, 1\n", encoding="utf-8")
                rows = "0, 0\n0.1, 1\n0.2, 0.5\n"
                table.write_text(rows, encoding="utf-8")
                self.run_entries(entries)
                before = contents(self.folder / "run")
                for others in (rows.replace("0.1, 1", "0.1, 2"), rows.replace("0.1,", "0.12,"), "0, 0\n0.2, 0.5\n", "0, 0\n0.05, 0.5\n0.1, 1\n0.2, 0.5\n"):
                    table.write_text(others, encoding="utf-8")
                    self.check_refused(before, self.run_entries(entries, "--restart", status=1),
                                       f"Tables/{kind}: --restart: found other rows or another interpolation in the table 'rise', which the run cannot "
                                       "go on with; allowed: the rows that it began with, and more behind them")
                table.write_text(rows, encoding="utf-8")
                swapped = {**entries, f"Tables/{kind}": "", f"Tables/{other}": "hold: hold.csv, rise: rise.csv"}
                self.check_refused(before, self.run_entries(swapped, "--restart", status=1),
                                   f"Tables/{other}: --restart: found other rows or another interpolation in the table 'rise'")
                table.write_text(rows + "0.3, 3\n", encoding="utf-8")
                longer = ("--restart", "--set", "Time integration/End time = 0.3")
                if kind == "Cubic":
                    # New rows change the last interval, whose slope depends on them.
                    self.check_refused(before, self.run_entries(entries, *longer, status=1),
                                       r"Tables/Cubic: --restart: found new rows in the table 'rise': they change it from 0\.1 on, and the run has come to "
                                       r"t = 0\.2; allowed: the rows that it began with")
                    continue
                self.run_entries(entries, *longer)
                self.assertAlmostEqual(float(read_history(self.folder / "run")[-1]["time"]), 0.3, delta=1e-12)

    def test_final_row_between_rows(self):
        """If a run stops between two rows, as with a limit on its time, the final entries of the summary are those of the last row."""
        entries = {**SHORT, "Output/Steps between rows": "4", "Output/Probes": "tip: 1 0.1 0.1", "Output/Stress probes": "middle: 0.5 0.05 0.05",
                   "Checkpoint/Wall time limit": "1e-9"}
        self.run_entries(entries, status=4)
        n_runs = 1
        while n_runs < 20:
            n_runs += 1
            run = self.run_entries(entries, "--restart", status=None)
            final, row = read_summary(self.folder / "run")["final"], read_history(self.folder / "run")[-1]
            for name in ("step", "tip_x", "tip_z", "max_displacement", "middle_von_mises"):
                self.assertEqual(final[name], float(row[name]), name)
            if run.returncode == 0:
                break
        self.assertEqual(run.returncode, 0)
        # There are ten steps and three rows, so some runs stopped between two.
        self.assertGreater(n_runs, 4)

    def test_rows_behind_a_table(self):
        """Rows may be added to a table as long as the past of the run does not change: the restarted run equals one that had them from
        its start."""
        table = self.folder / "rise.csv"
        few, more = "0, 0\n0.125, 1\n0.1875, 2\n0.25, 1\n", "0.375, 3\n0.5, 2\n"
        force, support = ("Loads/Gravity", "0; 0; -10 * rise({})"), ("Boundary conditions/Displacement", "x-max: 0; 0; 1e-2 * rise({})")
        for (entry, formula), argument, kind, reached, from_here in (
                (force, "t", "Linear", 0.25, None), (force, "t", "Linear", 0.265625, "0.25"), (force, " t ", "Cubic", 0.1875, None),
                (force, "t", "Cubic", 0.25, "0.1875"), (support, "t", "Linear", 0.1875, None), (support, "t", "Linear", 0.25, "0.25"),
                (force, "2 * t", "Linear", 0.125, "something else than t")):
            with self.subTest(entry=entry, argument=argument, kind=kind, reached=reached):
                shutil.rmtree(self.folder / "run", ignore_errors=True)
                entries = {**SHORT, entry: formula.format(argument), f"Tables/{kind}": "rise: rise.csv", "Time integration/Time step": "0.015625"}
                table.write_text(few, encoding="utf-8")
                self.run_entries(entries, "--set", f"Time integration/End time = {reached}")
                before = contents(self.folder / "run")
                table.write_text(few + more, encoding="utf-8")
                longer = ("--set", "Time integration/End time = 0.5")
                if from_here:
                    expected = from_here if "t" in from_here else f"they change it from {from_here} on"
                    self.check_refused(before, self.run_entries(entries, "--restart", *longer, status=1), f"new rows in the table 'rise': .*{expected}")
                    continue
                self.run_entries(entries, "--restart", *longer)
                rows = rows_without_time(self.folder / "run")
                shutil.rmtree(self.folder / "run")
                self.run_entries(entries, *longer)
                self.assertEqual(rows, rows_without_time(self.folder / "run"))

    def test_after_single_precision_has_failed(self):
        """Factors of a slender beam are in single precision for short steps, whose mass makes matrices definite, and in double precision
        from the first long step on: a restarted run keeps that, and has the same history to the last digit."""
        entries = {**SHORT, "Discretization/Degree": "2", "Mesh/box/Size": "40, 0.1, 0.1", "Mesh/box/Cells": "60, 1, 1",
                   "Material/Young's modulus": "1e9", "Material/Density": "1000", "Boundary conditions/Fixed": "x-min",
                   "Boundary conditions/Traction": "x-max: 0; 0; 2*t + if(t < 200, 0, 10000*sin(20*(t - 200)))", "Loads/Gravity": "0; 0; 0",
                   "Time integration/Type": "Newmark", "Time integration/Time step": "50", "Time integration/End time": "200.1",
                   "Time integration/Adaptive step/Enabled": "true", "Time integration/Adaptive step/Target error": "1e-2",
                   "Linear solver/Type": "p-multigrid", "Linear solver/p-multigrid/Vertex rotations": "false",
                   "Checkpoint/Steps between checkpoints": "1", "Checkpoint/Keep": "1000"}
        self.run_entries(entries)
        run, kept = self.folder / "run", 12
        whole = rows_without_time(run)
        self.assertGreater(len(whole), kept + 4)
        for path in (run / "checkpoint").iterdir():
            number = re.match(r"step_0*(\d+)", path.name)
            if number and int(number[1]) > kept:
                shutil.rmtree(path) if path.is_dir() else path.unlink()
        self.run_entries(entries, "--restart")
        self.assertEqual(rows_without_time(run), whole)

    def test_other_limits_of_adaptive_steps(self):
        """Steps have grown a lot until the restart; then they are limited by the new largest step."""
        entries = {**SHORT, "Boundary conditions/Fixed": "x-min", "Loads/Gravity": "0; 0; -0.01", "Damping/Mass coefficient": "40",
                   "Time integration/Type": "Newmark", "Time integration/End time": "20", "Time integration/Adaptive step/Enabled": "true"}
        self.run_entries(entries)
        last = float(read_history(self.folder / "run")[-2]["dt"])
        limit = 0.9 * last
        self.run_entries(entries, "--restart", "--set", "Time integration/End time = 24",
                         "--set", f"Time integration/Adaptive step/Largest step = {limit!r}")
        later = [float(row["dt"]) for row in read_history(self.folder / "run") if float(row["time"]) > 20 + 1e-9]
        self.assertGreater(len(later), 4 / limit - 1)
        self.assertLessEqual(max(later), limit * (1 + 1e-12))

    def test_explicit_run_of_a_deformed_body_with_another_step(self):
        """A bar has been crushed to less than half of its length: its stable step, far below that at rest, limits the new step."""
        entries = {**SHORT, "Mesh/box/Size": "1, 0.4, 0.4", "Discretization/Mass": "row sum", "Material/Type": "neo-Hookean", "Material/Young's modulus": "1e6",
                   "Boundary conditions/Fixed": "x-min", "Boundary conditions/Displacement": "x-max: -0.6 * smooth_step(t, 0, 0.5); 0; 0",
                   "Damping/Mass coefficient": "5", "Time integration/Type": "central difference", "Time integration/End time": "0.55",
                   "Time integration/Time step": "5e-4", "Loads/Gravity": "0; 0; 0", "Checkpoint/Steps between checkpoints": "500"}
        self.run_entries(entries)
        longer = ("--restart", "--set", "Time integration/End time = 0.57")
        before = contents(self.folder / "run")
        run = self.run_entries(entries, *longer, "--set", "Time integration/Time step = 3e-3", status=1)
        self.check_refused(before, run, "Time integration/Time step: found a step of 0\\.0028[^ ]* s at t = 0.55, which is unstable; allowed: up to the stable "
                           "step, 0.00[^ ]* s now that the body has deformed")
        self.run_entries(entries, *longer, "--set", "Time integration/Time step = 0")
        for row in read_history(self.folder / "run"):
            self.assertGreaterEqual(float(row["kinetic_energy"]), 0)

    def test_finished_run_with_another_step(self):
        """Nothing is left to do, so another step has no effect."""
        self.run_entries(SHORT)
        rows = rows_without_time(self.folder / "run")
        for step in ("0.03", "0.5", "1e-3"):
            self.run_entries(SHORT, "--restart", "--set", f"Time integration/Time step = {step}")
            self.assertEqual(rows_without_time(self.folder / "run"), rows)

    def test_other_spelling(self):
        """Blanks around items of lists and the spelling of numbers may change, with a checkpoint and without; formulas may not."""
        entries = {**SHORT, "Mesh/box/Size": "1, 0.1, 0.1", "Material/Density": "body: 1000", "Boundary conditions/Fixed": "x-min & z-min, x-min",
                   "Boundary conditions/Displacement": "x-max & z-max: free; 0.1*t; 0"}
        others = {"Mesh/box/Cells": "4,1,1", "Mesh/box/Size": "1.0,1e-1 , 0.10", "Material/Density": "body:1e3", "Loads/Gravity": "0;0.0;-1e1",
                  "Boundary conditions/Fixed": "x-min&z-min,x-min", "Boundary conditions/Displacement": "x-max&z-max:free;0.1*t;0.0",
                  "Output/Probes": "tip:1.0  5e-2 0.05"}
        others = [word for entry, value in others.items() for word in ("--set", f"{entry} = {value}")]
        self.run_entries(entries)
        before = contents(self.folder / "run")
        for change, found in (("Loads/Gravity", "0; 0; -5*2"), ("Loads/Gravity", "0; 0; -10.1"), ("Mesh/box/Cells", "4, 1, 2"),
                              ("Boundary conditions/Displacement", "x-max & z-max: free; 0.1 * t; 0"), ("Output/Probes", "tip: 1 0.05 0.05, mid: 0.5 0.05 0.05"), ("Output/Probes", "tip: 1 0.05 0.06")):
            self.check_refused(before, self.run_entries(entries, "--restart", *others, "--set", f"{change} = {found}", status=1),
                               f"--set: {change}: --restart: found '{re.escape(found)}', which the run cannot go on with")
        run = self.run_entries(entries, "--restart", *others, "--set", "Time integration/End time = 0.3")
        self.assertNotIn("begins anew", run.stdout)
        self.assertEqual(float(read_history(self.folder / "run")[0]["time"]), 0)
        self.assertAlmostEqual(float(read_history(self.folder / "run")[-1]["time"]), 0.3, delta=1e-12)
        self.run_killed(entries, "--set", "Output/Overwrite = true")
        shutil.rmtree(self.folder / "run" / "checkpoint", ignore_errors=True)
        self.assertIn("the run begins anew", self.run_entries(entries, "--restart", *others).stdout)

    def test_states_that_are_gone(self):
        """A time series whose earlier states are missing or cut off would show zeros there, so it is not continued."""
        entries = {**SHORT, "Output/Stress": "both"}
        self.run_entries(entries)
        run = self.folder / "run"
        for series in ("solution", "stress_points"):
            for change, found in (("gone", "No such file or directory"), ("cut off", "100 bytes"), ("all gone", "No such file or directory")):
                with self.subTest(series=series, change=change):
                    file = run / series / ("step_000000.h5" if change == "all gone" else "step_000002.h5")
                    kept = {path: path.read_bytes() for path in run.glob(f"{series}/step_*.h5")}
                    for path in kept if change == "all gone" else (file,):
                        if change == "cut off":
                            path.write_bytes(kept[path][:100])
                        else:
                            path.unlink()
                    before = contents(run)
                    self.check_refused(before, self.run_entries(entries, "--restart", "--set", "Time integration/End time = 0.3", status=3),
                                       f"{series}/{file.name}: the time series cannot be continued: found {found}, needed are its \\d+ bytes")
                    for path, content in kept.items():
                        path.write_bytes(content)
        self.run_entries(entries, "--restart", "--set", "Time integration/End time = 0.3")

    def test_results_of_later_steps_go(self):
        """A restart from an earlier checkpoint removes results of later steps, and blocks that refer to them."""
        entries = {**SHORT, "Time integration/Time step": "0.004", "Checkpoint/Steps between checkpoints": "10", "Checkpoint/Keep": "20"}
        self.run_entries(entries, "--set", "Time integration/End time = 0.28")
        run = self.folder / "run"
        self.assertTrue((run / "solution" / "block_000032.h5").exists())
        for file in (run / "checkpoint").iterdir():
            if not file.name.startswith("step_000010."):
                file.unlink()
        (run / "solution" / "block_000032.h5.tmp").write_bytes(b"of a run that was killed")
        self.run_entries(entries, "--restart", "--set", "Time integration/End time = 0.08")
        self.assertEqual(sorted(file.name for file in (run / "solution").iterdir()),
                         ["mesh.h5", *(f"step_{step:06}.h5" for step in range(21))])

    def test_refusals_change_no_file(self):
        """Refusals that are found after the checkpoint has been read change no file either."""
        self.run_entries(SHORT)
        before = contents(self.folder / "run")
        for more in ((), ("--validate",)):
            self.check_refused(before, self.run_entries(SHORT, "--restart", "--set", "Time integration/End time = 0.1", *more, status=1),
                               "Time integration/End time: --restart: found 0.1")
            self.check_refused(before, self.run_entries(SHORT, "--restart", "--set", "Discretization/Degree = 2", *more, status=1),
                               "Discretization/Degree: --restart: found '2'")
        run = self.run_entries(SHORT, "--restart", "--set", "Time integration/End time = 0.3", "--validate")
        self.assertTrue(run.stdout.endswith("case.prm: valid\n"), run.stdout)
        self.assertEqual(contents(self.folder / "run"), before)

    def run_killed(self, entries, *arguments):
        """Leaves the files of a run that was killed before its first checkpoint. Returns their fingerprints."""
        self.run_entries({**entries, "Checkpoint/Steps between checkpoints": "0"}, *arguments)
        (self.folder / "run" / "summary.json").unlink()
        return contents(self.folder / "run")

    def test_another_run_without_checkpoint(self):
        """Without a checkpoint, results of the same run are replaced by its restart, but those of another run are not."""
        before = self.run_killed(SHORT)
        for entry, old, new in (("Material/Density", "1000", "900"), ("Mesh/box/Cells", "4, 1, 1", "5, 1, 1"), ("Discretization/Degree", "1", "2"),
                                ("Output/Probes", "tip: 1 0.05 0.05", "end: 1 0.05 0.05")):
            for more in ((), ("--quiet",), ("--validate",)):
                self.check_refused(before, self.run_entries(SHORT, "--restart", "--set", f"{entry} = {new}", *more, status=1),
                                   f"--set: {entry}: --restart: found '{new}', but in 'run' are results of another run, with '{old}'; "
                                   "allowed: another directory, or Output/Overwrite = true to begin anew")
        run = self.run_entries(SHORT, "--restart", "--set", "Time integration/End time = 0.1", "--set", "Newton/Maximum iterations = 30", "--set", "Material/Density = 1e3")
        self.assertIn("there is no checkpoint in run; the run begins anew", run.stdout)
        self.assertAlmostEqual(float(read_history(self.folder / "run")[-1]["time"]), 0.1, delta=1e-12)
        self.run_killed(SHORT, "--set", "Output/Overwrite = true")
        self.run_entries(SHORT, "--restart", "--set", "Material/Density = 900", "--set", "Output/Overwrite = true")
        # parameters.prm may have been written by another program, or damaged by a loss of power.
        before = self.run_killed(SHORT, "--set", "Output/Overwrite = true")
        parameters = self.folder / "run" / "parameters.prm"
        text = parameters.read_text(encoding="utf-8")
        parameters.write_text(text + "set Colour = red\n", encoding="utf-8")
        before = contents(self.folder / "run")
        self.check_refused(before, self.run_entries(SHORT, "--restart", status=1), "Output/Directory: --restart: found results in 'run' whose parameters this program "
                           "cannot read .*there is no entry \"Colour\".*; allowed: another directory, or Output/Overwrite = true to begin anew")
        parameters.write_text("", encoding="utf-8")
        self.run_entries(SHORT, "--restart")

    def test_another_file_without_checkpoint(self):
        """The name of a file counts, not its folder; blanks do not."""
        shutil.copy(ROOT / "meshes" / "l_block.msh", self.folder)
        shutil.copy(ROOT / "meshes" / "l_block.msh", self.folder / "other.msh")
        for name in ("rise.csv", "other.csv"):
            (self.folder / name).write_text("0, 0\n1, 1\n", encoding="utf-8")
        entries = {"Mesh/Type": "file", "Mesh/file/File": "l_block.msh", "Tables/Linear": "rise:   rise.csv", "Loads/Gravity": "0; 0; -rise(t)",
                   "Discretization/Degree": "1", "Time integration/End time": "0.1", "Time integration/Time step": "0.05", "Output/Directory": "run",
                   "Checkpoint/Minutes between checkpoints": "0"}
        before = self.run_killed(entries)
        for entry, value in (("Mesh/file/File", "other.msh"), ("Tables/Linear", "rise: other.csv")):
            self.check_refused(before, self.run_entries(entries, "--restart", "--set", f"{entry} = {value}", status=1),
                               f"{entry}: --restart: found '{value}', but in 'run' are results of another run, with '.*'; allowed: ")
        (self.folder / "moved").mkdir()
        for name in ("l_block.msh", "rise.csv"):
            (self.folder / name).rename(self.folder / "moved" / name)
        self.run_entries(entries, "--restart", "--set", "Mesh/file/File = moved/l_block.msh", "--set", "Tables/Linear = rise: moved/rise.csv")

    def test_output_behind_a_link(self):
        """".." behind a link leads to the folder above the link's target, and the files there are protected."""
        (self.folder / "other" / "place").mkdir(parents=True)
        (self.folder / "link").symlink_to("other/place")
        for there in ("results", "letters"):
            (self.folder / "other" / there).mkdir()
        self.run_entries(SHORT, "--output", "other/results")
        (self.folder / "other" / "letters" / "history.csv").write_text("mine", encoding="utf-8")
        before = contents(self.folder / "other")
        for there in ("results", "letters"):
            self.assertIn("Output/Directory", self.run_entries(SHORT, "--output", f"link/../{there}", status=1).stderr)
            self.assertEqual(contents(self.folder / "other"), before)
        self.assertIn("holds no results of corotet", self.run_entries(SHORT, "--output", "link/../letters", "--set", "Output/Overwrite = true", status=1).stderr)
        self.assertEqual(contents(self.folder / "other"), before)
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), ["case.prm", "link", "other"])

    def test_full_disk_at_the_start(self):
        """The folder is recognised as one of results, though its files could not be written."""
        self.run_entries(SHORT)
        rows = rows_without_time(self.folder / "run")
        # Messages go to pipes, which the limit of file sizes does not affect.
        run = subprocess.run([os.environ["COROTET_PROGRAM"], "case.prm", "--restart"], cwd=self.folder, capture_output=True, text=True, check=False,
                             preexec_fn=lambda: limit_files(0))
        self.assertEqual(run.returncode, 3, run.stderr)
        self.run_entries(SHORT, "--restart", "--set", "Time integration/End time = 0.3")
        self.assertEqual(rows_without_time(self.folder / "run")[:len(rows)], rows)

    def test_parameters_repeat_the_run(self):
        """Names of files in parameters.prm are relative to its folder, also if a link leads there."""
        (self.folder / "far" / "away" / "place").mkdir(parents=True)
        (self.folder / "link").symlink_to("far/away/place")
        shutil.copy(ROOT / "meshes" / "l_block.msh", self.folder)
        (self.folder / "rise.csv").write_text("0, 0\n1, 1\n", encoding="utf-8")
        entries = {"Mesh/Type": "file", "Mesh/file/File": "l_block.msh", "Tables/Linear": "rise: rise.csv", "Loads/Gravity": "0; 0; -rise(t)",
                   "Discretization/Degree": "1", "Time integration/End time": "0.1", "Time integration/Time step": "0.05"}
        self.run_entries(entries, "--output", "link/run")
        self.run_program("link/run/parameters.prm", "--output", "again")
        self.run_program(self.folder / "far" / "away" / "place" / "run" / "parameters.prm", "--output", "once_more")
        rows = rows_without_time(self.folder / "link" / "run")
        self.assertEqual(len(rows), 3)
        for again in ("again", "once_more"):
            self.assertEqual(rows_without_time(self.folder / again), rows)

    def test_folders_that_parameters_cannot_say(self):
        """Folders whose names parameters.prm cannot contain are refused before the run, unless the path from the results does not lead
        through them."""
        entries = {"Mesh/Type": "file", "Mesh/file/File": "l_block.msh", "Tables/Linear": "rise: rise.csv", "Loads/Gravity": "0; 0; -rise(t)",
                   "Discretization/Degree": "1", "Time integration/End time": "0.1", "Time integration/Time step": "0.05"}
        for folder, entry in (("m#1", "Mesh/file/File"), ("a, b", "Tables/Linear"), ("a: b", "Tables/Linear"), ("a\tb", "Mesh/file/File"), ("a; b", None)):
            with self.subTest(folder=folder):
                place = self.folder / folder
                place.mkdir()
                shutil.copy(ROOT / "meshes" / "l_block.msh", place)
                (place / "rise.csv").write_text("0, 0\n1, 1\n", encoding="utf-8")
                (place / "case.prm").write_text(parameter_text(entries), encoding="utf-8")
                for more in ((), ("--validate",)) if entry else ():
                    errors = self.run_program(f"{folder}/case.prm", "--output", "out", *more, status=1).stderr
                    self.assertIn(f"{entry}: found '", errors)
                    self.assertIn("parameters.prm", errors)
                    self.assertFalse((self.folder / "out").exists())
                for case, output in (("case.prm", "out"), ("out/parameters.prm", "again")):
                    run = run_on(1, [case, "--output", output], place)
                    self.assertEqual((run.returncode, run.stderr), (0, ""))
                self.assertEqual(rows_without_time(place / "again"), rows_without_time(place / "out"))


if __name__ == "__main__":
    unittest.main()
