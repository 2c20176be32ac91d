# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors

"""What `make bench` runs and what it must show: cases, runs and required ratios. Adding one is adding a line."""

from dataclasses import dataclass, field


@dataclass
class Case:
    """A beam: polynomial degree and cuboids in x, y and z (five tetrahedra each). The label tells the unknowns."""

    degree: int
    cells: tuple


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
}

# Cases that stand for the large ones when there is little time. Ratios get no verdict then.
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


APPLICATIONS = ["assembly", "epetra", "eigen", "block_csr", "matrix_free.*", "quadrature"]
FREE_APPLICATIONS = ["matrix_free.*", "quadrature"]
UPDATES = ["rotations.*"]
MULTIGRID = ["solve/p-multigrid.*"]

RUNS = [
    Run("machine", quick=True),
    Run("machine", ["triad_memory"], ranks=2, quick=True),
    Run("kernels", quick=True),
    Run("P3/20k", APPLICATIONS + MULTIGRID + ["solve/(cg_ml|cholmod|jacobi)"], quick=True),
    Run("P3/60k", APPLICATIONS + UPDATES + MULTIGRID + ["solve/(cg_ml|cholmod)", "newton/(amg|p-multigrid)"], quick=True),
    Run("P3/240k", APPLICATIONS + MULTIGRID + ["solve/(cg_ml|cholmod)", "newton.*/p-multigrid"]),
    Run("P3/840k", APPLICATIONS + UPDATES + MULTIGRID + ["solve/cg_ml", "setup_after_rotation", "explicit_step"]),
    Run("P2/20k", APPLICATIONS, quick=True),
    Run("P2/60k", APPLICATIONS + MULTIGRID + ["solve/cg_ml"], quick=True),
    Run("P2/870k", APPLICATIONS + MULTIGRID + ["solve/cg_ml"]),
    Run("P1/20k", APPLICATIONS + UPDATES + ["backward_euler/(amg|jacobi|p-multigrid)"], quick=True),
    Run("P1/60k", APPLICATIONS, quick=True),
    Run("P1/110k", APPLICATIONS + UPDATES + ["backward_euler/(amg|jacobi|p-multigrid)"]),
    Run("P1/1000k", APPLICATIONS),
    Run("P3/60k", ["epetra"] + FREE_APPLICATIONS + MULTIGRID, ranks=2, quick=True),
    Run("P3/840k", FREE_APPLICATIONS + MULTIGRID, ranks=2),
    Run("P3/60k", ["memory/amg"], quick=True),
    Run("P3/60k", ["memory/p-multigrid"], quick=True),
    Run("P3/240k", ["memory/amg"]),
    Run("P3/840k", ["memory/p-multigrid"]),
]


@dataclass
class Ratio:
    """
    A required ratio. Numerator and denominator are benchmarks, "NAME@RANKS" on several ranks: their times, or with
    ":COUNTER" one of their counters. Of a list it is the largest; without a denominator the numerator itself.
    """

    name: str
    numerator: object
    denominator: object
    prototype: str
    at_least: float = None
    at_most: float = None


RATIOS = [
    Ratio("P3 matrix-free over Epetra SpMV", "P3/840k/epetra", "P3/840k/matrix_free", "38", at_least=25),
    Ratio("P2 matrix-free over Epetra SpMV", "P2/870k/epetra", "P2/870k/matrix_free", "19", at_least=12),
    Ratio("P3 factored over quadrature kernel", "P3/840k/quadrature", "P3/840k/matrix_free", "3.3", at_least=2.5),
    Ratio("P3 840k static solve: CG + ML over p-multigrid", "P3/840k/solve/cg_ml", "P3/840k/solve/p-multigrid", "49 to 72",
          at_least=40),
    Ratio("P2 870k static solve: CG + ML over p-multigrid", "P2/870k/solve/cg_ml", "P2/870k/solve/p-multigrid", "14 to 18",
          at_least=12),
    Ratio("P3 p-multigrid iterations, most of all sizes",
          ["P3/20k/solve/p-multigrid:cg_iterations", "P3/60k/solve/p-multigrid:cg_iterations",
           "P3/240k/solve/p-multigrid:cg_iterations", "P3/840k/solve/p-multigrid:cg_iterations"], None, "13", at_most=14),
    Ratio("P3 840k solve in operator applications", "P3/840k/solve/p-multigrid:solve_s", "P3/840k/matrix_free", "250",
          at_most=300),
    Ratio("JacobiSVD per cell over rotations of all cells", "P3/840k/rotations_svd", "P3/840k/rotations", "24", at_least=20),
    Ratio("P1 bent backward Euler step in Epetra SpMVs", "P1/110k/backward_euler/p-multigrid", "P1/110k/epetra",
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

# Largest relative difference between an operator and the assembled matrix, and largest residual of a solve to 1e-8: that
# which conjugate gradients update drifts from the true one.
DIFFERENCE = {"float": 1e-5, "": 1e-12}
RESIDUAL = 5e-8
