# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors

"""Results of benchmarks as text."""

OPERATORS = ["matrix_free", "matrix_free_mass", "matrix_free_float", "quadrature", "block_csr", "eigen", "epetra"]


def table(title, head, rows):
    """Columns as wide as needed, the first to the left."""
    rows = [[str(cell) for cell in row] for row in rows]
    if not rows:
        return ""
    widths = [max(len(row[i]) for row in [head] + rows) for i in range(len(head))]

    def line(row):
        return "  ".join(c.ljust(w) if i == 0 else c.rjust(w) for i, (c, w) in enumerate(zip(row, widths))).rstrip()

    return "\n".join([title, line(head), "  ".join("-" * w for w in widths)] + [line(row) for row in rows]) + "\n"


def number(result, key, scale=1.0, form=".3g"):
    return format(result[key] * scale, form) if key in result else "-"


def rate(result, key):
    """A counter per second, in 1e9."""
    return result[key] / result["seconds"] / 1e9 if key in result else None


def show(value, form=".3g"):
    return "-" if value is None else format(value, form)


def ratios(rows):
    return table("Required ratios", ["ratio", "measured", "prototype", "required", "verdict"], rows)


def operator_of(name):
    """The operator that a benchmark applies, or None."""
    word = name.split("@")[0].rpartition("/")[2]
    return word if word in OPERATORS else None


def operators(results):
    memory = results.get("machine/triad_memory", {})
    peak = results.get("machine/multiply_add_double", {})
    triad = rate(memory, "bytes")
    flops = rate(peak, "flops")
    rows = []
    for name, r in results.items():
        if operator_of(name) is None:
            continue
        bandwidth, arithmetic = rate(r, "bytes"), rate(r, "flops")
        single = r["ranks"] == 1
        rows.append([name, number(r, "unknowns", form=".0f"), number(r, "seconds", 1e3),
                     show(r["unknowns"] / r["seconds"] / 1e6), show(bandwidth),
                     show(100 * bandwidth / triad if bandwidth and triad and single else None, ".0f"), show(arithmetic),
                     show(100 * arithmetic / flops if arithmetic and flops and single else None, ".0f"),
                     number(r, "difference", form=".1e")])
    return table("y = K x", ["benchmark", "unknowns", "ms", "MDoF/s", "GB/s", "% triad", "GFLOP/s", "% peak", "difference"],
                 rows)


def select(results, word):
    return {name: r for name, r in results.items() if f"/{word}" in name}


def details(results):
    """All tables but that of ratios."""
    parts = []
    parts.append(table("Machine (all ranks together)", ["benchmark", "GB/s", "GFLOP/s"],
                       [[n, show(rate(r, "bytes")), show(rate(r, "flops"))]
                        for n, r in results.items() if n.startswith("machine/")]))
    parts.append(operators(results))
    parts.append(table("Linear static solves to 1e-8",
                       ["benchmark", "unknowns", "iterations", "set-up s", "solve s", "sum s", "residual"],
                       [[n, number(r, "unknowns", form=".0f"), number(r, "cg_iterations"), number(r, "setup_s"),
                         number(r, "solve_s"), number(r, "seconds"), number(r, "residual", form=".1e")]
                        for n, r in select(results, "solve/").items()]))
    parts.append(table("Per cell", ["benchmark", "cells", "ns per cell", "ms", "difference"],
                       [[n, number(r, "cells", form=".0f"), show(1e9 * r["seconds"] / r["cells"]), number(r, "seconds", 1e3),
                         number(r, "difference", form=".1e")] for n, r in results.items() if "cells" in r]))
    parts.append(table("Dynamics: a Newton iteration, everything included",
                       ["benchmark", "unknowns", "s", "steps per s", "Newton iterations", "linear iterations each"],
                       [[n, number(r, "unknowns", form=".0f"), number(r, "seconds"), show(1 / r["step_s"]),
                         number(r, "newton_iterations"), number(r, "linear_iterations")]
                        for n, r in select(results, "newton").items()]))
    parts.append(table("Backward Euler: a step with one Newton iteration, from a bent state",
                       ["benchmark", "unknowns", "iterations", "set-up s", "solve s", "all s"],
                       [[n, number(r, "unknowns", form=".0f"), number(r, "cg_iterations"), number(r, "setup_s"),
                         number(r, "solve_s"), number(r, "seconds")] for n, r in select(results, "backward_euler").items()]))
    parts.append(table("Assembled matrix",
                       ["benchmark", "unknowns", "nonzeros", "sparsity s", "assembly s", "GB", "peak GB"],
                       [[n, number(r, "unknowns", form=".0f"), number(r, "nonzeros", form=".0f"), number(r, "sparsity_s"),
                         number(r, "seconds"), number(r, "bytes", 1e-9), number(r, "peak_bytes", 1e-9)]
                        for n, r in select(results, "assembly").items()]))
    parts.append(table("Peak memory of a process", ["benchmark", "unknowns", "GB", "bytes per unknown",
                                                    "before operators"],
                       [[n, number(r, "unknowns", form=".0f"), number(r, "peak_bytes", 1e-9),
                         number(r, "bytes_per_unknown", form=".0f"),
                         show(r["discretization_bytes"] / r["unknowns"], ".0f")]
                        for n, r in select(results, "memory/").items()]))
    return "\n".join(part for part in parts if part)
