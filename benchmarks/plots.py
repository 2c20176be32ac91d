# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors

"""Results of benchmarks as pictures: throughput over size, the roofline, and times of solves."""

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "corotet"
import matplotlib.pyplot as plt  # noqa: E402

import tables  # noqa: E402

COLOURS = {name: f"C{i}" for i, name in enumerate(tables.OPERATORS)}
MARKERS = {1: "^", 2: "s", 3: "o"}
TITLES = {"matrix_free": "matrix-free", "matrix_free_mass": "matrix-free with mass", "matrix_free_float": "matrix-free, float",
          "quadrature": "quadrature", "block_csr": "3 x 3 block CSR", "eigen": "Eigen CSR", "epetra": "Trilinos Epetra CSR",
          "deal_matrix_free": "deal.II's MatrixFree"}

SOLVERS = {"p-multigrid": "CG + p-multigrid", "cg_ml": "CG + ML, assembled", "jacobi": "CG + Jacobi, matrix-free",
           "cholmod": "CHOLMOD, assembled"}


def applications(results):
    """Yields (degree, operator, result) of all operators that ran on one
    rank."""
    for name, result in results.items():
        operator = tables.operator_of(name)
        if operator is not None and result["ranks"] == 1:
            yield int(name[1]), operator, result


def save(figure, path):
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)


def show_legend(axes):
    """Shows one legend for all axes, beside the last of them."""
    entries = {}
    for axis in axes:
        for handle, label in zip(*axis.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    if entries:
        axes[-1].legend(entries.values(), entries.keys(), loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)


def draw_throughput(results, path):
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.6), sharey=True)
    for degree, axis in zip((1, 2, 3), axes):
        for operator in tables.OPERATORS:
            points = sorted((r["unknowns"], r["unknowns"] / r["seconds"] / 1e6)
                            for d, o, r in applications(results) if d == degree and o == operator)
            if points:
                axis.loglog(*zip(*points), marker=MARKERS[degree], color=COLOURS[operator], label=TITLES[operator])
        axis.set_title(f"degree {degree}")
        axis.set_xlabel("unknowns")
        axis.grid(True, which="both", alpha=0.2)
    axes[0].set_ylabel("million unknowns per second, one core")
    show_legend(axes)
    save(figure, path)


def draw_roofline(results, path):
    needed = ["machine/triad_memory", "machine/triad_cache", "machine/multiply_add_double", "machine/multiply_add_float"]
    if any(name not in results for name in needed):
        return
    memory, cache = (tables.rate(results[name], "bytes") for name in needed[:2])
    peaks = {"double": tables.rate(results[needed[2]], "flops"), "float": tables.rate(results[needed[3]], "flops")}
    figure, axis = plt.subplots(figsize=(6.5, 4.2))
    low, high = 0.05, 100.0
    for bandwidth, word in ((memory, "memory"), (cache, "second-level cache")):
        knee = peaks["double"] / bandwidth
        axis.loglog([low, knee], [low * bandwidth, peaks["double"]], "k-", linewidth=1)
        axis.annotate(f"{word} {bandwidth:.0f} GB/s", (low * 1.2, low * 1.5 * bandwidth), fontsize=8)
    for word, peak in peaks.items():
        axis.axhline(peak, color="k", linewidth=1, linestyle="-" if word == "double" else ":")
        axis.annotate(f"{word} {peak:.0f} GFLOP/s", (high, peak * 1.05), ha="right", fontsize=8)
    seen = set()
    largest = {}
    for degree, operator, r in applications(results):
        if "flops" in r and "bytes" in r and r["unknowns"] > largest.get((degree, operator), {"unknowns": 0})["unknowns"]:
            largest[degree, operator] = r
    for (degree, operator), r in largest.items():
        axis.plot(r["flops"] / r["bytes"], tables.rate(r, "flops"), MARKERS[degree], color=COLOURS[operator],
                  label=None if operator in seen else TITLES[operator])
        seen.add(operator)
    axis.set_xlim(low, high)
    axis.set_xlabel("flops per byte (marks: degree 1 triangle, 2 square, 3 circle)")
    axis.set_ylabel("GFLOP/s, one core")
    axis.grid(True, which="both", alpha=0.2)
    axis.legend(frameon=False, fontsize=8, loc="lower right")
    save(figure, path)


def draw_solves(results, path):
    ways = ["p-multigrid", "cg_ml", "jacobi", "cholmod"]
    figure, axes = plt.subplots(1, 2, figsize=(8.5, 3.6), sharey=True)
    for degree, axis in zip((2, 3), axes):
        for i, way in enumerate(ways):
            points = sorted((r["unknowns"], r["seconds"]) for name, r in tables.of_beam(results).items()
                            if name.startswith(f"P{degree}/") and name.endswith(f"/solve/{way}"))
            if points:
                axis.loglog(*zip(*points), marker=MARKERS[degree], color=f"C{i}", label=SOLVERS[way])
        axis.set_title(f"degree {degree}")
        axis.set_xlabel("unknowns")
        axis.grid(True, which="both", alpha=0.2)
    axes[0].set_ylabel("seconds to 1e-8, set-up included, one core")
    show_legend(axes)
    save(figure, path)


def draw(results, folder, stem):
    draw_solves(results, folder / f"{stem}-solves.svg")
    draw_throughput(results, folder / f"{stem}-throughput.svg")
    draw_roofline(results, folder / f"{stem}-roofline.svg")
