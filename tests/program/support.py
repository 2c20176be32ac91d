# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Tools that the tests of the program share. The environment gives
COROTET_PROGRAM, COROTET_MPIRUN (words), and, if short runs are to share the
loading of libraries, COROTET_FORK_SERVER."""

import csv
import functools
import json
import os
import pathlib
import re
import resource
import shlex
import signal
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CASES = sorted((ROOT / "parameters").glob("*.prm"))

COLUMNS = ("step time dt newton_iterations linear_iterations kinetic_energy elastic_energy dissipated_energy external_work "
           "energy_balance momentum_x momentum_y momentum_z angular_momentum_x angular_momentum_y angular_momentum_z "
           "max_displacement min_det_F inverted_cells wall_time").split()
COLUMNS_AFTER_PROBES = ("volume reaction_x reaction_y reaction_z degenerate_cells robust_rotations clamped_cells parts "
                        "internal_moment_x internal_moment_y internal_moment_z rejected_steps").split()
SUMMARY_KEYS = ("status version git_revision dealii_version ranks cells nodes dofs degree mesh_volume total_mass steps end_time preconditioner_builds "
                "final wall_time peak_memory_bytes").split()
MODES_COLUMNS = ("mode frequency angular_frequency eigenvalue residual modal_mass effective_mass_x effective_mass_y effective_mass_z "
                 "mass_share_x mass_share_y mass_share_z").split()
MODES_SUMMARY_KEYS = ("status version git_revision dealii_version ranks cells nodes dofs degree mesh_volume total_mass modes frequencies "
                      "wall_time peak_memory_bytes").split()
WALL_TIME_KEYS = "setup read partition assembly solve output total".split()


def read_history(directory):
    """The rows of history.csv as dictionaries of text."""
    with open(directory / "history.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def read_modes(directory):
    """The rows of modes.csv as dictionaries of text."""
    with open(directory / "modes.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def read_summary(directory):
    return json.loads((directory / "summary.json").read_text(encoding="utf-8"))


def limit_files(size=2000):
    """In a new process: limits the size of files, in bytes. Programs get the
    same error as on a full disk."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def parameter_text(entries):
    """A parameter file with these entries, "Section/Subsection/Name": value."""
    lines = []
    for entry, value in entries.items():
        *sections, name = entry.split("/")
        lines += [f"subsection {section}" for section in sections]
        lines.append(f"set {name} = {value}")
        lines += ["end"] * len(sections)
    return "\n".join(lines) + "\n"


@functools.cache
def sessions():
    """A folder for the files of launchers while they run."""
    return tempfile.TemporaryDirectory(ignore_cleanup_errors=True)


def launcher(ranks):
    """The words before a program that start it once on so many ranks."""
    if ranks == 1:
        return []
    # Files that a killed mpirun leaves must not affect a later one with the
    # same process id.
    session = tempfile.mkdtemp(dir=sessions().name)
    # The last word of the variable is a number of ranks, which is replaced.
    return ["env", f"TMPDIR={session}", *shlex.split(os.environ["COROTET_MPIRUN"])[:-1], str(ranks)]


class ForkServer:
    """Runs the program on one rank, many times, in children of one process
    (fork_server.cc) that has loaded its libraries."""

    def __init__(self, server, preloaded):
        environment = {**os.environ, "LD_PRELOAD": preloaded} if preloaded else None
        self.process = subprocess.Popen([server], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment)
        self.files = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)

    def run(self, arguments, folder, timeout, memory, environment):
        """Returns a CompletedProcess with bytes, and the processor time in
        seconds."""
        output, errors = (pathlib.Path(self.files.name) / name for name in ("output", "errors"))
        arguments = [os.environ["COROTET_PROGRAM"], *map(str, arguments)]
        request = {"arguments": arguments, "folder": str(folder), "output": str(output), "errors": str(errors), "timeout": timeout, "memory": memory,
                   "environment": {name: str(value) for name, value in environment.items()}}
        print(json.dumps(request), file=self.process.stdin, flush=True)
        answer = json.loads(self.process.stdout.readline())
        if answer["status"] == -signal.SIGALRM:
            raise subprocess.TimeoutExpired(arguments, timeout)
        return subprocess.CompletedProcess(arguments, answer["status"], output.read_bytes(), errors.read_bytes()), answer["seconds"]


@functools.cache
def fork_server(preloaded=None):
    """The fork server of this process that was started with that library."""
    return ForkServer(os.environ["COROTET_FORK_SERVER"], preloaded)


def run_alone(arguments, folder, timeout=600, memory=0, **environment):
    """Runs the program on one rank, with so many bytes of memory (0: any) and further variables of the environment. A
    CompletedProcess with bytes, and the processor time in seconds. Without COROTET_FORK_SERVER each run is a process of its own
    from the beginning."""
    if "COROTET_FORK_SERVER" in os.environ:
        return fork_server(environment.pop("LD_PRELOAD", None)).run(arguments, folder, timeout, memory, environment)

    def limit_memory():
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run([os.environ["COROTET_PROGRAM"], *map(str, arguments)], cwd=folder, capture_output=True, timeout=timeout, check=False,
                         env={**os.environ, **{name: str(value) for name, value in environment.items()}},
                         preexec_fn=limit_memory if memory else None)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return run, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def run_on(ranks, arguments, folder, timeout=600, **environment):
    """Runs the program on so many ranks, with further variables of the environment. A CompletedProcess with text."""
    if ranks == 1:
        run, _ = run_alone(arguments, folder, timeout, **environment)
        run.stdout, run.stderr = (text.decode(errors="backslashreplace") for text in (run.stdout, run.stderr))
        return run
    variables = ["env", *(f"{name}={value}" for name, value in environment.items())]
    command = [*launcher(ranks), *variables, os.environ["COROTET_PROGRAM"], *map(str, arguments)]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=timeout, check=False)


@functools.cache
def is_allowed(section, entry, value):
    """Whether this program accepts the value: some need optional parts of the
    build."""
    program = [os.environ["COROTET_PROGRAM"], "--print-parameters", "markdown"]
    parameters = subprocess.run(program, capture_output=True, text=True, check=True).stdout
    allowed = re.search(rf"## {section}\n.*?\| {entry} \| [^|]* \| one of ([^|]*) \|", parameters, re.DOTALL).group(1)
    return value in allowed.split(", ")


def has_preconditioner(name):
    return is_allowed("Linear solver", "Type", name)


def has_pt_scotch():
    return is_allowed("Mesh", "Partitioner", "PT-Scotch")


class ProgramTest(unittest.TestCase):
    """A test with a temporary folder, in which it runs the program."""

    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, *arguments, status=0, ranks=1):
        """Runs the program; its exit status must be @p status (None: any)."""
        run = run_on(ranks, arguments, self.folder)
        if status is not None:
            self.assertEqual(run.returncode, status, f"exit status of {shlex.join(run.args)}\n{run.stdout}\n{run.stderr}")
        if status == 0 and ranks == 1:
            self.assertEqual(run.stderr, "")
        return run

    def run_case(self, case, output, *settings, more=(), **others):
        """Runs parameters/@p case.prm with overrides and @p more arguments; returns the output directory."""
        overrides = [word for setting in settings for word in ("--set", setting)]
        self.run_program(ROOT / "parameters" / f"{case}.prm", *overrides, "--output", output, *more, **others)
        return self.folder / output

    def check_vtkhdf(self, directory):
        """VTK's own reader accepts the time series."""
        check = subprocess.run([sys.executable, ROOT / "tests" / "output" / "check_vtkhdf.py", directory], capture_output=True, text=True,
                               check=False)
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)
