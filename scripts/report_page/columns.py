# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Units and names of the columns of history.csv, modes.csv and study.csv, and of the values in summary.json."""

import re

# Units of columns of history.csv: (regular expression for the name, unit). The first expression that fits counts.
UNITS = (("dt|(.*_)?time(_step)?", "s"), (".*energy|external_work|friction_work|energy_balance", "J"), ("angular_momentum_[xyz]", "kg m²/s"),
         ("momentum_[xyz]", "kg m/s"), ("(internal|.*_reaction)_moment_[xyz]", "N m"), ("(.*_)?reaction_[xyz]|.*_contact_[xyz]", "N"), ("volume|mesh_volume", "m³"),
         (".*_stress_[xyz][xyz]|.*_von_mises", "Pa"), ("max_displacement|.*_[xyz]", "m"))
# Units of names in modes.csv, study.csv and summary.json that UNITS does not give, or gives wrongly.
OTHER_UNITS = {"frequency": "Hz", "angular_frequency": "rad/s", "eigenvalue": "1/s²", "modal_mass": "kg m²", "total_mass": "kg", "h": "m",
               "peak_memory_bytes": "B", "largest_rotation_difference": "rad"}

# Errors in norms, in the columns NORM_error of study.csv; other errors there are those of quantities.
ERRORS = {"L2": "error in L2", "H1": "error in H1 (seminorm)", "energy": "error in the energy norm"}

NAMES = {
    "dt": "length of the last step", "time": "time", "dofs": "unknowns", "kinetic_energy": "kinetic energy", "elastic_energy": "elastic energy",
    "dissipated_energy": "dissipated energy", "external_work": "external work", "energy_balance": "energy balance",
    "contact_energy": "energy of contact", "friction_work": "work of friction",
    "newton_iterations": "Newton iterations", "linear_iterations": "linear iterations", "max_displacement": "largest displacement of a node",
    "min_det_F": "smallest det F", "inverted_cells": "inverted cells", "volume": "volume, displaced", "mesh_volume": "volume at rest",
    "total_mass": "mass", "degenerate_cells": "degenerate cells", "robust_rotations": "rotations by singular values",
    "clamped_cells": "cells with a clamped derivative", "rejected_steps": "rejected steps", "preconditioner_builds": "preconditioners made",
    "peak_memory_bytes": "memory, largest", "largest_rotation_difference": "rotations differ inside of cells by up to", "end_time": "time reached",
    "momentum": "momentum", "angular_momentum": "angular momentum", "reaction": "reaction of supports", "internal_moment": "internal moment",
    "h": "h, size of the cells", "wall_time": "wall time"}


def unit(column):
    """The unit of a column of history.csv; "-" if there is none."""
    return next((name for pattern, name in UNITS if re.fullmatch(pattern, column)), "-")


def any_unit(column):
    """The unit of a column of any table; "-" if there is none."""
    if (error := re.fullmatch("(.+)_error", column)) and error[1] not in ERRORS:
        return any_unit(error[1])  # the difference of a quantity from its reference
    if column.startswith("effective_mass"):
        return "kg"
    if column.startswith(("mass_share", "residual")) or re.search("_(error|order|reference)(_|$)|_order_in_time$", column):
        return "-"
    if re.fullmatch(r"frequency_\d+", column):
        return "Hz"
    return OTHER_UNITS.get(column) or unit(column)


def name(column):
    """The name of a column in words, for people."""
    return NAMES.get(column) or column.replace("_", " ")


def is_of_support(stem):
    """Whether the columns of a vector are the force or the moment of a single support or obstacle. `stem` is their name without _x, _y and _z."""
    return stem.endswith(("_reaction", "_reaction_moment", "_contact"))


def vectors(columns):
    """Names of the vectors among the columns, without _x, _y and _z, in the order of the columns."""
    columns = list(columns)
    stems = [column[:-2] for column in columns if column.endswith("_x")]
    return [stem for stem in stems if all(f"{stem}_{c}" in columns for c in "xyz")]
