#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""scripts/render: pictures and films of results. Sizes and colours in the pictures are compared with the run's numbers, read by VTK's own reader."""

import json
import os
import shutil
import subprocess
import unittest

import matplotlib
import numpy as np
from PIL import Image
from vtkmodules import vtkRenderingOpenGL2

from scripts_support import ScriptTest, state_of, times_of  # and the scripts' modules

from fields import round_factor
from scene import number_text

BARE = ("--without", "legend", "time", "axes", "outline")
SMALL = ("--size", "400", "300")
FONT = 11  # pixels, at the sizes of these tests; margins are 1.5 of it


def pixels(path):
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB")).astype(int)


def is_body(picture):
    """Which pixels show the body: all colours of the map have a component below
    140, and pixels at edges count if the body covers about half."""
    return (picture < 140).any(axis=2)


def extent(picture):
    """The extent of the body: first and last column, first and last row (the
    last ones not included)."""
    rows, columns = np.nonzero(is_body(picture))
    return columns.min(), columns.max() + 1, rows.min(), rows.max() + 1


class Render(ScriptTest):
    script = "render"

    def notes(self, name):
        with Image.open(self.folder / name) as image:
            return dict(image.text)

    def test_legend(self):
        """The range of the legend is that of the recovered stress at all nodes;
        its colours are those of the whole map, and so are the body's."""
        said = self.start(self.runs / "beam", *SMALL)
        picture, notes = pixels(self.folder / "render.png"), self.notes("render.png")
        self.assertEqual(picture.shape, (300, 400, 3))
        stress = state_of(self.runs / "beam", -1).point_data["von_mises"]
        self.assertEqual((notes["Field"], notes["Title"], notes["Time"]), ("von_mises", "von Mises stress [kPa]", "300 ms"))
        # The tolerance is the round-off of the factor 1e-3.
        np.testing.assert_allclose([float(end) for end in notes["Range"].split()], [stress.min() / 1e3, stress.max() / 1e3], rtol=1e-15)
        self.assertIn(f"{stress.max() / 1e3:.3g}", said)
        bar = picture[300 - round(4.3 * FONT) + 3, 80:320]
        expected = 255 * matplotlib.colormaps["viridis"](np.linspace(0, 1, 240))[:, :3]
        np.testing.assert_allclose(bar, expected, atol=0.5)
        # The displacement is zero at the clamped end and largest at the tip;
        # shading makes colours darker, but yellow stays yellow and violet
        # violet.
        self.start(self.runs / "beam", *SMALL, *BARE, "--camera", "front", "--warp", "0", "--field", "displacement")
        body = pixels(self.folder / "render.png")
        left, right, top, bottom = extent(body)
        root, tip = body[(top + bottom) // 2, left + 3], body[(top + bottom) // 2, right - 4]
        self.assertLess(root[1], 0.5 * root[2])
        self.assertLess(tip[2], 0.5 * tip[1])

    def test_size_of_the_body(self):
        """The body fills the picture up to the margins, in the proportions of
        its displaced bounding box; pixels at edges may count or not."""
        self.start(self.runs / "beam", *SMALL, *BARE, "--camera", "front")
        left, right, top, bottom = extent(pixels(self.folder / "render.png"))
        places = state_of(self.runs / "beam", -1).displaced()
        size = np.ptp(places, axis=0)
        margin = 1.5 * FONT
        scale = min((400 - 2 * margin) / size[0], (300 - 2 * margin) / size[2])
        self.assertAlmostEqual(right - left, scale * size[0], delta=2)
        self.assertAlmostEqual(bottom - top, scale * size[2], delta=2)
        self.assertAlmostEqual((left + right) / 2, 200, delta=1.5)
        self.assertAlmostEqual((top + bottom) / 2, 150, delta=1.5)
        # With the same view from an explicit position, a picture of three times
        # the height shows the body at a third of its size.
        middle = (places.min(axis=0) + places.max(axis=0)) / 2
        self.start(self.runs / "beam", *SMALL, *BARE, "--position", middle[0], middle[1] - 5, middle[2], "--focus", *middle, "--height", 3 * 300 / scale)
        small = extent(pixels(self.folder / "render.png"))
        self.assertAlmostEqual(small[1] - small[0], (right - left) / 3, delta=2)
        # With perspective the height holds at the middle of the view; the
        # beam's near side, 0.05 of 5.6 nearer, differs by 1 %.
        self.start(self.runs / "beam", *SMALL, *BARE, "--camera", "front", "--perspective", "--height", 3 * 300 / scale)
        small = extent(pixels(self.folder / "render.png"))
        self.assertAlmostEqual(small[1] - small[0], (right - left) / 3, delta=3)

    def test_curved_cells(self):
        """The silhouette of the sphere's octant is a quarter of a disc of radius 2, to 0.2 %: flat faces would be 2 % smaller. A cut at
        y = 1 leaves a quarter of a disc of radius 3^(1/2)."""
        for words, radius in (((), 2), (("--clip", "front", 0, 1, 0), 3**0.5)):
            self.start(self.runs / "sphere", "--size", 800, 800, *BARE, "--camera", "front", "--warp", "0", "--field", "region", *words)
            picture = pixels(self.folder / "render.png")
            scale = (800 - 2 * 1.5 * round(0.022 * 800)) / 2
            area = is_body(picture).sum() / scale**2
            self.assertAlmostEqual(area / (np.pi * radius**2 / 4), 1, delta=2e-3)
            self.assertAlmostEqual(extent(picture)[1] - extent(picture)[0], radius * scale, delta=3)
        # Light is the same on all of a plane, except for highlights, and the
        # cut covers all that is behind it; pixels at edges are lighter.
        colours = picture[is_body(picture)]
        self.assertGreater((abs(colours - np.median(colours, axis=0)).max(axis=1) < 10).mean(), 0.99)

    def test_time_and_repetition(self):
        """Pictures change with time; a repeated picture has the same bytes,
        also with another number of processes."""
        self.start(self.runs / "beam", *SMALL, "--times", 0.09, 0.18, 0.3, "--out", "several.png", "--out", "several.gif", "--jobs", 1)
        first = {path.name: path.read_bytes() for path in self.folder.glob("several*")}
        self.assertEqual(sorted(first), ["several.gif", "several_0001.png", "several_0002.png", "several_0003.png"])
        a, b = pixels(self.folder / "several_0001.png"), pixels(self.folder / "several_0002.png")
        self.assertGreater((abs(a - b).max(axis=2) > 20).mean(), 0.05)
        self.start(self.runs / "beam", *SMALL, "--times", 0.09, 0.18, 0.3, "--out", "several.png", "--out", "several.gif", "--jobs", 3)
        self.assertEqual(first, {path.name: path.read_bytes() for path in self.folder.glob("several*")})

    def test_films(self):
        """All films have a frame for each state, with their size and time;
        sizes of an MP4 are even."""
        outs = [word for kind in ("gif", "webp", "mp4") for word in ("--out", f"film.{kind}")]
        self.start(self.runs / "beam", "--size", 321, 241, "--fps", 10, "--field", "rotation_angle", *outs)
        n = len(times_of(self.runs / "beam"))
        self.assertEqual(n, 11)
        for kind in ("gif", "webp"):
            with Image.open(self.folder / f"film.{kind}") as film:
                self.assertEqual((film.n_frames, film.size, film.info.get("loop")), (n, (321, 241), 0), kind)
                frames = []
                for i in range(n):
                    film.seek(i)
                    frames.append(np.asarray(film.convert("RGB")).astype(int))
                    self.assertEqual(film.info["duration"], 100)
            self.assertTrue(all(abs(one - other).max() > 50 for one, other in zip(frames, frames[1:])), kind)
        if not shutil.which("ffprobe"):
            return
        probe = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", self.folder / "film.mp4"], capture_output=True,
                               text=True, check=True)
        stream = json.loads(probe.stdout)["streams"][0]
        found = [stream[key] for key in ("codec_name", "pix_fmt", "width", "height", "nb_read_frames", "avg_frame_rate")]
        self.assertEqual(found, ["h264", "yuv420p", 322, 242, str(n), "10/1"])

    def test_modes(self):
        """A film of modes shows the first one that deforms the body: it is
        displaced most after a quarter and three quarters, to opposite sides."""
        self.start(self.runs / "plate", *SMALL, "--swing", 4, "--out", "mode.png", "--without", "time")
        frames = [pixels(self.folder / f"mode_000{i}.png") for i in (1, 2, 3, 4)]
        self.assertIn("mode 4: ", self.notes("mode_0001.png")["Time"])
        np.testing.assert_array_equal(frames[0], frames[2])
        self.assertGreater(abs(frames[1] - frames[3]).max(), 50)
        self.assertIn("displacement drawn × 10", self.notes("mode_0001.png")["Title"])
        self.start(self.runs / "plate", *SMALL, "--out", "mode.gif")
        with Image.open(self.folder / "mode.gif") as film:
            self.assertEqual(film.n_frames, 24)

    def test_numbers(self):
        """Numbers have three digits, or are whole; never with a power of ten
        instead."""
        self.assertEqual([number_text(value) for value in (0, 999.4, 999.7, -999.7, 1234.4, 12345, 0.00123)],
                         ["0", "999", "999.7", "\N{MINUS SIGN}999.7", "1234", "1.234e+4", "0.00123"])

    def test_round_factors(self):
        """For modes the ratio of scales is a power of ten up to round-off, on
        either side."""
        for ratio, factor in ((10, 10), (np.nextafter(10, 0), 10), (np.nextafter(10, 20), 10), (9.99, 5), (4.99, 2), (2, 2), (1.9, 1), (0.05, 0.05),
                              (np.nextafter(1e-3, 0), 1e-3), (np.nextafter(5000, 0), 5000)):
            with self.subTest(ratio=ratio):
                np.testing.assert_allclose(round_factor(ratio), factor, rtol=1e-15)

    def test_together(self):
        """Three states side by side have the width that their shifts tell."""
        self.start(self.runs / "beam", *SMALL, *BARE, "--times", 0, 0.03, 0.06, "--together", "--shift", 1.5, 0, 0, "--camera", "front", "--field", "region")
        picture = pixels(self.folder / "render.png")
        left, right, _, _ = extent(picture)
        gaps = np.flatnonzero(~is_body(picture[:, left:right]).any(axis=0))
        # The beams have 1 m, of which the third has lost less than 1 % by
        # bending, and the two gaps 0.5 m each.
        self.assertAlmostEqual(len(gaps) / (right - left), 1 / 4, delta=0.01)

    def test_mistakes(self):
        beam = self.runs / "beam"
        for name in ("empty", "waiting", "study", "damaged", "shortened", "incomplete"):
            (self.folder / name).mkdir()
        (self.folder / "waiting" / ".corotet").touch()
        (self.folder / "study" / "study.csv").touch()
        (self.folder / "damaged" / "solution.vtkhdf").write_bytes((beam / "solution.vtkhdf").read_bytes()[:5000])
        for name in ("shortened", "incomplete"):
            shutil.copytree(beam, self.folder / name, dirs_exist_ok=True)
        last = sorted((self.folder / "shortened" / "solution").iterdir())[-1].name
        data = self.folder / "shortened" / "solution" / last
        data.write_bytes(data.read_bytes()[:1000])
        (self.folder / "incomplete" / "solution" / last).unlink()
        (self.folder / "foreign.png").write_text("a picture of someone else")
        self.check_mistakes((
            (("nothing",), "nothing is not a folder of results: it does not exist"),
            (("empty",), "empty is not a folder of results: there is no solution.vtkhdf"),
            (("waiting",), "waiting has no states yet"),
            (("study",), "study has the results of a convergence study"),
            (("damaged",), "damaged/solution.vtkhdf is damaged: "),
            (("shortened",), f"shortened/solution.vtkhdf is damaged: solution/{last}: "),
            (("incomplete",), f"incomplete/solution.vtkhdf is damaged: solution/{last}: the file is missing"),
            ((beam, "--field", "von_mise"), "no field 'von_mise' in"), ((beam, "--field", "von_mise"), "is it von_mises? There are: "),
            ((beam, "--time", "0.4"), "0.4 is outside of the run, whose times are from 0 to 0.3"),
            ((beam, "--times", "soon"), "found the time 'soon'; allowed are numbers, FROM:TO, FROM:TO:NUMBER and all"),
            ((beam, "--times", "0.2:0.1"), "the first must not be after the last"),
            ((beam, "--shift", "1", "0", "0"), "--shift has no effect without --together"),
            ((beam, "--out", "picture.jpg"), "found 'picture.jpg'; allowed are .png, .gif, .webp, .mp4"),
            ((beam, "--out", "nowhere/picture.png"), "nowhere/picture.png cannot be written: the folder nowhere does not exist"),
            ((beam, "--out", "foreign.png"), "foreign.png exists and was not made by this program; --overwrite replaces it"),
            ((beam, "--camera", "somewhere"), "found --camera somewhere; allowed are front, back"),
            ((beam, "--clip", "right", "5", "0", "0"), "the plane of --clip does not cut the body"),
            ((beam, "--size", "1", "1"), "found the size 1 x 1; allowed are 64 to 8192 pixels"),
            ((beam, "--colours", "virids"), "no colours 'virids'; is it viridis?"),
            ((beam, "--swing"), "--swing is for modes"), ((beam, "--tim", "1"), "unrecognized arguments: --tim 1"),
            ((beam, "--time", "0", "--times", "0"), "allowed is one of them"),
            *(((beam, "--warp", factor), f"found --warp {factor}; allowed are numbers and auto") for factor in ("nan", "inf")),
            ((beam, "--warp", "1e30"), "the displaced body is not finite at 0.3, with displacements multiplied by 1e+30"),
            *(((beam, f"--{name}", *words), f"argument --{name}: found {words[-1]}; allowed are numbers from -1e+50 to 1e+50")
              for name, words in (("range", ("0", "inf")), ("height", ("nan",)), ("position", ("0", "0", "1e300")), ("fps", ("nan",)))),
            ((beam, "--range", "1", "1"), "the first must be the lower one"), ((beam, "--fps", "0"), "found --fps 0; allowed are 0.01 to 100"),
            ((beam, "--fps", "60", "--out", "film.gif"), "found --fps 60; allowed are 0.01 to 50"),
            ((beam, "--camera", "0", "nan", "0"), "found --camera 0 nan 0; allowed are"), ((beam, "--camera", "front-back"), "found --camera front-back"),
            ((beam, "--clip", "front", "0", "inf", "0"), "found --clip front 0 inf 0; allowed are"), ((beam, "--clip", "1e200", "0", "0"), "found --clip"),
            ((beam, "--up", "0", "0", "0"), "found --up 0 0 0; allowed are directions"),
            ((beam, "--position", "1", "0", "0", "--focus", "1", "0", "0"), "--position and --focus must be different places")))
        self.assertEqual((self.folder / "foreign.png").read_text(), "a picture of someone else")
        self.start(beam, *SMALL, "--out", "foreign.png", "--overwrite")
        self.assertEqual(pixels(self.folder / "foreign.png").shape, (300, 400, 3))

    def test_full_disk(self):
        """A full disk is also reported if ffmpeg notices it."""
        (self.folder / "bin").mkdir()
        ffmpeg = self.folder / "bin" / "ffmpeg"
        ffmpeg.write_text("#!/bin/sh\ncat > /dev/null\necho 'Error writing trailer: No space left on device' >&2\nexit 228\n")
        ffmpeg.chmod(0o755)
        path = f"{ffmpeg.parent}:{os.environ['PATH']}"
        message = self.start(self.runs / "beam", *SMALL, "--times", 0, 0.3, "--out", "film.mp4", status=3, env={**os.environ, "PATH": path})
        self.assertEqual(message, "render: error: film.mp4: No space left on device\n")
        self.assertEqual([name.name for name in self.folder.iterdir()], ["bin"])

    @unittest.skipUnless(hasattr(vtkRenderingOpenGL2, "vtkXOpenGLRenderWindow"), "this VTK needs no display")
    def test_without_a_display(self):
        """Without a display and without Xvfb one line tells so."""
        message = self.start(self.runs / "beam", status=1, env={"PATH": "/nonexistent", "HOME": str(self.folder)})
        self.assertIn("there is no display, and no Xvfb", message)


if __name__ == "__main__":
    unittest.main()
