# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Encodes the surface and its states for the page: as blocks, each deflated and in base64, with a description of their content.

Numbers of states have 16 bits, relative to the largest number of their field in the state: the error is 1.5e-5 of that. For each component, the
differences from node to node, modulo 2^16, are stored one after another; all low bytes of a field come before all high bytes, as this deflates best.
js/store.js decodes the blocks.
"""

import base64
import zlib

import numpy as np

from commands import WrongInput
from results import Obstacles

from . import fields as field_module
from .fields import Reader, values_of
from .mesh import Quality
from .run import ReportError
from .surface import MAX_TRIANGLES, extract

SCALE = 32767
N_SAMPLES = 4
FEWEST_STATES = 12  # extra fields are left out before there are fewer states than this
MARGIN = 0.97


def text_of(data):
    return base64.b64encode(zlib.compress(data, 6)).decode()


def packed(values):
    """Returns the bytes of values (components x nodes), and the unit: the value that the stored number 1 stands for."""
    largest = np.abs(values).max(initial=0)
    unit = largest / SCALE if largest > 0 else 1.0
    whole = np.round(values / unit).astype(np.int16)
    differences = np.diff(whole.astype(np.uint16), axis=1, prepend=np.uint16(0)).ravel().astype("<u2")
    return np.concatenate([differences & 255, differences >> 8]).astype(np.uint8).tobytes(), unit


class Encoder:
    """Encodes the surface of a run, and as many of its states as there is room for."""

    def __init__(self, series, kind, max_triangles=MAX_TRIANGLES):
        self.series, self.kind = series, kind
        self.quality = Quality(series.points, series.cells)
        self.surface, self.n_triangles = extract(series.points, series.cells, series.regions, series.degree, max_triangles)
        self.reader = Reader(series, self.surface, self.quality.volumes)
        self.fields = field_module.fields_of(series, kind)
        self.left_out = []  # fields
        self.not_finite = 0  # states
        self.not_finite_fields = []

    @property
    def is_thinned(self):
        return len(self.surface.triangles) < self.n_triangles

    def geometry(self):
        """The block that all states share, and a list of the arrays in it, in order: [name, type, count]."""
        s = self.surface
        arrays = {"rest": s.rest.astype("<f4"), "weights": s.weights().astype("<f4"), "faces": s.faces.astype("<u4"),
                  "vertexFaces": s.vertex_faces.astype("<u4"), "triangles": s.triangles.astype("<u4"), "cellEdges": s.cell_edges.astype("<u4"),
                  "outline": s.outline.astype("<u4"), "regions": s.node_regions.astype("<i4"), "vertexPlaces": s.vertex_places.astype("<u4")}
        types = {"f": "Float32Array", "u": "Uint32Array", "i": "Int32Array"}
        return text_of(b"".join(a.tobytes() for a in arrays.values())), [[name, types[a.dtype.kind], a.size] for name, a in arrays.items()]

    def state(self, index):
        """A block with all fields of a state, and its description; None if some numbers of the state are not finite.

        If such numbers are in an extra field, the field is left out of the page, and not the state: a missing field is the smaller loss."""
        parts, units, ranges = [], [], {}
        for field in list(self.fields):
            values = self.reader(field, index)
            if not np.isfinite(values).all():
                if not field.is_extra:
                    return None
                self.fields.remove(field)
                self.not_finite_fields.append(field)
                continue
            data, unit = packed(values)
            parts.append(data)
            units.append(unit)
            for option in field.options:
                shown = values_of(option, values)
                ranges[option.name] = [float(shown.min()), float(shown.max())]
        return text_of(b"".join(parts)), {"time": float(self.series.times[index]), "index": index, "units": units, "ranges": ranges}

    def states(self, room):
        """As many blocks of states as fit into @p room bytes, with their descriptions. The states are evenly spread; the first and the last are among
        them."""
        n = len(self.series.times)
        while True:
            samples = [self.state(i) for i in {round(k * (n - 1) / (N_SAMPLES - 1)) for k in range(N_SAMPLES)}]
            sizes = [len(sample[0]) for sample in samples if sample]
            fitting = int(MARGIN * room / max(np.mean(sizes), 1)) if sizes else n
            extra = [field for field in self.fields if field.is_extra]
            if fitting >= min(n, FEWEST_STATES) or not extra:
                break
            self.left_out.append(extra[-1])
            self.fields.remove(extra[-1])
        wanted = min(n, max(fitting, 2))
        while True:
            found = self.encode_states(wanted)
            size = sum(len(block) for block, _ in found)
            if size <= room or wanted <= 2:
                return found
            wanted = max(2, min(wanted - 1, int(MARGIN * wanted * room / size)))

    def encode_states(self, wanted):
        n = len(self.series.times)
        indices = np.unique(np.round(np.linspace(0, n - 1, wanted)).astype(int)) if wanted > 1 else [n - 1]
        n_fields = None
        while n_fields != len(self.fields):  # if a field was left out of a state, it must be left out of all states
            n_fields = len(self.fields)
            found = [self.state(int(i)) for i in indices]
        self.not_finite = sum(one is None for one in found)
        found = [one for one in found if one is not None]
        if not found:
            raise ReportError(f"{self.series.path} has no state whose numbers are finite")
        return found

    def obstacles(self, times):
        """The obstacles, with their displacements in the states at some times."""
        path = self.series.path.with_name("obstacles.vtkhdf")
        if self.kind != "simulation" or not path.exists():
            return []
        try:
            return [{"points": [[float(f"{x:.7g}") for x in point] for point in points], "triangles": triangles.tolist(), "isHollow": is_hollow,
                     "moves": moves.tolist()} for points, triangles, is_hollow, moves in Obstacles(path).each(times)]
        except WrongInput as error:
            raise ReportError(str(error)) from error

    def describe(self, states, arrays):
        """The description of surface, fields and states that the page's scripts need, without the blocks."""
        s = self.surface
        return {"degree": s.degree, "nodes": len(s.nodes), "places": len(s.weights()), "nodesOfFace": s.faces.shape[1], "arrays": arrays,
                "states": states, "isThinned": self.is_thinned, "obstacles": self.obstacles([state["time"] for state in states]),
                "bounds": [s.rest.min(axis=0).tolist(), s.rest.max(axis=0).tolist()],
                "fields": [{"name": f.name, "unit": f.unit, "components": f.components, "options": [vars(o) for o in f.options]} for f in self.fields]}
