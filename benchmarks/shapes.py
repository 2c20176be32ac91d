#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""How many shapes of somebody else mesh and solve unaided: boxes with random unions and cuts of boxes, cylinders, spheres and tori, as
STEP and as STL files made by gmsh, each read, meshed and bent by its weight (statics, degree 2, corotational) with no parameters but the
size of elements. Run it inside of scripts/toolchain:

    benchmarks/shapes.py [--shapes N] [--seed S] [--jobs N] [--program PROGRAM] [--keep FOLDER] [--document]

A shape is solved if the program ends with status 0, refused if it ends with a status of its own and one line that says why, and lost
otherwise (a crash, no end within five minutes, a message of several lines). The last lines are the sums; the status is 1 if fewer than
95 in 100 of either format are solved, or one is lost. --document writes the table into benchmarks/shapes.md.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True

from program_runs import document  # pylint: disable=wrong-import-position

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "benchmarks" / "shapes.md"
FORMATS = ("step", "stl")
ELEMENT_SIZE = 0.15
TIME_LIMIT = 300
REQUIRED = 0.95

CASE = """subsection Mesh
  set Type = file
  subsection file
    set File = {file}
    set Element size = {size}
  end
end
subsection Selections
  set Boundaries = bottom: plane 0 0 0 0 0 1
end
subsection Discretization
  set Degree = 2
end
subsection Material
  set Young's modulus = 1e6
  set Poisson's ratio = 0.3
  set Density = 1000
end
subsection Boundary conditions
  set Fixed = bottom
end
subsection Loads
  set Gravity = 2; 0; -2
end
subsection Time integration
  set Type = static
end
"""


def number(value):
    return f"{value:.4f}"


def solid(rng, tag, cut):
    """A primitive of OpenCASCADE as gmsh writes it. Its centre is in the upper
    part of the unit cube, to which all primitives are applied, so that most of
    the bottom stays; primitives that are cut out are smaller than those that
    are added."""
    size = rng.uniform(0.1, 0.25) if cut else rng.uniform(0.15, 0.4)
    x, y, z = rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0.55, 1)
    kind = rng.choice(("Box", "Cylinder", "Sphere", "Torus"))
    if kind == "Box":
        sides = [rng.uniform(0.6, 1.6) * size for _ in range(3)]
        values = [x - sides[0] / 2, y - sides[1] / 2, z - sides[2] / 2, *sides]
    elif kind == "Cylinder":
        axis = [rng.gauss(0, 1) for _ in range(3)]
        length = sum(a * a for a in axis) ** 0.5
        axis = [a / length * 2 * size for a in axis]
        values = [x - axis[0] / 2, y - axis[1] / 2, z - axis[2] / 2, *axis, rng.uniform(0.4, 0.9) * size]
    elif kind == "Sphere":
        values = [x, y, z, size]
    else:
        values = [x, y, z, size, rng.uniform(0.25, 0.5) * size]
    return f"{kind}({tag}) = {{{', '.join(map(number, values))}}};"


def geometry(seed):
    """The text of a .geo file with a random shape, which prints the number of
    its pieces."""
    rng = random.Random(seed)
    lines = ['SetFactory("OpenCASCADE");', "Box(1) = {0, 0, 0, 1, 1, 1};", "body() = {1};"]
    for i in range(rng.randint(1, 4)):
        tool = 1000 + i
        cut = rng.random() < 0.5
        lines.append(solid(rng, tool, cut))
        if rng.random() < 0.5:
            axis = ", ".join(number(rng.gauss(0, 1)) for _ in range(3))
            lines.append(f"Rotate {{{{{axis}}}, {{0.5, 0.5, 0.8}}, {number(rng.uniform(0, 0.5))}}} {{ Volume{{{tool}}}; }}")
        operation = "BooleanDifference" if cut else "BooleanUnion"
        lines.append(f"body() = {operation}{{ Volume{{body()}}; Delete; }}{{ Volume{{{tool}}}; Delete; }};")
    return "\n".join([*lines, 'Printf("pieces %g", #body());', ""])


def make_files(number_of_shape, folder):
    """Writes the shape as STEP and, as a surface mesh, as STL. Returns the
    formats that gmsh could make. A shape that falls into pieces, one of which
    would have no support, is replaced by the next random one."""
    for attempt in range(100):
        (folder / f"shape_{number_of_shape}.geo").write_text(geometry(f"{number_of_shape} {attempt}"), encoding="utf-8")
        run = run_gmsh(number_of_shape, folder, "step", "-0")
        if "pieces 1\n" in run.stdout:
            break
    sizes = {"Mesh.MeshSizeMax": ELEMENT_SIZE, "Mesh.MeshSizeMin": ELEMENT_SIZE / 10, "Mesh.MeshSizeFromCurvature": 12}
    run_gmsh(number_of_shape, folder, "stl", "-2", *(word for name, value in sizes.items() for word in ("-setnumber", name, str(value))))
    return [suffix for suffix in FORMATS if (folder / f"shape_{number_of_shape}.{suffix}").exists()]


