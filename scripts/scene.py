# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Draws a picture of displaced bodies, coloured by a field, with a legend, for scripts/render. Needs PyVista, Pillow and matplotlib. Call
display.have_display() first."""

import dataclasses
import functools

import matplotlib
import matplotlib.font_manager
import matplotlib.ticker
import numpy as np
from PIL import Image, ImageDraw, ImageFont

BLACK, GREY, OBSTACLE = (30, 30, 30), (120, 120, 120), (205, 205, 210)


@dataclasses.dataclass
class Body:
    """A body in a state, as it is drawn: places of its vertices, triangles, values at the vertices or of the triangles, and lines between vertices."""
    points: np.ndarray
    triangles: np.ndarray
    values: np.ndarray
    lines: np.ndarray


@dataclasses.dataclass
class Shape:
    """Rigid obstacles in a state: places of the vertices, triangles, and for each triangle whether one looks through it."""
    points: np.ndarray
    triangles: np.ndarray
    is_clear: np.ndarray


@dataclasses.dataclass
class Legend:
    """The legend. Colours go from the value `low` to the value `high`; `least` and `largest` are the extreme values of the data. All are in the unit
    of the title."""
    title: str
    low: float
    high: float
    least: float
    largest: float
    colours: str = "viridis"
    whole_numbers: bool = False

    def limits(self):
        """The interval of values that the colours span. It is never empty."""
        tiny = 1e-12 * max(abs(self.low), abs(self.high))
        return (self.low, self.high) if self.high - self.low > tiny else (self.low, self.low + max(tiny, 1e-300))

    def ticks(self):
        """The ticks of the legend, as (value, text): the ends, and round numbers between them."""
        if self.whole_numbers:
            numbers = sorted({int(self.low), int(self.high)} | {int(t) for t in matplotlib.ticker.MaxNLocator(6, integer=True).tick_values(self.low, self.high)
                                                                 if self.low < t < self.high})
            return [(number, str(number)) for number in numbers]
        low, high = self.limits()
        ends = [(low, number_text(self.low)), (high, number_text(self.high))]
        between = [t for t in matplotlib.ticker.MaxNLocator(5).tick_values(low, high) if 0.12 < (t - low) / (high - low) < 0.88]
        if self.high - self.low <= 1e-3 * max(abs(low), abs(high)):
            return ends if self.high > self.low else ends[:1]
        return [ends[0], *((t, number_text(t)) for t in between), ends[1]]


def number_text(value):
    """The text of a number: three digits, or all digits of a whole number up to 9999."""
    return f"{value:.{4 if abs(value) >= 999.5 else 3}g}".replace("e-0", "e-").replace("e+0", "e+").replace("-", "\N{MINUS SIGN}")


def font_size(size):
    return max(11, round(0.022 * (size[0] * size[1]) ** 0.5))


@functools.cache
def font(pixels):
    return ImageFont.truetype(matplotlib.font_manager.findfont("DejaVu Sans"), pixels)


def draw_bodies(view, bodies, shapes, outline, legend):
    """Draws the bodies and the obstacles, and the outline as lines in space. Returns an image without texts."""
    import pyvista as pv
    plotter = pv.Plotter(off_screen=True, window_size=view.size, lighting="light kit")
    plotter.set_background("white")
    plotter.enable_anti_aliasing("ssaa")
    if outline is not None and len(outline):
        add_lines(plotter, outline.reshape(-1, 3), np.arange(2 * len(outline)).reshape(-1, 2), GREY, 1.5 * font_size(view.size) / 20, 1)
    for body in bodies:
        mesh = pv.PolyData(body.points, np.insert(body.triangles, 0, 3, axis=1).ravel())
        (mesh.point_data if len(body.values) == len(body.points) else mesh.cell_data)["values"] = body.values
        mesh = mesh.compute_normals(cell_normals=False, point_normals=True, split_vertices=True, feature_angle=35, consistent_normals=False)
        plotter.add_mesh(mesh, scalars="values", clim=legend.limits(), cmap=legend.colours, show_scalar_bar=False, specular=0.15, specular_power=20,
                         ambient=0.25, diffuse=0.85, smooth_shading=True, nan_color="grey")
        if len(body.lines):
            # The lines are moved a little towards the eye, so that the surface does not hide them.
            add_lines(plotter, body.points + 1e-3 * view.height * view.towards, body.lines, BLACK, 1.2 * font_size(view.size) / 20, 0.45)
    for shape in shapes:
        add_shape(plotter, shape)
    view.set_camera(plotter)
    image = Image.fromarray(plotter.screenshot(return_img=True))
    plotter.close()
    return image


def add_shape(plotter, shape):
    import pyvista as pv
    for triangles, opacity in ((shape.triangles[~shape.is_clear], 1), (shape.triangles[shape.is_clear], 0.25)):
        if len(triangles):
            mesh = pv.PolyData(shape.points, np.insert(triangles, 0, 3, axis=1).ravel())
            mesh = mesh.compute_normals(cell_normals=False, point_normals=True, split_vertices=True, feature_angle=35, consistent_normals=False)
            plotter.add_mesh(mesh, color=[c / 255 for c in OBSTACLE], opacity=opacity, ambient=0.3, diffuse=0.7, smooth_shading=True)


def add_lines(plotter, points, lines, colour, width, opacity):
    import pyvista as pv
    mesh = pv.PolyData(points, lines=np.insert(lines, 0, 2, axis=1).ravel())
    plotter.add_mesh(mesh, color=[c / 255 for c in colour], line_width=width, opacity=opacity, lighting=False)


def draw_legend(image, legend):
    """Draws the legend at the bottom: a bar of colours with ticks, and the title."""
    width, height = image.size
    f = font_size(image.size)
    draw = ImageDraw.Draw(image)
    left, right, top = round(0.2 * width), round(0.8 * width), height - round(4.3 * f)
    n = right - left
    colours = (255 * matplotlib.colormaps[legend.colours](np.linspace(0, 1, n))[:, :3]).round().astype(np.uint8)
    image.paste(Image.fromarray(np.broadcast_to(colours, (round(0.8 * f), n, 3)).copy()), (left, top))
    low, high = legend.limits()
    for value, text in legend.ticks():
        x = left + (n - 1) * (value - low) / (high - low)
        draw.line((x, top + 0.8 * f, x, top + 1.1 * f), BLACK, 1)
        draw.text((x, top + 1.15 * f), text, BLACK, font(f), "ma")
    title = legend.title
    if (legend.least, legend.largest) != (legend.low, legend.high):
        title += f"; there are {number_text(legend.least)} to {number_text(legend.largest)}"
    for size in range(f, 7, -1):
        if draw.textlength(title, font(size)) < 0.97 * width:
            break
    draw.text((width / 2, top + 2.5 * f), title, BLACK, font(size), "ma")


def draw_axes(image, view):
    """Draws arrows along x, y and z in the lower left corner."""
    f = font_size(image.size)
    draw = ImageDraw.Draw(image)
    origin = np.array([2.6 * f, image.size[1] - 2.6 * f])
    vectors = np.stack([view.right, -view.up], axis=1) * 1.5 * f
    for axis in np.argsort(view.towards):
        end = origin + vectors[axis]
        colour = ((190, 40, 40), (30, 130, 30), (40, 70, 190))[axis]
        if np.linalg.norm(vectors[axis]) > 0.5 * f:
            draw.line((*origin, *end), colour, max(2, f // 9))
            draw.text(tuple(origin + 1.45 * vectors[axis]), "xyz"[axis], colour, font(round(0.85 * f)), "mm")


def draw_label(image, place, away, text):
    """Draws a text beside a place, on the side that the vector @p away points to."""
    f = font_size(image.size)
    draw = ImageDraw.Draw(image)
    box = np.array([draw.textlength(text, font(f)), f])
    away = away / max(np.linalg.norm(away), 1e-300)
    x, y = place + away * (0.7 * f + np.abs(away) @ box / 2)
    x = min(max(x, box[0] / 2 + 2), image.size[0] - box[0] / 2 - 2)
    draw.text((x, y), text, BLACK, font(f), "mm")


def draw_time(image, text):
    f = font_size(image.size)
    ImageDraw.Draw(image).text((f, 0.7 * f), text, BLACK, font(f), "la")
