#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Every command of the documentation works as written: the commands of a page are run in their order, in a folder that looks like the project's.

A command is right if it ends with the status that the page says in a comment, `# status 2`, else with 0. That is the expected value: a page promises that
its commands work. What is changed before a command is run is all in the tables below:
- cases are shorter or coarser (SHORTER, and SHORTER of cases.py), pictures smaller;
- `make run` and `make report` are looked up by `make --dry-run`, and the program is run as they do, without building it;
- results that a page supposes are computed first (BEFORE);
- what takes too long, or is no program of the project, is not run, each with its reason (NOT_RUN); scripts and targets of these must be there.
Texts of files in pages, which follow upon "as `NAME`", are written to files first. Pages of verification decks have one command each, that of their deck.
"""

import json
import os
import pathlib
import re
import shlex
import subprocess
import unittest

from cases import SHORTER as SHORTER_CASES
from documentation import PAGES
from support import ROOT, ProgramTest, launcher, read_history, read_modes

PROGRAMS = r"(?:make|cmake|ctest|sh|cp|mkdir|export|podman|gmsh|cpack|parameter_gui|mpirun|corotet|\(?cd|python3|\.ci/run|" \
    r"(?:scripts|build|benchmarks)/\S+)(?= |$)"

STUDY = ("Convergence study/Refinements = 0", "Convergence study/Degrees = 1", "Verification/Checks =")
SHORTER = {
    **SHORTER_CASES,
    "cantilever": ("Discretization/Degree = 1", "Mesh/box/Cells = 4, 1, 1", "Time integration/Time step = 0.4"),
    "knot": ("Discretization/Degree = 1",),
    "manufactured_corotational": STUDY,
    "manufactured_static": STUDY,
    "modes": (),
    "part": (),
    "study": ("Convergence study/Degrees = 1", "Mesh/file/Element size = 15", "Mesh/file/Geometry degree = 1"),
    "swing": ("Discretization/Degree = 1", "Mesh/file/Element size = 15", "Mesh/file/Geometry degree = 1", "Time integration/End time = 0.003"),
}
# Entries for a case on one page only: the run must reach the limit of time; the
# states that are drawn must exist.
SHORTER_ON_PAGE = {("doc/pictures.md", "spring"): ("Discretization/Degree = 1", "Time integration/Time step = 0.05", "Time integration/End time = 0.3"),
                   ("doc/command_line.md", "spring"): ("Discretization/Degree = 1", "Time integration/Maximum halvings = 2"),
                   ("doc/command_line.md", "cantilever"): ("Mesh/box/Cells = 6, 1, 1", "Time integration/End time = 0.4")}
# Entries for the run on two ranks, whose mesh is finer.
COARSER = {"Mesh/Refinements = 1": ("Discretization/Degree = 1", "Mesh/file/Element size = 15", "Mesh/file/Geometry degree = 1")}

CANTILEVER = "scripts/toolchain build/release/corotet parameters/cantilever.prm"
MOUNT = ["mkdir -p my", "cp meshes/rubber_mount.step my/part.step"]
BEFORE = {
    "doc/report.md": [CANTILEVER],
    "doc/results.md": [CANTILEVER, f'{CANTILEVER} --set "Discretization/Degree = 1" --output output/degree_1'],
    "doc/pictures.md": [CANTILEVER, *(CANTILEVER.replace("cantilever", case) for case in ("bracket", "tuning_fork_modes", "spring"))],
    **{f"doc/tutorial/{page}.md": MOUNT for page in ("3_convergence", "4_dynamics", "5_modes", "6_many_ranks")},
}
# For each page, the pages whose files it uses.
FILES_OF = {"doc/tutorial/3_convergence.md": ["doc/tutorial/1_step_part.md"], "doc/tutorial/4_dynamics.md": ["doc/tutorial/1_step_part.md"],
            "doc/tutorial/5_modes.md": ["doc/tutorial/1_step_part.md"],
            "doc/tutorial/6_many_ranks.md": ["doc/tutorial/1_step_part.md", "doc/tutorial/4_dynamics.md"]}

NOT_RUN = {
    r"make (test|verify|bench|docs|format|check)\b": "builds, or takes minutes; the target is there",
    r"make test PRESETS=no-epetra": "builds",
    r"\.ci/run|scripts/check_package": "everything, or a system of its own; .ci/run runs this test",
    r"scripts/(mutation_score|coverage)$": "takes an hour",
    r"podman ": "makes an image",
    r"export DEAL_II_DIR|cmake |ctest |\(cd build/package": "builds; tests/program/external.py configures, builds and installs",
    r"build/my_solids/|cd build/my_solids": "tests/program/external.py runs these programs",
    r"build/release/tests/test_simulation --gtest_filter=CurvedSphere.Orders": "CTest runs this test",
    r"parameter_gui ": "a program that Debian does not have",
}


def commands_of(text):
    """The commands in the indented blocks of a page."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
    return re.findall(rf"^ {{4}}({PROGRAMS}.*)$", text, re.MULTILINE)


