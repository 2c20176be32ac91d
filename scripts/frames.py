# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Makes the frames of a picture or a film of a run: chooses the states, the view and the colours."""

import dataclasses

import numpy as np

from fields import choose_field, choose_warp, limits_of, mean_of_cells, with_prefix
from lagrange import Surface, inside
from commands import WrongInput, is_number
from scene import Body, Legend, Shape, draw_axes, draw_bodies, draw_label, draw_legend, draw_time, font_size
from views import View, direction_of

FOLD = 35  # [degrees]: edges where the surface is folded by more are drawn in the outline
MANY_TRIANGLES = 400_000
LARGEST_PLACE = 1e18  # [m]: VTK draws in single precision, and must be able to square coordinates
FROM_FRONT_RIGHT_ABOVE = (0.45, -1, 0.4)


@dataclasses.dataclass(frozen=True)
class Frame:
    """States that are shown together, each with the factor of its displacement."""
    states: tuple
    factor: float = 1.0


class Pictures:
    """All frames, in one view and with one legend. @p options are those of scripts/render."""

    def __init__(self, run, options, states):
        self.run, self.options = run, options
        self.field = choose_field(run, options.field)
        self.frames = self.choose_frames(states)
        self.states = states
        self.surface = self.make_surface()
        self.rest = self.surface.at(run.points)
        self.size_of_body = float(np.linalg.norm(np.ptp(run.points, axis=0)))
        self.warp = choose_warp(run, states, options.warp)
        self.obstacles = None if "obstacles" in options.without else run.obstacles()
        self.legend, self.factor = self.make_legend()
        self.clip = self.make_clip()
        self.outline = None if "outline" in options.without else self.rest[self.surface.lines(self.rest, FOLD)]
        self.view = self.make_view()

    def choose_frames(self, states):
        if self.options.swing:
            phases = 2 * np.pi * np.arange(self.options.swing) / self.options.swing
            return [Frame((state,), float(np.sin(phase))) for state in states for phase in phases]
        return [Frame(tuple(states))] if self.options.together else [Frame((state,)) for state in states]

    def make_surface(self):
        faces = Surface(self.run.cells, self.run.degree, 1)
        finest = int((MANY_TRIANGLES / len(faces.simplices)) ** 0.5)
        wanted = {1: 1, 2: 3, 3: 4}[self.run.degree]
        return faces if min(finest, wanted) <= 1 else Surface(self.run.cells, self.run.degree, min(finest, wanted))

    def values(self, state):
        """Values of the field in a state: at nodes, or of cells if these are to be shown as they are."""
        values = self.field.values(self.run, state)
        return mean_of_cells(self.run, values) if self.field.of_cells and not self.shows_cells() else values

    def shows_cells(self):
        return self.field.of_cells and (self.options.cells or self.field.is_number_of_something())

    def make_legend(self):
        least, largest = limits_of(self.field.name, map(self.values, self.states))
        factor, unit = with_prefix(max(abs(least), abs(largest)), self.field.unit)
        low, high = self.options.range or (factor * least, factor * largest)
        title = self.field.title + (f" [{unit}]" if unit else "")
        if self.field.of_cells and not self.shows_cells():
            title += ", means of cells at nodes"
        if self.run.is_modes:
            title += ", amplitude"
        if self.warp != 1:
            title += f"; displacement drawn × {self.warp:g}"
        return Legend(title, low, high, factor * least, factor * largest, self.options.colours, self.field.is_number_of_something()), factor

    def make_clip(self):
        """The normal of the plane of --clip, a point in it, the cells that it cuts, and these cut into straight pieces; None without --clip."""
        words = self.options.clip
        if not words:
            return None
        normal, rest = direction_of(words[0]), words[1:]
        if normal is None:
            normal, rest = words[:3], words[3:]
        normal, point = (np.array(part, float) if all(map(is_number, part)) else np.zeros(0) for part in (normal, rest))
        if len(normal) != 3 or len(point) not in (0, 3) or len(rest) != len(point) or not normal.any():
            raise WrongInput(f"found --clip {' '.join(words)}; allowed are a direction (front, left-top, .. or X Y Z) and a point X Y Z")
        if not len(point):
            point = (self.run.points.min(axis=0) + self.run.points.max(axis=0)) / 2
        side = (self.run.points - point) @ normal
        if not (side.min() < 0 < side.max()):
            raise WrongInput("the plane of --clip does not cut the body")
        # The plane is moved by a tiny distance so that no nodes lie in it, where VTK loses pieces of the cut. So cells with a face in the plane are cut,
        # too.
        point = point - 1e-6 * self.size_of_body * normal / np.linalg.norm(normal)
        side = (self.run.points - point) @ normal
        cut = (side[self.run.cells].min(axis=1) < 0) & (side[self.run.cells].max(axis=1) > 0)
        return normal, point, np.flatnonzero(cut), inside(self.run.cells[cut], self.run.degree, self.run.degree)

    def places(self, state, factor):
        places = self.run.points + self.warp * factor * self.run.displacement(state)
        if not (np.abs(places) < LARGEST_PLACE).all():
            raise WrongInput(f"the displaced body is not finite at {self.run.times[state]:g}, with displacements multiplied by {self.warp:g}")
        return places

    def shifts(self, n):
        return np.outer(np.arange(n), self.options.shift or (0, 0, 0))

    def body(self, state, factor, shift):
        nodes = self.places(state, factor) + shift
        values = self.factor * self.values(state)
        points = self.surface.at(nodes)
        shown = values[self.surface.owners] if self.shows_cells() else self.surface.at(values)
        lines = self.surface.lines(points) if self.options.mesh else np.zeros((0, 2), dtype=int)
        body = Body(points, self.surface.simplices, shown, lines)
        return self.clipped(body, nodes, values) if self.clip else body

    def shape(self, state, shift):
        """The obstacles in a state."""
        return Shape(self.obstacles.points + self.obstacles.displacement(self.run.times[state]) + shift, self.obstacles.triangles, self.obstacles.is_hollow)

    def clipped(self, body, nodes, values):
        """The part of the body that is behind the plane at rest, with the area of the cut. So all states show the same material."""
        import pyvista as pv
        normal, point, cut_cells, pieces = self.clip
        of_cells = self.shows_cells()
        shell = pv.PolyData(self.rest, np.insert(body.triangles, 0, 3, axis=1).ravel())
        solid = pv.UnstructuredGrid({pv.CellType.TETRA: pieces.simplices}, pieces.at(self.run.points))
        shell["places"], solid["places"] = body.points, pieces.at(nodes)
        if of_cells:
            shell.cell_data["values"], solid.cell_data["values"] = body.values, values[cut_cells[pieces.owners]]
        else:
            shell.point_data["values"], solid.point_data["values"] = body.values, pieces.at(values)
        parts = [shell.clip(normal, point), solid.slice(normal, point)]
        parts = [part.triangulate() for part in parts if part.n_points]
        offsets = np.cumsum([0] + [part.n_points for part in parts])
        triangles = np.concatenate([part.regular_faces + offset for part, offset in zip(parts, offsets)])
        data = [(part.cell_data if of_cells else part.point_data)["values"] for part in parts]
        lines = np.zeros((0, 2), dtype=int)
        points = np.concatenate([part["places"] for part in parts])
        if len(body.lines):
            edges = pv.PolyData(self.rest, lines=np.insert(body.lines, 0, 2, axis=1).ravel())
            edges["places"] = body.points
            edges = edges.clip(normal, point)
            lines = edges.lines.reshape(-1, 3)[:, 1:] + len(points)
            points = np.concatenate([points, edges["places"]])
            if not of_cells:
                data.append(np.zeros(edges.n_points))
        return Body(points, triangles, np.concatenate(data), lines)

    def make_view(self):
        options = self.options
        towards = np.array(FROM_FRONT_RIGHT_ABOVE)
        if options.camera:
            towards = direction_of(options.camera[0]) if len(options.camera) == 1 else np.array(options.camera, float)
        if options.position:
            towards = np.array(options.position) - np.array(options.focus or self.rest.mean(axis=0))
            if not towards.any():
                raise WrongInput("the eye is in the middle of the picture; --position and --focus must be different places")
        view = View(options.size, towards, options.up or (0, 0, 1))
        corners = self.corners(view)
        view.fit(corners, self.margins(), options.perspective)
        if options.focus or options.position:
            view.centre = np.array(options.focus or self.rest.mean(axis=0))
            if options.perspective and options.position:
                view.distance = np.linalg.norm(towards)
                view.height = 2 * np.tan(np.radians(15)) * view.distance
            elif not options.perspective:
                seen = np.abs(view.coordinates(corners)).max(axis=0)
                view.height = 2.2 * max(seen[1], seen[0] * options.size[1] / options.size[0])
        if options.height:
            view.height = options.height
            if options.perspective and not options.position:
                view.distance = view.height / (2 * np.tan(np.radians(15)))
        return view

    def corners(self, view):
        """The corners of boxes around each state and around the outline. The boxes are as small as possible, with sides along the axes of the view."""
        axes = np.stack([view.right, view.up, view.towards])
        clouds = [] if self.outline is None else [self.rest]
        for frame in self.frames:
            for state, shift in zip(frame.states, self.shifts(len(frame.states))):
                clouds.append(self.surface.at(self.places(state, frame.factor) + shift))
        boxes = [(cloud @ axes.T).min(axis=0) for cloud in clouds] + [(cloud @ axes.T).max(axis=0) for cloud in clouds]
        low, high = boxes[: len(clouds)], boxes[len(clouds) :]
        pick = np.array(np.meshgrid(*[(0, 1)] * 3)).reshape(3, -1).T
        return np.concatenate([np.where(pick, h, l) for l, h in zip(low, high)]) @ axes

    def margins(self):
        f = font_size(self.options.size)
        labels = self.options.together and "time" not in self.options.without
        side = 5 * f if labels else 1.5 * f
        above = 1.5 * f if "time" in self.options.without or self.options.together else 2.5 * f
        below = 1.5 * f if {"legend", "axes"} <= set(self.options.without) else 5.5 * f
        return side, side, above, below + (1.5 * f if labels else 0)

    def times(self):
        """A text for the time of each state, with enough digits to tell the times apart. Modes have their numbers and frequencies."""
        run, states = self.run, self.states
        if run.is_modes:
            frequencies = run.history().get("frequency")
            return {state: f"mode {run.times[state]:g}" + (f": {frequencies[state]:.5g} Hz" if frequencies is not None and state < len(frequencies) else "")
                    for state in states}
        factor, unit = (1, "") if run.is_static else with_prefix(np.abs(run.times[states]).max(), "s")
        times = factor * run.times[states]
        gap = np.diff(times).min() if len(times) > 1 else max(abs(times[0]), 1e-300) / 10
        digits = next(d for d in range(12) if np.abs(np.round(times, d) - times).max() <= 0.01 * gap or d == 11)
        return {state: (f"t = {time:.{digits}f}" if run.is_static else f"{time:.{digits}f} {unit}") for state, time in zip(states, times)}

    def draw(self, frame):
        """The picture of a frame."""
        without, texts = self.options.without, self.times()
        shown = list(zip(frame.states, self.shifts(len(frame.states))))
        bodies = [self.body(state, frame.factor, shift) for state, shift in shown]
        shapes = [self.shape(state, shift) for state, shift in shown] if self.obstacles else []
        image = draw_bodies(self.view, bodies, shapes, self.outline, self.legend)
        if "legend" not in without:
            draw_legend(image, self.legend)
        if "axes" not in without:
            draw_axes(image, self.view)
        if "time" in without:
            return image
        if not self.options.together:
            draw_time(image, texts[frame.states[0]])
            return image
        for state, body in zip(frame.states, bodies):
            draw_label(image, *self.label_place(state, body), texts[state])
        return image

    def label_place(self, state, body):
        """Where the label of a state goes: a place at the body, and the direction in which the text lies from there."""
        seen = self.view.pixels(body.points)
        low, high = seen.min(axis=0), seen.max(axis=0)
        middle = (low + high) / 2
        if self.options.shift:
            # If bodies are side by side, the label is below each body; if they are one above the other, it is to the right.
            step = np.abs(np.diff(self.view.pixels(self.shifts(2)), axis=0)[0])
            return (np.array([middle[0], high[1]]), np.array([0.0, 1.0])) if step[0] > step[1] else (np.array([high[0], middle[1]]), np.array([1.0, 0.0]))
        # The label lies beside the point that has moved farthest, on the side away from the middle.
        moved = self.surface.at(np.linalg.norm(self.run.displacement(state), axis=1))
        if moved.max() < 1e-3 * self.size_of_body:
            return np.array([middle[0], high[1]]), np.array([0.0, 1.0])
        place = self.view.pixels(self.surface.at(self.places(state, 1.0))[moved.argmax()])[0]
        return place, place - middle
