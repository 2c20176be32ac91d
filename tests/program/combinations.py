#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Random combinations of entries, each computed twice: once on one rank with a
direct solver, once on 1, 2 or 3 ranks with another solver. Both must end with
status 0 and agree to solver tolerance.

A combination is made by a number, its seed; `combinations.py --seeds 0 300`
runs 300 of them and names those that disagree. The problem is posed in units of
the body's length L, Young's modulus E and density rho, and then given to the
program in random units, from which the results are converted back.

How close results must be: Newton's method and linear solvers have tolerances of 1e-10 and 1e-11 here, relative to the forces and
the displacement; a soft direction of these bodies (length over thickness up to 3, strains down to 1e-6) makes at most some 1e3 of
that, and so do some steps of dynamics. So displacements must agree to
- 1e-7 of the largest difference of displacements in the body;
- 1e4 roundings of the largest displacement, to which strains are known where a
  body has moved far;
- in static load steps whose support moves, to 1e-8 of the largest displacement, since linear solves begin with the forces of that
  motion: all of it if the material is linear; if not, no more than 1e4 roundings of the length, as Newton's method removes what is
  above its estimate of round-off, which is up to 700 times the true one.
The tolerances of energies follow from these.
"""

import argparse
import functools
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

from support import ROOT, ProgramTest, has_preconditioner, parameter_text, read_history, run_on

EPSILON = 2.0**-52
N_SEEDS_IN_CI = 30


@functools.cache
def time_integration():
    """The section with the time integration, as the program lists it."""
    listing = subprocess.run([os.environ["COROTET_PROGRAM"], "--print-parameters", "json"], capture_output=True, text=True, check=True)
    return json.loads(listing.stdout)["Time integration"]


def components(*values):
    return "; ".join(f"{value:.17g}" if isinstance(value, float) else str(value) for value in values)


class Combination:
    """The entries of a parameter file, and its units."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.entries = {}
        self.length = 10 ** self.random.uniform(-9, 6)
        self.modulus = 10 ** self.random.uniform(-3, 12)
        self.density = 10 ** self.random.uniform(-2, 4)
        self.time = self.length * math.sqrt(self.density / self.modulus)
        self.choose_body()
        self.choose_law()
        self.choose_integrator()
        self.choose_loads()
        self.choose_solvers()
        if self.entries["Discretization/Degree"] == 1:
            self.choose("Material/Dilatation", "cells", "vertices")

    def choose(self, entry, *values):
        self.entries[entry] = self.random.choice(values)
        return self.entries[entry]

    def choose_body(self):
        self.curved = self.random.random() < 0.25
        self.entries["Mesh/Scale"] = self.length
        if self.curved:
            # The mesh is a thick sphere's octant with radii 1 and 2, held in
            # its planes of symmetry.
            self.entries["Mesh/Type"] = "gmsh"
            self.entries["Mesh/gmsh/File"] = ROOT / "meshes" / "sphere_octant.geo"
            self.choose("Mesh/gmsh/Geometry degree", 2, 3)
            self.entries["Mesh/gmsh/Element size"] = 1.2
            self.support, self.loaded = None, "inside"
            self.probes = {"base": (1, 0, 0), "tip": (0, 0, 2)}
        else:
            self.entries["Mesh/Type"] = "box"
            self.choose("Mesh/box/Size", "1, 1, 1", "2, 1, 1", "3, 1, 1")
            self.entries["Mesh/box/Cells"] = self.random.choice(("2, 1, 1", "3, 2, 1", "2, 2, 2"))
            self.support, self.loaded = "x-min", "x-max"
            size = [float(word) for word in self.entries["Mesh/box/Size"].split(",")]
            self.probes = {"base": (0, 0, 0), "tip": tuple(size)}
        self.entries["Output/Probes"] = ", ".join(
            f"{name}: " + " ".join(f"{x * self.length:.17g}" for x in point) for name, point in self.probes.items())
        degree = self.choose("Discretization/Degree", 1, 2, 3)
        masses = {1: ("consistent", "diagonal scaling", "row sum"),
                  2: ("consistent", "diagonal scaling", "nodal quadrature"),
                  3: ("consistent", "diagonal scaling")}[degree]
        self.choose("Discretization/Mass", *masses)

    def choose_law(self):
        self.linear = self.choose("Material/Type", "linear", "corotational", "corotational") == "linear"
        self.choose("Material/Rotation", "cell centre", "quadrature points", "cell centre, variational")
        self.entries["Material/Young's modulus"] = self.modulus
        self.choose("Material/Poisson's ratio", 0., 0.3, 0.45)
        self.entries["Material/Density"] = self.density
        self.frozen = self.choose("Newton/Tangent", "consistent", "consistent", "frozen rotation") != "consistent"
        self.entries["Newton/Maximum iterations"] = 400
        self.entries["Newton/Residual tolerance"] = 1e-10
        self.entries["Newton/Increment tolerance"] = 1e-10
        self.entries["Linear solver/Tolerance"] = 1e-11

    def choose_integrator(self):
        section = time_integration()
        integrator = self.choose("Time integration/Type", *section["Type"]["allowed"].removeprefix("one of ").split(", "))
        # Explicit methods choose a part of their stable step; statics has load
        # steps.
        self.explicit = "Safety factor" in section.get(integrator, {})
        self.static = "Load steps" in section.get(integrator, {})
        steps = 4
        dt = self.random.choice((0.05, 0.5, 5.))
        if self.explicit:
            steps, dt = 1, 0.5
        self.duration = steps * dt
        self.entries["Time integration/End time"] = self.duration * self.time
        self.entries["Time integration/Time step"] = 0 if self.explicit else dt * self.time
        self.entries["Time integration/static/Load steps"] = 2
        if not self.static and not self.explicit:
            self.choose("Newton/Linearly implicit", "false", "false", "true")
        damping = self.random.choice((None, "Mass coefficient", "Stiffness coefficient"))
        if damping and not self.static:
            factor = 1 / self.time if damping == "Mass coefficient" else self.time
            self.entries["Damping/" + damping] = 0.1 * factor

    def choose_loads(self):
        # The load is given as traction over modulus: with length over thickness
        # up to 3, bodies bend by some 50 times that strain.
        strain = self.random.choice((1e-6, 1e-4, 2e-3))
        scale = f"(t / {self.duration * self.time:.17g})"
        load = self.random.choice(("gravity", "traction", "pressure", "support"))
        if self.curved and load in ("gravity", "support"):
            load = "pressure"
        stress = strain * self.modulus
        self.entries["Loads/Gravity"] = components(0., 0.3 * strain * self.length / self.time**2, -strain * self.length / self.time**2) \
            if load == "gravity" else "0; 0; 0"
        if load == "traction":
            self.entries["Boundary conditions/Traction"] = f"{self.loaded}: " + components(
                f"{stress:.17g} * {scale}", f"{-stress:.17g}", 0)
        if load == "pressure":
            self.entries["Boundary conditions/Pressure"] = f"{self.loaded}: {stress:.17g} * {scale}"
        self.supports_move = False
        if self.curved:
            self.entries["Boundary conditions/Displacement"] = "x-min: 0; free; free, y-min: free; 0; free, z-min: free; free; 0"
            return
        # A support carries the body far away, up to a thousand times its
        # length; in dynamics with an acceleration that bends the body, which
        # moves along from the start.
        distance, acceleration = 0., 0.
        if load == "support":
            self.supports_move = True
            distance = self.random.choice((1e-3, 1., 1e3))
            acceleration = 0. if self.static else strain
        speed = distance * self.length / (self.duration * self.time)
        motion = f"{speed:.17g} * t + {0.5 * acceleration * self.length / self.time**2:.17g} * t^2"
        self.entries["Boundary conditions/Displacement"] = f"{self.support}: " + components(0, motion, f"0.5 * ({motion})")
        if not self.static:
            self.entries["Initial conditions/Velocity"] = components(0, speed, 0.5 * speed)

    def choose_solvers(self):
        by_cell = self.linear or (self.frozen and self.entries["Material/Rotation"] == "cell centre")
        self.reference = {"Linear solver/Type": "direct"}
        self.other = {"Linear solver/Type": self.random.choice(("p-multigrid", "p-multigrid", "p-multigrid", "jacobi", "amg"))}
        self.other["Linear solver/p-multigrid/Coarse solver"] = self.random.choice(("automatic", "direct", "aggregation", "amg"))
        if not has_preconditioner("amg"):
            for entry, another in (("Type", "p-multigrid"), ("p-multigrid/Coarse solver", "aggregation")):
                if self.other[f"Linear solver/{entry}"] == "amg":
                    self.other[f"Linear solver/{entry}"] = another
        if by_cell and self.entries["Newton/Tangent"] != "consistent":
            self.other["Linear solver/Operator"] = self.random.choice(("matrix-free", "assembled"))
        if self.random.random() < 0.3:
            self.other["Linear solver/Method"] = "gmres"
        self.ranks = self.random.choice((1, 2, 3))

    def compare(self, histories):
        """Lines on differences between the two histories that are too large."""
        one, other = histories
        if len(one) != len(other):
            return [f"{len(one)} and {len(other)} rows"]
        value = lambda row, name: float(row[name])
        positions = [f"{probe}_{axis}" for probe in self.probes for axis in "xyz"]
        moved = max(abs(value(row, name)) for row in one for name in positions)
        strained = max(abs(value(row, f"tip_{axis}") - value(row, f"base_{axis}")) for row in one for axis in "xyz")
        if not (math.isfinite(moved) and moved > 0):
            return [f"the largest displacement is {moved}"]
        tolerance = 1e-7 * strained + 1e4 * EPSILON * moved
        left_by_solver = 0.
        if self.static and self.supports_move:
            left_by_solver = 1e-8 * moved if self.linear else min(1e-8 * moved, 1e4 * EPSILON * self.length)
        tolerance += left_by_solver
        spring = self.modulus * self.length * left_by_solver
        differences = []
        for row, other_row in zip(one, other):
            for axis in "xyz":
                difference = [value(r, f"tip_{axis}") - value(r, f"base_{axis}") for r in (row, other_row)]
                if abs(difference[1] - difference[0]) > tolerance:
                    differences.append(f"step {row['step']}: tip_{axis} - base_{axis} {difference}, allowed {tolerance:.3g}")
        for name in ("elastic_energy", "kinetic_energy", "external_work", "volume"):
            size = max(abs(value(row, name)) for row in one)
            for row, other_row in zip(one, other):
                allowed = 2 * size * (tolerance / strained if strained > 0 else math.inf)
                # The energy of a spring with about the body's stiffness, and
                # the work of its force at the moving support.
                allowed += spring * {"elastic_energy": left_by_solver, "external_work": moved}.get(name, 0.)
                if not abs(value(row, name) - value(other_row, name)) <= allowed:
                    differences.append(f"step {row['step']}: {name} {value(row, name)} and {value(other_row, name)} of {size}")
        return differences


