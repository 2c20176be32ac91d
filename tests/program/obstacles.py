#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Obstacles of contact to look at: obstacles.vtkhdf, and obstacles in pictures, in glTF and in the page of a run."""

import json
import re
import unittest

import numpy as np
from PIL import Image

from contact import CASE
from export import Glb
from scripts_support import ScriptTest  # and the scripts' modules
from support import parameter_text, run_on

from results import Obstacles, Run

# The block, a belt that moves, a wall, a hollow ball around all, and a peg far away; 10 steps.
ENTRIES = {**CASE, "Contact/Obstacles": CASE["Contact/Obstacles"] + ", peg: cylinder 2 0 0 2 0 3 0.5", "Time integration/End time": "0.0390625"}
DIAGONAL = (0.4**2 + 0.2**2 + 0.2**2) ** 0.5


def volume(points, triangles):
    """The volume that triangles enclose, above zero if all their normals point outwards."""
    return np.linalg.det(points[triangles]).sum() / 6


class ObstaclesToSee(ScriptTest):

    @classmethod
    def setUpClass(cls):
        """Each test makes its own runs."""

    def make(self, name, entries=ENTRIES, ranks=1, words=()):
        (self.folder / "case.prm").write_text(parameter_text(entries), encoding="utf-8")
        run = run_on(ranks, ["case.prm", "--output", self.folder / name, "--quiet", *words], self.folder, 120)
        self.assertEqual(run.returncode, 0, run.stderr)
        return self.folder / name

    def start_of(self, script, *words):
        self.script = script
        return self.start(*words)

    def test_file(self):
        """Shapes and displacements are those of the parameters, on any number of ranks."""
        for ranks in (1, 2, 3):
            with self.subTest(ranks=ranks):
                folder = self.make(f"on_{ranks}", ranks=ranks)
                obstacles = Obstacles(folder / "obstacles.vtkhdf")
                np.testing.assert_array_equal(obstacles.times, Run(folder).times)
                self.assertEqual(len(obstacles.times), 11)
                belt, wall, ball, peg = obstacles.each(obstacles.times)
                expected = np.stack([0.5 * obstacles.times, 0 * obstacles.times, 0.01 * np.sin(50 * obstacles.times)], axis=1)
                np.testing.assert_allclose(belt[3], expected, atol=1e-16)
                for one in (wall, ball, peg):
                    self.assertFalse(one[3].any())
                self.assertEqual([one[2] for one in (belt, wall, ball, peg)], [False, False, True, False])
                # The square lies in the plane, below the middle of the body.
                np.testing.assert_allclose(belt[0][:, 2], -0.002, atol=1e-15)
                np.testing.assert_allclose(belt[0].mean(axis=0)[:2], (0.2, 0.1), atol=1e-15)
                self.assertAlmostEqual(np.linalg.norm(belt[0][1] - belt[0][0]), 2 * DIAGONAL, delta=1e-14)
                np.testing.assert_array_equal(np.unique(wall[0], axis=0)[[0, -1]], ((0.41, -1, -1), (1, 1, 1)))
                self.assertAlmostEqual(volume(*wall[:2]), 0.59 * 2 * 2, delta=1e-14)
                np.testing.assert_allclose(np.linalg.norm(ball[0] - (0.2, 0.1, 0.1), axis=1), 0.5, atol=1e-15)
                # Polyhedra with 48 corners around have up to a hundredth less than round bodies.
                for one, whole in ((ball, 4 / 3 * np.pi * 0.5**3), (peg, np.pi * 0.5**2 * 3)):
                    self.assertLess(volume(*one[:2]), whole)
                    self.assertGreater(volume(*one[:2]), 0.99 * whole)

    def test_restart_and_removal(self):
        """A restarted run goes on with the series, and one that replaces it without obstacles leaves none."""
        whole = Obstacles(self.make("whole") / "obstacles.vtkhdf")
        self.make("run", {**ENTRIES, "Time integration/End time": "0.01953125"})
        again = Obstacles(self.make("run", words=["--restart"]) / "obstacles.vtkhdf")
        np.testing.assert_array_equal(again.times, whole.times)
        for time in whole.times:
            np.testing.assert_array_equal(again.displacement(time), whole.displacement(time))
        again.file.close()
        alone = {name: value for name, value in ENTRIES.items() if not name.startswith("Contact")}
        self.make("run", {**alone, "Output/Overwrite": "true"})
        self.assertFalse((self.folder / "run" / "obstacles.vtkhdf").exists() or (self.folder / "run" / "obstacles").exists())

    def test_picture(self):
        """From the front, the belt is a line below the body, and the wall is grey beside it."""
        entries = {**ENTRIES, "Contact/Obstacles": "belt: plane 0 0 -0.002 0 0 1, wall: box 0.41 -1 -1 1 1 1"}
        folder = self.make("run", entries)
        view = (folder, "--camera", "front", "--height", 0.5, "--focus", 0.2, 0.1, 0.1, "--size", 400, 300, "--time", 0, "--overwrite")
        grey = []
        for without in (["legend", "time", "axes", "outline"], ["legend", "time", "axes", "outline", "obstacles"]):
            self.start_of("render", *view, "--without", *without)
            with Image.open(self.folder / "render.png") as image:
                picture = np.asarray(image.convert("RGB")).astype(int)
            # The wall begins 0.21 m to the right of the middle, 126 pixels.
            grey.append((np.ptp(picture, axis=2) < 12) & (picture.max(axis=2) < 215))
        self.assertTrue(grey[0][:, 330:].all())
        self.assertFalse(grey[0][:85, 20:322].any())
        self.assertFalse(grey[1].any())

    def test_gltf(self):
        """Each obstacle is a node with a mesh; the belt moves with the animation."""
        folder = self.make("run")
        self.start_of("export", folder, "--to", "gltf", "--out", "run.glb")
        file = Glb(self, self.folder / "run.glb")
        document = file.json
        self.assertEqual(document["nodes"][0]["children"], [1, 2, 3, 4])
        self.assertEqual([node["mesh"] for node in document["nodes"]], [0, 1, 2, 3, 4])
        obstacles = Obstacles(folder / "obstacles.vtkhdf")
        parts = list(obstacles.each(obstacles.times))
        for mesh, (points, triangles, is_hollow, _) in zip(document["meshes"][1:], parts):
            primitive = mesh["primitives"][0]
            np.testing.assert_array_equal(file.read(primitive["attributes"]["POSITION"]), points[triangles.ravel()].astype(np.float32))
            self.assertEqual("alphaMode" in document["materials"][primitive["material"]], is_hollow)
        animation, = document["animations"]
        moved = [(channel["target"], file.read(animation["samplers"][channel["sampler"]]["output"])) for channel in animation["channels"][1:]]
        self.assertEqual([target for target, _ in moved], [{"node": 1, "path": "translation"}])
        np.testing.assert_array_equal(moved[0][1], parts[0][3].astype(np.float32))

    def test_page(self):
        """The page has the obstacles with a displacement for each state, and says what they are."""
        folder = self.make("run")
        self.start_of("report", folder)
        page = (folder / "report.html").read_text(encoding="utf-8")
        view = json.loads(re.search(r'id="description"[^>]*>(.*?)</script>', page, re.DOTALL).group(1))["view"]
        obstacles = Obstacles(folder / "obstacles.vtkhdf")
        self.assertEqual(len(view["obstacles"]), 4)
        for shown, (points, triangles, is_hollow, moves) in zip(view["obstacles"], obstacles.each(obstacles.times)):
            np.testing.assert_allclose(shown["points"], points, atol=1e-6)
            np.testing.assert_array_equal(shown["triangles"], triangles)
            np.testing.assert_array_equal(shown["moves"], moves)
            self.assertEqual(shown["isHollow"], is_hollow)
        self.assertIn("<dt>Contact</dt>", page)
        self.assertIn("belt: plane 0 0 -0.002 0 0 1", page)


if __name__ == "__main__":
    unittest.main()
