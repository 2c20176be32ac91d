# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The library from outside: installs it, moves the installation, builds the project tests/external against it, runs its
programs. The environment says further: COROTET_BUILD, the build folder; COROTET_CMAKE, the program."""

import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from support import ROOT, launcher, read_history

BUILD = pathlib.Path(os.environ["COROTET_BUILD"])
CMAKE = os.environ["COROTET_CMAKE"]
PROJECT = ROOT / "tests" / "external"


def run(*command, **others):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **others)
    assert result.returncode == 0, f"{command}\n{result.stdout}\n{result.stderr}"
    return result.stdout


class External(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.addClassCleanup(cls.temporary.cleanup)
        run(CMAKE, "--install", BUILD, "--prefix", cls.folder / "made here")
        # The installation is moved, as nothing in it may depend on its place.
        cls.prefix = cls.folder / "moved"
        shutil.move(cls.folder / "made here", cls.prefix)
        cls.build = cls.folder / "build"
        # The project is built without a build type, so that all flags come from
        # the library's target and from this command.
        run(CMAKE, "-G", "Ninja", "-S", PROJECT, "-B", cls.build, f"-DCMAKE_PREFIX_PATH={cls.prefix}", "-DCMAKE_BUILD_TYPE=",
            "-DCMAKE_CXX_FLAGS=-O1", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", "-DCMAKE_UNITY_BUILD=ON")
        run(CMAKE, "--build", cls.build, "--parallel", "2")

    def run_here(self, *words, ranks=1):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        return folder, run(*launcher(ranks), *words, cwd=folder)

    def test_flags_do_not_leak(self):
        """Compile commands have the user's flags, the standard, deal.II's
        definitions, and no flags of the library's own build."""
        for command in json.loads((self.build / "compile_commands.json").read_text()):
            flags = [word for word in command["command"].split() if re.match("-[OWfgm]|-pedantic", word)]
            self.assertEqual(flags, ["-O1"])
            self.assertIn("-std=gnu++20", command["command"])

    def test_headers(self):
        """Installed headers include only installed headers, and none that
        depends on the processor that the compiler targets."""
        folder = self.prefix / "include"
        headers = list(folder.rglob("*.h"))
        self.assertIn(folder / "corotet" / "corotet.h", headers)
        for header in headers:
            text = header.read_text()
            for name in re.findall("#include <(corotet/.*)>", text):
                self.assertTrue((folder / name).exists(), f"{header}: {name}")
            self.assertNotRegex(text, "simd.h|n_lanes|batch_size|__AVX")
        self.assertLess(len(headers), 40, "most headers are private")

    def test_no_paths_of_the_build(self):
        """No installed file has the path of the sources or of the build
        folder."""
        for file in self.prefix.rglob("*"):
            if file.is_file() and "share" not in file.relative_to(self.prefix).parts:
                content = file.read_bytes()
                for path in (ROOT, BUILD):
                    self.assertNotIn(str(path).encode() + b"/", content, f"{file}: {path}")

    def test_links_of_pages(self):
        """Links of the installed pages lead to installed files."""
        pages = list((self.prefix / "share" / "doc").rglob("*.md"))
        self.assertGreater(len(pages), 20)
        for page in pages:
            for target in re.findall(r"\]\(([^)#\s]+)", page.read_text(encoding="utf-8")):
                self.assertTrue(target.startswith("http") or (page.parent / target).exists(), f"{page}: {target}")

    def test_own_law(self):
        """The stretch of a bar in a smooth tube solves mu (s - 1 / s) + lambda
        (s - 1) = P, to Newton's tolerance."""
        mu, lame, stress = 1e6 / 2.6, 3e5 / (1.3 * 0.4), 1e6
        a, b = mu + lame, -(lame + stress)
        stretch = (-b + math.sqrt(b * b + 4 * a * mu)) / (2 * a)
        for ranks in (1, 2):
            folder, _ = self.run_here(self.build / "my_corotet", PROJECT / "confined.prm", "--quiet", ranks=ranks)
            row = read_history(folder / "output" / "confined")[-1]
            self.assertAlmostEqual(float(row["end_x"]), 2 * (stretch - 1), delta=1e-10)

    def tethered(self, steps, ranks=1):
        """The heights of the cube's top at the end of each step, with so many
        steps in the period."""
        folder, _ = self.run_here(self.build / "my_corotet", PROJECT / "tethered_cube.prm", "--set",
                                  f"Time integration/Time step = {math.pi / 5 / steps!r}", "--quiet", ranks=ranks)
        return [float(row["top_z"]) for row in read_history(folder / "output" / "tethered_cube")]

    def test_own_force_and_integrator(self):
        """A mass on a spring, from rest where the spring is slack: z = - m g /
        k (1 - cos omega t), omega^2 = k / m. The method is of second order, and
        the next term of its error, of fourth order, is (omega dt)^2 = 0.02 of
        the first; the cube's own compliance, k / (E L) = 1e-7, is far below."""
        errors = []
        for steps in (40, 80):
            z = self.tethered(steps)
            self.assertEqual(len(z), steps + 1)
            errors.append(max(abs(z[i] + 0.1 * (1 - math.cos(2 * math.pi * i / steps))) for i in range(steps + 1)))
        self.assertLess(errors[0], 0.002)
        self.assertAlmostEqual(math.log2(errors[0] / errors[1]), 2, delta=0.05)
        two_ranks = self.tethered(80, ranks=2)
        self.assertLess(max(abs(a - b) for a, b in zip(z, two_ranks)), 1e-9)

    def test_own_parameters(self):
        """Added parameters are listed and checked like the program's own."""
        _, text = self.run_here(self.build / "my_corotet", "--print-parameters")
        self.assertTrue("subsection Tether" in text)
        self.assertTrue("central difference, Bathe]" in " ".join(text.split()))
        result = subprocess.run([self.build / "my_corotet", PROJECT / "tethered_cube.prm", "--set", "Tether/Stiffness = -1", "--validate"],
                                stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn("Tether", result.stderr)

    def test_step_by_step(self):
        """Starting at rest, all modes of a bar have their largest elongation,
        twice the static one, at 2 L / c (their frequencies are odd multiples of
        c / 4 L), and without the load swing back to the opposite. The same load
        as an expression has the same result."""
        folder, text = self.run_here(self.build / "let_go", PROJECT / "bar.prm")
        let_go_at, highest, lowest = (float(word) for word in text.split())
        at_rest = 100 * 10**2 / (2 * 1e6)
        # The end reverses its motion within one step of 0.005 s.
        self.assertAlmostEqual(let_go_at, 2 * 10 / math.sqrt(1000), delta=0.0051)
        self.assertAlmostEqual(highest, 2 * at_rest, delta=0.01 * at_rest)
        self.assertAlmostEqual(lowest, -2 * at_rest, delta=0.02 * at_rest)

        history = read_history(folder / "output" / "bar")
        self.assertEqual(json.loads((folder / "output" / "bar" / "summary.json").read_text())["status"], "done")
        other, _ = self.run_here(self.prefix / "bin" / "corotet", PROJECT / "bar.prm", "--quiet", "--set",
                                 f"Loads/Body force = if(t < {let_go_at + 0.0025!r}, 100, 0); 0; 0")
        expected = read_history(other / "output" / "bar")
        self.assertEqual(len(history), len(expected))
        for name in ("end_x", "external_work", "kinetic_energy"):
            size = max(abs(float(row[name])) for row in expected)
            # Newton's tolerance is 1e-8, which bounds the difference.
            for row, wanted in zip(history, expected):
                self.assertAlmostEqual(float(row[name]), float(wanted[name]), delta=1e-6 * size)

        (folder / "modes.prm").write_text("set Type = modes\n")
        result = subprocess.run([self.build / "let_go", folder / "modes.prm"], capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr, f"corotet: error: {folder}/modes.prm:1: Type: found 'modes'; allowed in a run step by step: "
                                        "'simulation'\n")

        _, on_two_ranks = self.run_here(self.build / "let_go", PROJECT / "bar.prm", ranks=2)
        for a, b in zip(on_two_ranks.split(), (let_go_at, highest, lowest)):
            self.assertAlmostEqual(float(a), b, delta=1e-6 * abs(b))

    def test_installed_scripts(self):
        """The installed program finds the script that draws a study after the
        installation was moved."""
        study = "set Type = convergence study\n" \
                "subsection Exact solution\nset Displacement = 0.1*x^2; 0; 0\nset Displacement boundary = x-min\nend\n" \
                "subsection Time integration\nset Type = static\nset Time step = 1\nend\n" \
                "subsection Convergence study\nset Degrees = 1\nset Refinements = 0, 1\nend\n"
        (self.folder / "study.prm").write_text(study)
        folder, text = self.run_here(self.prefix / "bin" / "corotet", self.folder / "study.prm")
        self.assertNotIn("could not be drawn", text)
        self.assertTrue((folder / "output" / "study" / "study_l2_over_h.svg").exists())
        with open(folder / "output" / "study" / "study.csv", newline="", encoding="utf-8") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 2)
        # The script for the page is installed as well, and finds the program
        # beside it: it knows the defaults.
        subprocess.run([self.prefix / "share" / "corotet" / "scripts" / "report", folder / "output" / "study"], capture_output=True, check=True)
        page = (folder / "output" / "study" / "report.html").read_text(encoding="utf-8")
        self.assertIn("<code>Convergence study/Degrees</code>", page)


if __name__ == "__main__":
    unittest.main()
