#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Weak scaling, as far as this machine goes, and a model of it for more ranks. Run it inside of scripts/toolchain:

    benchmarks/scaling.py [--program PROGRAM] [--most-ranks 16] [--cells 4] [--document]

Linear statics of beams of --cells^3 times four cuboids for each rank at degree
3, 8 and 64 times as many at degrees 2 and 1, on 1, 2, 4, .. ranks, and on one.
If there are more ranks than cores, ranks share them, and only iterations and
memory count. The model takes the times of one rank and of two and computes
those of up to 1,024 ranks for 1e9 unknowns; its assumptions are in doc/scaling.md, into which --document writes
the tables.

The status is 1 if a body takes more than two iterations more than on one rank, if the largest takes more than three more than the smallest, if
one rank has more than 1.3 times the memory of the mean, or if the model is wrong by more than a third for two ranks.
"""

import argparse
import dataclasses
import math
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True

from end_to_end import MOST_OVER_MEAN, ROOT, run  # pylint: disable=wrong-import-position
from program_runs import BY_AGGREGATION, bent_body, box, document  # pylint: disable=wrong-import-position

PAGE = ROOT / "doc" / "scaling.md"
MOST_MORE_BY_RANKS, MOST_MORE_BY_SIZE = 2, 3
MOST_ERROR = 1 / 3
# The network between machines, for each rank: seconds for a message, and bytes
# per second.
LATENCY, BANDWIDTH = 2e-6, 1e9
# The number of pieces that touch a piece of a space-filling curve, about.
NEIGHBOURS = 14
# Numbers from doc/algorithms.md ("Between ranks"): messages of an iteration to
# each neighbour, by degree; messages of a level of aggregation each time that
# it is visited; and sums over all ranks.
MESSAGES, MESSAGES_OF_LEVEL, SUMS = {1: 2, 2: 20, 3: 38}, 8, 2
# Measured numbers of points of a level for one of the next: for aggregates of
# points (degree 1 alone, and below degrees 2 and 3), and for aggregates of
# aggregates; and the most on the last level.
POINTS_OF_AGGREGATE, AGGREGATES_OF_AGGREGATE, MOST_ON_LAST_LEVEL = {1: 49, 2: 14, 3: 14}, 60, 330
# The number of unknowns for each cell in a large body of tetrahedra.
UNKNOWNS_OF_CELL = {1: 0.53, 2: 4.2, 3: 13.9}
LARGE = 1e9


@dataclasses.dataclass
class Rates:
    """Measured rates of one degree: seconds of an iteration for each unknown,
    and seconds of set-up for each cell."""
    iteration: float
    cell: float


def cuboids(ranks, n):
    """The cuboids of a body of 4 : 1 : 1 on one rank, which is doubled along
    its shortest direction for each doubling of ranks."""
    cells = [4 * n, n, n]
    for _ in range(int(math.log2(ranks))):
        shortest = cells.index(min(cells))
        cells[shortest] *= 2
    return cells


def measure(options, folder, degree, ranks, n, parts=None):
    """Runs a body as large as for `parts` ranks, by default for the ranks that
    it runs on. Returns summary and memory."""
    cells = cuboids(parts or ranks, n)
    mesh = box(f"{cells[0] / cells[1]}, 1, 1", ", ".join(map(str, cells)))
    (folder / "case.prm").write_text(bent_body(mesh, degree, "x-min", BY_AGGREGATION), encoding="utf-8")
    return run(options.program, folder, ranks)[2:]


def weak_scaling(options, folder):
    """The lines of the table, and lines on figures that exceed their limits."""
    lines = ["| degree | ranks | unknowns | iterations | on one rank | MB of the mean rank | largest over mean |", "|---:|" + "---:|" * 6]
    mistakes = []
    for degree in (1, 2, 3):
        alone = []
        n = {1: 4, 2: 2, 3: 1}[degree] * options.cells
        ranks = 1
        while ranks <= options.most_ranks:
            summary, memory = measure(options, folder, degree, ranks, n)
            iterations = summary["final"]["linear_iterations"]
            alone.append(measure(options, folder, degree, 1, n, ranks)[0]["final"]["linear_iterations"] if ranks > 1 else iterations)
            mean = sum(memory) / len(memory)
            lines.append(f"| {degree} | {ranks} | {summary['dofs']} | {iterations} | {alone[-1]} | {mean / 1e6:.0f} | {max(memory) / mean:.2f} |")
            print(lines[-1], flush=True)
            if max(memory) > MOST_OVER_MEAN * mean:
                mistakes.append(f"degree {degree}, {ranks} ranks: one has {max(memory) / mean:.2f} times the mean memory")
            if iterations > alone[-1] + MOST_MORE_BY_RANKS:
                mistakes.append(f"degree {degree}: {iterations} iterations on {ranks} ranks, {alone[-1]} on one")
            ranks *= 2
        if alone[-1] > alone[0] + MOST_MORE_BY_SIZE:
            mistakes.append(f"degree {degree}: {alone[0]} iterations for the smallest body, {alone[-1]} for the largest")
    return lines, mistakes


def rates(alone, both):
    """The rates from runs on one rank and on two, with as many cells on each:
    set-up is that of the latter, in which ranks exchange cells."""
    times, together = alone["wall_time"], both["wall_time"]
    return Rates(times["solve"] / alone["final"]["linear_iterations"] / alone["dofs"],
                 (together["setup"] - together["read"] + together["assembly"]) / (both["cells"] / 2))


def visits(degree, unknowns):
    """How often an iteration visits levels of aggregation: each level is
    visited twice as often as the one above."""
    points = unknowns / 3 / degree**3 / POINTS_OF_AGGREGATE[degree]
    visited = result = 1
    while points > MOST_ON_LAST_LEVEL:
        points /= AGGREGATES_OF_AGGREGATE
        visited *= 2
        result += visited
    return result


def predicted(degree, rate, unknowns, ranks):
    """Predicted seconds of an iteration for computing, messages and sums; and
    of set-up."""
    own = unknowns / ranks
    # The part of a rank is a cube whose surface is shared with neighbours;
    # displacements have 4 bytes.
    border = 6 * (own / 3) ** (2 / 3) * 3 * 4
    neighbours = min(NEIGHBOURS, ranks - 1)
    messages = MESSAGES[degree] * (neighbours * LATENCY + border / BANDWIDTH) if ranks > 1 else 0
    messages += MESSAGES_OF_LEVEL * visits(degree, unknowns) * neighbours * LATENCY
    sums = SUMS * 2 * math.ceil(math.log2(ranks)) * LATENCY
    cells = unknowns / UNKNOWNS_OF_CELL[degree]
    return own * rate.iteration, messages, sums, rate.cell * cells / ranks


def model(options, folder):
    """The lines of the table, and lines on figures that exceed their limits."""
    lines = ["| degree | ranks | unknowns on each | iteration: computing | messages | sums | efficiency | set-up |",
             "|---:|" + "---:|" * 7]
    mistakes = []
    for degree in (1, 2, 3):
        n = {1: 12, 2: 6, 3: 4}[degree] * options.cells
        alone, both = (min((measure(options, folder, degree, ranks, n)[0] for _ in range(3)), key=lambda one: one["wall_time"]["solve"])
                       for ranks in (1, 2))
        rate = rates(alone, both)
        expected = sum(predicted(degree, rate, both["dofs"], 2)[:3])
        found = both["wall_time"]["solve"] / both["final"]["linear_iterations"]
        print(f"degree {degree}, 2 ranks, {both['dofs']} unknowns: an iteration takes {found:.3g} s, the model says {expected:.3g}", flush=True)
        if abs(expected / found - 1) > MOST_ERROR:
            mistakes.append(f"degree {degree}: an iteration on two ranks takes {found:.3g} s, the model says {expected:.3g}")
        for ranks in (64, 256, 1024):
            computing, messages, sums, set_up = predicted(degree, rate, LARGE, ranks)
            lines.append(f"| {degree} | {ranks} | {LARGE / ranks:.2g} | {computing:.2g} | {messages:.2g} | {sums:.2g} | "
                         f"{100 * computing / (computing + messages + sums):.0f} % | {set_up:.2g} |")
            print(lines[-1], flush=True)
    return lines, mistakes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "corotet"))
    parser.add_argument("--most-ranks", type=int, default=16)
    parser.add_argument("--cells", type=int, default=4)
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        weak, mistakes = weak_scaling(options, folder)
        large, more = model(options, folder)
    if options.document:
        document(PAGE, "weak scaling", weak)
        document(PAGE, "model", large)
    for mistake in mistakes + more:
        print(mistake)
    return 1 if mistakes + more else 0


if __name__ == "__main__":
    sys.exit(main())
