# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Reads a folder of results: the state of its run, tables and log. mesh.py reads the time series."""

import csv
import dataclasses
import fcntl
import json
import math
import pathlib
import re
import time

from commands import WrongInput

from .parameters import read_parameters

SIGNATURE = "Results of corotet."
KINDS = {"simulation": "simulation", "modes": "modes", "convergence study": "study"}
LOG_BYTES = 100_000


class ReportError(WrongInput):
    """The folder of results cannot be used, or the page cannot be written to its place; the message says why."""


@dataclasses.dataclass
class Run:
    folder: pathlib.Path
    kind: str  # simulation, modes or study
    parameters: dict  # "Section/Entry": value
    summary: dict  # empty without summary.json
    state: str  # done, failed, stopped, running, killed, unfinished
    table: dict  # columns of history.csv, modes.csv or study.csv: lists of numbers, or of texts
    checks: list  # rows of verification.csv
    log: str
    warnings: list
    date: str  # of the newest of the files that were read

    @property
    def name(self):
        return self.folder.resolve().name

    @property
    def is_modal(self):
        """Whether modes were computed, by a run or by those of a study."""
        return self.kind == "modes" or self.kind == "study" and self.parameters.get("Convergence study/Run") == "modes"

    @property
    def is_static(self):
        return self.kind == "simulation" and self.parameters.get("Time integration/Type") == "static"

    def entry(self, path):
        return self.parameters.get(path, "")


def read_text(path):
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise ReportError(f"{path} cannot be read: {error.strerror}") from error


def number_or_text(text):
    try:
        return float(text)
    except ValueError:
        return text


def read_table(path):
    """The columns of a table: {name: values}. Values are numbers, or texts if they are not numbers. A last row that is not
    yet complete is left out."""
    try:
        names, *rows = list(csv.reader(read_text(path).splitlines())) or [[]]
    except (ValueError, csv.Error) as error:
        raise ReportError(f"{path} is damaged: {error}") from error
    short = [i for i, row in enumerate(rows) if len(row) != len(names)]
    if short and short != [len(rows) - 1]:
        raise ReportError(f"{path} is damaged: row {short[0] + 1} has {len(rows[short[0]])} values instead of {len(names)}")
    rows = [row for row in rows if len(row) == len(names)]
    return {name: [number_or_text(row[i]) for row in rows] for i, name in enumerate(names)}


def read_numbers(path):
    """The columns of a table whose values must all be numbers."""
    columns = read_table(path)
    texts = [name for name, values in columns.items() if any(isinstance(value, str) for value in values)]
    if texts:
        raise ReportError(f"{path} is damaged: column {texts[0]} has what is not a number")
    return columns


def read_summary(path):
    if not path.exists():
        return {}
    try:
        summary = json.loads(read_text(path))
    except ValueError as error:
        raise ReportError(f"{path} is damaged: {error}") from error
    if not isinstance(summary, dict) or "status" not in summary:
        raise ReportError(f"{path} is damaged: it has no status")
    return summary


def check_folder(folder):
    """Raises ReportError unless the folder has results of corotet."""
    if not folder.exists():
        raise ReportError(f"{folder} does not exist")
    if not folder.is_dir():
        raise ReportError(f"{folder} is a file; allowed is a folder of results")
    mark = folder / ".corotet"
    marked = mark.is_file() and read_text(mark).startswith(SIGNATURE)
    tables = [name for name in ("history.csv", "modes.csv", "study.csv") if (folder / name).exists()]
    if not marked and not ((folder / "parameters.prm").exists() and tables):
        raise ReportError(f"{folder} is no folder of results of corotet")


def is_in_use(folder):
    """Whether a run is writing to the folder: a run locks the file .corotet, which marks the folder."""
    try:
        with open(folder / ".corotet", "rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        pass
    return False


def kind_of(folder, parameters):
    named = KINDS.get(parameters.get("Type"))
    if named:
        return named
    return "study" if (folder / "study.csv").exists() else "modes" if (folder / "modes.csv").exists() else "simulation"


def read_run(folder):
    check_folder(folder)
    path = folder / "parameters.prm"
    try:
        parameters = read_parameters(read_text(path)) if path.exists() else {}
    except ValueError as error:
        raise ReportError(f"{path} is damaged: {error}") from error
    kind = kind_of(folder, parameters)
    summary = read_summary(folder / "summary.json")
    state = summary.get("status") or ("running" if is_in_use(folder) else "killed")
    table_path = folder / {"simulation": "history.csv", "modes": "modes.csv", "study": "study.csv"}[kind]
    table = {}
    if table_path.exists():
        table = read_table(table_path) if kind == "study" else read_numbers(table_path)
    if not any(table.values()):
        what = "finished runs" if kind == "study" else "states"
        raise ReportError(f"{folder} has no {what} yet" if state in ("running", "killed") else f"{folder} has no {what}")
    checks_path = folder / "verification.csv"
    checks = read_table(checks_path) if checks_path.exists() else {}
    rows = [dict(zip(checks, row)) for row in zip(*checks.values())]
    if rows and not {"quantity", "computed", "reference", "error", "tolerance", "pass"} <= set(checks):
        raise ReportError(f"{checks_path} is damaged: columns are missing")
    log = read_text(folder / "log.txt") if (folder / "log.txt").exists() else ""
    newest = max(file.stat().st_mtime for file in (table_path, folder / "summary.json", folder / "log.txt") if file.exists())
    return Run(folder, kind, parameters, summary, state, table, rows, log[-LOG_BYTES:], warnings_of(log),
               time.strftime("%Y-%m-%d %H:%M", time.localtime(newest)))


def warnings_of(log):
    """The warnings in the log, each once, without "warning: " at the start."""
    lines = [line.strip() for line in log.splitlines() if re.match(r"\s*warning\b", line)]
    return list(dict.fromkeys(re.sub(r"^warning: ", "", line) for line in lines))


def last_row(run):
    """The last row of the history, as {name: value}. summary.json has it at the end of a run."""
    return run.summary.get("final") or {name: values[-1] for name, values in run.table.items() if math.isfinite(values[-1])}
