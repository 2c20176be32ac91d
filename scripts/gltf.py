# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes the displaced surface as glTF 2.0 in one binary file (.glb): a mesh with colours, the states as morph targets, and an animation of these. Needs
NumPy and VTK."""

import json
import struct

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals

from commands import MARK
from exports import colours_of, numbered, vtk_triangles

FLOAT, UNSIGNED = 5126, 5125
VERTICES, INDICES = 34962, 34963
FOLD = 35  # [degrees]: edges where the surface is folded by more look sharp
FRAMES_OF_A_SWING = 24
PLAIN = (0.2, 0.35, 0.5, 1)  # red, green, blue, opacity
OBSTACLE, HOLLOW = (0.6, 0.6, 0.62, 1), (0.6, 0.6, 0.62, 0.25)


class Buffer:
    """The binary part of the file, with the views and accessors that describe its content."""

    def __init__(self):
        self.parts, self.size, self.views, self.accessors = [], 0, [], []

    def add(self, data, target=None, limits=False):
        """Appends an array of vectors or scalars to the buffer; returns the number of its accessor."""
        data = np.ascontiguousarray(data, np.uint32 if target == INDICES else np.float32)
        kind = "SCALAR" if data.ndim == 1 else f"VEC{data.shape[1]}"
        view = {"buffer": 0, "byteOffset": self.size, "byteLength": data.nbytes}
        self.views.append(view | ({"target": target} if target else {}))
        accessor = {"bufferView": len(self.views) - 1, "componentType": UNSIGNED if target == INDICES else FLOAT, "count": len(data), "type": kind}
        if limits:
            flat = data.reshape(len(data), -1)
            accessor |= {"min": flat.min(axis=0).tolist(), "max": flat.max(axis=0).tolist()}
        self.accessors.append(accessor)
        self.parts.append(data.tobytes())
        self.size += data.nbytes
        return len(self.accessors) - 1


def linear(colours):
    """Converts colours as sent to screens (sRGB) to intensities, which glTF wants."""
    return np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)


class Skin:
    """The vertices of the file. A vertex of the surface is repeated for each side of a sharp edge, or for each triangle if colours jump between
    triangles."""

    def __init__(self, source):
        surface = source.make_surface()
        if source.flat():
            self.vertices = surface.simplices.ravel()
            self.triangles = np.arange(len(self.vertices)).reshape(-1, 3)
            self.values = lambda state: source.colour_values(state)
            return
        mesh = vtk_triangles(surface.at(source.run.points), surface.simplices)
        vertices = numpy_to_vtkIdTypeArray(np.arange(mesh.GetNumberOfPoints()), deep=True)
        vertices.SetName("vertex")
        mesh.GetPointData().AddArray(vertices)
        normals = vtkPolyDataNormals()
        normals.SetInputData(mesh)
        normals.SetFeatureAngle(FOLD)
        normals.ConsistencyOff()
        normals.NonManifoldTraversalOff()
        normals.Update()
        mesh = normals.GetOutput()
        self.vertices = vtk_to_numpy(mesh.GetPointData().GetArray("vertex")).copy()
        self.triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3).copy()
        self.values = lambda state: source.colour_values(state)[self.vertices]

    def normals(self, points):
        """Unit normals at the vertices: means of the normals of their triangles, weighted with the areas."""
        a, b, c = (points[self.triangles[:, i]] for i in range(3))
        of_triangles = np.cross(b - a, c - a)
        sums = np.stack([np.bincount(self.triangles.ravel(), np.repeat(of_triangles[:, i], 3), len(points)) for i in range(3)], axis=1)
        lengths = np.linalg.norm(sums, axis=1)
        return np.where(lengths[:, None] > 0, sums / np.where(lengths > 0, lengths, 1)[:, None], (0, 0, 1))


def write_gltf(source, path, split=False, seconds=None):
    """Writes one file in which the states follow each other at their times, counted from the first; with @p seconds, the animation is stretched to that
    length, or that of each mode. With @p split, writes a file for each state."""
    if not split:
        write_file(source, source.states, path, seconds)
        return [path.name]
    files = numbered(path, len(source.states))
    for state, file in zip(source.states, files):
        write_file(source, [state], file, seconds)
    return [file.name for file in files]


def write_file(source, states, path, seconds):
    buffer, skin = Buffer(), Skin(source)
    swings, limits = source.run.is_modes, source.colour_range()
    base = attributes(source, skin, states[0], limits, 0.0 if swings else 1.0)
    alone = len(states) == 1
    if swings and not alone:
        del base["COLOR_0"]  # colours would differ from mode to mode
    elif not alone:
        # Some programs ignore the colours of morph targets. They show these colours of the mesh: at each vertex, that of the largest value in all states.
        base["COLOR_0"] = colours(np.max([skin.values(state) for state in states], axis=0), limits)
    primitive = {"attributes": {name: buffer.add(data, VERTICES, name == "POSITION") for name, data in base.items()},
                 "indices": buffer.add(skin.triangles.ravel(), INDICES), "material": 0}
    targets = []
    for state in [] if alone and not swings else states:
        target = attributes(source, skin, state, limits, 1.0)
        if swings:
            del target["COLOR_0"]
        targets.append({name: buffer.add(data - base[name], VERTICES, name == "POSITION") for name, data in target.items()})
        source.advance()
    mesh = {"primitives": [primitive | ({"targets": targets} if targets else {})],
            "extras": {"field": source.colour_field.name, "unit": source.colour_field.unit, "range": [float(end) for end in limits],
                       "times": source.run.times[states].tolist()}}
    if targets:
        mesh["weights"] = [0] * len(targets) if swings else [1] + [0] * (len(targets) - 1)
    animations = swing(buffer, source.run, states, seconds or 1) if swings else follow(buffer, source.run.times[states], seconds) if targets else []
    rigid = rigid_nodes(buffer, source.run, states, animations)
    document = {
        "asset": {"version": "2.0", "generator": MARK},
        "scene": 0, "scenes": [{"nodes": [0]}],
        # The axis z points upwards in the run, and the axis y in glTF.
        "nodes": [{"mesh": 0, "name": source.run.folder.resolve().name, "rotation": [-(0.5 ** 0.5), 0, 0, 0.5 ** 0.5]}
                  | ({"children": list(range(1, len(rigid) + 1))} if rigid else {}), *(node for node, _ in rigid)],
        "meshes": [mesh, *(shape for _, shape in rigid)],
        "materials": [material({} if "COLOR_0" in base else {"baseColorFactor": PLAIN})]
        + ([material({"baseColorFactor": OBSTACLE}, doubleSided=True), material({"baseColorFactor": HOLLOW}, doubleSided=True, alphaMode="BLEND")]
           if rigid else []),
        "buffers": [{"byteLength": buffer.size}], "bufferViews": buffer.views, "accessors": buffer.accessors,
    } | ({"animations": animations} if animations else {})
    write_glb(path, document, buffer)


def material(colour, **properties):
    return {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.7} | colour} | properties


def rigid_nodes(buffer, run, states, animations):
    """A node and a mesh for each obstacle of the run, which the animation moves with the body. Their nodes are numbered from 1 on, and so are meshes."""
    obstacles = None if run.is_modes else run.obstacles()
    result = []
    for points, triangles, is_hollow, moves in obstacles.each(run.times[states]) if obstacles else []:
        # Each triangle has vertices of its own: sides are flat.
        places = points[triangles.ravel()]
        normals = np.cross(places[1::3] - places[0::3], places[2::3] - places[0::3])
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        attributes = {"POSITION": buffer.add(places, VERTICES, True), "NORMAL": buffer.add(np.repeat(normals, 3, axis=0), VERTICES)}
        result.append(({"mesh": len(result) + 1, "name": f"obstacle {len(result)}", "translation": moves[0].tolist()},
                       {"primitives": [{"attributes": attributes, "material": 2 if is_hollow else 1}]}))
        if animations and np.ptp(moves, axis=0).any():
            one = animations[0]
            one["samplers"].append({"input": one["samplers"][0]["input"], "output": buffer.add(moves), "interpolation": "LINEAR"})
            one["channels"].append({"sampler": len(one["samplers"]) - 1, "target": {"node": len(result), "path": "translation"}})
    return result


def colours(values, limits):
    return linear(colours_of(values, limits))


def attributes(source, skin, state, limits, factor):
    points = source.surface_points(state, factor)[skin.vertices]
    return {"POSITION": points, "NORMAL": skin.normals(points), "COLOR_0": colours(skin.values(state), limits)}


def animation(buffer, name, times, weights):
    sampler = {"input": buffer.add(times, limits=True), "output": buffer.add(weights.ravel()), "interpolation": "LINEAR"}
    return {"name": name, "samplers": [sampler], "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}


def follow(buffer, times, seconds):
    """An animation of one state after the other: each state is a target, whose weight is 1 at its time. The format wants growing times from 0 on, in
    single precision."""
    times = times - times[0]
    if seconds and times[-1] > 0:
        times = times * seconds / times[-1]
    times = times.astype(np.float32)
    for i in range(1, len(times)):
        times[i] = max(times[i], np.nextafter(times[i - 1], np.float32(np.inf)))
    return [animation(buffer, "states", times, np.eye(len(times)))]


def swing(buffer, run, modes, seconds):
    """An animation for each mode: a vibration in it."""
    phases = np.linspace(0, 2 * np.pi, FRAMES_OF_A_SWING + 1)
    frequencies = run.history()["frequency"]
    result = []
    for i, mode in enumerate(modes):
        weights = np.zeros((len(phases), len(modes)))
        weights[:, i] = np.sin(phases)
        result.append(animation(buffer, f"mode {run.times[mode]:g}: {frequencies[mode]:.5g} Hz", phases / (2 * np.pi) * seconds, weights))
    return result


def write_glb(path, document, buffer):
    text = json.dumps(document, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + buffer.size))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", buffer.size, b"BIN\0"))
        file.writelines(buffer.parts)
