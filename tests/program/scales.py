#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The same problem in other units: figures and numbers of iterations do not depend on whether lengths are in metres, millimetres,
micrometres or kilometres, nor on how stiff and heavy the body is, in statics, dynamics, explicit and adaptive steps and modes.
"""

import math
import unittest

from support import ProgramTest, parameter_text, read_history, read_modes, read_summary

# Factors of lengths, of Young's modulus (here 1 Pa) and of the density (here 1 kg/m^3).
SYSTEMS = {
    # SI with other materials: jelly (as soft as its weight allows), steel, diamond.
    "soft": (1, 1e3, 1e3), "steel": (1, 2.1e11, 7850), "stiff": (1, 1e13, 3.5e3),
    # The same steel in other units of length; masses in kg, times in s: stresses in kg / (mm s^2) and so on.
    "millimetres": (1e3, 2.1e8, 7850e-9), "micrometres": (1e6, 2.1e5, 7850e-18), "kilometres": (1e-3, 2.1e14, 7850e9),
    # Bodies of other sizes.
    "micrometre": (1e-6, 1e9, 1e3), "thousand kilometres": (1e6, 1e11, 5e3),
    # Engineers' units: mm, tonnes, seconds and MPa.
    "mm, t, s": (1e3, 2.1e5, 7.85e-9),
}
# Factors that are powers of two, with roots that are powers of two, too: every
# sum has the same digits, so all figures are the same to the last one. A
# length, time or stress that the program compares with a constant shows here.
EXACT = {"powers of two, small": (2. ** -20, 2. ** 30, 2. ** 10), "powers of two, large": (2. ** 20, 2. ** 40, 2. ** -4)}


class Units:
    """The factors of all quantities that follow from those of lengths,
    stiffnesses and densities."""

    def __init__(self, length, stiffness, density):
        self.length, self.stiffness, self.density = length, stiffness, density
        self.time = length * math.sqrt(density / stiffness)
        self.velocity = length / self.time
        self.acceleration = self.velocity / self.time
        self.force = stiffness * length ** 2
        self.energy = self.force * length
        self.momentum = density * length ** 3 * self.velocity

    def of_column(self, name):
        """The factor of a column of history.csv or modes.csv; None if the
        column is not compared."""
        if name.endswith("energy") or name == "external_work" or name.startswith("internal_moment"):
            return self.energy
        if name.startswith("angular_momentum"):
            return self.momentum * self.length
        factors = {"time": self.time, "dt": self.time, "max_displacement": self.length, "volume": self.length ** 3, "frequency": 1 / self.time,
                   "angular_frequency": 1 / self.time, "eigenvalue": 1 / self.time ** 2, "min_det_F": 1, "newton_iterations": 1, "linear_iterations": 1,
                   "parts": 1, "rejected_steps": 1, "inverted_cells": 1, "degenerate_cells": 1, "robust_rotations": 1, "mode": 1, "step": 1}
        if name in factors:
            return factors[name]
        for start, factor in (("momentum", self.momentum), ("reaction", self.force)):
            if name.startswith(start):
                return factor
        return None


# Different units have different factors here, which tells columns of different
# units apart.
PROBE = Units(3, 5, 7)


def beam(units, cells, degree):
    """A slender beam, fixed at one end, of length 1, with Young's modulus and density 1 in these units."""
    thickness = repr(0.125 * units.length)
    return {"Mesh/Type": "box", "Mesh/box/Size": f"{units.length!r}, {thickness}, {thickness}", "Mesh/box/Cells": cells, "Discretization/Degree": degree,
            "Material/Young's modulus": repr(units.stiffness), "Material/Density": repr(units.density), "Boundary conditions/Fixed": "x-min",
            "Output/Time between results": repr(1e6 * units.time)}


def gravity(units, size):
    return {"Loads/Gravity": f"0; 0; {-size * units.acceleration!r}"}


def steps(units, kind, step, end):
    return {"Time integration/Type": kind, "Time integration/Time step": repr(step * units.time), "Time integration/End time": repr(end * units.time)}


def statics(units):
    # The beam is bent by half its length. Single precision of the
    # preconditioner rounds differently in other units, which changes the errors
    # of inexact linear solves and, squared by Newton's method, the final error:
    # with its default tolerances of 1e-8, up to 3e-12 of the energy.
    return {**beam(units, "6, 1, 1", 2), "Newton/Residual tolerance": 1e-12, "Newton/Increment tolerance": 1e-12, "Time integration/Type": "static", "Time integration/static/Load steps": 6, "Time integration/End time": repr(units.time),
            "Boundary conditions/Traction": f"x-max: 0; 0; {2e-3 * units.stiffness!r}"}


