# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Tools of the tests of scripts that show results: small runs, made once, and
the scripts as users start them."""

import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader

from support import ROOT, ProgramTest

sys.path.insert(0, str(ROOT / "scripts"))

# A quadratic beam that swings, with recovered stress; a cubic octant of a
# sphere with curved cells, in statics; modes of a plate, three of them rigid.
RUNS = {"beam": ("cantilever", "Discretization/Degree = 2", "Output/Stress = nodes", "Time integration/End time = 0.3", "Time integration/Time step = 0.03",
                 "Mesh/box/Cells = 6, 1, 1", "Checkpoint/Minutes between checkpoints = 0"),
        "sphere": ("lame_sphere",),
        "plate": ("plate_modes", "Mesh/box/Cells = 4, 4, 1", "Modes/Number = 5")}


# Settings of a run whose first states are in files that a file of 32 states refers to.
LONG = ("Discretization/Degree = 1", "Mesh/box/Cells = 6, 1, 1", "Time integration/End time = 0.4", "Output/Time between results = 0",
        "Checkpoint/Minutes between checkpoints = 0")


class ScriptTest(ProgramTest):
    """Tests of one script, with a folder `runs` of results that no test
    changes."""

    script = ""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.runs = pathlib.Path(folder.name)
        for name, (case, *settings) in RUNS.items():
            overrides = [word for setting in settings for word in ("--set", setting)]
            subprocess.run([os.environ["COROTET_PROGRAM"], ROOT / "parameters" / f"{case}.prm", "--quiet", *overrides, "--output", cls.runs / name], check=True)

    def start(self, *words, status=0, **others):
        """Runs the script in the test's folder; a mistake must give one line.
        Returns its output."""
        command = [sys.executable, "-B", ROOT / "scripts" / self.script, *map(str, words)]
        run = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False, timeout=300, **others)
        self.assertEqual(run.returncode, status, f"{shlex.join(map(str, words))}\n{run.stdout}{run.stderr}")
        if status == 0:
            self.assertEqual(run.stderr, "")
            return run.stdout
        self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertTrue(run.stderr.startswith(f"{self.script}: error: "), run.stderr)
        self.assertEqual(run.stdout, "")
        return run.stderr

    def check_mistakes(self, mistakes):
        """Checks pairs of a command's words and the message about them; nothing
        may be written."""
        before = sorted(self.folder.rglob("*"))
        for words, message in mistakes:
            with self.subTest(words=words):
                self.assertIn(message, self.start(*words, status=1))
                self.assertEqual(sorted(self.folder.rglob("*")), before)


class State:
    """A state as VTK's own reader reads it."""

    def __init__(self, grid):
        self.grid = grid
        self.points = vtk_to_numpy(grid.GetPoints().GetData()).copy()
        self.cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1).copy()
        self.point_data, self.cell_data = ({data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).copy() for i in range(data.GetNumberOfArrays())}
                                           for data in (grid.GetPointData(), grid.GetCellData()))

    def displaced(self):
        return self.points + self.point_data["displacement"]


def times_of(run):
    reader = vtkHDFReader()
    reader.SetFileName(str(run / "solution.vtkhdf"))
    reader.UpdateInformation()
    return np.array(reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()))


def state_of(run, index):
    """A state by its position in the series; -1 is the last one."""
    reader = vtkHDFReader()
    reader.SetFileName(str(run / "solution.vtkhdf"))
    reader.UpdateInformation()
    reader.UpdateTimeStep(times_of(run)[index])
    return State(reader.GetOutputDataObject(0))
