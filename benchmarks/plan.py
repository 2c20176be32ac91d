# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors

"""The cases and runs of `make bench`, and the ratios that it requires. To add
one, add a line."""

from dataclasses import dataclass, field


@dataclass
class Case:
    """
    A body: polynomial degree and cuboids in x, y and z (five tetrahedra each) of the beam, or the size [m] of the
    elements of the bracket. What differs from the straight homogeneous body with Poisson's ratio 0.3 is in `arguments`.
    The label tells the unknowns.
    """

    degree: int
    cells: tuple = None
    element_size: float = None
    arguments: tuple = ()


BRACKET = "meshes/bracket.geo"

CASES = {
    "P3/20k": Case(3, (24, 3, 3)),
    "P3/60k": Case(3, (40, 4, 4)),
    "P3/240k": Case(3, (64, 7, 7)),
    "P3/840k": Case(3, (112, 10, 10)),
    "P2/20k": Case(2, (40, 4, 4)),
    "P2/60k": Case(2, (60, 6, 6)),
    "P2/240k": Case(2, (100, 10, 10)),
    "P2/870k": Case(2, (150, 16, 16)),
    "P1/20k": Case(1, (80, 8, 8)),
    "P1/60k": Case(1, (120, 12, 12)),
    "P1/110k": Case(1, (150, 15, 14)),
    "P1/1000k": Case(1, (320, 31, 31)),
    "P3/27k-bracket": Case(3, element_size=0.010),
    "P3/260k-bracket": Case(3, element_size=0.0030),
    "P3/840k-bracket": Case(3, element_size=0.0019),
    "P2/18k-bracket": Case(2, element_size=0.0060),
    "P2/144k-bracket": Case(2, element_size=0.0025),
    "P2/840k-bracket": Case(2, element_size=0.0013),
}

# Bodies of some 60,000 unknowns that are hard to precondition, by name. The
# last one has cells of aspect ratio 10.
HARD = {
    "bent": ("--bend", "1.5707963"),
    "nu-0.45": ("--poissons-ratio", "0.45"),
    "jump-1000": ("--jump", "1000"),
    "aspect-10": (),
}
for _name, _arguments in HARD.items():
    _flat = _name == "aspect-10"
    CASES[f"P3/60k-{_name}"] = Case(3, (9, 9, 9) if _flat else (40, 4, 4), arguments=_arguments)
    CASES[f"P2/60k-{_name}"] = Case(2, (13, 13, 13) if _flat else (60, 6, 6), arguments=_arguments)

# Small cases that replace large ones with --quick. Ratios get no verdict then.
QUICK_CASES = {
    "P3/240k": "P3/60k",
    "P3/840k": "P3/60k",
    "P2/240k": "P2/60k",
    "P2/870k": "P2/60k",
    "P1/110k": "P1/20k",
    "P1/1000k": "P1/60k",
}


@dataclass
class Run:
    """A process: an executable ("machine", "kernels", or a case's label) and the benchmarks that it runs."""

    what: str
    benchmarks: list = field(default_factory=lambda: [".*"])
    ranks: int = 1
    quick: bool = False


APPLICATIONS = ["assembly", "epetra", "eigen", "block_csr", "matrix_free.*", "quadrature", "deal_matrix_free"]
FREE_APPLICATIONS = ["matrix_free.*", "quadrature", "deal_matrix_free"]
UPDATES = ["rotations.*", "setup_after_rotation", "explicit_step", "(force|linearization|tangent)_.*"]
COARSE = ["direct", "aggregation", "amg"]
MULTIGRID = ["solve/p-multigrid", "solve/p-multigrid-.*"]

RUNS = [
    Run("machine", quick=True),
    Run("machine", ["triad_memory"], ranks=2, quick=True),
    Run("kernels", quick=True),
    Run("P3/20k", APPLICATIONS + MULTIGRID + ["solve/(cg_ml|cholmod|jacobi)"], quick=True),
    Run("P3/60k", APPLICATIONS + UPDATES + MULTIGRID + ["solve/(cg_ml|cholmod)", "newton/(amg|p-multigrid)"], quick=True),
    Run("P3/240k", APPLICATIONS + MULTIGRID + ["solve/(cg_ml|jacobi)", "newton.*/p-multigrid"]),
    Run("P3/840k", APPLICATIONS + UPDATES + MULTIGRID + ["solve/cg_ml"]),
    Run("P2/20k", APPLICATIONS + MULTIGRID, quick=True),
    Run("P2/60k", APPLICATIONS + UPDATES + MULTIGRID + ["solve/cg_ml"], quick=True),
    Run("P2/240k", FREE_APPLICATIONS + MULTIGRID),
    Run("P2/870k", APPLICATIONS + UPDATES + MULTIGRID + ["solve/cg_ml"]),
    Run("P1/20k", APPLICATIONS + UPDATES + ["solve/p-multigrid", "backward_euler/(amg|jacobi|p-multigrid)"], quick=True),
    Run("P1/60k", APPLICATIONS, quick=True),
    Run("P1/110k", APPLICATIONS + UPDATES + ["solve/p-multigrid", "backward_euler/(amg|jacobi|p-multigrid)"]),
    Run("P1/1000k", APPLICATIONS),
    *[Run(label, MULTIGRID, quick=CASES[label].degree == 3 and label.startswith("P3/60k"))
      for label in CASES if "-" in label],
    Run("P3/60k", ["epetra"] + FREE_APPLICATIONS + MULTIGRID, ranks=2, quick=True),
    Run("P3/840k", FREE_APPLICATIONS + MULTIGRID, ranks=2),
    Run("P3/60k", ["memory/amg"], quick=True),
    Run("P3/60k", ["memory/p-multigrid"], quick=True),
    Run("P3/240k", ["memory/amg"]),
    Run("P3/840k", ["memory/p-multigrid"]),
    Run("P2/870k", ["memory/p-multigrid"]),
]


