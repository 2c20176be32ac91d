# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Fields that the surface can be coloured by: their values at its nodes. Data of cells become means over the cells of a node, for each region by
itself."""

import dataclasses

import numpy as np

DEGREES_PER_RADIAN = 180 / np.pi


@dataclasses.dataclass
class Option:
    """One way to colour by a field: a component, or the length of a vector (-1)."""
    name: str
    label: str
    component: int = 0
    signed: bool = False
    middle: float = 0.0  # if signed: the value between "more" and "less", at which colours change


@dataclasses.dataclass
class Field:
    name: str
    unit: str
    components: int
    options: list
    kind: str  # PointData or CellData
    array: str  # its name in the file
    factor: float = 1.0
    is_extra: bool = False  # whether it is left out if the page would be too large
    per_volume: bool = False


def vector(name, word, unit, **others):
    options = [Option(name, f"{word}, length", -1)] + [Option(f"{name}_{c}", f"{word} {c}", i, True) for i, c in enumerate("xyz")]
    return Field(name, unit, 3, options, "PointData", name, **others)


def fields_of(series, kind):
    """The fields that the time series has, in the order in which the page offers them."""
    fields = [vector("displacement", "displacement", "m")]
    if series.has("PointData", "von_mises"):
        fields.append(Field("von_mises", "Pa", 1, [Option("von_mises", "von Mises stress")], "PointData", "von_mises"))
        fields.append(Field("principal_stress", "Pa", 3, [Option("principal_1", "largest principal stress", 0, True),
                                                          Option("principal_3", "smallest principal stress", 2, True)],
                            "PointData", "principal_stress", is_extra=True))
        fields.append(Field("stress", "Pa", 6, [Option(f"stress_{c}", f"stress {c}", i, True) for i, c in enumerate(("xx", "yy", "zz", "xy", "yz", "xz"))],
                            "PointData", "stress", is_extra=True))
    else:
        fields.append(Field("von_mises", "Pa", 1, [Option("von_mises", "von Mises stress, mean of cells")], "CellData", "von_mises"))
    if kind == "modes":
        return [field for field in fields if series.has(field.kind, field.array)]
    fields.append(Field("rotation_angle", "°", 1, [Option("rotation_angle", "rotation, mean of cells")], "CellData", "rotation_angle", DEGREES_PER_RADIAN))
    fields.append(vector("velocity", "velocity", "m/s"))
    fields.append(Field("det_F", "-", 1, [Option("det_F", "volume over that at rest, mean of cells", 0, True, 1.0)], "CellData", "det_F", is_extra=True))
    fields.append(Field("error_estimate", "(J/m³)^½", 1, [Option("error_estimate", "estimated error of the raw stress, mean of cells")], "CellData",
                        "error_estimate", is_extra=True, per_volume=True))
    return [field for field in fields if series.has(field.kind, field.array)]


class CellMeans:
    """Turns data of cells into values at the nodes of a surface: the mean over the cells of the node that are in its region."""

    def __init__(self, series, surface):
        node_of = np.full(len(series.points), -1)
        nodes, cells = [], []
        for region in np.unique(surface.node_regions):
            own = np.flatnonzero(surface.node_regions == region)
            node_of[:] = -1
            node_of[surface.nodes[own]] = own
            in_region = np.flatnonzero(series.regions == region)
            found = node_of[series.cells[in_region]]
            cell, place = np.nonzero(found >= 0)
            nodes.append(found[cell, place])
            cells.append(in_region[cell])
        self.nodes, self.cells = np.concatenate(nodes), np.concatenate(cells)
        self.counts = np.bincount(self.nodes, minlength=len(surface.nodes))

    def __call__(self, values):
        return np.bincount(self.nodes, weights=values[self.cells], minlength=len(self.counts)) / self.counts


class Reader:
    """Reads the values of a field at the nodes of a surface (components x nodes)."""

    def __init__(self, series, surface, volumes):
        self.series, self.surface, self.volumes = series, surface, volumes
        self.means = CellMeans(series, surface)

    def __call__(self, field, state):
        values = self.series.values(field.kind, field.array, state).astype(float)
        if field.kind == "CellData":
            if field.per_volume:
                values /= np.sqrt(self.volumes)
            values = self.means(values)
        else:
            values = values[self.surface.nodes]
        return np.atleast_2d((field.factor * values).T)


def values_of(option, values):
    """The numbers that an option shows, from the values of its field: a component, or the length."""
    return np.linalg.norm(values, axis=0) if option.component < 0 else values[option.component]
