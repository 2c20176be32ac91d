# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Functions that the scripts for results share: mistakes are told in one line, progress is shown by a bar, and a file is written as a whole or not
at all. Needs Python alone."""

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

# Each file that the scripts write contains this mark near its start or end. Files with the mark may be replaced.
MARK = "made by corotet"
FIRST_COLUMNS = "node,x,y,z,"
# Largest absolute value of a number in an option.
LARGEST = 1e50
# Errors of a full disk: no space at all, no space for this user, or none for so large a file.
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class WrongInput(Exception):
    """The user asked for something that is not possible; the message is one line for the user."""


def one_line(error):
    """The start of the message of an exception, as one line."""
    text = " ".join(str(getattr(error, "strerror", None) or (error.args[0] if error.args else error)).split())
    return text if len(text) < 150 else text[:150] + "..."


def number(text):
    """Converts the text of an option to a number. Numbers beyond LARGEST are refused: vectors of such numbers would have no finite length."""
    value = float(text)
    if not abs(value) <= LARGEST:
        raise argparse.ArgumentTypeError(f"found {text}; allowed are numbers from -{LARGEST:g} to {LARGEST:g}")
    return value


def is_number(text):
    """Whether the text is a number that options may have."""
    try:
        return abs(float(text)) <= LARGEST
    except ValueError:
        return False


class Parser(argparse.ArgumentParser):
    """A parser that reports a mistake in the command line as WrongInput: one line, and exit status 1."""

    def __init__(self, name, description):
        super().__init__(prog=name, description=description, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False)
        # A word that matches this is a value: argparse itself would take -1e-3 and -0.5:2 for options.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def error(self, message):
        raise WrongInput(message)


def run_command(name, main):
    """Calls main. The exit status of the process is 0 after success, 1 for wrong input, 3 if the machine failed, and 128 plus the number of a
    signal that ended it."""
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
    """Shows on a terminal a bar of the work that is done, and how long the rest will take. Shows nothing if there is no terminal."""

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
    """Whether a file was written by these scripts: it contains the mark, or it is a table that begins with FIRST_COLUMNS."""
    with open(path, "rb") as file:
        start = file.read(1 << 16)
        file.seek(max(0, os.path.getsize(path) - (1 << 16)))
        content = start + file.read()
    return MARK.encode() in content or start.startswith(FIRST_COLUMNS.encode())


def check_folder(path):
    """Raises WrongInput unless the folder of the path exists and may be written to."""
    path = pathlib.Path(path)
    if not path.parent.is_dir():
        raise WrongInput(f"{path} cannot be written: the folder {path.parent} does not exist")
    if not os.access(path.parent, os.W_OK):
        raise WrongInput(f"{path} cannot be written: the folder {path.parent} may not be written to")


def check_target(path, overwrite):
    """Raises WrongInput unless a file may be written at the path. A file that these scripts have not made is replaced only if @p overwrite is
    set."""
    check_folder(path)
    if path.is_dir():
        raise WrongInput(f"{path} cannot be written: it is a folder")
    if path.exists() and not overwrite and not is_ours(path):
        raise WrongInput(f"{path} exists and was not made by this program; --overwrite replaces it")


def remove_after(last):
    """Removes files of an earlier, longer series FILE_0000, FILE_0001, .. that come after @p last, up to the first one that these scripts have not
    written."""
    stem, number = last.stem.rsplit("_", 1)
    number = int(number) + 1
    while (path := last.with_name(f"{stem}_{number:04d}{last.suffix}")).is_file() and is_ours(path):
        path.unlink()
        number += 1


@contextlib.contextmanager
def named(target):
    """Errors of a full disk, and errors without a file name, get the name of the target, as the user does not know the temporary file."""
    try:
        yield
    except OSError as error:
        if error.errno in FULL or not error.filename:
            raise OSError(error.errno, error.strerror or one_line(error), str(target)) from error
        raise


@contextlib.contextmanager
def written_beside(target):
    """Yields a temporary folder beside the target, which is removed at the end. The caller moves complete files from there to their places by
    os.replace."""
    target = pathlib.Path(target)
    with named(target):
        folder = pathlib.Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=target.parent))
        try:
            yield folder
        finally:
            shutil.rmtree(folder, ignore_errors=True)


@contextlib.contextmanager
def moved_to(target, part):
    """Yields @p part, the name of a temporary file. At the end that file is moved to the target; after an exception it is removed."""
    with named(target):
        try:
            yield part
            os.replace(part, target)
        except BaseException:
            pathlib.Path(part).unlink(missing_ok=True)
            raise