def files_of(page):
    """Returns {name: text} of the blocks that a sentence introduces as
    files."""
    text = (ROOT / page).read_text(encoding="utf-8")
    return dict(re.findall(r"[Aa]s\s`([\w./]+\.\w+)`[:,]\n\n```\w+\n(.*?)^```$", text, re.DOTALL | re.MULTILINE))


def without_comment(command):
    """The command, and the exit status that its comment tells."""
    words, _, comment = command.partition(" #")
    return words.strip(), int((re.match(r" status (\d)$", comment) or [0, 0])[1])


def shortened(command, page):
    """The command with the settings that the tables add to it."""
    words = shlex.split(command)
    case = next((pathlib.Path(word).stem for word in words if word.endswith(".prm")), None)
    if "build/release/corotet" in words and "mesh" not in words and case:
        settings = list(SHORTER_ON_PAGE.get((page, case), SHORTER.get(case, ())))
        settings += [setting for given, more in COARSER.items() if given in words for setting in more]
        given = {word.split("=")[0].strip() for word in words if "=" in word}
        more = [word for setting in settings if setting.split("=")[0].strip() not in given for word in ("--set", setting)]
        command = " ".join([command, *map(shlex.quote, more)]) if ">" not in words else command
    if "scripts/render" in words:
        command += " --size 160 120" + (" --swing 6" if "modes" in command else "")
    if "scripts/parameters_to_xml" in words or "scripts/verify" in words:
        command += f" --program {shlex.quote(os.environ['COROTET_PROGRAM'])}"
    return command


def settings_of(case):
    return [word for setting in SHORTER.get(case, ()) for word in ("--set", shlex.quote(setting))]


def for_test(text):
    """The command without the toolchain, in which the test runs already, and
    with the tests' way to start ranks."""
    return re.sub(r"\bmpirun -n (\d+)", lambda match: shlex.join(launcher(int(match.group(1)))), text.replace("scripts/toolchain ", ""))


