#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""scripts/report in a browser: the pages of a motion, a static deformation on curved cells, modes, a convergence study, a verification case and a body
of many triangles. What they show is compared with the files of the run, with theory, and with itself after each control was used."""

import csv
import functools
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
from selenium.webdriver.common.keys import Keys

from browser import Browser, n_different
from report_body import write_plate
from support import ROOT, ProgramTest, parameter_text, read_history, read_modes, read_summary

STUDY = {"Type": "convergence study", "Mesh/box/Cells": "2, 2, 2", "Mesh/box/Size": "1, 1, 1", "Material/Type": "linear",
         "Exact solution/Displacement": "0.1*sin(2*x+y)*exp(z); 0.1*x*y^2*z; 0.05*cos(2*x-z)", "Exact solution/Displacement boundary": "x-min",
         "Time integration/Type": "static", "Time integration/Time step": "1", "Convergence study/Degrees": "1, 2",
         "Convergence study/Refinements": "0, 1", "Convergence study/Pictures": "false"}
HALF_A_UNIT = 0.5 / 32767  # numbers of the view are rounded to 16 bits of the state's largest
MOST_BYTES = 15_000_000


class Report(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.results = pathlib.Path(folder.name)
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        super().setUp()
        self.browser.set_size(900, 640)
        self.browser.set_media(prefers_color_scheme="light", prefers_reduced_motion="reduce")

    def run_of(self, name):
        """The folder of a run with its page, which is made once."""
        if (self.results / name).exists():
            return self.results / name
        if name == "study":
            (self.folder / "study.prm").write_text(parameter_text(STUDY), encoding="utf-8")
            self.run_program("study.prm", "--output", self.results / name)
        else:
            case, *settings = {
                "motion": ("cantilever", "Discretization/Degree = 2", "Mesh/box/Cells = 8, 1, 1", "Time integration/End time = 0.3",
                           "Output/Stress = nodes"),
                "sphere": ("lame_sphere", "Material/Young's modulus = 1"), "modes": ("plate_modes",), "verification": ("verification/patch_degree_2",)}[name]
            self.run_case(case, self.results / name, *settings)
        self.make(self.results / name)
        return self.results / name

    def make(self, folder):
        run = subprocess.run([sys.executable, "-B", ROOT / "scripts" / "report", folder], capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertRegex(run.stdout, f"^The page of the run is {folder}/report.html ")

    def open(self, name):
        """Opens the page of a run, and checks that it reports no errors and loads nothing."""
        folder = self.run_of(name)
        self.browser.open(folder / "report.html")
        self.assertEqual(self.browser.messages(), [])
        self.assertEqual(self.browser.requests(), [])
        self.assertEqual(self.browser.run("return performance.getEntriesByType('resource').length"), 0)
        return folder

    def check_number(self, key, expected):
        """The page stores all digits of a number, and shows five, so the error is half a unit of the fifth."""
        value, text = self.data[key]
        self.assertEqual(float(value), expected, key)
        shown = text.replace("\u202f", "").replace("\u2212", "-")
        if match := re.fullmatch(r"(.*)×10(-?\d+)", shown):
            shown = f"{match.group(1)}e{match.group(2)}"
        # The prefix of the unit is a power of 1000.
        power = round(math.log10(abs(expected / float(shown))) / 3) if expected and float(shown) else 0
        self.assertAlmostEqual(float(shown) * 1000.0**power, expected, delta=6e-5 * abs(expected), msg=f"{key}: {text}")

    def test_numbers_are_those_of_the_files(self):
        folder = self.open("motion")
        summary, self.data = read_summary(folder), self.browser.data()
        for key in ("cells", "nodes", "dofs", "degree", "mesh_volume", "total_mass", "steps", "end_time", "peak_memory_bytes"):
            self.check_number(key, summary[key])
        for key, value in summary["final"].items():
            if key != "wall_time":
                self.check_number(f"final.{key}", value)
        for key, value in summary["wall_time"].items():
            self.check_number(f"wall_time.{key}", value)
        self.check_number("error_estimate.relative", summary["error_estimate"]["relative"])
        # The quality of the mesh is that in the log, to four digits.
        log = (folder / "log.txt").read_text()
        angle, aspect = re.search(r"smallest dihedral angle ([\d.]+) degrees, worst aspect ratio ([\d.]+)", log).groups()
        self.assertAlmostEqual(float(self.data["quality.angle"][0]), float(angle), delta=0.006)
        self.assertAlmostEqual(float(self.data["quality.aspect"][0]), float(aspect), delta=0.006)
        # Settings on the page are those that differ from defaults, set in the case or here; not those set to their default.
        with open(folder / "parameters.prm", encoding="utf-8") as file:
            self.assertIn("set Spectral radius = 0.8", file.read())
        entries = set(self.browser.texts("#parameters th code"))
        self.assertLessEqual({"Boundary conditions/Fixed", "Mesh/box/Cells", "Loads/Gravity", "Output/Stress"}, entries)
        self.assertFalse({"Type", "Discretization/Degree", "Output/Directory", "Time integration/generalized-alpha/Spectral radius"} & entries)

    def test_surface_is_that_of_the_body(self):
        folder = self.open("motion")
        rows = {float(row["time"]): row for row in read_history(folder)}
        states = self.browser.run("return report.description.view.states")
        self.assertEqual([state["time"] for state in states], list(rows))
        # A beam is bent most at its surface; values at nodes are shown unchanged.
        for state in states:
            self.assertAlmostEqual(state["ranges"]["displacement"][1], float(rows[state["time"]]["max_displacement"]), delta=1e-14)
        # Decoded values differ by the rounding of three components.
        largest = self.browser.run("return Math.max(...report.surface.valuesOf(report.options[0], report.states[arguments[0]]))", len(states) - 1)
        expected = float(rows[states[-1]["time"]]["max_displacement"])
        self.assertAlmostEqual(largest, expected, delta=math.sqrt(3) * HALF_A_UNIT * expected + 1e-6 * expected)
        # The body at rest is a box of 1 x 0.1 x 0.1 m, in single precision.
        self.browser.set_value("warp", 0)
        self.assertAlmostEqual(self.browser.run("return report.surface.area()"), 0.42, delta=1e-6)
        places = np.array(self.browser.run("return [...report.surface.places]")).reshape(-1, 3)
        np.testing.assert_allclose([places.min(axis=0), places.max(axis=0)], [[0, 0, 0], [1, 0.1, 0.1]], atol=1e-7)

    def test_stress_is_the_recovered_one(self):
        folder = self.open("motion")
        self.assertEqual(self.browser.texts("#field option:checked"), ["von Mises stress"])
        with h5py.File(folder / "solution.vtkhdf", locking=False) as file:
            root = file["VTKHDF"]
            points, first = root["Points"][:], int(root["Steps/PointDataOffsets/von_mises"][-1])
            values = root["PointData/von_mises"][first:first + len(points)]
        on_surface = (np.abs(points - [0.5, 0.05, 0.05]) > np.array([0.5, 0.05, 0.05]) - 1e-9).any(axis=1)
        expected = [values[on_surface].min(), values[on_surface].max()]
        ranges = self.browser.run("return report.description.view.states.map((state) => state.ranges.von_mises)")
        np.testing.assert_allclose(ranges[-1], expected, rtol=1e-14)
        # The legend has the range of all states.
        ticks = [float(tick) for tick in self.browser.run("return [...document.querySelectorAll('#legend .ticks span')].map((one) => one.dataset.value)")]
        np.testing.assert_allclose([ticks[0], ticks[-1]], [min(r[0] for r in ranges), max(r[1] for r in ranges)])
        self.browser.set_value("range", "state")
        ticks = self.browser.run("return [...document.querySelectorAll('#legend .ticks span')].map((one) => Number(one.dataset.value))")
        np.testing.assert_allclose([ticks[0], ticks[-1]], expected)

    def test_controls_change_the_picture(self):
        self.open("motion")
        before = self.browser.picture("#canvas")
        background = before[2, -2]
        body = (abs(before - background).max(axis=2) > 30).sum()
        self.assertGreater(body, 0.03 * before[:, :, 0].size, "the view is blank")
        self.assertGreater(len(np.unique(before.reshape(-1, 3), axis=0)), 200, "the body has no colours")
        # Each control is used and reset, which must give the first picture again: so differences are no accident.
        for name, value, back, least in (("time", 12, 30, 2000), ("field", "displacement", "von_mises", 2000), ("warp", 0.5, 1, 2000),
                                         ("clip", "1", "", 2000)):
            with self.subTest(control=name):
                self.browser.set_value(name, value)
                picture = self.browser.picture("#canvas")
                self.browser.set_value(name, back)
                self.assertGreater(n_different(before, picture), least)
                self.assertLess(n_different(before, self.browser.picture("#canvas")), 20)
        for name, least in (("outline", 300), ("edges", 300), ("bands", 500)):
            with self.subTest(control=name):
                self.browser.click(f"#{name}")
                picture = self.browser.picture("#canvas")
                self.browser.click(f"#{name}")
                self.assertGreater(n_different(before, picture), least)
                self.assertLess(n_different(before, self.browser.picture("#canvas")), 20)
        self.check_clip(before)
        # Early states have low stress: their own range shows more of it.
        self.browser.set_value("time", 3)
        picture = self.browser.picture("#canvas")
        self.browser.set_value("range", "state")
        self.assertGreater(n_different(picture, self.browser.picture("#canvas")), 2000)
        self.browser.set_media(prefers_color_scheme="dark")
        dark = self.browser.picture("#canvas")[2, -2]
        self.assertGreater(background.sum(), 650)
        self.assertLess(dark.sum(), 150)

    def check_clip(self, whole):
        """A plane across the beam leaves none, about half or all of it, and the cut is grey."""
        def coloured(picture):
            return (np.ptp(picture, axis=2) > 60).sum()

        self.browser.set_value("clip", "0")
        pictures = []
        for place in (0, 500, 1000):
            self.browser.set_value("clip-place", place)
            pictures.append(self.browser.picture("#canvas"))
        shares = [coloured(picture) / coloured(whole) for picture in pictures]
        np.testing.assert_allclose(sorted([shares[0], shares[2]]), [0, 1], atol=0.02)
        self.assertAlmostEqual(shares[1], 0.5, delta=0.2)
        is_grey = (abs(pictures[1] - [0xb9, 0xc0, 0xc8]).max(axis=2) < 3).sum()
        self.assertGreater(is_grey, 200)
        self.browser.set_value("clip", "")

    def test_keys(self):
        self.open("motion")
        place = functools.partial(self.browser.run, "return Number(document.getElementById('time').value)")
        self.assertEqual(place(), 30)
        self.browser.press(Keys.ARROW_LEFT, Keys.ARROW_LEFT, Keys.ARROW_RIGHT)
        self.assertEqual(place(), 29)
        self.browser.press(Keys.HOME)
        self.assertEqual((place(), self.browser.texts("#now")), (0, ["t = 0\u00a0ms"]))
        self.browser.press(" ")
        self.assertEqual(self.browser.find("#play").get_attribute("aria-label"), "Stop")
        self.browser.driver.execute_async_script("setTimeout(arguments[0], 600)")
        self.browser.press(" ")
        self.assertEqual(self.browser.find("#play").get_attribute("aria-label"), "Play")
        # The page shows 31 states in three seconds, or in more if the machine is busy.
        self.assertGreater(place(), 1)
        # The Tab key reaches all controls from the top.
        self.browser.run("document.body.tabIndex = -1; document.body.focus()")
        met = []
        for _ in range(40):
            self.browser.press(Keys.TAB, settled=False)
            met.append(self.browser.run("return document.activeElement.id || document.activeElement.textContent"))
        wanted = ["canvas", "play", "time", "speed", "field", "range", "warp", "true-scale", "clip", "outline", "edges", "bands", "slanted"]
        self.assertEqual([name for name in met if name in wanted], wanted)
        # These keys act in the view.
        self.browser.run("document.getElementById('canvas').focus()")
        picture = self.browser.picture("#canvas")
        for keys, shift in ((Keys.ARROW_LEFT, True), ("+", False), ("x", False), ("z", False)):
            self.browser.press(keys, shift=shift)
            last, picture = picture, self.browser.picture("#canvas")
            self.assertGreater(n_different(last, picture), 1000, keys)
        self.browser.press("m")
        value = self.browser.run("return Math.max(...report.values)")
        shown = dict(row.rsplit("\t", 1) if "\t" in row else (row, "") for row in self.browser.find("#readout").text.replace(" kPa", "\t").split("\n"))
        stress = float(next(row.split()[-1] for row in shown if row.startswith("von Mises stress")))
        self.assertAlmostEqual(stress * 1e3, value, delta=1e-3 * value)
        self.assertTrue(self.browser.find("#history-of-point").is_displayed())
        self.browser.press(Keys.ESCAPE)
        self.assertFalse(self.browser.find("#readout").is_displayed())

    def test_values_under_the_pointer(self):
        folder = self.open("motion")
        # The end of the beam faces the camera that looks along x; its middle is the probe.
        self.browser.click("[data-look=x]")
        box = self.browser.run("const b = document.getElementById('canvas').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]")
        final = read_summary(folder)["final"]
        tip = [1 + final["tip_x"], 0.05 + final["tip_y"], 0.05 + final["tip_z"]]
        x, y = self.browser.run("const p = new THREE.Vector3(...arguments[0]).project(report.view.camera); return [p.x, p.y]", tip)
        self.browser.point_at(box[0] + (1 + x) / 2 * box[2], box[1] + (1 - y) / 2 * box[3])
        row = next(row for row in self.browser.find("#readout").text.split("\n") if row.startswith("displacement ["))
        unit, *shown = re.fullmatch(r"displacement \[(\w+)\] (\S+) (\S+) (\S+)", row.replace("\u2212", "-")).groups()
        self.assertEqual(unit, "mm")
        # A pixel is less than 1 mm of the end, which has rotated by less than a right angle's half: so displacements differ at most by
        # that.
        for value, expected in zip(shown, (final["tip_x"], final["tip_y"], final["tip_z"])):
            self.assertAlmostEqual(float(value) * 1e-3, expected, delta=1e-3)
        self.browser.point_at(5, 5)
        self.assertFalse(self.browser.find("#readout").is_displayed())

    def test_plots(self):
        folder = self.open("motion")
        rows = read_history(folder)
        chart = '[data-chart="energies"]'
        self.assertEqual(self.browser.run(f"return document.querySelectorAll('{chart} path.curve').length"), 3)
        self.browser.run(f"document.querySelector('{chart} svg').scrollIntoView({{block: 'center'}})")
        box = self.browser.run(f"const b = document.querySelector('{chart} svg').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]")
        self.browser.point_at(box[0] + box[2] / 2, box[1] + box[3] / 2)
        texts = [text.replace("\u00a0", " ") for text in self.browser.texts(f"{chart} .keyline button")]
        at = float(re.search(r"at time ([\d.]+) ms", self.browser.texts(f"{chart} .at")[0]).group(1)) * 1e-3
        row = min(rows, key=lambda row: abs(float(row["time"]) - at))
        for text, column in zip(texts, ("kinetic_energy", "elastic_energy", "external_work")):
            self.assertAlmostEqual(float(text.split()[-1]), float(row[column]), delta=6e-5 * float(row[column]), msg=text)
        # A click moves the view to that time; a curve that is switched off is gone.
        self.browser.press_mouse()
        self.assertEqual(self.browser.run("return report.description.view.states[report.state].time"), float(row["time"]))
        self.browser.click(f"{chart} .keyline button")
        self.assertEqual(self.browser.run(f"return document.querySelectorAll('{chart} path.curve').length"), 2)
        # The time has enough digits to distinguish states.
        self.browser.run("report.description.view.states.forEach((one, k) => { one.time = 1 + 5e-5 * k; }); report.state = 1; report.showTime()")
        self.assertEqual(self.browser.texts("#clock"), ["t = 1.00005\u00a0s"])

    def test_curved_cells(self):
        """An eighth of a thick sphere, radii 1 and 2, has three flat quarters of a ring and two curved sides."""
        folder = self.open("sphere")
        self.browser.set_value("warp", 0)
        expected = 3 * math.pi / 4 * (4 - 1) + 4 * math.pi / 8 * (4 + 1)
        # Cells have 0.5 rad and are divided by six: polygons inside of a circle lack (0.5 / 6)^2 / 6 of it; undivided ones would lack 30
        # times as much.
        area = self.browser.run("return report.surface.area()")
        self.assertAlmostEqual(area, expected, delta=1.2e-3 * expected)
        places = np.array(self.browser.run("return [...report.surface.places]")).reshape(-1, 3)
        np.testing.assert_allclose([places.min(axis=0), places.max(axis=0)], [[0, 0, 0], [2, 2, 2]], atol=1e-6)
        # The page shows the warning of the log, in the same words.
        warning = next(line for line in (folder / "log.txt").read_text().splitlines() if line.startswith("warning: "))
        self.assertEqual(self.browser.texts(".warnings li"), [warning.removeprefix("warning: ")])

    def test_modes(self):
        folder = self.open("modes")
        frequencies, self.data = read_summary(folder)["frequencies"], self.browser.data()
        for i, frequency in enumerate(frequencies):
            self.check_number(f"frequencies.{i}", frequency)
        self.assertEqual(len(read_modes(folder)), len(frequencies))
        # The first mode that is shown deforms the body.
        self.assertEqual(self.browser.run("return document.querySelector('[data-mode][aria-pressed=true]').dataset.mode"), "3")
        before = self.browser.picture("#canvas")
        self.browser.click("[data-mode='6']")
        self.assertGreater(n_different(before, self.browser.picture("#canvas")), 2000)
        self.assertIn("mode 7, 169.55\u00a0Hz", self.browser.texts("#clock")[0])
        # A reader who prefers reduced motion gets none without asking.
        self.assertEqual(self.browser.find("#play").get_attribute("aria-label"), "Play")
        # Half a vibration later the shape is the opposite one, and after a whole vibration the first one.
        places = [np.array(self.browser.run("report.player.go(arguments[0]); return [...report.surface.places]", place)) for place in (18, 54, 0)]
        np.testing.assert_allclose((places[0] + places[1]) / 2, places[2], atol=1e-5)
        self.assertGreater(abs(places[0] - places[2]).max(), 0.1)
        self.browser.set_media(prefers_reduced_motion="no-preference")
        self.browser.click("[data-mode='3']")
        self.assertEqual(self.browser.find("#play").get_attribute("aria-label"), "Stop")
        self.browser.click("#play")

    def test_study(self):
        folder = self.open("study")
        with open(folder / "study.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        head = self.browser.texts("#study thead th")
        cells = self.browser.run("return [...document.querySelectorAll('#study tbody tr')].map((row) => [...row.children].map("
                                 "(cell) => cell.querySelector('data')?.value ?? null))")
        self.assertEqual(len(cells), 4)
        for column in ("degree", "cells", "L2_error", "L2_order", "energy_error"):
            shown = [row[head.index(column.replace("_", " "))] for row in cells]
            self.assertEqual([float(value) if value else None for value in shown],
                             [float(row[column]) if row[column] != "nan" else None for row in rows], column)
        # There are two curves; the slope between their points is the order.
        self.assertEqual(self.browser.run("return document.querySelectorAll('[data-chart=\"L2-h\"] path.curve').length"), 2)
        slopes = [re.search(r"slope ([\d.]+)", text).group(1) for text in self.browser.texts('[data-chart="L2-h"] .keyline button')]
        self.assertEqual(slopes, [f"{float(row['L2_order']):.2f}" for row in rows if row["L2_order"] != "nan"])

    def test_checks(self):
        folder = self.open("verification")
        with open(folder / "verification.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(self.browser.texts(".checks th[scope=row]"), [row["quantity"] for row in rows])
        computed = self.browser.run("return [...document.querySelectorAll('.checks tbody tr')].map((row) => row.querySelector('data').value)")
        self.assertEqual([float(value) for value in computed], [float(row["computed"]) for row in rows])
        self.assertEqual(self.browser.texts(".checks .pass"), ["yes"] * len(rows))

    def test_narrow_windows(self):
        for name in ("motion", "modes", "study", "verification"):
            self.browser.set_size(340, 700)
            self.open(name)
            with self.subTest(run=name):
                self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 340)

    def test_many_triangles(self):
        """A plate of 54,280 triangles and states of noise, which cannot be compressed: the page tells what it leaves out."""
        folder = self.results / "plate"
        n_triangles = write_plate(folder, (115, 115, 2), 30)
        self.make(folder)
        self.assertLess((folder / "report.html").stat().st_size, MOST_BYTES)
        self.browser.open(folder / "report.html")
        self.assertEqual(self.browser.messages(), [])
        note = self.browser.texts("#view-note")[0].replace("\u202f", "")
        drawn = self.browser.run("return report.surface.triangles.length / 3")
        self.assertGreater(n_triangles, 50_000)
        self.assertLessEqual(drawn, 50_000)
        self.assertGreater(drawn, 45_000)
        self.assertIn(f"it has {n_triangles} triangles, of which the page draws {drawn:.0f} ", note)
        times = self.browser.run("return report.description.view.states.map((state) => state.time)")
        self.assertIn(f"{len(times)} states of 30 are in the page", note)
        self.assertEqual((times[0], times[-1]), (0, 1))
        self.assertGreater(len(times), 12)
        # Flat sides stay flat and complete: 1 x 1 x 0.05 m, in single precision.
        self.browser.set_value("warp", 0)
        self.assertAlmostEqual(self.browser.run("return report.surface.area()"), 2.2, delta=1e-5)


if __name__ == "__main__":
    unittest.main()
