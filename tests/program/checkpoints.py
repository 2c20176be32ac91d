#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Runs that are killed, stopped or damaged, and then restarted: nothing is lost, and nothing is counted twice.

A run that is killed at a random moment and goes on by --restart, perhaps several times, must give the history of the undisturbed
run, to the last digit on the same number of ranks (but for wall times), and the same time series. On another number of ranks
sums have another order and linear solvers leave other errors: the tolerances of ranks.py.

campaigns/restarts.py does more of the same, at random.
"""

import collections
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import time
import unittest

from support import ProgramTest, has_pt_scotch, launcher, parameter_text, read_history, read_summary, run_on

BEAM = {"Mesh/Type": "box", "Mesh/box/Size": "1, 0.1, 0.1", "Mesh/box/Cells": "8, 1, 1", "Discretization/Degree": "2",
        "Material/Young's modulus": "1e6", "Material/Poisson's ratio": "0.3", "Material/Density": "1000", "Boundary conditions/Fixed": "x-min",
        "Loads/Gravity": "0; 0; -10", "Output/Probes": "tip: 1 0.05 0.05", "Output/Directory": "run", "Checkpoint/Minutes between checkpoints": "0"}
IMPLICIT = {**BEAM, "Time integration/End time": "1", "Time integration/Time step": "0.02", "Checkpoint/Steps between checkpoints": "4"}
MOVING = {"Boundary conditions/Displacement": "x-min: 0; 0; 0.05 * sin(9 * t)", "Boundary conditions/Fixed": ""}
# The special properties of each kind of run: methods with a memory, steps of their own choice, loads and supports that move, damping,
# springs, states between the recorded ones, preconditioners that are kept for long.
KINDS = {
    "generalized-alpha": {**IMPLICIT, "Damping/Mass coefficient": "0.3", "Damping/Stiffness coefficient": "1e-3"},
    "BDF2": {**IMPLICIT, **MOVING, "Time integration/Type": "BDF2"},
    "midpoint": {**IMPLICIT, "Time integration/Type": "implicit midpoint", "Supports/Elastic": "x-max: 0; 0; 2e3",
                 "Supports/Dashpots": "x-max: 0; 0; 20", "Linear solver/Type": "direct"},
    "backward Euler": {**IMPLICIT, "Time integration/Type": "backward Euler", "Material/Type": "neo-Hookean", "Discretization/Degree": "1",
                       "Output/Steps between rows": "3"},
    "adaptive": {**IMPLICIT, "Time integration/Adaptive step/Enabled": "true", "Time integration/Adaptive step/Target error": "1e-3"},
    "Rayleigh, P3": {**IMPLICIT, "Discretization/Degree": "3", "Time integration/Time step": "0.04", "Output/Stress": "both",
                     "Output/Time between results": "0.1"},
    "explicit": {**BEAM, "Time integration/Type": "central difference", "Time integration/Time step": "0", "Time integration/End time": "0.5",
                 "Discretization/Mass": "diagonal scaling", "Output/Steps between rows": "50", "Output/Time between results": "0.1",
                 "Checkpoint/Steps between checkpoints": "100", "Time integration/central difference/Steps between estimates": "120"},
    "explicit, moving": {**BEAM, **MOVING, "Time integration/Type": "central difference", "Time integration/Time step": "0",
                         "Time integration/End time": "0.3", "Discretization/Mass": "diagonal scaling", "Output/Steps between rows": "7",
                         "Output/Time between results": "0.1", "Checkpoint/Steps between checkpoints": "20"},
    "static": {**BEAM, "Time integration/Type": "static", "Time integration/static/Load steps": "32", "Checkpoint/Steps between checkpoints": "3",
               "Loads/Gravity": "0; 0; -3"},
}


def rows_without_time(directory):
    return [{name: value for name, value in row.items() if name != "wall_time"} for row in read_history(directory)]


class Run:
    """Runs of one parameter file."""

    def __init__(self, folder, kind, ranks, entries=None):
        self.folder, self.ranks = folder, ranks
        self.folder.mkdir(parents=True)
        self.output = self.folder / "run"
        (self.folder / "case.prm").write_text(parameter_text({**KINDS[kind], **(entries or {})}), encoding="utf-8")

    def start(self, *arguments, ranks=None):
        command = [*launcher(ranks or self.ranks), os.environ["COROTET_PROGRAM"], "case.prm", *arguments]
        return subprocess.Popen(command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                start_new_session=True)

    def processes(self):
        """The processes of the program itself, one for each rank."""
        found = []
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if (entry / "cwd").resolve() == self.folder and (entry / "comm").read_text(encoding="utf-8").strip() == "corotet":
                    found.append(int(entry.name))
            except OSError:
                pass
        return found

    def finish(self, *arguments, ranks=None):
        """Finishes a run; returns its status, output and errors."""
        run = run_on(ranks or self.ranks, ["case.prm", *arguments], self.folder, 300)
        return run.returncode, run.stdout, run.stderr

    def kill(self, process):
        """Kills the run: mpirun, if it was started by that, and all ranks, which do not end with mpirun. Returns output and errors."""
        ranks = self.processes()
        # As long as the process is not reaped, its group exists, also if the run has just ended.
        if process.returncode is None:
            os.killpg(process.pid, signal.SIGKILL)
        for pid in ranks:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        said = process.communicate()
        while self.processes():
            time.sleep(0.005)
        return said

    def kill_after(self, seconds, *arguments):
        """Kills the run after some seconds; returns whether it had not ended before."""
        process = self.start(*arguments)
        try:
            process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            self.kill(process)
            return True
        return False


def results_of(directory):
    """The files of the time series by name. Equal numbers give equal files."""
    return {file.relative_to(directory): file.read_bytes() for file in sorted(directory.glob("solution*/**/*")) if file.is_file()} | {
        "index": (directory / "solution.vtkhdf").read_bytes()}


def different(files, others):
    """The names of files that only one has, or that differ."""
    return sorted(str(name) for name in files.keys() | others.keys() if files.get(name) != others.get(name))


class Checkpoints(ProgramTest):

    def undisturbed(self, kind, ranks=1, entries=None):
        run = Run(self.folder / f"{kind} {ranks} undisturbed".replace(" ", "_"), kind, ranks, entries)
        start = time.monotonic()
        process = run.start()
        out, errors = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, out + errors)
        return run, time.monotonic() - start

    def kill_and_restart(self, kind, undisturbed, seconds, moments, name):
        """Kills a run at these moments, as fractions of the time of an undisturbed run. Returns how often it was killed."""
        run = Run(self.folder / name.replace(" ", "_"), kind, undisturbed.ranks)
        kills = 0
        for moment in moments:
            kills += run.kill_after(moment * seconds, *(["--restart"] if kills else []))
        status, out, errors = run.finish("--restart")
        self.assertEqual(status, 0, out + errors)
        self.assertEqual(rows_without_time(run.output), rows_without_time(undisturbed.output))
        self.assertEqual(different(results_of(run.output), results_of(undisturbed.output)), [])
        shutil.rmtree(run.folder)
        return kills

    def test_killed_runs(self):
        # This is a part of campaigns/restarts.py.
        random.seed(1)
        for kind in KINDS:
            with self.subTest(kind=kind):
                run, seconds = self.undisturbed(kind)
                for number, moments in enumerate(((random.uniform(0.4, 1),), (random.uniform(0.4, 1), random.uniform(0.3, 0.8)))):
                    self.kill_and_restart(kind, run, seconds, moments, f"{kind} {number}")

    def test_killed_runs_on_two_ranks(self):
        random.seed(2)
        for kind in ("BDF2", "explicit"):
            with self.subTest(kind=kind):
                run, seconds = self.undisturbed(kind, 2)
                self.kill_and_restart(kind, run, seconds, (random.uniform(0.5, 1),), f"{kind} two")

    def stop_at(self, run, step, *arguments, keep=2):
        """Ends the run when it has a checkpoint of that step."""
        file = run.output / "checkpoint" / f"step_{step:06}.json"
        # If other processes keep the processor busy, the run may have passed the step before this loop sees it.
        for _ in range(5):
            process = run.start("--set", f"Checkpoint/Keep = {keep}", *arguments)
            while not file.exists() and process.poll() is None:
                time.sleep(0.002)
            out, errors = run.kill(process)
            if file.exists():
                return
            self.assertIn(process.returncode, (0, -signal.SIGKILL), out + errors)
            shutil.rmtree(run.output)
        self.fail(f"no run was stopped at step {step}")

    def test_damaged_checkpoints(self):
        reference, _ = self.undisturbed("generalized-alpha")
        whole = Run(self.folder / "whole", "generalized-alpha", 1)
        self.stop_at(whole, 24)
        newest = sorted((whole.output / "checkpoint").glob("*.json"))[-1].stem
        files = {suffix: (whole.output / "checkpoint" / f"{newest}{suffix}").read_bytes() for suffix in (".json", ".h5")}

        def flipped(data, place):
            place = int(place * (len(data) - 1))
            return data[:place] + bytes([data[place] ^ 16]) + data[place + 1:]

        wrong_version = json.dumps({**json.loads(files[".json"]), "format": 99}).encode()
        damages = [(suffix, what, data) for suffix in files for what, data in (
            *((f"flip {place}", flipped(files[suffix], place)) for place in (0, 0.01, 0.3, 0.5, 0.77, 1)),
            ("cut", files[suffix][:len(files[suffix]) // 2]), ("empty", b""), ("longer", files[suffix] + b"x"))]
        damages.append((".json", "version", wrong_version))
        for suffix, what, data in damages:
            with self.subTest(suffix=suffix, what=what):
                run = Run(self.folder / f"{suffix}_{what}".replace(" ", "_"), "generalized-alpha", 1)
                shutil.copytree(whole.output, run.output)
                (run.output / "checkpoint" / f"{newest}{suffix}").write_bytes(data)
                status, out, errors = run.finish("--restart")
                self.assertEqual((status, errors), (0, ""), out)
                self.assertIn(f"warning: run/checkpoint/{newest}", out)
                self.assertIn("the checkpoint before it is used", out)
                self.assertIn(f"warning: run/checkpoint/{newest}", (run.output / "log.txt").read_text(encoding="utf-8"))
                self.assertEqual(rows_without_time(run.output), rows_without_time(reference.output))
                shutil.rmtree(run.folder)

    def test_between_parts_of_a_step(self):
        """A step that is halved is saved between its parts, too, and continued there."""
        run = Run(self.folder / "halved", "static", 1, {"Time integration/static/Load steps": "2", "Loads/Gravity": "0; 0; -10",
                                                        "Newton/Maximum iterations": "5", "Checkpoint/Minutes between checkpoints": "1e-9",
                                                        "Checkpoint/Steps between checkpoints": "0", "Checkpoint/Keep": "1000"})
        status, out, errors = run.finish()
        self.assertEqual((status, errors), (0, ""), out)
        whole, results = rows_without_time(run.output), results_of(run.output)
        names = sorted(path.stem for path in (run.output / "checkpoint").glob("*.json"))
        for name in [name for name in names if name.count("_") == 2]:
            with self.subTest(name=name):
                # These are later checkpoints; a whole step comes after its parts.
                later = [path for path in (run.output / "checkpoint").iterdir()
                         if path.name.split(".")[0].split("_")[1:] > name.split("_")[1:] or path.stem == name.rsplit("_", 1)[0]]
                for path in later:
                    path.unlink()
                status, out, errors = run.finish("--restart")
                self.assertEqual((status, errors), (0, ""), out)
                self.assertIn(f"Restarted from within step {int(name.split('_')[1])}, t = ", out)
                self.assertEqual((rows_without_time(run.output), results_of(run.output)), (whole, results))
                self.assertEqual(sorted(path.stem for path in (run.output / "checkpoint").glob("*.json")), names)
        self.assertGreaterEqual(len(names), 4)

    def test_whole_steps_after_a_part(self):
        """A checkpoint within a step does not count for that step: a continued run, also with another step size, has a row for the step's
        number."""
        entries = {"Time integration/Time step": "0.2", "Newton/Maximum iterations": "2", "Checkpoint/Minutes between checkpoints": "1e-9",
                   "Checkpoint/Steps between checkpoints": "0", "Checkpoint/Keep": "1000"}
        later = ("--set", "Checkpoint/Minutes between checkpoints = 0", "--set", "Checkpoint/Steps between checkpoints = 1")
        for step in ("0.2", "0.05"):
            with self.subTest(step=step):
                run = Run(self.folder / step, "BDF2", 1, entries)
                self.assertEqual(run.finish()[0], 0)
                folder = run.output / "checkpoint"
                name = min(path.stem for path in folder.glob("*.json") if path.stem.count("_") == 2)
                number = int(name.split("_")[1])
                for path in folder.iterdir():
                    if int(path.stem.split("_")[1].split(".")[0]) >= number and path.name.split(".")[0] != name:
                        path.unlink()
                status, out, errors = run.finish("--restart", *later, "--set", f"Time integration/Time step = {step}")
                self.assertEqual((status, errors), (0, ""), out)
                rows = read_history(run.output)
                self.assertEqual([int(row["step"]) for row in rows], list(range(len(rows))))
                times = [float(row["time"]) for row in rows]
                self.assertEqual(times, sorted(set(times)))
                self.assertEqual(times[-1], 1)
                self.assertTrue((folder / f"step_{number:06}.json").exists())

    def test_unfinished_checkpoints_are_removed(self):
        """Files that a run left that was killed while it saved, vectors without .json file or temporary files, are removed. Files of
        others stay."""
        run = Run(self.folder / "run", "generalized-alpha", 1)
        self.stop_at(run, 24)
        folder = run.output / "checkpoint"
        kept = sorted(path.name for path in folder.iterdir())
        for name in ("step_000007.h5", "step_000009.h5.tmp", "step_000009.json.tmp", "notes.h5"):
            (folder / name).write_bytes(b"unfinished")
        status, out, errors = run.finish("--restart")
        self.assertEqual((status, errors), (0, ""), out)
        names = {path.name for path in folder.iterdir()}
        self.assertIn("notes.h5", names)
        self.assertEqual({name.split(".")[0] for name in names if name.endswith(".h5")} - {"notes"},
                         {name.split(".")[0] for name in names if name.endswith(".json")})
        self.assertFalse([name for name in names if name.endswith(".tmp")], kept)

    def test_no_checkpoint_that_is_good(self):
        # The run was killed: its results must not be lost if its checkpoints are unusable, as if another version had written them.
        run = Run(self.folder / "unusable", "static", 1)
        self.stop_at(run, 9)
        for file in (run.output / "checkpoint").glob("*.json"):
            file.write_text(json.dumps({**json.loads(file.read_text(encoding="utf-8")), "format": 1}), encoding="utf-8")
        before = results_of(run.output)
        status, _, errors = run.finish("--restart")
        self.assertEqual(status, 1)
        self.assertRegex(errors, "^corotet: error: .*Output/Directory: --restart: none of the checkpoints in 'run' can be gone on from; .*\n$")
        self.assertEqual(different(results_of(run.output), before), [])
        status, out, _ = run.finish("--restart", "--set", "Output/Overwrite = true")
        self.assertEqual(status, 0)
        self.assertIn("begins anew", out)

    def test_ended_run_with_damaged_checkpoints(self):
        # The run has checkpoints, so the message must not say that there are none.
        run = Run(self.folder / "damaged", "static", 1)
        status, _, errors = run.finish()
        self.assertEqual((status, errors), (0, ""))
        files = list((run.output / "checkpoint").glob("*.h5"))
        self.assertTrue(files)
        for file in files:
            file.write_bytes(file.read_bytes()[:-100])
        status, _, errors = run.finish("--restart")
        self.assertEqual(status, 1)
        self.assertRegex(errors, "^corotet: error: .*Output/Directory: --restart: none of the checkpoints in 'run' can be gone on from; .*\n$")

    def test_no_checkpoint(self):
        run = Run(self.folder / "none", "static", 1)
        status, out, _ = run.finish("--restart")
        self.assertEqual(status, 0)
        self.assertIn("there is no checkpoint in run; the run begins anew", out)

    def test_ended_run_without_checkpoint_is_kept(self):
        run = Run(self.folder / "ended", "static", 1, {"Checkpoint/Steps between checkpoints": "0"})
        self.assertEqual(run.finish()[0], 0)
        self.assertFalse((run.output / "checkpoint").exists())
        history = (run.output / "history.csv").read_bytes()
        status, _, errors = run.finish("--restart")
        self.assertEqual(status, 1)
        self.assertRegex(errors, "^corotet: error: case.prm:[0-9]+: Output/Directory: --restart: found the results of a run that has "
                                 "ended in 'run', and no checkpoint to go on from; allowed: .*\n$")
        self.assertEqual((run.output / "history.csv").read_bytes(), history)
        self.assertEqual(run.finish("--restart", "--set", "Output/Overwrite = true")[0], 0)

    def test_restart_keeps_files_of_others(self):
        # These files have names like results, but no run has marked the folder.
        run = Run(self.folder / "others", "static", 1)
        run.output.mkdir()
        for name in ("report.html", "log.txt", "study_notes.csv"):
            (run.output / name).write_text("mine", encoding="utf-8")
        for kind in ("simulation", "convergence study"):
            status, _, errors = run.finish("--restart", "--set", f"Type = {kind}")
            self.assertEqual(status, 1)
            self.assertRegex(errors, "^corotet: error: .*Output/Directory.*'run' is not empty and holds no results of corotet.*\n$")
        self.assertEqual({file.name: file.read_text(encoding="utf-8") for file in run.output.iterdir()},
                         {name: "mine" for name in ("report.html", "log.txt", "study_notes.csv")})
        # These are results of another kind of run.
        run = Run(self.folder / "simulation", "static", 1)
        self.assertEqual(run.finish()[0], 0)
        before = (run.output / "history.csv").read_bytes()
        status, _, errors = run.finish("--restart", "--set", "Type = convergence study", "--set", "Convergence study/Reference = none",
                                      "--set", "Convergence study/Quantities = elastic_energy")
        self.assertEqual(status, 1)
        self.assertIn("--restart: found results of a run that is no study in 'run'", errors)
        self.assertEqual((run.output / "history.csv").read_bytes(), before)

    def test_killed_run_that_was_finished_before(self):
        run = Run(self.folder / "longer", "generalized-alpha", 1)
        self.assertEqual(run.finish()[0], 0)
        self.assertTrue((run.output / "summary.json").exists())
        process = run.start("--restart", "--set", "Time integration/End time = 1e4")
        while (run.output / "summary.json").exists() and process.poll() is None:
            time.sleep(0.002)
        out, errors = run.kill(process)
        # A directory without summary.json tells that the run was killed.
        self.assertFalse((run.output / "summary.json").exists(), out + errors)
        self.assertEqual(process.returncode, -signal.SIGKILL)

    def test_unreadable_checkpoint_loses_nothing(self):
        run = Run(self.folder / "unreadable", "static", 1)
        self.assertEqual(run.finish()[0], 0)
        before = {file: file.read_bytes() for file in run.output.rglob("*") if file.is_file()}
        # Reading fails as without permission, which root always has.
        environment = {"LD_PRELOAD": os.environ["COROTET_FAILING_FILES"], "COROTET_TEST_RANK": "all", "COROTET_TEST_MODE": "from",
                       "COROTET_TEST_FROM": "1", "ASAN_OPTIONS": "verify_asan_link_order=0"}
        for suffix in (".json", ".h5"):
            with self.subTest(suffix=suffix):
                process = run_on(1, ["case.prm", "--restart"], run.folder, 60, COROTET_TEST_FILES=f"000032{suffix}", **environment)
                self.assertEqual(process.returncode, 3, process.stdout + process.stderr)
                self.assertRegex(process.stderr, "^corotet: error: run/checkpoint/step_000032.*\n$")
                mark = run.output / ".corotet"
                self.assertEqual({file: data for file, data in before.items() if file != mark},
                                 {file: file.read_bytes() for file in run.output.rglob("*") if file.is_file() and file != mark})

    def test_other_number_of_ranks(self):
        strict = {"Linear solver/Tolerance": "1e-11", "Newton/Residual tolerance": "1e-10", "Newton/Increment tolerance": "1e-10"}
        for kind, ranks, others in (("BDF2", 1, 2), ("explicit", 2, 1), ("static", 3, 2), ("midpoint", 2, 3)):
            with self.subTest(kind=kind, ranks=ranks, others=others):
                entries = {} if kind == "explicit" else strict
                reference, _ = self.undisturbed(kind, ranks, entries)
                run = Run(self.folder / f"{kind}_others", kind, ranks, entries)
                self.stop_at(run, {"explicit": 300, "static": 9}.get(kind, 16))
                # Cells have the same numbers in checkpoints for every partitioner.
                partitioner = "PT-Scotch" if has_pt_scotch() else "Hilbert curve"
                status, out, errors = run.finish("--restart", "--set", f"Mesh/Partitioner = {partitioner}", ranks=others)
                self.assertEqual(status, 0, out + errors)
                self.assertEqual(read_summary(run.output)["ranks"], others)
                self.compare(read_history(run.output), read_history(reference.output))
                self.check_vtkhdf(run.output)

    def compare(self, rows, reference):
        self.assertEqual(len(rows), len(reference))
        sizes = collections.defaultdict(float)

        def group(column):
            return "external_work" if column == "energy_balance" or column.startswith("internal_moment") else re.sub("_[xyz]$", "", column)

        for row in reference:
            for name, value in row.items():
                sizes[group(name)] = max(sizes[group(name)], abs(float(value)))
        for row, other in zip(rows, reference, strict=True):
            for name, value in row.items():
                if name not in ("wall_time", "newton_iterations", "linear_iterations"):
                    self.assertLessEqual(abs(float(value) - float(other[name])), 1e-8 * sizes[group(name)], f"{name} in step {row['step']}")

    def test_longer_run(self):
        for kind in ("generalized-alpha", "BDF2"):
            with self.subTest(kind=kind):
                long, _ = self.undisturbed(kind)
                run = Run(self.folder / f"{kind}_short", kind, 1)
                self.assertEqual(run.finish("--set", "Time integration/End time = 0.5")[0], 0)
                status, out, errors = run.finish("--restart")
                self.assertEqual(status, 0, out + errors)
                # Times of steps have other round-off, which Newton's method passes on.
                self.compare(read_history(run.output), read_history(long.output))
                # After a further restart nothing is left to do.
                self.assertEqual(run.finish("--restart")[0], 0)
                self.compare(read_history(run.output), read_history(long.output))

    def test_changes_that_are_allowed(self):
        """Solvers and tolerances, and entries without effect, may change: the results are the same."""
        strict = {"Linear solver/Tolerance": "1e-11", "Newton/Residual tolerance": "1e-10", "Newton/Increment tolerance": "1e-10"}
        reference, _ = self.undisturbed("static", 1, strict)
        for before, change in (("automatic", "Linear solver/Type = p-multigrid"), ("p-multigrid", "Linear solver/Type = automatic"),
                               ("direct", "Linear solver/Type = automatic"), ("automatic", "Newton/Tangent = frozen rotation"),
                               ("automatic", "Newton/Maximum iterations = 90"), ("automatic", "Time integration/Time step = 0.25"),
                               ("automatic", "Mesh/Partitioner = Hilbert curve")):
            with self.subTest(before=before, change=change):
                run = Run(self.folder / "allowed", "static", 1, {**strict, "Linear solver/Type": before})
                self.stop_at(run, 9)
                # Users may keep files beside their results.
                (run.output / "view.pvsm").write_text("<ParaView/>", encoding="utf-8")
                status, out, errors = run.finish("--restart", "--set", "Newton/Maximum iterations = 100", "--set", change)
                self.assertEqual(status, 0, out + errors)
                self.assertNotIn("begins anew", out)
                self.compare(read_history(run.output), read_history(reference.output))
                self.assertTrue((run.output / "view.pvsm").exists())
                shutil.rmtree(run.folder)

    def test_changes_that_are_refused(self):
        run = Run(self.folder / "changed", "static", 1)
        self.assertEqual(run.finish()[0], 0)
        before = (run.output / "history.csv").read_bytes()
        for change, text in (("Discretization/Degree = 1", "found '1'"), ("Material/Type = neo-Hookean", "found 'neo-Hookean'"),
                             ("Time integration/Type = BDF2", "found 'BDF2'"), ("Time integration/static/Load steps = 9", "found '9'"), ("Mesh/box/Cells = 9, 1, 1", "found '9, 1, 1'"),
                             ("Loads/Gravity = 0; 0; -4", "found '0; 0; -4'"), ("Time integration/End time = 2", "found 2")):
            with self.subTest(change=change):
                status, _, errors = run.finish("--restart", "--set", change)
                self.assertEqual(status, 1)
                self.assertRegex(errors, f"^corotet: error: --set: {change.split(' = ')[0]}: --restart: {text}.*allowed.*\n$")
                self.assertEqual((run.output / "history.csv").read_bytes(), before)

    def test_two_runs_in_one_directory(self):
        run = Run(self.folder / "shared", "generalized-alpha", 1, {"Time integration/End time": "8"})
        first = run.start()
        while not (run.output / "history.csv").exists():
            time.sleep(0.005)
        # The first run must not end while the others try, so it is stopped.
        first.send_signal(signal.SIGSTOP)
        for arguments in (("--set", "Output/Overwrite = true"), ("--restart",)):
            status, _, errors = run.finish(*arguments)
            self.assertEqual(status, 3, errors)
            self.assertRegex(errors, rf"^corotet: error: the output directory 'run' is in use by process {first.pid} on .*\n$")
        # --validate changes no file, so it need not wait.
        self.assertEqual(run.finish("--restart", "--validate")[0], 0)
        first.send_signal(signal.SIGCONT)
        self.assertEqual(first.wait(60), 0)
        first.communicate()
        self.assertEqual([int(row["step"]) for row in read_history(run.output)], list(range(401)))


if __name__ == "__main__":
    unittest.main()
