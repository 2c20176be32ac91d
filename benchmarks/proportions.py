#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Linear solves of degree 1 by smoothed aggregation, of bodies whose cells are well-shaped, flat and stretched: boxes that are clamped at a
side and bent by their weight, statics to the program's tolerance. Run it inside of scripts/toolchain:

    benchmarks/proportions.py [--ranks 1] [--repetitions 2] [--programs PROGRAM [PROGRAM]] [--quick] [--document]

Programs take turns, so that one can be compared with an older one; the table
has the fastest run of each. --quick leaves out large bodies. --document writes
the table of the first program into doc/algorithms.md. For all solvers and
degrees see hard_bodies.py.
"""

import argparse
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True

from program_runs import BY_AGGREGATION, bent_body, box, document, solve  # pylint: disable=wrong-import-position

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "doc" / "algorithms.md"
# The size and the cuboids of each body.
BODIES = {
    "well-shaped": [("4, 1, 1", "40, 10, 10"), ("4, 1, 1", "80, 20, 20"), ("4, 1, 1", "140, 35, 35")],
    "flat by 10": [("1, 1, 0.1", "16, 16, 16"), ("1, 1, 0.1", "32, 32, 32")],
    "flat by 30": [("1, 1, 0.0333", "16, 16, 16"), ("1, 1, 0.0333", "32, 32, 32")],
    "flat by 100": [("1, 1, 0.01", "16, 16, 16"), ("1, 1, 0.01", "32, 32, 32")],
    "stretched by 10": [("10, 1, 1", "16, 16, 16"), ("10, 1, 1", "32, 32, 32")],
    "stretched by 100": [("100, 1, 1", "16, 16, 16"), ("100, 1, 1", "32, 32, 32")],
    "plate of two layers": [("1, 1, 0.01", "80, 80, 2")],
}
QUICK = 60000


def measure(options, folder, case):
    """The fastest run of each program."""
    runs = {program: [] for program in options.programs}
    for _ in range(options.repetitions):
        for program in options.programs:
            runs[program].append(solve(program, folder, case, options.ranks))
    return {program: min(found, key=lambda run: run[2]) for program, found in runs.items()}


def aggregation(options, folder):
    lines = ["| body of degree 1 | unknowns | iterations | seconds | MB |", "|---|---:|---:|---:|---:|"]
    for name, sizes in BODIES.items():
        for size, cells in sizes:
            counts = [int(n) + 1 for n in cells.split(",")]
            if options.quick and 3 * counts[0] * counts[1] * counts[2] > QUICK:
                continue
            case = bent_body(box(size, cells), 1, "x-min", BY_AGGREGATION)
            for program, (unknowns, iterations, seconds, memory) in measure(options, folder, case).items():
                line = f"| {name} | {unknowns} | {iterations} | {seconds:.2g} | {memory:.0f} |"
                print(line + ("" if len(options.programs) == 1 else f" {program}"), flush=True)
                if program == options.programs[0]:
                    lines.append(line)
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--repetitions", type=int, default=2)
    parser.add_argument("--programs", nargs="+", default=[str(ROOT / "build" / "release" / "corotet")])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        lines = aggregation(options, pathlib.Path(temporary))
    if options.document:
        document(PAGE, "aggregation", lines)
    return 0


if __name__ == "__main__":
    sys.exit(main())
