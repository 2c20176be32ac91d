# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Directions and views from which a body is seen. Needs NumPy."""

import numpy as np

SIDES = {"front": (0, -1, 0), "back": (0, 1, 0), "left": (-1, 0, 0), "right": (1, 0, 0), "top": (0, 0, 1), "bottom": (0, 0, -1), "iso": (1, -1, 1)}


def direction_of(word):
    """The vector of a word such as front, top or front-right-top. None if the word is no direction, as front-back is not."""
    parts = word.split("-")
    direction = np.sum([SIDES[part] for part in parts], axis=0).astype(float) if all(part in SIDES for part in parts) else np.zeros(3)
    return direction if direction.any() else None


class View:
    """A view of the body: the vectors `right`, `up` and `towards` the eye, the point `centre` in the middle of the picture, and the `height` [m]
    of the picture at that point. With a `distance` [m] of the eye from the centre, the view is a perspective."""

    def __init__(self, size, towards, up):
        self.size = size
        self.towards = np.array(towards, float) / np.linalg.norm(towards)
        right = np.cross(up, self.towards)
        if np.linalg.norm(right) < 1e-6 * np.linalg.norm(up):
            right = np.cross((0, 1, 0) if abs(self.towards[1]) < 0.9 else (0, 0, 1), self.towards)
        self.right = right / np.linalg.norm(right)
        self.up = np.cross(self.towards, self.right)
        self.centre, self.height, self.distance = np.zeros(3), 1.0, None

    def coordinates(self, points):
        """Coordinates of points in the view, relative to the centre: to the right, upwards and towards the eye."""
        return (points - self.centre) @ np.stack([self.right, self.up, self.towards], axis=1)

    def fit(self, points, margins, perspective):
        """Chooses centre, height and distance so that all points are seen, with margins in pixels: left, right, top, bottom."""
        left, right, top, bottom = margins
        width, height = max(self.size[0] - left - right, 16), max(self.size[1] - top - bottom, 16)
        seen = self.coordinates(points)
        low, high = seen.min(axis=0), seen.max(axis=0)
        extent = np.maximum(high - low, 1e-6 * max(np.ptp(seen, axis=0).max(), 1e-300))
        scale = max(extent[0] / width, extent[1] / height)
        self.height = scale * self.size[1]
        middle = (low + high) / 2 + np.array([(right - left) / 2, (top - bottom) / 2, 0]) * scale
        self.centre = self.centre + middle @ np.stack([self.right, self.up, self.towards])
        if perspective:
            # The eye comes as near as it can while all points stay within an angle of 30 degrees and within the margins.
            seen = self.coordinates(points)
            slopes = np.tan(np.radians(15)) * np.array([width, height]) / self.size[1]
            self.distance = (seen[:, 2] + (np.abs(seen[:, :2]) / slopes).max(axis=1)).max()
            self.height = 2 * np.tan(np.radians(15)) * self.distance

    def pixels(self, points):
        """Places of points in the picture, in pixels from its upper left corner."""
        seen = self.coordinates(np.atleast_2d(points))
        scale = np.full(len(seen), self.size[1] / self.height)
        if self.distance:
            scale *= self.distance / np.maximum(self.distance - seen[:, 2], 1e-9 * self.distance)
        return np.stack([self.size[0] / 2 + scale * seen[:, 0], self.size[1] / 2 - scale * seen[:, 1]], axis=1)

    def set_camera(self, plotter):
        camera = plotter.camera
        camera.focal_point, camera.up = self.centre, self.up
        camera.position = self.centre + self.towards * (self.distance or 10 * self.height)
        camera.parallel_projection = self.distance is None
        camera.parallel_scale = self.height / 2
        if self.distance:
            camera.view_angle = np.degrees(2 * np.arctan(self.height / 2 / self.distance))
        plotter.renderer.reset_camera_clipping_range()
