# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors

"""Writes doc/measurements.md and its pictures, using only the JSON file of a
run."""

import shutil
import textwrap

import tables

PICTURES = {"throughput": ("Operators", "Throughput over size, by degree and way of application"),
            "roofline": ("Operators", "Roofline"),
            "solves": ("Linear static solves to 1e-8", "Time of linear static solves over size")}

HEAD = """# Measurements

Written by `benchmarks/run_benchmarks.py --document` from the results of `make bench` of {date}; do not edit. One machine,
{cpus} cores (as the system counts them), {bits}-bit registers, caches {caches}; load {load:.1f} when it began. Times are wall
times, and minima over repetitions if nothing else is said. All benchmarks run on one core; `@2` means two ranks. Names are
`P<degree>/<unknowns>/<benchmark>`. The body is a cantilever of 10 : 1 : 1; no two of its tetrahedra are alike.

`make bench` measures all of it again, and its exit status is 1 if a required ratio is not reached.
"""

RATIOS = """
## Required ratios

Both figures of a ratio come from the same run. A time in SpMVs or operator applications is a multiple of the time of one
y = K x of the same case, with Trilinos' matrix or matrix-free. `of` shows the two figures that were divided (or
subtracted). `prototype` is the ratio that a throw-away prototype or another code reached.

"""


def caches(machine):
    found = {}
    for cache in machine.get("caches") or []:
        if cache["type"] != "Instruction":
            found.setdefault(f"L{cache['level']} {cache['size'] / 1024:.0f} KiB")
    return ", ".join(found) or "unknown"


def page(document, ratios, pictures):
    """The page as text. @p pictures has the names of the existing pictures."""
    results, machine = document["results"], document["machine"]
    bits = results.get("machine/multiply_add_double", {}).get("simd_bits", 0)
    parts = [HEAD.format(date=str(document["date"])[:10], cpus=machine.get("num_cpus"), bits=int(bits),
                         caches=caches(machine), load=document["load"]),
             RATIOS, tables.ratios(ratios).as_markdown()]
    for table in tables.details(results):
        parts.append(f"\n## {table.title}\n\n{textwrap.fill(table.note, 120)}\n\n{table.as_markdown()}")
        parts += [f"\n![{text}](pictures/measurements-{name}.svg)\n"
                  for name, (title, text) in PICTURES.items() if title == table.title and name in pictures]
    return "".join(parts)


def write(document, ratios, output, stem, folder):
    """Writes the page into @p folder, with the pictures of @p output."""
    pictures = [name for name in PICTURES if (output / f"{stem}-{name}.svg").exists()]
    for name in pictures:
        shutil.copyfile(output / f"{stem}-{name}.svg", folder / "pictures" / f"measurements-{name}.svg")
    (folder / "measurements.md").write_text(page(document, ratios, pictures), encoding="utf-8")
