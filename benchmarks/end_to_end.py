#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""From a mesh file to results: linear statics of a cube of a million unknowns, degrees 1 to 3, and of nearly six million, degrees 2 and 3,
on one rank and more, as whole processes.
Run it inside of scripts/toolchain:

    benchmarks/end_to_end.py [--program PROGRAM] [--ranks 1 2] [--repetitions 2] [--quick] [--largest] [--document]

Times are those of the fastest run; set-up goes from the arrays of the mesh to
the first application of the operator, without reading. The processor's time is
that of all processes, including the launcher and gmsh, which reads the file.
Memory is the peak of each rank, or of gmsh's process, which rank 0 waits for,
if that had more.

The status is 1 if set-up on one rank takes more than 2 s for a million cells of
degree 1, 4 s of degree 2 or 3; if at degree 2 or 3 set-up and output take
longer than the solution; if one rank has more than 1,500 bytes for an unknown
of degree 1, 350 of degree 2, or 300 of degree 3; or if a rank has more than 1.3
times the memory of the mean one. --quick takes meshes of an eighth and checks
no limits. --largest runs only ten million cells of degree 1, on the largest
number in --ranks. --document writes the table, or with --largest that one, into
doc/scaling.md.
"""

import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True

from program_runs import bent_body, document, file, launcher  # pylint: disable=wrong-import-position
from readers import MESHED_BOX, gmsh  # pylint: disable=wrong-import-position

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "doc" / "scaling.md"
# The degree, and the number of cuboids in each direction, of six cells each.
BODIES = [(1, 68), (2, 34), (3, 23), (2, 62), (3, 41)]
# The most bytes for an unknown on one rank, by degree.
MOST_BYTES = {1: 1500, 2: 350, 3: 300}
CUBOIDS_OF_LARGEST = 119
MOST_SETUP = {1: 2, 2: 4, 3: 4}
MOST_OVER_MEAN = 1.3
# Starts a rank, and writes how much memory it has used.
RANK = """import os, resource, subprocess, sys
status = subprocess.call(sys.argv[2:])
open(f"{sys.argv[1]}/rank.{os.getpid()}", "w").write(str(1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss))
sys.exit(status)"""


def run(program, folder, ranks):
    """Wall and processor time of all processes [s], the summary, and the peak memory of each rank [byte]."""
    for path in folder.glob("rank.*"):
        path.unlink()
    command = [*launcher(ranks), sys.executable, "-c", RANK, str(folder), os.path.abspath(program), "case.prm", "--output", "results",
               "--quiet"]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    summary = json.loads((folder / "results" / "summary.json").read_text(encoding="utf-8"))
    return wall, processor, summary, [int(path.read_text()) for path in folder.glob("rank.*")]


def judge(degree, ranks, summary, memory):
    """Lines on figures that exceed their limits."""
    times, found = summary["wall_time"], []
    setup = times["setup"] - times["read"]
    each = 1e6 * setup / summary["cells"]
    if ranks == 1 and each > MOST_SETUP[degree]:
        found.append(f"degree {degree}: set-up takes {each:.2g} s for a million cells, not at most {MOST_SETUP[degree]}")
    if ranks == 1 and degree > 1 and setup + times["output"] > times["solve"]:
        found.append(f"degree {degree}: set-up and output take {setup + times['output']:.2g} s, the solution {times['solve']:.2g}")
    most_bytes = MOST_BYTES[degree]
    if ranks == 1 and sum(memory) > most_bytes * summary["dofs"]:
        found.append(f"degree {degree}: {sum(memory) / summary['dofs']:.0f} bytes for an unknown, not at most {most_bytes}")
    if max(memory) * len(memory) > MOST_OVER_MEAN * sum(memory):
        found.append(f"degree {degree}, {ranks} ranks: one has {max(memory) * len(memory) / sum(memory):.2f} times the mean memory")
    return found


def row(degree, ranks, fastest):
    wall, processor, summary, memory = fastest
    times, unknowns = summary["wall_time"], summary["dofs"]
    setup = times["setup"] - times["read"]
    seconds = [times["read"], setup, 1e6 * setup / summary["cells"], times["assembly"], times["solve"], times["output"], wall, processor]
    cells = [degree, ranks, summary["cells"], unknowns, summary["final"]["linear_iterations"],
             *(f"{value:.0f}" if value > 10 else f"{value:.2g}" for value in seconds),
             f"{sum(memory) / 1e6:.0f}", f"{sum(memory) / unknowns:.0f}", f"{max(memory) * len(memory) / sum(memory):.2f}"]
    return "| " + " | ".join(map(str, cells)) + " |"


def measure(options, folder):
    """The rows of the table, and lines on figures that exceed their limits."""
    heads = ["degree", "ranks", "cells", "unknowns", "iterations", "reading", "set-up", "for a million cells", "assembly", "solution",
             "output", "whole", "processor", "MB", "bytes for an unknown", "largest rank over mean"]
    lines, mistakes = ["| " + " | ".join(heads) + " |", "|" + "---:|" * len(heads)], []
    bodies = [(1, CUBOIDS_OF_LARGEST)] if options.largest else BODIES
    for degree, n in bodies:
        gmsh(folder, MESHED_BOX.format(n=n // 2 if options.quick else n), folder / "body.msh", "-3", "-bin")
        (folder / "case.prm").write_text(bent_body(file("body.msh"), degree, "foot"), encoding="utf-8")
        for ranks in [max(options.ranks)] if options.largest else options.ranks:
            runs = [run(options.program, folder, ranks) for _ in range(1 if options.largest else options.repetitions)]
            fastest = min(runs, key=lambda one: one[0])
            lines.append(row(degree, ranks, fastest))
            print(lines[-1], flush=True)
            mistakes += judge(degree, ranks, *fastest[2:])
    return lines, [] if options.quick else mistakes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "corotet"))
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--repetitions", type=int, default=2)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--largest", action="store_true")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        lines, mistakes = measure(options, pathlib.Path(folder))
    if options.document:
        document(PAGE, "largest" if options.largest else "end to end", lines)
    for mistake in mistakes:
        print(mistake)
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
