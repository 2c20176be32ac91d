#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors

"""Runs the benchmarks of plan.py, checks the required ratios, and writes tables, plots and one JSON file.

Times are minima over repetitions. Exit status: 0, or 1 if a ratio is not reached, could not be measured, or a benchmark
failed or computed something wrong. With --quick smaller cases stand for the large ones, and ratios get no verdict. With
--document it measures nothing but writes doc/measurements.md from the results of the last run.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import plan
import tables

SUFFIX = re.compile(r"/(iterations:\d+|repeats:\d+|manual_time).*$")
UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
FIELDS = {"name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions", "repetition_index",
          "threads", "iterations", "real_time", "cpu_time", "time_unit", "error_occurred", "error_message"}


def quick_label(label, quick):
    return plan.QUICK_CASES.get(label, label) if quick else label


def command(run, options, output):
    pattern = "|".join(run.benchmarks)
    executable = run.what if run.what in ("machine", "kernels") else "case"
    words = [str(options.build / "benchmarks" / f"bench_{executable}")]
    if executable == "case":
        case = plan.CASES[run.what]
        words += ["--label", run.what, "--degree", str(case.degree), *case.arguments]
        if case.cells:
            words += ["--cells", ",".join(map(str, case.cells))]
        else:
            words += ["--mesh", plan.BRACKET, "--clamped", "wall", "--element-size", str(case.element_size)]
    words += [f"--benchmark_filter=^{run.what.replace('.', '[.]')}/({pattern})(/iterations:|$)", f"--benchmark_out={output}",
              "--benchmark_out_format=json"]
    if run.ranks > 1:
        words = options.mpirun.split() + ["-n", str(run.ranks)] + words
    return words


def merge(document, ranks, results, failures):
    """Adds the fastest repetition of each benchmark of a process to `results`,
    and failed ones to `failures`."""
    for entry in document["benchmarks"]:
        if entry.get("run_type") != "iteration":
            continue
        name = SUFFIX.sub("", entry["name"]) + (f"@{ranks}" if ranks > 1 else "")
        if entry.get("error_occurred"):
            failures.append(f"{name}: {entry['error_message'].strip()[:300]}")
            continue
        seconds = entry["real_time"] * UNITS[entry["time_unit"]]
        if name not in results or seconds < results[name]["seconds"]:
            counters = {key: value for key, value in entry.items() if key not in FIELDS}
            results[name] = {"ranks": ranks, **counters, "seconds": seconds}


def execute(options):
    """Runs all processes. Returns results by name, the machine as Google
    Benchmark describes it, and failures."""
    results, context, failures = {}, {}, []
    runs = [run for run in plan.RUNS if run.quick or not options.quick]
    for number, run in enumerate(runs, 1):
        if options.only and not re.search(options.only, run.what):
            continue
        start = time.monotonic()
        what = run.what + (f" on {run.ranks} ranks" if run.ranks > 1 else "")
        with tempfile.TemporaryDirectory() as folder:
            output = Path(folder) / "results.json"
            print(f"[{number}/{len(runs)}] {what}:", end=" ", flush=True)
            process = subprocess.run(command(run, options, output), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                     text=True, errors="replace")
            text = output.read_text() if output.exists() else ""
        if process.returncode != 0:
            failures.append(f"{what}: exit status {process.returncode}: {process.stdout.strip()[-300:]}")
        elif text.strip():
            document = json.loads(text)
            context = context or document["context"]
            merge(document, run.ranks, results, failures)
        else:
            failures.append(f"{what}: no benchmark of that name")
        print(f"{time.monotonic() - start:.0f} s", flush=True)
    return results, context, failures


def value(term, results, quick):
    """The number that a term of a ratio stands for, or None if it has not been
    measured."""
    if isinstance(term, list):
        values = [v for v in (value(t, results, quick) for t in term) if v is not None]
        return max(values) if values and (quick or len(values) == len(term)) else None
    name, _, counter = term.partition(":")
    label, benchmark = split(name)
    result = results.get(f"{quick_label(label, quick)}/{benchmark}")
    return None if result is None else result.get(counter or "seconds")


def split(name):
    """The parts of a name: "P3/840k/solve/amg" has the case "P3/840k" and the
    benchmark "solve/amg"."""
    words = name.split("/")
    return "/".join(words[:2]), "/".join(words[2:])


def explain(term, amount):
    """The value of a term of a ratio, with its unit."""
    counter = (term[0] if isinstance(term, list) else term).partition(":")[2]
    if counter and not counter.endswith("_s"):
        return f"{amount:.4g}"
    return f"{amount:.3g} s" if amount >= 1 else f"{amount * 1e3:.3g} ms" if amount >= 1e-3 else f"{amount * 1e6:.3g} us"


def judge(results, quick):
    """The rows of the table of ratios: name, measured value, terms, prototype,
    requirement, verdict."""
    rows = []
    for ratio in plan.RATIOS:
        above = value(ratio.numerator, results, quick)
        below = 1.0 if ratio.denominator is None else value(ratio.denominator, results, quick)
        if above is None or not below:
            measured, terms = None, "-"
        else:
            measured = above - below if ratio.difference else above / below
            terms = explain(ratio.numerator, above)
            if ratio.denominator is not None:
                terms += (" - " if ratio.difference else " / ") + explain(ratio.denominator, below)
        required = f">= {ratio.at_least:g}" if ratio.at_least is not None else f"<= {ratio.at_most:g}"
        if quick:
            verdict = "-"
        elif measured is None:
            verdict = "FAIL (not measured)"
        else:
            reached = measured >= ratio.at_least if ratio.at_least is not None else measured <= ratio.at_most
            verdict = "pass" if reached else "FAIL"
        rows.append([ratio.name, "-" if measured is None else f"{measured:.3g}", terms, ratio.prototype, required, verdict])
    return rows


def wrong_results(results):
    """Results that are wrong: a fast wrong answer does not count."""
    found = []
    for name, result in results.items():
        for what, limits in (("difference", plan.DIFFERENCE), ("residual", plan.RESIDUAL)):
            limit = next(limits[word] for word in limits if word in name)
            if not result.get(what, 0) <= limit:
                found.append(f"{name}: {what} {result[what]:.2g}; allowed is {limit:g}")
    return found


def measure(options, path):
    """Runs everything, writes the JSON file and returns its contents."""
    start = time.monotonic()
    load = os.getloadavg()[0]
    results, context, failures = execute(options)
    machine = {key: context.get(key) for key in ("num_cpus", "mhz_per_cpu", "caches")}
    document = {"date": context.get("date"), "machine": machine, "load": load, "seconds": time.monotonic() - start,
                "failures": failures, "results": results}
    options.output.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    return document


def draw(results, output, stem):
    try:
        import plots
        plots.draw(results, output, stem)
    except ImportError as error:
        print(f"no plots: {error}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=Path("build/bench"), help="folder of the build")
    parser.add_argument("--output", type=Path, default=Path("output/benchmarks"), help="folder of the results")
    parser.add_argument("--quick", action="store_true", help="small cases only")
    parser.add_argument("--only", help="only runs whose case matches this regular expression")
    parser.add_argument("--mpirun", default="mpirun --bind-to none --oversubscribe", help="how to start several ranks")
    parser.add_argument("--document", action="store_true",
                        help="measure nothing; write doc/measurements.md from the last results")
    options = parser.parse_args()

    stem = "quick" if options.quick else "benchmarks"
    path = options.output / f"{stem}.json"
    document = json.loads(path.read_text(encoding="utf-8")) if options.document else measure(options, path)
    results = document["results"]
    failures = document["failures"] + wrong_results(results)
    ratios = judge(results, options.quick)
    text = "\n".join(table.as_text() for table in [tables.ratios(ratios)] + tables.details(results))
    (options.output / f"{stem}.txt").write_text(text, encoding="utf-8")
    draw(results, options.output, stem)
    if options.document:
        import document as writer
        writer.write(document, ratios, options.output, stem, Path("doc"))
    else:
        print("\n" + text)
    if document["load"] > 0.5:
        print(f"warning: others were using this machine at the start (load {document['load']:.1f}): times may be too long")
    for failure in failures:
        print("FAIL:", failure)
    print(f"{document['seconds']:.0f} s; results: {path}")
    return 1 if failures or any(row[-1].startswith("FAIL") for row in ratios) else 0


if __name__ == "__main__":
    sys.exit(main())
