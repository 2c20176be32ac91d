# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Reads the results of a run from its folder: the mesh, states, histories. Needs h5py and NumPy."""

import csv
import os
import pathlib
import re

import numpy as np

from commands import WrongInput, is_number, one_line

# Files must not be locked: they are only read here, the run may still write them, and some file systems cannot lock files.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
import h5py  # noqa: E402  (the environment is read when it is loaded)

DEGREES = {4: 1, 10: 2, 20: 3}  # by the number of a tetrahedron's nodes
MOST_TIMES = 100_000


class BadPart(Exception):
    """A file that another file refers to is missing, or cannot be read; then the reason is given."""

    def __init__(self, path, referrer, reason=None):
        super().__init__(path, referrer, reason)
        self.path, self.referrer, self.reason = path, referrer, reason


def check_parts(path, data, checked=None):
    """Raises BadPart unless all files that have parts of @p data, a dataset of the file @p path, can be opened and have their part, and so on for files
    that these refer to. HDF5 itself would silently read zeros in place of missing parts of a virtual dataset. File names in a file are relative to its
    folder."""
    checked = set() if checked is None else checked
    for name, part in sorted({(source.file_name, source.dset_name) for source in data.virtual_sources()} if data.is_virtual else set()):
        source = path if name == "." else path.parent / name
        if (source, part) in checked:
            continue
        checked.add((source, part))
        if not source.exists():
            raise BadPart(source, path)
        try:
            with h5py.File(source, "r", locking=False) as file:
                check_parts(source, file[part], checked)
        except (OSError, KeyError) as error:
            raise BadPart(source, path, one_line(error)) from error


class Obstacles:
    """The obstacles of a run as triangles. `points` [m] are the vertices without displacement, `triangles` the numbers of the vertices, `owners` the number of
    each triangle's obstacle, `is_hollow` tells for each triangle whether the body is inside of the obstacle."""

    def __init__(self, path):
        self.path = path
        try:
            self.file = h5py.File(path, "r")
            top = self.file["VTKHDF"]
            self.times = top["Steps/Values"][:]
            self.points = top["Points"][:]
            self.triangles = top["Connectivity"][:].reshape(-1, 3)
            self.owners = top["CellData/obstacle"][:]
            self.is_hollow = top["CellData/hollow"][:] != 0
            check_parts(path, top["PointData/displacement"])
        except BadPart as error:
            raise WrongInput(f"{path} is damaged: {error.path.name}: {error.reason or 'the file is missing'}") from error
        except (OSError, KeyError, ValueError, RuntimeError) as error:
            raise WrongInput(f"{path} is damaged: {one_line(error)}") from error

    def displacement(self, time):
        """The displacements of the vertices [m] in the state nearest to @p time."""
        first = int(np.abs(self.times - time).argmin()) * len(self.points)
        try:
            return self.file["VTKHDF/PointData/displacement"][first : first + len(self.points)]
        except (OSError, RuntimeError) as error:
            raise WrongInput(f"{self.path} is damaged: {one_line(error)}") from error

    def each(self, times):
        """For each obstacle its points, its triangles of these, whether it is hollow, and its displacements [m] in the states nearest to some times."""
        _, first_triangles = np.unique(self.owners, return_index=True)
        # All vertices of an obstacle move alike.
        moves = np.stack([self.displacement(time)[self.triangles[first_triangles, 0]] for time in times], axis=1)
        for first, own_moves in zip(first_triangles, moves):
            own = self.owners == self.owners[first]
            vertices, corners = np.unique(self.triangles[own], return_inverse=True)
            yield self.points[vertices], corners.reshape(-1, 3), bool(self.is_hollow[first]), own_moves