def run_gmsh(number_of_shape, folder, suffix, *arguments):
    shape = folder / f"shape_{number_of_shape}"
    target = shape.with_suffix("." + suffix)
    run = subprocess.run(["gmsh", f"{shape}.geo", *arguments, "-o", target, "-v", "4"], capture_output=True, text=True, timeout=TIME_LIMIT, check=False)
    if run.returncode != 0:
        target.unlink(missing_ok=True)
    return run


def outcome(status, errors):
    """The outcome in words, from the program's exit status and errors."""
    if status == 0:
        return "solved"
    said = re.findall(r"^corotet: error: (.*)$", errors, re.MULTILINE)
    if status in (1, 2, 3) and len(said) == 1 and errors.count("\n") == 1:
        return f"refused: {said[0][:200]}"
    return f"lost: status {status}: {errors.strip()[:200]}"


def solve(program, seed, suffix, folder):
    """The outcome for a shape in a format, the number of cells, and seconds."""
    case = folder / f"shape_{seed}_{suffix}.prm"
    size = ELEMENT_SIZE if suffix == "step" else 0
    case.write_text(CASE.format(file=f"shape_{seed}.{suffix}", size=size), encoding="utf-8")
    results = folder / f"results_{seed}_{suffix}"
    begin = time.monotonic()
    try:
        run = subprocess.run([program, case, "--output", results, "--quiet"], capture_output=True, text=True, timeout=TIME_LIMIT, check=False)
    except subprocess.TimeoutExpired:
        return {"outcome": f"lost: no end within {TIME_LIMIT} s", "cells": 0, "seconds": TIME_LIMIT}
    seconds = time.monotonic() - begin
    summary = results / "summary.json"
    cells = json.loads(summary.read_text(encoding="utf-8"))["cells"] if summary.exists() else 0
    return {"outcome": outcome(run.returncode, run.stderr.replace(f"{folder}/", "")), "cells": cells, "seconds": round(seconds, 1)}


def try_shape(program, seed, folder):
    """The outcomes by format; formats that gmsh could not make are left out."""
    return {suffix: solve(program, seed, suffix, folder) for suffix in make_files(seed, folder)}


def table(results):
    """The lines of a table in Markdown, and whether all requirements are
    met."""
    lines = ["| format | shapes | solved | refused | lost | cells (median) | seconds (median, longest) |", "|---|---:|---:|---:|---:|---:|---:|"]
    good = True
    for suffix in FORMATS:
        ends = [result[suffix] for result in results.values() if suffix in result]
        counts = collections.Counter(end["outcome"].split(":")[0] for end in ends)
        cells = sorted(end["cells"] for end in ends)
        seconds = sorted(end["seconds"] for end in ends)
        middle = len(ends) // 2
        lines.append(f"| {suffix.upper()} | {len(ends)} | {counts['solved']} | {counts['refused']} | {counts['lost']} | {cells[middle]} | "
                     f"{seconds[middle]}, {seconds[-1]} |")
        good = good and counts["solved"] >= REQUIRED * len(ends) and counts["lost"] == 0
    return lines, good


def refusals(results):
    return [f"- shape {seed}, {suffix.upper()}: {end['outcome']}" for seed, result in sorted(results.items()) for suffix, end in result.items()
            if end["outcome"] != "solved"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shapes", type=int, default=100, metavar="N")
    parser.add_argument("--seed", type=int, default=0, metavar="S", help="of the first shape")
    parser.add_argument("--jobs", type=int, default=2, metavar="N")
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "corotet"))
    parser.add_argument("--keep", metavar="FOLDER", help="for the shapes and their results")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        folder = pathlib.Path(options.keep or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        seeds = range(options.seed, options.seed + options.shapes)
        results = dict(zip(seeds, pool.map(lambda seed: try_shape(os.path.abspath(options.program), seed, folder), seeds)))
    others = refusals(results) + [f"- shape {seed}: gmsh could not write it as {suffix.upper()}" for seed, result in results.items()
                                  for suffix in FORMATS if suffix not in result]
    lines, good = table(results)
    print("\n".join([*lines, *others]))
    if options.document:
        document(PAGE, "table", [*lines, *(["", *others] if others else [])])
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
