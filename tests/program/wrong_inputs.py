#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Wrong inputs, each refused with its message: wrong_inputs.py [--count] [--every N] [--seconds LIMIT]

The table is in wrong_input_rows.py: every parameter with values of the wrong
type, out of range, not a number, infinite, empty or far too long;
contradictions; files that are no meshes, tables or parameter files. For each
row the exit status, the place (file and line, or --set) and parts of the one
line of the message must be right; nothing may be on standard output, no output
directory may have been made, and the run may take no more than LIMIT seconds of
processor time.

With --every N only each N-th row is run, with --only TEXT those whose name
contains it. --count shows the number of rows. COROTET_PROGRAM is the program.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

from support import run_alone
from wrong_input_rows import all_rows


def write_files(row, folder):
    for name, content in row.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())


def start(row, folder):
    """Runs the program; returns its exit status, output and processor time."""
    run, used = run_alone(row.arguments, folder, 60, row.memory)
    return run.returncode, run.stdout, run.stderr.decode(errors="backslashreplace"), used


def mistakes_of(row, seconds):
    """Lines on wrong results of a row, and the processor time."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_files(row, folder)
        before = sorted(folder.rglob("*"))
        try:
            status, output, message, used = start(row, folder)
        except subprocess.TimeoutExpired:
            return ["it does not end"], 60
        after = sorted(folder.rglob("*"))
    mistakes = []
    if status != row.status:
        mistakes.append(f"the exit status is {status}, not {row.status}")
    beginning = "corotet: error: " + row.place
    if not message.startswith(beginning) or message.count("\n") != 1:
        mistakes.append(f"expected is one line that starts with {beginning!r}")
    if len(message) > 1500:
        mistakes.append(f"it says {len(message)} characters, too many to be read")
    mistakes += [f"{part!r} is not said" for part in row.parts if part not in message]
    if any(ord(c) < 32 and c != "\n" for c in message):
        mistakes.append("a control character is said")
    if output:
        mistakes.append(f"nothing is expected on standard output, found {output!r}")
    if after != before:
        mistakes.append(f"it has left files: {set(after) - set(before)}")
    if used > seconds:
        mistakes.append(f"it took {used:.2f} s of processor time; {seconds} s are allowed")
    return [*mistakes, f"said was: {message.strip()[:700]}"] if mistakes else [], used


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", action="store_true")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=2)
    parser.add_argument("--only", default="", help="rows whose name has this")
    options = parser.parse_args()
    # A program with assertions or sanitizers needs more memory from the start.
    rows = [row for row in all_rows()[::options.every] if options.only in row.name and not (options.every > 1 and row.memory)]
    names = [row.name for row in rows]
    assert len(set(names)) == len(names), [name for name in names if names.count(name) > 1]
    n_wrong, longest = 0, 0
    for row in rows:
        mistakes, used = mistakes_of(row, options.seconds)
        longest = max(longest, used)
        if mistakes:
            n_wrong += 1
            print(f"{row.name}:", *mistakes, sep="\n  ", flush=True)
    if options.count and n_wrong == 0:
        print(f"{len(rows)} wrong inputs, each refused with its message, longest {longest:.2f} s")
    elif n_wrong:
        print(f"{n_wrong} of {len(rows)} wrong inputs are not refused as they should be")
    sys.exit(1 if n_wrong else 0)


if __name__ == "__main__":
    main()
