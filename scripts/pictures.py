# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Parts of the pictures of the documentation: states of a run, displaced surfaces, colour bars. Works without a display. Needs PyVista and
matplotlib (packages of scripts/packages.txt)."""

import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pyvista as pv

from display import have_display
from results import Run

ROOT = pathlib.Path(__file__).resolve().parent.parent
PICTURES = ROOT / "doc" / "pictures"
COLOURS = "viridis"


class Results(Run):
    """The results of one run, with states as meshes of PyVista."""

    def state(self, time):
        """The mesh with the data of the state nearest to @p time."""
        state = np.abs(self.times - time).argmin()
        cells = np.insert(self.cells, 0, self.cells.shape[1], axis=1).ravel()
        grid = pv.UnstructuredGrid(cells, np.full(len(self.cells), pv.CellType.LAGRANGE_TETRAHEDRON), self.points)
        for name in self.point_fields:
            grid.point_data[name] = self.point_data(name, state)
        for name in self.cell_fields:
            grid.cell_data[name] = self.cell_data(name, state)
        return grid


def surface(grid, warp=1.0, subdivisions=4):
    """The displaced surface of a mesh. Curved cells stay curved."""
    moved = grid.copy(deep=True)
    moved.points = grid.points + warp * grid["displacement"]
    # Data of cells become averages at nodes, for smooth colours.
    smooth = moved.cell_data_to_point_data(pass_cell_data=False)
    smooth.cell_data["cell"] = np.arange(smooth.n_cells)
    return smooth.extract_surface(nonlinear_subdivision=subdivisions)


def outline(grid):
    """The edges of the body at rest."""
    return grid.extract_surface(nonlinear_subdivision=0).extract_feature_edges(
        feature_angle=35, boundary_edges=False, non_manifold_edges=False, manifold_edges=False)


def plotter(size, columns=1):
    have_display()
    p = pv.Plotter(off_screen=True, window_size=size, shape=(1, columns), border=False)
    p.set_background("white")
    p.enable_anti_aliasing("ssaa")
    return p


def show_body(p, mesh, scalars, limits):
    p.add_mesh(mesh, scalars=scalars, clim=limits, cmap=COLOURS, show_scalar_bar=False, specular=0.2, ambient=0.25)


def camera(p, focus, direction, height):
    """Parallel projection from @p direction with z up; @p height is that of the picture in m."""
    p.camera.focal_point = focus
    p.camera.position = np.array(focus) + 10 * np.array(direction) / np.linalg.norm(direction)
    p.camera.up = (0, 0, 1)
    p.camera.parallel_projection = True
    p.camera.parallel_scale = height / 2
    p.renderer.reset_camera_clipping_range()


def image_of(p):
    """The picture that the plotter shows, without white margins."""
    image = p.screenshot(return_img=True)
    p.close()
    rows, columns = np.nonzero((image < 255).any(axis=2))
    return image[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1]


def add_image(figure, axes, image, limits, title):
    """Puts an image into axes, with a colour bar below it."""
    axes.imshow(image)
    axes.axis("off")
    colours = plt.cm.ScalarMappable(plt.Normalize(*limits), COLOURS)
    figure.colorbar(colours, ax=axes, orientation="horizontal", label=title, fraction=0.05, pad=0.04, aspect=30, shrink=0.8)


def cell_edges(mesh, angle=30):
    """The edges of cells in a displaced surface: lines between triangles that belong to different cells, or that meet at an edge of the
    body."""
    triangles = mesh.regular_faces
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    owners = np.repeat(np.arange(len(triangles)), 3)
    order = np.lexsort(sides.T)
    sides, owners = sides[order], owners[order]
    pairs = np.flatnonzero((sides[1:] == sides[:-1]).all(axis=1))
    cells = np.asarray(mesh["cell"])[owners]
    normals = mesh.face_normals[owners]
    turned = (normals[pairs] * normals[pairs + 1]).sum(axis=1) < np.cos(np.radians(angle))
    lines = sides[pairs[(cells[pairs] != cells[pairs + 1]) | turned]]
    return pv.PolyData(mesh.points, lines=np.column_stack([np.full(len(lines), 2), lines]).ravel())