class DocumentedCommands(ProgramTest):

    def setUp(self):
        super().setUp()
        for path in ROOT.iterdir():
            if path.name not in ("build", "output", "my", ".git"):
                (self.folder / path.name).symlink_to(path)
        (self.folder / "build" / "release").mkdir(parents=True)
        (self.folder / "build" / "release" / "corotet").symlink_to(os.environ["COROTET_PROGRAM"])

    def run_command(self, command, page, folder=None):
        words, status = without_comment(command)
        line = for_test(shortened(words, page))
        run = subprocess.run(["sh", "-c", line], cwd=folder or self.folder, capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(run.returncode, status, f"{page}: {command}\nrun as: {line}\n{run.stdout[-2000:]}\n{run.stderr[-2000:]}")
        return run.stdout

    def run_make(self, command, page):
        """Checks that the target exists; returns the command that it runs after
        building."""
        words = shlex.split(without_comment(command)[0])
        dry = subprocess.run(["make", "--dry-run", *words[1:]], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(dry.returncode, 0, f"{page}: {command}\n{dry.stderr}")
        if words[1] in ("run", "report"):
            case = next((word.removeprefix("PRM=") for word in words if word.startswith("PRM=")), "parameters/cantilever.prm")
            self.run_command(f'build/release/corotet {case} --set "Output/Overwrite = true"', page)
            if words[1] == "report":
                self.run_command(f"scripts/report output/{pathlib.Path(case).stem}", page)

    def run_page(self, page):
        """Runs the commands of a page; returns {command: output}."""
        for name, text in [item for source in [*FILES_OF.get(page, []), page] for item in files_of(source).items()]:
            path = self.folder / name
            path.parent.mkdir(exist_ok=True)
            if path.suffix == ".sh":
                text = for_test(re.sub(r"\S+/(\w+)\.prm", lambda match: " ".join([match.group(0), *settings_of(match.group(1))]), text))
            path.write_text(text, encoding="utf-8")
        printed = {}
        for command in BEFORE.get(page, []):
            self.run_command(command, page)
        for command in commands_of((ROOT / page).read_text(encoding="utf-8")):
            if command.startswith("make "):
                self.run_make(command, page)
            elif not any(re.match(pattern, without_comment(command)[0].removeprefix("scripts/toolchain ")) for pattern in NOT_RUN):
                printed[command] = self.run_command(command, page)
            else:
                for script in re.findall(r"scripts/\w+", command):
                    self.assertTrue(os.access(ROOT / script, os.X_OK), f"{page}: {script}")
        return printed

    def test_tables_are_needed(self):
        # Each entry of NOT_RUN belongs to a command that exists.
        commands = [without_comment(command)[0].removeprefix("scripts/toolchain ")
                    for page in PAGES for command in commands_of(page.read_text(encoding="utf-8"))]
        self.assertEqual([pattern for pattern in NOT_RUN if not any(re.match(pattern, command) for command in commands)], [])
        self.assertGreater(len(commands), 100)

    def test_verification_pages(self):
        for page in sorted((ROOT / "doc" / "verification").glob("*.md")):
            self.assertEqual(commands_of(page.read_text(encoding="utf-8")), [f"scripts/toolchain scripts/verify {page.stem}"])
        self.run_page("doc/verification/patch_degree_1.md")

    def test_meshes(self):
        # The commands run in a copy of the folder, as they replace its files.
        meshes = self.folder / "copy"
        meshes.mkdir()
        for path in (ROOT / "meshes").glob("*.geo"):
            (meshes / path.name).write_bytes(path.read_bytes())
        commands = commands_of((ROOT / "meshes" / "README.md").read_text(encoding="utf-8"))
        for command in commands:
            self.run_command(command, "meshes/README.md", folder=meshes)
        self.assertEqual(len(list(meshes.glob("*.msh"))), len(commands))

    def test_results(self):
        # The example in Python prints numbers of history.csv.
        lines = self.run_page("doc/results.md")["scripts/toolchain python3 read.py"].splitlines()
        rows = {float(row["time"]): row for row in read_history(self.folder / "output" / "cantilever")}
        self.assertGreater(len(lines), 2)
        for line in lines:
            time, n_nodes, largest, stress = map(float, line.split())
            self.assertAlmostEqual(largest, float(rows[time]["max_displacement"]), delta=1e-12)
            self.assertEqual(n_nodes, json.loads((self.folder / "output" / "cantilever" / "summary.json").read_text(encoding="utf-8"))["nodes"])
            self.assertEqual(stress > 0, time > 0)

    def test_step_part(self):
        # The page tells the displacement of the plate [mm].
        page = "doc/tutorial/1_step_part.md"
        self.run_page(page)
        last = read_history(self.folder / "output" / "part")[-1]
        text = " ".join((ROOT / page).read_text(encoding="utf-8").split())
        self.assertIn(f"by {1e3 * float(last['top_x']):.0f} mm sideways and {-1e3 * float(last['top_z']):.1f} mm down", text)

    def test_modes_of_part(self):
        # The page tells the frequencies.
        page = "doc/tutorial/5_modes.md"
        self.run_page(page)
        f = [float(row["frequency"]) for row in read_modes(self.folder / "output" / "modes")]
        text = " ".join((ROOT / page).read_text(encoding="utf-8").split())
        for words in (f"{f[0]:.1f} Hz, where", f"{f[1]:.1f} Hz twice", f"{f[3]:.0f} Hz twice", f"zeros are {500 / f[1]:.1f} ms apart"):
            self.assertIn(words, text)


OWN_TESTS = {"meshes/README.md", "doc/results.md", "doc/tutorial/1_step_part.md", "doc/tutorial/5_modes.md"}


def add_test(page):
    name = re.sub(r"\W", "_", page.removesuffix(".md")).lower()

    def test(self):
        self.run_page(page)
    setattr(DocumentedCommands, f"test_page_{name}", test)


for path_of_page in PAGES:
    page_name = str(path_of_page.relative_to(ROOT))
    if page_name not in OWN_TESTS and "verification/" not in page_name and commands_of(path_of_page.read_text(encoding="utf-8")):
        add_test(page_name)

if __name__ == "__main__":
    unittest.main(verbosity=2)
