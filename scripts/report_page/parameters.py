# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Reads the parameters of a run, and finds those that differ from the defaults, which the program prints."""

import dataclasses
import json
import os
import pathlib
import re
import shutil
import subprocess

# Entries that are not listed: the place of results is no part of the case, and checks have a section of the page to
# themselves.
LEFT_OUT = re.compile("Output/(Directory|Overwrite)|Verification/.*")


@dataclasses.dataclass
class Difference:
    entry: str
    value: str
    default: str
    meaning: str


def read_parameters(text):
    """The entries of a parameter file: {"Section/Subsection/Entry": value}."""
    entries, sections = {}, []
    for line in re.sub(r"\\[ \t]*\n", "", text).splitlines():
        line = line.split("#")[0].strip()
        if match := re.fullmatch(r"subsection\s+(.*)", line):
            sections.append(match.group(1).strip())
        elif line == "end":
            if not sections:
                raise ValueError("an 'end' too many")
            sections.pop()
        elif match := re.fullmatch(r"set\s+([^=]*?)\s*=\s*(.*)", line):
            entries["/".join([*sections, match.group(1)])] = re.sub(r"\s+", " ", match.group(2))
        elif line:
            raise ValueError(f"found '{line[:80]}'")
    if sections:
        raise ValueError("an 'end' is missing")
    return entries


def find_program():
    """The path of the program corotet: the one of the build or installation that this script belongs to, else the one that a
    shell would start, or None."""
    here = pathlib.Path(__file__)
    for path in (here.absolute(), here.resolve()):
        for folder in path.parents:
            for place in ("corotet", "bin/corotet", "build/release/corotet"):
                if (folder / place).is_file() and os.access(folder / place, os.X_OK):
                    return folder / place
    return shutil.which("corotet")


def flatten(tree, path=""):
    for name, value in tree.items():
        if isinstance(value, dict) and "default_value" in value and isinstance(value["default_value"], str):
            yield path + name, value
        elif isinstance(value, dict):
            yield from flatten(value, f"{path}{name}/")


def read_defaults():
    """The program's description of each entry: {entry: description}; empty if there is no program."""
    program = find_program()
    if program is None:
        return {}
    try:
        run = subprocess.run([program, "--print-parameters", "json"], capture_output=True, text=True, timeout=60, check=True)
        return dict(flatten(json.loads(run.stdout)))
    except (OSError, ValueError, subprocess.SubprocessError):
        return {}


def same(a, b):
    """Whether two values of an entry are the same, as texts or as numbers: 1 and 1.0 are the same."""
    words = [re.findall(r"[^\s,;]+|[,;]", text) for text in (a, b)]
    if len(words[0]) != len(words[1]):
        return False

    def equal(x, y):
        try:
            return x == y or float(x) == float(y)
        except ValueError:
            return False

    return all(equal(x, y) for x, y in zip(*words))


def differences(parameters, defaults):
    """The entries whose values are not the defaults, in the order of the file."""
    return [Difference(entry, value, defaults[entry]["default_value"], defaults[entry].get("documentation", ""))
            for entry, value in parameters.items()
            if entry in defaults and not LEFT_OUT.fullmatch(entry) and not same(value, defaults[entry]["default_value"])]
