# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Units and names of what history.csv, modes.csv, study.csv and summary.json hold."""

import re

# By what their names are or end with.
UNITS = (("(time|dt|(.*_)?time|time_step)", "s"), (".*energy|external_work|energy_balance", "J"), ("angular_momentum_[xyz]", "kg m²/s"),
         ("momentum_[xyz]", "kg m/s"), ("(internal|.*_reaction)_moment_[xyz]", "N m"), ("(.*_)?reaction_[xyz]", "N"), ("volume|mesh_volume", "m³"),
         (".*_stress_[xyz][xyz]|.*_von_mises", "Pa"), ("max_displacement|.*_[xyz]", "m"))
# Of modes.csv, study.csv and summary.json, where they differ from those of history.csv.
OTHER_UNITS = {"frequency": "Hz", "angular_frequency": "rad/s", "eigenvalue": "1/s²", "modal_mass": "kg m²", "total_mass": "kg", "h": "m",
               "peak_memory_bytes": "B", "largest_rotation_difference": "rad"}

NAMES = {
    "dt": "length of the last step", "time": "time", "dofs": "unknowns", "kinetic_energy": "kinetic energy", "elastic_energy": "elastic energy",
    "dissipated_energy": "dissipated energy", "external_work": "external work", "energy_balance": "energy balance",
    "newton_iterations": "Newton iterations", "linear_iterations": "linear iterations", "max_displacement": "largest displacement of a node",
    "min_det_F": "smallest det F", "inverted_cells": "inverted cells", "volume": "volume, displaced", "mesh_volume": "volume at rest",
    "total_mass": "mass", "degenerate_cells": "degenerate cells", "robust_rotations": "rotations by singular values",
    "clamped_cells": "cells with a clamped derivative", "rejected_steps": "rejected steps", "preconditioner_builds": "preconditioners made",
    "peak_memory_bytes": "memory, largest", "largest_rotation_difference": "rotations differ inside of cells by up to", "end_time": "time reached",
    "momentum": "momentum", "angular_momentum": "angular momentum", "reaction": "reaction of supports", "internal_moment": "internal moment",
    "h": "h, size of the cells", "wall_time": "wall time"}


def unit(column):
    """Of a column of history.csv."""
    return next((name for pattern, name in UNITS if re.fullmatch(pattern, column)), "-")


def any_unit(column):
    """Of a column of any table."""
    if column.startswith("effective_mass"):
        return "kg"
    if column.startswith(("mass_share", "residual")) or re.search("_(error|order|reference)(_|$)|_order_in_time$", column):
        return "-"
    if re.fullmatch(r"frequency_\d+", column):
        return "Hz"
    return OTHER_UNITS.get(column) or unit(column)


def name(column):
    """In words, for people."""
    return NAMES.get(column) or column.replace("_", " ")


def is_of_support(stem):
    """Whether these are the force or the moment of a single support; `stem` is a name before _x, _y and _z."""
    return stem.endswith(("_reaction", "_reaction_moment"))


def vectors(columns):
    """The names before _x, _y and _z of those columns that come in threes, in order."""
    columns = list(columns)
    stems = [column[:-2] for column in columns if column.endswith("_x")]
    return [stem for stem in stems if all(f"{stem}_{c}" in columns for c in "xyz")]
