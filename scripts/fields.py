# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The fields of a run that can be shown, by name, with their units. Needs NumPy."""

import dataclasses
import difflib

import numpy as np

from commands import WrongInput

# Titles and units of the arrays that runs write (doc/results.md).
KNOWN = {"displacement": ("displacement", "m"), "velocity": ("velocity", "m/s"), "stress": ("stress", "Pa"), "strain": ("strain", ""),
         "von_mises": ("von Mises stress", "Pa"), "principal_stress": ("principal stress", "Pa"), "error_estimate": ("estimated error", "J^(1/2)"),
         "rotation_angle": ("rotation", "rad"), "det_F": ("det F: volume relative to rest", ""), "region": ("region", ""), "rank": ("rank", "")}
PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"))
WITH_PREFIX = ("m", "m/s", "Pa", "s", "N", "J")
NUMBERS_OF_SOMETHING = ("region", "rank")


def with_prefix(largest, unit):
    """A factor and a unit for numbers up to @p largest: 0.002 m are 2 mm."""
    if unit == "rad":
        return 180 / np.pi, "degrees"
    if unit not in WITH_PREFIX:
        return 1, unit
    size, prefix = next(((size, prefix) for size, prefix in PREFIXES if largest >= size), PREFIXES[-1] if largest > 0 else (1, ""))
    return 1 / size, prefix + unit


def limits_of(name, values_of_states):
    """The least and the largest value of a field in all states. Throws WrongInput if there are values that are not finite."""
    ends = np.array([(values.min(), values.max()) for values in values_of_states])
    if not np.isfinite(ends).all():
        raise WrongInput(f"{name} is not finite in the states asked for")
    return ends[:, 0].min(), ends[:, 1].max()


def components(name, n):
    """Names of the components of an array with n components; an empty list if it is a scalar."""
    if name.startswith("principal"):
        return [f"{name}_{i + 1}" for i in range(n)]
    return [f"{name}_{part}" for part in {3: "x y z", 6: "xx yy zz xy yz xz"}[n].split()] if n in (3, 6) else []


@dataclasses.dataclass(frozen=True)
class Field:
    """A scalar of a run: an array, one of its components, or the length of its vectors."""
    name: str
    array: str
    component: int | None
    of_cells: bool
    title: str
    unit: str

    def values(self, run, state):
        """The values of the field in a state: one for each node, or one for each cell if the field belongs to cells."""
        data = (run.cell_data if self.of_cells else run.point_data)(self.array, state).astype(float)
        if data.ndim == 1:
            return data
        return np.linalg.norm(data, axis=1) if self.component is None else data[:, self.component]

    def is_number_of_something(self):
        return self.array in NUMBERS_OF_SOMETHING


def fields_of(run):
    """All fields by name. If there are values both at nodes and of cells, as there may be of the von Mises stress, the plain name means those at
    nodes, and the name after `cells.` those of cells."""
    found = {}
    for of_cells, arrays in ((True, run.cell_fields), (False, run.point_fields)):
        for array, n in arrays.items():
            title, unit = KNOWN.get(array, (array.replace("_", " "), ""))
            if of_cells and array in run.point_fields:
                found[f"cells.{array}"] = Field(f"cells.{array}", array, None, True, f"{title} of cells", unit)
                continue
            if n in (1, 3) and not array.startswith("principal"):
                found[array] = Field(array, array, None, of_cells, title, unit)
            for i, name in enumerate(components(array, n)):
                found[name] = Field(name, array, i, of_cells, f"{title} {name.rsplit('_', 1)[1]}", unit)
    return found


def nearest(wanted, names):
    """The end of an error message: the name that may be meant, and all names there are."""
    near = difflib.get_close_matches(wanted, names, 1, 0.5)
    return (f"is it {near[0]}? " if near else "") + f"There are: {', '.join(names)}"


def choose_field(run, wanted):
    """The field called @p wanted. If that is None, the recovered von Mises stress if the run has it, else the displacement."""
    fields = fields_of(run)
    if wanted is None:
        return fields["von_mises" if "von_mises" in run.point_fields else "displacement"]
    if wanted not in fields:
        raise WrongInput(f"no field '{wanted}' in {run.folder}; {nearest(wanted, list(fields))}")
    return fields[wanted]


def choose_arrays(run, wanted):
    """Two lists: names of the wanted arrays at nodes, and of the wanted arrays of cells, which have names as in fields_of(). If none is wanted,
    the lists have all names."""
    of_nodes = {name: name for name in run.point_fields}
    of_cells = {f"cells.{name}" if name in run.point_fields else name: name for name in run.cell_fields}
    names = [*of_nodes, *of_cells]
    for name in wanted or []:
        if name not in names:
            raise WrongInput(f"no field '{name}' in {run.folder}; {nearest(name, names)}")
    return [[array for name, array in arrays.items() if not wanted or name in wanted] for arrays in (of_nodes, of_cells)]


def mean_of_cells(run, values):
    """Turns values of cells into values at nodes: the mean of the cells that a node belongs to."""
    nodes = run.cells.ravel()
    n = len(run.points)
    repeated = np.repeat(values, run.cells.shape[1])
    return np.bincount(nodes, repeated, n) / np.bincount(nodes, minlength=n)


def round_factor(ratio):
    """The largest of the numbers 1, 2, 5, 10, .. that is not above the ratio, round-off aside: a ratio of 9.999999999999998 gives 10."""
    power = 10.0 ** np.floor(np.log10(ratio))
    return power * max(leading for leading in (1, 2, 5, 10) if leading * power <= ratio * (1 + 1e-9))


def choose_warp(run, states, wanted):
    """The factor that displacements are multiplied by: the number @p wanted, or a round number that makes displacements visible if @p wanted is
    "auto". The default is 1, and "auto" for modes."""
    if wanted != "auto" and not (wanted is None and run.is_modes):
        return float(1 if wanted is None else wanted)
    largest = max(np.linalg.norm(run.displacement(state), axis=1).max() for state in states)
    ratio = 0.1 * np.linalg.norm(np.ptp(run.points, axis=0)) / largest if largest > 0 else 1
    # Displacements that can be seen as they are, are not magnified.
    return 1.0 if ratio < 2 else round_factor(ratio)
