# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The table of wrong_inputs.py. Allowed values of parameters are those that the
program lists; other rows are in this file and in wrong_input_files.py.
"""

import dataclasses
import functools
import itertools
import json
import os
import re
import subprocess


@dataclasses.dataclass
class Row:
    name: str
    # Parts that the message must have, besides its place.
    parts: list
    # The place that follows "corotet: error: ".
    place: str
    arguments: list
    files: dict
    status: int = 1
    # The limit of the program's memory [bytes], if there is one.
    memory: int = 0


@functools.cache
def parameters():
    """All entries, "Section/Name", with the program's description of their
    values."""
    listing = subprocess.run([os.environ["COROTET_PROGRAM"], "--print-parameters", "json"], capture_output=True, text=True, check=True).stdout
    entries = {}

    def collect(section, path):
        for name, node in section.items():
            if isinstance(node.get("value"), str):
                entries[path + name] = node["pattern_description"]
            else:
                collect(node, path + name + "/")
    collect(json.loads(listing), "")
    return entries


def parameter_file(settings):
    """The text with these settings, "Section/Name = value", and the line of
    each."""
    lines, places = [], []
    for setting in settings:
        path, _, value = setting.partition("=")
        *sections, name = path.strip().split("/")
        lines += [f"subsection {section}" for section in sections]
        lines.append(f"set {name} = {value.strip()}")
        places.append(len(lines))
        lines += ["end"] * len(sections)
    return "\n".join(lines) + "\n", places


# A small body that is held, so that statics is possible.
SMALL = ("Mesh/box/Cells = 2, 1, 1", "Discretization/Degree = 1", "Boundary conditions/Fixed = x-min")
count = itertools.count()


def wrong(name, settings, *parts, blamed=-1, by_option=None, validate=True, files=None, arguments=(), **others):
    """A row whose settings are wrong; the message must blame the setting with
    the number `blamed`, or for None the whole file. Settings are in the file,
    and in turn the last one is given by --set. A setting replaces that of SMALL
    for the same entry."""
    settings = [settings] if isinstance(settings, str) else list(settings)
    entry_of = lambda setting: setting.partition("=")[0].strip()
    base = [setting for setting in SMALL if entry_of(setting) not in map(entry_of, settings)]
    # Values with these characters cannot be in a file.
    if by_option is None:
        by_option = next(count) % 3 == 0
    in_file = settings[:-1] if by_option else settings
    text, lines = parameter_file(base + in_file)
    overrides = ["--set", settings[-1]] if by_option else []
    if blamed is None:
        place, parts = "case.prm: ", parts
    else:
        position = blamed % len(settings)
        is_option = by_option and position == len(settings) - 1
        place = "--set: " if is_option else f"case.prm:{lines[len(base) + position]}: "
        parts = (entry_of(settings[position]), *parts)
    command = ["case.prm", *overrides, "--quiet", "--output", "results", *(["--validate"] if validate else []), *arguments]
    return Row(name, list(parts), place, command, {"case.prm": text, **(files or {})}, **others)


def bounds(pattern):
    """The lower and upper bound of a pattern "[Double a...b (inclusive)]", None
    where there is none."""
    lower, upper = re.search(r"(\S+)\.\.\.(\S+) \(inclusive\)", pattern).groups()
    unbounded = ("-MAX_DOUBLE", "MAX_DOUBLE", str(2**31 - 1))
    return (None if lower in unbounded else float(lower)), (None if upper in unbounded else float(upper))


def out_of_range(pattern, number, step):
    """A value below or, for odd @p number, above the range, or beyond all
    numbers where there is no bound."""
    lower, upper = bounds(pattern)
    choices = [f"{lower - step:.17g}"] if lower is not None else []
    choices += [f"{upper + step:.17g}"] if upper is not None else []
    return choices[number % len(choices)] if choices else "1e400"


def values_for(pattern, number):
    """Wrong values for an entry, with the kind of mistake; similar kinds take
    turns with @p number."""
    turn = lambda *choices: choices[number % len(choices)]
    if pattern.startswith("[Double"):
        return [*([("not a number", "nan")] if number % 2 else []), ("out of range", out_of_range(pattern, number, 1e-3)),
                turn(("a word", "much"), ("empty", ""), ("two numbers", "1 2"), ("with unit", "1 s"), ("infinite", "inf"),
                     ("beyond all numbers", "-1e400"), ("far too long", 3000 * "9" + "x"))]
    if pattern.startswith("[Integer"):
        return [("out of range", out_of_range(pattern, number, 1)),
                turn(("a word", "many"), ("empty", ""), ("not whole", "1.5"), ("not a number", "nan"), ("beyond all numbers", 20 * "9"),
                     ("negative", "-7"), ("far too long", 3000 * "9"))]
    if pattern.startswith("[Selection"):
        return [turn(("empty", ""), ("far too long", 3000 * "x"), ("two", "none, all"), ("a number", "17"))]
    if pattern.startswith("[Bool"):
        return [turn(("a word", "maybe"), ("empty", ""), ("a number", "2"))]
    if pattern.startswith("[List"):
        return [turn(("a word", "much, more"), ("not a number", "nan, nan, nan"), ("out of range", "1e400, -1, -1"),
                     ("far too long", ", ".join(2000 * "x")))]
    if pattern.startswith("[Map"):
        return [("without colon", "name"), ("far too long", 3000 * "x")]
    return []


def parameter_rows():
    for number, (entry, pattern) in enumerate(parameters().items()):
        for kind, value in values_for(pattern, number):
            said = f'the value "{value}" of' if len(value) < 60 else f"({len(value)} characters)"
            yield wrong(f"{entry}, {kind}", f"{entry} = {value}", said, "is not allowed; allowed is ")


def all_rows():
    from wrong_input_files import file_rows
    from wrong_input_contradictions import contradiction_rows
    return [*parameter_rows(), *contradiction_rows(), *file_rows()]
