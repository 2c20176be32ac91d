# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors

"""Results of benchmarks as tables: their content, and their form as text and on
a page."""

from dataclasses import dataclass

OPERATORS = ["matrix_free", "matrix_free_mass", "matrix_free_float", "quadrature", "block_csr", "eigen", "epetra",
             "deal_matrix_free"]
COARSE = ["direct", "aggregation", "amg"]


@dataclass
class Table:
    """Rows of text under a head, and a sentence on how they were measured."""

    title: str
    head: list
    rows: list
    note: str = ""

    def as_text(self):
        """The table as text; columns are as wide as needed, the first one
        aligned to the left."""
        rows = [[str(cell) for cell in row] for row in self.rows]
        widths = [max(len(row[i]) for row in [self.head] + rows) for i in range(len(self.head))]

        def line(row):
            return "  ".join(c.ljust(w) if i == 0 else c.rjust(w) for i, (c, w) in enumerate(zip(row, widths))).rstrip()

        lines = [self.title, line(self.head), "  ".join("-" * w for w in widths)] + [line(row) for row in rows]
        return "\n".join(lines) + "\n"

    def as_markdown(self):
        lines = [self.head, ["---"] + ["---:"] * (len(self.head) - 1)] + self.rows
        return "\n".join("| " + " | ".join(str(cell).replace("|", "\\|") for cell in line) + " |" for line in lines) + "\n"


def show(value, scale=1.0, form=".3g"):
    """A number with three digits, without an exponent where it is readable
    without."""
    if value is None:
        return "-"
    value *= scale
    return f"{value:.0f}" if form == ".3g" and 1e3 <= abs(value) < 1e7 else format(value, form)


def number(result, key, scale=1.0, form=".3g"):
    return show(result.get(key), scale, form)


def rate(result, key):
    """A counter per second, in 1e9."""
    return result[key] / result["seconds"] / 1e9 if key in result else None


def percent(value, whole):
    return show(100 * value / whole, form=".0f") if value and whole else "-"


def operator_of(name):
    """The operator that a benchmark applies, or None."""
    word = name.split("@")[0].rpartition("/")[2]
    return word if word in OPERATORS else None


def select(results, word):
    return {name: r for name, r in results.items() if f"/{word}" in name}


def of_beam(results):
    """The results for the beam: labels of other bodies have a dash."""
    return {name: r for name, r in results.items() if "-" not in name.split("/")[1]}


def ratios(rows):
    return Table("Required ratios", ["ratio", "measured", "of", "prototype", "required", "verdict"], rows)


def machine(results):
    return Table("Machine", ["benchmark", "GB/s", "GFLOP/s", "bits of a register"],
                 [[name, show(rate(r, "bytes")), show(rate(r, "flops")), number(r, "simd_bits")]
                  for name, r in results.items() if name.startswith("machine/")],
                 "The table has STREAM's triad (two reads and a write counted) in main memory and in the second-level "
                 "cache, and chains of independent multiply-adds in registers. All ranks run together; `@2` means two "
                 "ranks.")


def operators(results):
    triad = rate(results.get("machine/triad_memory", {}), "bytes")
    peak = {word: rate(results.get(f"machine/multiply_add_{word}", {}), "flops") for word in ("double", "float")}
    rows = []
    for name, r in results.items():
        operator = operator_of(name)
        if operator is None:
            continue
        bandwidth, arithmetic = rate(r, "bytes"), rate(r, "flops")
        single = r["ranks"] == 1
        rows.append([name, number(r, "unknowns", form=".0f"), number(r, "seconds", 1e3),
                     show(r["unknowns"] / r["seconds"] / 1e6), show(bandwidth), percent(bandwidth, triad) if single else "-",
                     show(arithmetic),
                     percent(arithmetic, peak["float" if "float" in operator else "double"]) if single else "-",
                     number(r, "difference", form=".1e")])
    return Table("Operators", ["y = K x", "unknowns", "ms", "MDoF/s", "GB/s", "% triad", "GFLOP/s", "% peak", "difference"],
                 rows,
                 "Times are those of one application as in conjugate gradients: before each application the vectors "
                 "are used as that method uses them, which is not timed. Each time is the least of three repetitions, "
                 "of which each gives the median over its applications. Bytes are those that must move if each number "
                 "moves once; so matrices that fit a cache exceed the triad, as that of P1/110k fits a large "
                 "third-level cache. Operations of the factored kernel are counted by running it with a number type "
                 "that counts, and those of quadrature by formula. `matrix_free` is the operator that the solver "
                 "calls, with distributed vectors and constraints; `deal_matrix_free` is that of deal.II. `difference` "
                 "is the difference from quadrature (for quadrature and deal.II, that from the factored kernel), "
                 "relative to the largest entry.")


