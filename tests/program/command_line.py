#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Options that answer instead of running, and --validate; how make starts the program; parameter files as XML."""

import fcntl
import json
import os
import pathlib
import pty
import re
import struct
import subprocess
import sys
import termios
import time
import unittest

from support import CASES, ROOT, ProgramTest, limit_files, parameter_text

BEAM = {"Mesh/box/Size": "1, 0.1, 0.1", "Mesh/box/Cells": "4, 1, 1", "Discretization/Degree": "1", "Boundary conditions/Fixed": "x-min"}


class CommandLine(ProgramTest):

    def test_help(self):
        text = self.run_program("--help").stdout
        for option in ("--set", "--output", "--validate", "--print-parameters", "--quiet", "--version", "--help"):
            self.assertIn(option, text)

    def test_start_loads_what_is_called(self):
        program = pathlib.Path(os.environ["COROTET_PROGRAM"])
        if not (program.parent / "lib" / "corotet" / "placeholders").exists():
            self.skipTest("built without placeholders")
        # With this variable the dynamic loader lists the libraries that it
        # would load.
        loaded = subprocess.run([program], env={**os.environ, "LD_TRACE_LOADED_OBJECTS": "1"}, check=True, capture_output=True, text=True).stdout
        paths = dict(re.findall(r"(\S+) => (\S+)", loaded))
        placeholders = [name for name, path in paths.items() if "/placeholders/" in path]
        for name in ("libgmsh", "libTKernel", "libslepc", "libsundials"):
            self.assertTrue(any(placeholder.startswith(name) for placeholder in placeholders), name)
        # Libraries that only these need, such as those of a CAD program's
        # windows.
        for name in ("libfltk", "libGL.", "libvtk", "libarpack"):
            self.assertFalse([path for path in paths if path.startswith(name)], name)
        self.assertIn("/libdeal.ii", loaded)

    def test_huge_pages(self):
        """Where Linux gives huge pages on request only, the program asks for
        them, unless the environment says otherwise."""
        setting = pathlib.Path("/sys/kernel/mm/transparent_hugepage/enabled")
        if not setting.exists() or "[madvise]" not in setting.read_text(encoding="utf-8"):
            self.skipTest("huge pages are for all, or for none")
        inherited = {name: value for name, value in os.environ.items() if name != "GLIBC_TUNABLES"}
        for chosen, is_huge in (({}, True), ({"GLIBC_TUNABLES": "glibc.malloc.hugetlb=0"}, False)):
            # The run is so long that it does not end before this test ends it.
            run = subprocess.Popen([os.environ["COROTET_PROGRAM"], ROOT / "parameters" / "cantilever.prm", "--output", f"of_{is_huge}", "--quiet",
                                    "--set", "Mesh/box/Cells = 80, 16, 16", "--set", "Time integration/End time = 1e6"],
                                   cwd=self.folder, env={**inherited, **chosen})
            pages = []
            while run.poll() is None and len(pages) < (100 if is_huge else 20) and not (is_huge and pages and pages[-1] > 0):
                time.sleep(0.1)
                text = pathlib.Path(f"/proc/{run.pid}/smaps_rollup").read_text(encoding="utf-8")
                pages.append(int(re.search(r"AnonHugePages: *(\d+) kB", text).group(1)))
            name = pathlib.Path(f"/proc/{run.pid}/comm").read_text(encoding="utf-8")
            self.assertIsNone(run.poll(), "the run has ended by itself")
            run.kill()
            run.wait()
            self.assertEqual(pages[-1] > 0, is_huge, pages)
            self.assertEqual(name, "corotet\n")

    def test_terminal(self):
        """A terminal shows a live line with a bar, as wide as it allows, and
        last lines that tell where to look; never colours."""
        for columns, pattern in ((120, r"step \d+, time [^\r]* left \[=* *\]$"), (60, r"step \d+, time [^\r\[]*$")):
            main, terminal = pty.openpty()
            fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
            run = subprocess.Popen([os.environ["COROTET_PROGRAM"], ROOT / "parameters" / "crushed_cube.prm", "--output", f"of_{columns}",
                                    "--set", "Time integration/End time = 3"], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=terminal)
            os.close(terminal)
            shown = b""
            try:
                while piece := os.read(main, 65536):
                    shown += piece
            except OSError:  # the error of a terminal whose other end is closed
                pass
            os.close(main)
            self.assertEqual(run.wait(), 0)
            shown = shown.decode()
            self.assertEqual(set(re.findall(r"\x1b\[[^A-Za-z]*[A-Za-z]", shown)), {"\x1b[K"})
            live = [line for line in re.findall(r"\r\x1b\[K([^\r]*)", shown) if line.startswith("step ")]
            self.assertGreater(len(live), 3)
            for line in live:
                self.assertLess(len(line), columns)
            self.assertRegex(live[-2], pattern)
            toolchain = os.environ.get("COROTET_TOOLCHAIN", "")
            self.assertRegex(shown, rf"Results are in of_{columns}: history.csv, solution.vtkhdf for ParaView; "
                                    rf"{toolchain} ?\S*scripts/report of_{columns} makes a page of them\r\nWorth a look above, or in log.txt: 1 warning\r\n$")
            self.assertNotIn("\x1b", (self.folder / f"of_{columns}" / "log.txt").read_text(encoding="utf-8"))

    def test_version(self):
        self.assertRegex(self.run_program("--version").stdout, r"corotet \d+\.\d+\.\d+.*deal\.II \d+\.\d+.*for \S+")

    def test_print_parameters(self):
        # --print-parameters prints a file of defaults: prm and json can be read
        # again, with the same values.
        prm = self.run_program("--print-parameters", "prm").stdout
        self.assertEqual(self.run_program("--print-parameters").stdout, prm)
        self.assertIn("subsection Time integration", prm)
        listing = self.run_program("--print-parameters", "json").stdout
        self.assertIn("Time integration", json.loads(listing))
        for name, text in (("defaults.prm", prm), ("defaults.json", listing)):
            (self.folder / name).write_text(text, encoding="utf-8")
            self.run_program(name, "--validate", "--quiet")

    def test_print_parameters_of_a_file(self):
        # With a file, its values are printed, and those of --set.
        (self.folder / "beam.prm").write_text("subsection Mesh\n  subsection box\n    set Cells = 4, 1, 1\n  end\nend\n", encoding="utf-8")
        for style in ("prm", "json"):
            text = self.run_program("beam.prm", "--set", "Discretization/Degree = 3", "--print-parameters", style).stdout
            (self.folder / f"all.{style}").write_text(text, encoding="utf-8")
            again = self.run_program(f"all.{style}", "--print-parameters", "json").stdout
            tree = json.loads(again)
            self.assertEqual(tree["Mesh"]["box"]["Cells"]["value"], "4, 1, 1")
            self.assertEqual(tree["Discretization"]["Degree"]["value"], "3")
        self.assertIn("nothing.prm", self.run_program("nothing.prm", "--print-parameters", status=1).stderr)
        self.assertIn("--set: a parameter file is needed", self.run_program("--print-parameters", "prm", "--set", "Type = modes", status=1).stderr)

    def test_validate(self):
        for case in CASES:
            run = self.run_program(case, "--validate")
            self.assertIn(f"{case}: valid", run.stdout)
        self.assertEqual(list(self.folder.iterdir()), [], "--validate must not leave anything behind")

    def test_validate_where_results_are(self):
        """--validate accepts a case whose output directory has results, with a
        warning, and still reports mistakes."""
        (self.folder / "case.prm").write_text(parameter_text({**BEAM, "Type": "modes", "Modes/Number": "1"}), encoding="utf-8")
        self.run_program("case.prm", "--output", "results")
        run = self.run_program("case.prm", "--output", "results", "--validate")
        self.assertIn("warning: the output directory 'results' holds results: a run takes another one, or needs Output/Overwrite = true\n", run.stdout)
        self.assertIn("case.prm: valid", run.stdout)
        # Modes cannot be continued by --restart, but a simulation could.
        run = self.run_program("case.prm", "--output", "results", "--validate", "--set", "Type = simulation")
        self.assertIn("or needs Output/Overwrite = true or --restart\n", run.stdout)
        run = self.run_program("case.prm", "--output", "results", "--validate", "--set", "Boundary conditions/Fixed = nowhere", status=1)
        self.assertIn("no such boundary: found 'nowhere'", run.stderr)

    def test_warning_of_large_results(self):
        # A row has at least 12 characters for each of 20 columns.
        for steps, size in ((1e3, None), (1e9, "240"), (2e9, "480")):
            run = self.run_program(ROOT / "parameters" / "cantilever.prm", "--validate", "--set", "Time integration/End time = 1",
                                   "--set", f"Time integration/Time step = {1 / steps!r}")
            if size:
                self.assertRegex(run.stdout, f"warning: Output: results will have some {size} GB, and the disk has .* GB left: {steps:.3g} rows "
                                 .replace("+", r"\+"))
            else:
                self.assertNotIn("results will have", run.stdout)

    def test_quiet(self):
        run = self.run_program(ROOT / "parameters" / "gravity_linear.prm", "--quiet", "--output", "results")
        self.assertEqual(run.stdout, "")

    def test_words_before_mesh(self):
        """The command `mesh` must be the first word, as options before it would
        be lost."""
        mesh = ROOT / "meshes" / "l_block.msh"
        for word, found in (("--quiet", "--quiet"), (ROOT / "parameters" / "cantilever.prm", "FILE")):
            run = self.run_program(word, "mesh", mesh, status=1)
            self.assertEqual((run.stdout, run.stderr), ("", f"corotet: error: command line: found {found} before 'mesh'; allowed: corotet mesh [OPTIONS] FILE\n"))
        self.assertIn("99 cells", self.run_program("mesh", mesh).stdout)

    def test_mesh_for_a_folder_that_is_not_there(self):
        """A missing folder is the user's mistake and reported before the mesh
        is made; so are numbers that are not numbers."""
        mesh = ROOT / "meshes" / "l_block.msh"
        self.assertEqual(self.run_program("mesh", mesh, "--out", "no_where/x.msh", status=1).stderr,
                         "corotet: error: 'no_where/x.msh' cannot be written: there is no folder 'no_where'; allowed is a name in a folder that is there\n")
        for words, allowed in ((("--size", "nan"), "a number > 0"), (("--feature-angle", "nan"), "a number from 1 to 180")):
            self.assertEqual(self.run_program("mesh", mesh, *words, status=1).stderr, f"corotet: error: command line: {words[0]}: found 'nan'; allowed is {allowed}\n")
        for words in (("mesh", mesh, "--out", ""), (ROOT / "parameters" / "cantilever.prm", "--validate", "--output", "")):
            self.assertEqual(self.run_program(*words, status=1).stderr, f"corotet: error: command line: {words[-2]}: found ''; allowed is a name\n")

    def test_answers_to_a_full_disk(self):
        """An answer that cannot be written is an error."""
        for words in (["--print-parameters", "json"], [ROOT / "parameters" / "cantilever.prm", "--print-parameters"], ["--version"], ["--help"],
                      ["mesh", ROOT / "meshes" / "l_block.msh"], [ROOT / "parameters" / "cantilever.prm", "--validate"]):
            with self.subTest(words), open("/dev/full", "w", encoding="utf-8") as full:
                run = subprocess.run([os.environ["COROTET_PROGRAM"], *words], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual((run.returncode, run.stderr), (3, "corotet: error: the standard output cannot be written (is the disk full?)\n"))

    def test_entries_of_another_type(self):
        """Entries for another type of run are a mistake if no type was chosen;
        otherwise there is a warning that they have no effect."""
        (self.folder / "beam.prm").write_text(parameter_text(BEAM), encoding="utf-8")
        for setting, kind in (("Modes/Number = 3", "modes"), ("Convergence study/Degrees = 1, 2", "convergence study")):
            run = self.run_program("beam.prm", "--validate", "--set", setting, status=1)
            self.assertEqual(run.stderr, f"corotet: error: --set: {setting.split(' = ')[0]}: it would have no effect: \"Type\" is not set, and its default is "
                                         f"'simulation'; allowed with \"Type = {kind}\"\n")
        for more in ([], ["--set", "Modes/Number = 3"]):
            run = self.run_program("beam.prm", "--validate", "--set", "Type = simulation", *more)
            self.assertEqual("Modes" in run.stdout, bool(more), run.stdout)
        for limit, warned in (("100", 1), ("0", 0)):
            run = self.run_program("beam.prm", "--validate", "--set", "Type = modes", "--set", f"Checkpoint/Wall time limit = {limit}")
            self.assertEqual(run.stdout.count('no effect on modes: "Checkpoint/Wall time limit"'), warned)

    def test_rotations_without_effect(self):
        """The coarse solver amg has no rotations of vertices: if they are
        requested, there is a warning; other solvers have their own warning."""
        (self.folder / "beam.prm").write_text(parameter_text(BEAM), encoding="utf-8")
        section = "Linear solver/p-multigrid/"
        warning = f'no effect, as "{section}Coarse solver" is \'amg\': {section}Vertex rotations'
        for solver, coarse, rotations, warned in (("automatic", "amg", "true", 1), ("p-multigrid", "amg", "true", 1), ("p-multigrid", "amg", "automatic", 0),
                                                  ("p-multigrid", "direct", "true", 0), ("jacobi", "amg", "true", 0)):
            with self.subTest((solver, coarse, rotations)):
                out = self.run_program("beam.prm", "--validate", "--set", f"Linear solver/Type = {solver}", "--set", f"{section}Coarse solver = {coarse}",
                                       "--set", f"{section}Vertex rotations = {rotations}").stdout
                self.assertEqual(out.count(warning), warned, out)

    def test_entries_without_effect(self):
        """For entries that another entry switches off there is a warning with
        their place."""
        (self.folder / "beam.prm").write_text(parameter_text(BEAM), encoding="utf-8")
        static, adaptive = "Time integration/Type = static", "Time integration/Adaptive step/"
        for setting, unless in (("Time integration/Time step = 0.5", static), (f"{adaptive}Target error = 1e-5", f"{adaptive}Enabled = false"),
                                ("Material/Rotation = quadrature points", "Material/Type = linear"),
                                ("Output/Stress at probes = raw", "Output/Stress probes =")):
            entry, choice = setting.split(" =")[0], unless.split(" =")[0]
            with self.subTest(setting):
                out = self.run_program("beam.prm", "--validate", "--set", setting, "--set", unless).stdout
                self.assertIn(f"--set: no effect, as \"{choice}\" is '{unless.split('=')[1].strip()}': {entry}\n", out)
                out = self.run_program("beam.prm", "--validate", "--set", unless).stdout
                self.assertNotIn(entry, out)

    def test_make(self):
        """make passes names with spaces and quotes unchanged, and touches no
        other folder; a script that prints its arguments replaces the
        toolchain."""
        toolchain = self.folder / "toolchain"
        toolchain.write_text("""#!/bin/sh\nprintf '[%s]' "$@"\necho\n""", encoding="utf-8")
        toolchain.chmod(0o755)
        for name, more in (("my case", ["--output", "output/my case"]), ("it's \"one\" case.v2", ["--output", "output/it's \"one\" case.v2"])):
            own, other = self.folder / "output" / name / "report.html", self.folder / "output" / "my" / "case" / "report.html"
            for target, output in (("run", []), ("report", more)):
                for page in (own, other):
                    page.parent.mkdir(parents=True, exist_ok=True)
                    page.write_text("a page")
                run = subprocess.run(["make", "-s", "-f", ROOT / "Makefile", "TOOLCHAIN=./toolchain", target, f"PRM=some cases/{name}.prm"], cwd=self.folder,
                                     capture_output=True, text=True, check=False)
                self.assertEqual((run.returncode, run.stderr), (0, ""))
                words = ["build/release/corotet", f"some cases/{name}.prm", *output, "--set", "Output/Overwrite = true"]
                self.assertIn("".join(f"[{word}]" for word in words), run.stdout.splitlines())
                if output:
                    self.assertEqual(run.stdout.splitlines()[-1], f"[scripts/report][{output[-1]}]")
                self.assertEqual((own.exists(), other.exists()), (False, True))

    def to_xml(self, *words, status=0, **others):
        command = [sys.executable, "-B", ROOT / "scripts" / "parameters_to_xml", "--program", os.environ["COROTET_PROGRAM"], *words]
        run = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False, **others)
        self.assertEqual((run.returncode, len(run.stderr.splitlines())), (status, 1 if status else 0), run.stderr)
        return run.stderr

    def test_parameters_to_xml(self):
        """Parameter files in XML are replaced, other files only with
        --overwrite, and an old file stays if the new one cannot be written
        completely."""
        case = self.folder / "case.prm"
        case.write_text("set Type = modes\n", encoding="utf-8")
        self.assertIn("case.prm exists and is no parameter file in XML; --overwrite replaces it", self.to_xml("case.prm", "--out", "case.prm", status=1))
        self.assertEqual(case.read_text(encoding="utf-8"), "set Type = modes\n")
        self.to_xml("case.prm", "--out", "case.xml")
        before = (self.folder / "case.xml").read_bytes()
        self.assertIn(b"<value>modes</value>", before)
        self.assertEqual(self.to_xml("--out", "case.xml", status=3, preexec_fn=limit_files), "parameters_to_xml: error: case.xml: File too large\n")
        self.assertEqual((self.folder / "case.xml").read_bytes(), before)
        self.to_xml("--out", "case.xml")
        self.assertNotEqual((self.folder / "case.xml").read_bytes(), before)
        self.to_xml("--out", "case.prm", "--overwrite")
        self.assertIn("no_where does not exist", self.to_xml("--out", "no_where/case.xml", status=1))
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["case.prm", "case.xml"])


if __name__ == "__main__":
    unittest.main()