@dataclass
class Ratio:
    """ A required ratio. Numerator and denominator are benchmarks, "NAME@RANKS"
    on several ranks: their times, or with ":COUNTER" one of their counters. A
    list stands for its largest value; without a denominator the ratio is the
    numerator. With `difference` the denominator is subtracted.
    """

    name: str
    numerator: object
    denominator: object
    prototype: str
    at_least: float = None
    at_most: float = None
    difference: bool = False


def iterations(labels, coarse="direct"):
    return [f"{label}/solve/p-multigrid-{coarse}:cg_iterations" for label in labels]


def hard(name):
    """The iterations of a hard body, for both degrees and all coarse
    solvers."""
    return [term for coarse in COARSE for term in iterations([f"P3/60k-{name}", f"P2/60k-{name}"], coarse)]


RATIOS = [
    Ratio("P3 matrix-free over Epetra SpMV", "P3/840k/epetra", "P3/840k/matrix_free", "38", at_least=25),
    Ratio("P2 matrix-free over Epetra SpMV", "P2/870k/epetra", "P2/870k/matrix_free", "19", at_least=12),
    Ratio("P3 factored over quadrature kernel", "P3/840k/quadrature", "P3/840k/matrix_free", "3.3", at_least=2.5),
    *[Ratio(f"P{label[1]} deal.II's MatrixFree over matrix-free", f"{label}/deal_matrix_free", f"{label}/matrix_free", "-",
            at_least=1) for label in ("P3/840k", "P2/870k", "P1/1000k")],
    Ratio("P3 840k static solve: CG + ML over p-multigrid", "P3/840k/solve/cg_ml", "P3/840k/solve/p-multigrid", "49 to 72",
          at_least=40),
    Ratio("P2 870k static solve: CG + ML over p-multigrid", "P2/870k/solve/cg_ml", "P2/870k/solve/p-multigrid", "14 to 18",
          at_least=12),
    Ratio("P3 p-multigrid iterations, direct P1 solve, most of all sizes",
          iterations(["P3/20k", "P3/60k", "P3/240k", "P3/840k"]), None, "13", at_most=14),
    Ratio("P3 beam: iterations at 840k less those at 20k", *iterations(["P3/840k", "P3/20k"]), "-", at_most=2,
          difference=True),
    Ratio("P2 beam: iterations at 870k less those at 20k", *iterations(["P2/870k", "P2/20k"]), "-", at_most=2,
          difference=True),
    Ratio("P3 bracket: iterations at 840k less those at 27k", *iterations(["P3/840k-bracket", "P3/27k-bracket"]), "-",
          at_most=2, difference=True),
    Ratio("P2 bracket: iterations at 840k less those at 18k", *iterations(["P2/840k-bracket", "P2/18k-bracket"]), "-",
          at_most=2, difference=True),
    Ratio("Bent by 90 degrees: most iterations", hard("bent"), None, "16", at_most=39),
    Ratio("Poisson's ratio 0.45: most iterations", hard("nu-0.45"), None, "-", at_most=39),
    Ratio("Stiffness jump of 1000: most iterations", hard("jump-1000"), None, "-", at_most=39),
    Ratio("P3 840k solve in operator applications", "P3/840k/solve/p-multigrid:solve_s", "P3/840k/matrix_free", "250",
          at_most=300),
    Ratio("JacobiSVD per cell over rotations of all cells (twisted, bent, stretched)", "P3/840k/rotations_svd",
          "P3/840k/rotations", "24", at_least=20),
    Ratio("P1 bent backward Euler step, patterns known, in Epetra SpMVs", "P1/110k/backward_euler/p-multigrid", "P1/110k/epetra",
          "VegaFEM 1000", at_most=200),
    Ratio("P1 rotations and matrix in Epetra SpMVs", "P1/110k/rotations_and_matrix", "P1/110k/epetra", "VegaFEM 61",
          at_most=25),
    Ratio("P3 set-up after rotations in operator applications", "P3/840k/setup_after_rotation", "P3/840k/matrix_free", "-",
          at_most=20),
    Ratio("P3 240k dynamic Newton iteration in Epetra SpMVs", "P3/240k/newton/p-multigrid", "P3/240k/epetra", "-",
          at_most=15),
    Ratio("P3 840k solve: one rank over two", "P3/840k/solve/p-multigrid", "P3/840k/solve/p-multigrid@2", "-", at_least=1.6),
    Ratio("P3 explicit step in operator applications", "P3/840k/explicit_step", "P3/840k/matrix_free", "-", at_most=1.6),
    Ratio("P3 matrix-free memory in bytes per unknown", "P3/840k/memory/p-multigrid:bytes_per_unknown", None, "190",
          at_most=600),
]

# The largest allowed relative difference between an operator and the same
# operator by quadrature.
DIFFERENCE = {"float": 1e-5, "": 1e-11}
# The largest allowed residual of a solve to 1e-8: the residual that conjugate
# gradients update drifts from the true one, by round-off of the forces of a
# stiff part that hangs on a soft one.
RESIDUAL = {"jump": 5e-6, "": 2e-7}