def deal_matrix_free(results):
    rows = []
    for name, r in select(results, "deal_matrix_free").items():
        own, quadrature = (results.get(name.replace("deal_matrix_free", word), {}) for word in ("matrix_free", "quadrature"))
        ratio, by_quadrature = (r["seconds"] / o["seconds"] if o else None for o in (own, quadrature))
        rows.append([name.replace("/deal_matrix_free", ""), number(r, "unknowns", form=".0f"), number(r, "width"),
                     number(r, "own_width"), number(r, "seconds", 1e3), number(own, "seconds", 1e3),
                     number(quadrature, "seconds", 1e3), show(r["unknowns"] / r["seconds"] / 1e6),
                     show(r["unknowns"] / own["seconds"] / 1e6) if own else "-", show(ratio), show(by_quadrature),
                     show(ratio and ratio * r["width"] / r["own_width"])])
    return Table("deal.II's matrix-free operator beside this one",
                 ["y = K x", "unknowns", "width", "own width", "ms", "own ms", "own quadrature ms", "MDoF/s", "own MDoF/s",
                  "ratio", "to quadrature", "at equal width, at least"],
                 rows,
                 "The same operator of linear elasticity by deal.II's `MatrixFree` and `FEEvaluation` (`FE_SimplexP`, three "
                 "components, affine cells) with the same mesh, numbering of unknowns, supports and points of quadrature: 1, 4 "
                 "or 14, which are exact. Its functions are compiled with the options of this program's kernels. Results are "
                 "compared before anything is timed: to 1e-12 of the largest entry they must be those of `matrix_free`. `width` "
                 "is the number of cells that deal.II takes at once, `VectorizedArray<double>::size()`, which is the choice of "
                 "who built deal.II; `own width` that of this program. `ratio` is deal.II's time over that of `matrix_free`, `to "
                 "quadrature` over that of this program's kernel with the same points. The last column is what would be left of "
                 "the ratio if deal.II with the own width were faster by the whole quotient of the widths: memory, gather and "
                 "scatter make that less.")


def kernels(results):
    peak = {word: rate(results.get(f"machine/multiply_add_{word}", {}), "flops") for word in ("double", "float")}
    rows = []
    for name, r in select(results, "").items():
        if name.startswith("kernels/") and "flops" in r:
            rows.append([name.removeprefix("kernels/"), show(r["flops"] / r["cells"], form=".0f"),
                         show(1e9 * r["seconds"] / r["cells"]), show(rate(r, "flops")),
                         percent(rate(r, "flops"), peak["float" if "float" in name else "double"])])
    return Table("Kernels in the cache", ["kernel", "operations per cell", "ns per cell", "GFLOP/s", "% peak"], rows,
                 "Nodal values come from and go to the first-level cache, without gather and scatter.")


def rotations(results):
    return Table("Rotations", ["kernel", "ns per cell"],
                 [[name.removeprefix("kernels/"), show(1e9 * r["seconds"] / r["cells"])]
                  for name, r in results.items() if name.startswith("kernels/") and "flops" not in r],
                 "Each kernel computes rotations of deformation gradients in the cache, with stretches of some ten "
                 "percent.")


def solves(results):
    return Table("Linear static solves to 1e-8",
                 ["solve", "unknowns", "iterations", "set-up s", "solve s", "sum s", "residual"],
                 [[n.replace("/solve/", " "), number(r, "unknowns", form=".0f"), number(r, "cg_iterations"), number(r, "setup_s"),
                   number(r, "solve_s"), number(r, "seconds"), number(r, "residual", form=".1e")]
                  for n, r in select(of_beam(results), "solve/").items()],
                 "The beam under its weight is solved by conjugate gradients with a matrix-free operator, except in "
                 "two solves: `cg_ml` is the usual way (assembled matrix, Trilinos ML with rigid body modes), and "
                 "`cholmod` factorises that matrix. The times of these two do not contain the assembly of the "
                 "matrix. The times of p-multigrid contain the assembly of its matrix of degree 1. `p-multigrid` "
                 "chooses its solver for degree 1, and the other names with p-multigrid name it.")