def dynamics(units):
    # The case has everything with its own unit: damping, springs, dashpots, a
    # pressure, a point force, an initial velocity.
    spring, dashpot = 0.1 * units.stiffness / units.length, 0.01 * units.stiffness / units.velocity
    return {**beam(units, "4, 1, 1", 3), **gravity(units, 1e-3), **steps(units, "generalized-alpha", 2, 20),
            "Damping/Mass coefficient": repr(0.01 / units.time), "Damping/Stiffness coefficient": repr(0.01 * units.time),
            "Supports/Elastic": f"x-max: {spring!r}; 0; 0", "Supports/Dashpots": f"x-max: 0; {dashpot!r}; 0",
            "Boundary conditions/Pressure": f"z-max: {1e-4 * units.stiffness!r} * sin(t / {units.time!r})",
            "Loads/Point forces": f"{units.length!r} 0 0: 0; {1e-6 * units.force!r}; 0",
            "Initial conditions/Velocity": f"0; {1e-3 * units.velocity / units.length!r} * x; 0"}


def explicit(units):
    # The program chooses the step.
    return {**beam(units, "6, 1, 1", 1), **gravity(units, 1e-3), **steps(units, "central difference", 0, 10), "Discretization/Mass": "diagonal scaling",
            "Output/Steps between rows": 10}


def adaptive(units):
    return {**beam(units, "4, 1, 1", 2), **gravity(units, 1e-3), **steps(units, "generalized-alpha", 1, 60), "Time integration/Adaptive step/Enabled": "true",
            "Time integration/Adaptive step/Target error": 1e-3}


def modes(units):
    return {**beam(units, "6, 1, 1", 2), "Type": "modes", "Modes/Number": 6}


def free_modes(units):
    return {**modes(units), "Boundary conditions/Fixed": "", "Modes/Number": 12}


class Scales(ProgramTest):

    def rows_of(self, problem, name, factors):
        """Rows with numbers in units of the problem itself, by columns, and how
        often a preconditioner was built."""
        units = Units(*factors)
        entries = problem(units)
        (self.folder / "scaled.prm").write_text(parameter_text(entries), encoding="utf-8")
        output = self.folder / name.replace(" ", "_")
        self.run_program("scaled.prm", "--quiet", "--output", output)
        rows = read_modes(output) if "Type" in entries else read_history(output)
        numbers = [{column: float(value) / units.of_column(column) for column, value in row.items() if units.of_column(column) is not None} for row in rows]
        return numbers, read_summary(output).get("preconditioner_builds")

    def compare(self, problem, tolerance, rigid=0):
        """@p tolerance holds for systems whose round-off differs, relative to
        the largest figure of the unit. @p rigid is the number of first rows
        that are rigid modes, whose frequencies are round-off."""
        expected, builds = self.rows_of(problem, "unit", (1, 1, 1))
        expected = expected[rigid:]
        self.assertGreater(len(expected), 2)
        for name, factors in {**SYSTEMS, **EXACT}.items():
            found, others = self.rows_of(problem, name, factors)
            found = found[rigid:]
            self.assertEqual(len(found), len(expected), name)
            for column in expected[0]:
                # The largest figure of all columns with this unit, as some
                # columns are sums that vanish.
                unit = PROBE.of_column(column)
                largest = max(abs(row[other]) for row in expected for other in row if PROBE.of_column(other) == unit)
                # Factors of time are roots, and files have decimal digits.
                allowed = largest * (1e-15 if name in EXACT else tolerance)
                if column == "linear_iterations" and name not in EXACT:
                    # Where a residual is close to its bound, round-off decides
                    # on one more iteration; and if that is one too many, a new
                    # preconditioner is built, which saves some of the following
                    # iterations.
                    allowed = max(1, 0.01 * largest) if others == builds else 0.2 * largest
                elif column.endswith("iterations"):
                    allowed = 0
                for one, other in zip(expected, found):
                    self.assertLessEqual(abs(one[column] - other[column]), allowed,
                                         f"{column} of {problem.__name__} in {name}: {other[column]!r} instead of {one[column]!r}, of at most {largest!r}")

    # Round-off, 1e-16, is multiplied by the condition of the matrices, about
    # 1e3 to 1e4 here, and grows with the number of steps.

    def test_statics(self):
        self.compare(statics, 1e-12)

    def test_dynamics(self):
        self.compare(dynamics, 1e-12)

    def test_explicit(self):
        self.compare(explicit, 1e-11)

    def test_adaptive(self):
        # The length of each step follows from an error that is a small
        # difference, 1e-3 of the displacement, and shifts all later steps.
        self.compare(adaptive, 1e-9)

    def test_modes(self):
        self.compare(modes, 1e-13)

    def test_free_modes(self):
        self.compare(free_modes, 1e-13, rigid=6)


if __name__ == "__main__":
    unittest.main()
