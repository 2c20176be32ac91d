# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""What scripts for results share as programs: one line for a mistake, a bar of progress, files that are whole or not there. Needs Python alone."""

import argparse
import contextlib
import errno
import os
import pathlib
import re
import shutil
import signal
import sys
import tempfile
import time

# In each file that is written, near its start or end: such files may be replaced.
MARK = "made by corotet"
FIRST_COLUMNS = "node,x,y,z,"
# Of numbers in options.
LARGEST = 1e50
# What a full disk says, also one that is full for this user or this file.
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class WrongInput(Exception):
    """What was asked for is not possible; the message is one line for the user."""


def one_line(error):
    """The start of what an exception says."""
    text = " ".join(str(getattr(error, "strerror", None) or (error.args[0] if error.args else error)).split())
    return text if len(text) < 150 else text[:150] + "..."


def number(text):
    """For an option: one with which vectors have lengths."""
    value = float(text)
    if not abs(value) <= LARGEST:
        raise argparse.ArgumentTypeError(f"found {text}; allowed are numbers from -{LARGEST:g} to {LARGEST:g}")
    return value


def is_number(text):
    """Whether it is one that options may have."""
    try:
        return abs(float(text)) <= LARGEST
    except ValueError:
        return False


class Parser(argparse.ArgumentParser):
    """Mistakes are one line, and status 1."""

    def __init__(self, name, description):
        super().__init__(prog=name, description=description, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
        # What begins so is a value, no option: argparse itself takes -1e-3 and -0.5:2 for options.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message):
        raise WrongInput(message)


def run_command(name, main):
    """Calls main and ends the process: status 0, 1 for wrong input, 3 if the machine failed (interrupted: as signals do)."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    try:
        main()
    except WrongInput as error:
        sys.exit(f"{name}: error: {error}")
    except OSError as error:
        print(f"{name}: error: {error.filename + ': ' if error.filename else ''}{one_line(error)}", file=sys.stderr)
        sys.exit(3)
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)


class Progress:
    """A bar on a terminal, else nothing: what is done, and how long the rest will take."""

    def __init__(self, what, n):
        self.what, self.n, self.done, self.start = what, n, 0, time.monotonic()
        self.shown = sys.stderr.isatty() and n > 1

    def advance(self):
        self.done += 1
        if not self.shown:
            return
        left = (time.monotonic() - self.start) / self.done * (self.n - self.done)
        bar = "#" * round(30 * self.done / self.n)
        end = "\n" if self.done == self.n else ""
        print(f"\r{self.what} {self.done}/{self.n} [{bar:<30}] {left:.0f} s left ", end=end, file=sys.stderr, flush=True)


def is_ours(path):
    """Whether a file was written by these scripts; a table is known by its first columns."""
    with open(path, "rb") as file:
        start = file.read(1 << 16)
        file.seek(max(0, os.path.getsize(path) - (1 << 16)))
        content = start + file.read()
    return MARK.encode() in content or start.startswith(FIRST_COLUMNS.encode())


def check_folder(path):
    """A file can be written there."""
    path = pathlib.Path(path)
    if not path.parent.is_dir():
        raise WrongInput(f"{path} cannot be written: the folder {path.parent} does not exist")
    if not os.access(path.parent, os.W_OK):
        raise WrongInput(f"{path} cannot be written: the folder {path.parent} may not be written to")


def check_target(path, overwrite):
    """A file may be written there: nothing of others is lost, unless that is wanted."""
    check_folder(path)
    if path.is_dir():
        raise WrongInput(f"{path} cannot be written: it is a folder")
    if path.exists() and not overwrite and not is_ours(path):
        raise WrongInput(f"{path} exists and was not made by this program; --overwrite replaces it")


def remove_after(last):
    """What a longer series FILE_0000, FILE_0001, .. has left after its last file now, as far as these scripts have written it."""
    stem, number = last.stem.rsplit("_", 1)
    number = int(number) + 1
    while (path := last.with_name(f"{stem}_{number:04d}{last.suffix}")).is_file() and is_ours(path):
        path.unlink()
        number += 1


@contextlib.contextmanager
def named(target):
    """What the machine could not write is said of the target, not of a file on the way there."""
    try:
        yield
    except OSError as error:
        if error.errno in FULL or not error.filename:
            raise OSError(error.errno, error.strerror or one_line(error), str(target)) from error
        raise


@contextlib.contextmanager
def written_beside(target):
    """A folder beside the target, gone at the end. Files that are whole go from there to their places by os.replace."""
    target = pathlib.Path(target)
    with named(target):
        folder = pathlib.Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=target.parent))
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)


@contextlib.contextmanager
def moved_to(target, part):
    """For a file whose name on the way is given: it goes to its place when it is whole, or is removed."""
    with named(target):
        try:
            yield part
            os.replace(part, target)
        except BaseException:
            pathlib.Path(part).unlink(missing_ok=True)
            raise