class Run:
    """The results in a folder, as they were when the folder was opened. Numbers have the units of the files.

    `points` [m] are the nodes of the body at rest, `cells` the numbers of the nodes of each cell in VTK's order, `times` the times of the states (the
    numbers of modes), `point_fields` and `cell_fields` the numbers of components of the arrays at nodes and of cells, by name.
    """

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not self.folder.is_dir():
            raise WrongInput(f"{folder} is not a folder of results: " + ("it is a file" if self.folder.exists() else "it does not exist"))
        path = self.folder / "solution.vtkhdf"
        if not path.exists():
            raise WrongInput(self.why_without_states())
        try:
            self.file = h5py.File(path, "r")
            self.check_files(path, self.file["VTKHDF/PointData/displacement"])
            self.read_mesh()
        except (OSError, KeyError, ValueError, RuntimeError) as error:
            raise WrongInput(f"{path} is damaged: {one_line(error)}") from error
        self.is_modes = (self.folder / "modes.csv").exists()
        self.is_static = not self.is_modes and self.entry("Time integration", "Type") == "static"
        if not self.times.size:
            raise WrongInput(f"{folder} has no states yet")

    def why_without_states(self):
        if (self.folder / "study.csv").exists():
            return f"{self.folder} has the results of a convergence study, which are no states of a body (scripts/draw_study draws them)"
        if (self.folder / ".corotet").exists() or (self.folder / "parameters.prm").exists():
            return f"{self.folder} has no states yet: there is no solution.vtkhdf"
        return f"{self.folder} is not a folder of results: there is no solution.vtkhdf"

    def read_mesh(self):
        top = self.file["VTKHDF"]
        self.times = top["Steps/Values"][:]
        self.points = top["Points"][:]
        n_cells = int(top["NumberOfCells"][0])
        self.cells = top["Connectivity"][:].reshape(n_cells, -1)
        if self.cells.shape[1] not in DEGREES or self.cells.min() < 0 or self.cells.max() >= len(self.points):
            raise ValueError("its cells are no tetrahedra of degree 1 to 3")
        self.degree = DEGREES[self.cells.shape[1]]
        self.point_fields = self.fields_of(top["PointData"], len(self.points))
        self.cell_fields = self.fields_of(top["CellData"], n_cells)

    def fields_of(self, group, n):
        fields = {}
        for name in sorted(group):
            shape = group[name].shape
            if shape[0] not in (n, n * len(self.times)):
                raise ValueError(f"{name} has {shape[0]} rows")
            fields[name] = shape[1] if len(shape) > 1 else 1
        return fields

    def check_files(self, path, data):
        try:
            check_parts(path, data)
        except BadPart as error:
            raise OSError(f"{error.path.relative_to(self.folder)}: {error.reason or 'the file is missing'}") from error

    def obstacles(self):
        """The obstacles; None if there are none."""
        path = self.folder / "obstacles.vtkhdf"
        return Obstacles(path) if path.exists() else None

    def rows(self, group, name, n, state):
        data = self.file["VTKHDF"][group][name]
        first = state * n if data.shape[0] == n * len(self.times) else 0
        try:
            return data[first : first + n]
        except (OSError, RuntimeError) as error:
            raise WrongInput(f"{self.folder / 'solution.vtkhdf'} is damaged: {name}: {one_line(error)}") from error

    def point_data(self, name, state):
        """Values of an array at the nodes in a state, which is given by its index."""
        return self.rows("PointData", name, len(self.points), state)

    def cell_data(self, name, state):
        return self.rows("CellData", name, len(self.cells), state)

    def displacement(self, state):
        return self.point_data("displacement", state)

    def index(self, time):
        """The state nearest to @p time, which must be within those of the run."""
        first, last = self.times[0], self.times[-1]
        if not first - self.margin() <= time <= last + self.margin():
            what = "modes" if self.is_modes else "times"
            raise WrongInput(f"{time:g} is outside of the run, whose {what} are from {first:g} to {last:g}")
        return int(np.abs(self.times - time).argmin())

    def margin(self):
        """The difference that is allowed between times of a command line and times of states, as both are rounded."""
        return 1e-9 * max(abs(self.times[0]), abs(self.times[-1]))

    def between(self, first, last):
        return np.flatnonzero((self.times >= first - self.margin()) & (self.times <= last + self.margin())).tolist()

    def choose(self, words):
        """The states that words of a command line mean, each once, in the order of time. A word is `all`, a time, FROM:TO for all states in between, or
        FROM:TO:NUMBER for so many states at equal distances."""
        chosen = set()
        for word in words:
            parts = word.split(":")
            if word == "all":
                chosen |= set(range(len(self.times)))
            elif len(parts) == 1 and is_number(word):
                chosen.add(self.index(float(word)))
            elif len(parts) in (2, 3) and all(map(is_number, parts[:2])) and all(part.isdecimal() and int(part) > 0 for part in parts[2:]):
                ends = [float(part) for part in parts[:2]]
                nearest = [self.index(time) for time in ends]
                if ends[0] > ends[1]:
                    raise WrongInput(f"found the times {word}; the first must not be after the last")
                if parts[2:] and int(parts[2]) > MOST_TIMES:
                    raise WrongInput(f"found the times {word}; allowed are up to {MOST_TIMES}")
                between = {self.index(time) for time in np.linspace(*ends, int(parts[2]))} if parts[2:] else set(self.between(*ends))
                if not between:
                    near = " and ".join(f"{self.times[state]:g}" for state in sorted(set(nearest)))
                    raise WrongInput(f"found the times {word}; there is no state between, the nearest is at {near}")
                chosen |= between
            else:
                raise WrongInput(f"found the time '{word}'; allowed are numbers, FROM:TO, FROM:TO:NUMBER and all")
        return sorted(chosen)

    def history(self):
        """The columns of history.csv, or of modes.csv."""
        path = self.folder / ("modes.csv" if self.is_modes else "history.csv")
        try:
            with open(path, newline="", encoding="utf-8") as file:
                names, *rows = list(csv.reader(file))
            # The last row may be incomplete, as the run may be writing it.
            return {name: np.array([float(row[i]) for row in rows if len(row) == len(names)]) for i, name in enumerate(names)}
        except (OSError, ValueError, csv.Error) as error:
            raise WrongInput(f"{path} cannot be read: {one_line(error)}") from error

    def entry(self, section, name):
        """The value of an entry in a top section of the parameters, or an empty text if the file has no such entry."""
        path = self.folder / "parameters.prm"
        text = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
        found = re.search(rf"^subsection {re.escape(section)}\n(?:  .*\n|\n)*?  set {re.escape(name)}\s*=([^#\n]*)", text, re.MULTILINE)
        return found.group(1).strip() if found else ""