def run(seed, folder):
    """Computes a combination twice. Returns lines on what is wrong."""
    combination = Combination(seed)
    histories = []
    for name, ranks, solver in (("one", 1, combination.reference), ("other", combination.ranks, combination.other)):
        file = folder / f"{seed}_{name}.prm"
        file.write_text(parameter_text({**combination.entries, **solver}), encoding="utf-8")
        output = folder / f"{seed}_{name}"
        arguments = [file, "--output", output, "--quiet", "--set", "Output/Time between results = 1e300"]
        try:
            result = run_on(ranks, arguments, folder, 120)
        except subprocess.TimeoutExpired:
            return [f"{name}: no end within 120 s"]
        if result.returncode != 0:
            return [f"{name} ({ranks} ranks): status {result.returncode}: {result.stderr.strip()[:400]}"]
        histories.append(read_history(output))
    return combination.compare(histories)


class Combinations(ProgramTest):

    def test_random(self):
        for seed in range(N_SEEDS_IN_CI):
            with self.subTest(seed=seed):
                self.assertEqual(run(seed, self.folder), [])


def main():
    parser = argparse.ArgumentParser(description="Runs random combinations.")
    parser.add_argument("--seeds", nargs=2, type=int, metavar=("FIRST", "END"))
    parser.add_argument("--keep", help="folder for parameter files and results")
    arguments, others = parser.parse_known_args()
    if not arguments.seeds:
        unittest.main(argv=sys.argv[:1] + others)
    failed = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(arguments.keep or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for seed in range(*arguments.seeds):
            problems = run(seed, folder)
            failed += bool(problems)
            for line in problems[:4]:
                print(f"seed {seed}: {line}", flush=True)
    print(f"{arguments.seeds[1] - arguments.seeds[0]} combinations, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main())
