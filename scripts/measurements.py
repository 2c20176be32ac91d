# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Classes and functions that the scripts measure_* share: runs of the program, which are kept for the next call, and the page that a
script writes."""

import argparse
import csv
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

ROOT = pathlib.Path(__file__).resolve().parent.parent
DEGREES = (1, 2, 3)
N_SIDE_BY_SIDE = 2


class Results:
    """The results of a run. The status is done, failed, or late if the run took too long and was stopped. The processor time is in
    s."""

    def __init__(self, directory, status, processor_time):
        self.directory = directory
        self.status = status
        self.processor_time = float(processor_time)

    @property
    def done(self):
        return self.status == "done"

    @property
    def summary(self):
        return json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))

    @property
    def log(self):
        return (self.directory / "log.txt").read_text(encoding="utf-8")

    def history(self):
        with open(self.directory / "history.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}

    def vectors(self, name):
        """The columns NAME_x, NAME_y and NAME_z of the history: a row for each row of the history."""
        history = self.history()
        return np.stack([history[f"{name}_{c}"] for c in "xyz"], axis=1)

    def nodes(self):
        """Two arrays: the places of all nodes at rest, and in the last state."""
        reader = vtkHDFReader()
        reader.SetFileName(str(self.directory / "solution.vtkhdf"))
        reader.UpdateInformation()
        reader.UpdateTimeStep(reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())[-1])
        grid = reader.GetOutputDataObject(0)
        rest = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
        return rest, rest + vtk_to_numpy(grid.GetPointData().GetArray("displacement"))


class Runs:
    """Makes runs of the program, or takes those of an earlier call from the folder."""

    def __init__(self, program, folder):
        self.program = program.resolve()
        self.folder = folder
        self.version = subprocess.run([self.program, "--version"], capture_output=True, text=True, check=True).stdout
        self.count = 0
        self.locks = defaultdict(threading.Lock)  # so that two threads do not make the same run
        folder.mkdir(parents=True, exist_ok=True)

    def run(self, case, settings, seconds=120):
        """Runs parameters/CASE.prm, or a text of parameters, with settings {entry: value}."""
        overrides = [f"{name} = {value}" for name, value in settings.items()]
        text = case if "\n" in case else (ROOT / "parameters" / f"{case}.prm").read_text(encoding="utf-8")
        key = hashlib.sha256("\n".join([self.version, text, *overrides]).encode()).hexdigest()[:16]
        directory = self.folder / key
        status_file = self.folder / f"{key}.status"
        with self.locks[key]:
            if not status_file.exists():
                shutil.rmtree(directory, ignore_errors=True)
                file = ROOT / "parameters" / f"{case}.prm"
                if "\n" in case:
                    file = self.folder / f"{key}.prm"
                    file.write_text(text, encoding="utf-8")
                words = [word for o in overrides for word in ("--set", o)]
                command = [self.program, file, "--quiet", "--output", directory, *words]
                status_file.write_text(self.call(command, seconds), encoding="utf-8")
                self.count += 1
        return Results(directory, *status_file.read_text(encoding="utf-8").split())

    @staticmethod
    def call(command, seconds):
        """Runs the command, and returns its status (done, failed or late) and its processor time [s] as a text."""
        with tempfile.TemporaryFile("w+", encoding="utf-8") as messages:
            with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=messages) as process:
                timer = threading.Timer(seconds, process.kill)
                timer.start()
                _, status, usage = os.wait4(process.pid, 0)
                is_late = not timer.is_alive()
                timer.cancel()
                process.returncode = os.waitstatus_to_exitcode(status)
            if process.returncode not in (0, 2) and not is_late:
                messages.seek(0)
                sys.exit(f"{command[1]}: {messages.read()}")
        name = "late" if is_late else "failed" if process.returncode else "done"
        return f"{name} {usage.ru_utime + usage.ru_stime:.4f}"

    def each(self, function, items):
        """Calls the function for all items, some at a time, and returns its values. The function may make runs."""
        with ThreadPoolExecutor(N_SIDE_BY_SIDE) as pool:
            return list(pool.map(function, items))


class Page:
    """The page that the sections of a script write: its text, and the requirements that are not met. Pictures go to the folder
    pictures beside the page; their names begin with the name of the page."""

    def __init__(self, file):
        self.pictures = file.parent / "pictures"
        self.name = file.stem
        self.text = []
        self.missed = []

    def add(self, text):
        self.text.append(text.strip())

    def table(self, header, rows):
        lines = [header, ["---"] + ["---:"] * (len(header) - 1), *rows]
        self.add("\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines))

    def verdict(self, ok, what):
        if not ok:
            self.missed.append(what)
        return "yes" if ok else "**no**"

    def picture(self, figure, name, title):
        path = self.pictures / f"{self.name}-{name}.svg"
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, metadata={"Date": None})
        plt.close(figure)
        self.add(f"![{title}](pictures/{path.name})")


def number(value, digits=2):
    """The text of a number with so many digits, in scientific notation only if that is shorter."""
    if 10 ** (digits - 1) <= abs(value) < 1e4:
        return f"{value:.0f}"
    return f"{value:.{digits}g}" if 1e-3 <= abs(value) < 1e4 or value == 0 else f"{value:.{digits - 1}e}"


def write_page(description, name, head, sections, **more_options):
    """Writes doc/NAME.md from the sections that the command line asks for. Returns the exit status: 1 if a requirement is not met."""
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer and shorter runs")
    parser.add_argument("--program", default=ROOT / "build" / "release" / "corotet", type=pathlib.Path)
    parser.add_argument("--results", type=pathlib.Path, help="where runs are kept; default: a temporary directory")
    parser.add_argument("--page", default=ROOT / "doc" / f"{name}.md", type=pathlib.Path)
    for option, settings in more_options.items():
        parser.add_argument(f"--{option}", **settings)
    names = [section.__name__[8:] for section in sections]
    parser.add_argument("names", nargs="*", metavar="SECTION", help="parts to measure: " + ", ".join(names) + "; default: all")
    options = parser.parse_args()
    if unknown := set(options.names) - set(names):
        parser.error(f"found {', '.join(unknown)}; allowed: {', '.join(names)}")
    matplotlib.rcParams["svg.hashsalt"] = name  # the same picture from the same figures
    page = Page(options.page)
    page.add(head.replace("%COMMAND", f"scripts/measure_{name}{' --quick' if options.quick else ''}"))
    with tempfile.TemporaryDirectory() as temporary:
        runs = Runs(options.program, options.results or pathlib.Path(temporary))
        for section in sections:
            if not options.names or section.__name__[8:] in options.names:
                section(page, runs, options)
                print(f"{section.__name__[8:]}: done, {runs.count} runs so far", flush=True)
    options.page.write_text("\n\n".join(page.text) + "\n", encoding="utf-8")
    for what in page.missed:
        print(f"not met: {what}", file=sys.stderr)
    return 1 if page.missed else 0