def iterations(results):
    rows = []
    for label in dict.fromkeys("/".join(name.split("/")[:2]) for name in select(results, "solve/")):
        found = [results.get(f"{label}/solve/p-multigrid-{coarse}") for coarse in COARSE]
        if any(found):
            unknowns = next(r for r in found if r)["unknowns"]
            rows.append([label, show(unknowns, form=".0f")] + [number(r or {}, "cg_iterations") for r in found])
    return Table("Iterations of p-multigrid", ["body", "unknowns"] + COARSE, rows,
                 "The table has the iterations to a relative residual of 1e-8, by the solver for degree 1. Bodies are "
                 "the beam of 10 : 1 : 1, also bent by 90 degrees, with Poisson's ratio 0.45, with halves whose "
                 "stiffness differs by 1000, and with cells of aspect ratio 10; and the bracket of "
                 "`meshes/bracket.geo`, whose coarse meshes have the worse cells.")


def updates(results):
    return Table("Rotation updates and explicit steps", ["benchmark", "cells", "ns per cell", "ms", "difference"],
                 [[n, number(r, "cells", form=".0f"), show(1e9 * r["seconds"] / r["cells"]), number(r, "seconds", 1e3),
                   number(r, "difference", form=".1e")] for n, r in results.items() if "cells" in r and n[0] == "P"],
                 "The beam is twisted by two radians, bent by 1.5 and stretched by some ten percent. `rotations` "
                 "gathers, computes and stores the rotation of every cell; `rotations_svd` takes Eigen's JacobiSVD of "
                 "deformation gradients that are there already. `rotations_and_matrix` also fills the existing "
                 "sparsity. `setup_after_rotation` is all that a Newton iteration does but its solve: rotations with "
                 "internal force, operator and preconditioner. `explicit_step` is one sweep with rotations, external "
                 "force and inverse mass as vectors. `force_`, `linearization_` and `tangent_` are benchmarks of "
                 "rotations with internal force, of the data that the exact tangent stores, and of its application, "
                 "for each place where rotations are taken.")


def newton(results):
    return Table("Dynamics",
                 ["Newton iteration", "unknowns", "s", "steps per s", "Newton iterations", "linear iterations each"],
                 [[n, number(r, "unknowns", form=".0f"), number(r, "seconds"), show(1 / r["step_s"]),
                   number(r, "newton_iterations"), number(r, "linear_iterations")]
                  for n, r in select(results, "newton").items()],
                 "The beam is released from rest and integrated by generalised alpha to 1e-6, with steps of a "
                 "hundredth of the first period, or of a thousandth (`newton_short_step`). The time of an iteration "
                 "contains all that it does.")


def backward_euler(results):
    return Table("One backward Euler step from a bent state",
                 ["step", "unknowns", "iterations", "set-up s", "solve s", "all s", "first step s"],
                 [[n, number(r, "unknowns", form=".0f"), number(r, "cg_iterations"), number(r, "setup_s"),
                   number(r, "solve_s"), number(r, "seconds"), number(r, "first_s")]
                  for n, r in select(results, "backward_euler").items()],
                 "The step takes one Newton iteration: rotations, forces, matrix, preconditioner and solve to 1e-6. "
                 "The length of the step is a tenth of the first period. The first step also finds the patterns of the "
                 "preconditioner.")


def assembly(results):
    return Table("Assembled matrix", ["matrix", "unknowns", "nonzeros", "sparsity s", "assembly s", "GB", "peak GB"],
                 [[n, number(r, "unknowns", form=".0f"), number(r, "nonzeros", form=".0f"), number(r, "sparsity_s"),
                   number(r, "seconds"), number(r, "bytes", 1e-9), number(r, "peak_bytes", 1e-9)]
                  for n, r in select(results, "assembly").items()],
                 "The sparsity, and the places of cells in it, are found once.")


def memory(results):
    return Table("Memory", ["process", "unknowns", "GB", "bytes per unknown", "of these, mesh and operator data"],
                 [[n, number(r, "unknowns", form=".0f"), number(r, "peak_bytes", 1e-9),
                   number(r, "bytes_per_unknown", form=".0f"), show(r["discretization_bytes"] / r["unknowns"], form=".0f")]
                  for n, r in select(results, "memory/").items()],
                 "The table has the peak memory of a process that sets up one solve and iterates, less the memory that "
                 "it had when the serial mesh was there.")


ALL = [machine, operators, deal_matrix_free, kernels, rotations, solves, iterations, updates, newton, backward_euler, assembly,
       memory]


def details(results):
    """All tables except that of ratios, without those that have no rows."""
    return [table for table in (make(results) for make in ALL) if table.rows]
