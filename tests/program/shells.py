#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Completions of shells and the manual page have exactly the options that
--help lists; bash completes options, styles, entries and files. (The files for
zsh and fish are compared with --help only.)"""

import os
import pathlib
import re
import subprocess
import unittest

from support import ROOT, ProgramTest

COMPLETION = ROOT / "scripts" / "completion"


class Shells(ProgramTest):

    def options(self, *command):
        return set(re.findall(r"^  (?:-h,)?(--[a-z-]+)", self.run_program(*command, "--help").stdout, re.MULTILINE))

    def test_options(self):
        options = self.options() | self.options("mesh")
        self.assertIn("--restart", options)
        for file, pattern, prefix in ((COMPLETION / "corotet.bash", r'(?<=[" ])--[a-z-]+(?=[ "])', ""),
                                      (COMPLETION / "_corotet", r"'\*?(--[a-z-]+)\[|\{-h,(--[a-z-]+)\}", ""),
                                      (COMPLETION / "corotet.fish", r" -l ([a-z-]+)", "--"),
                                      (ROOT / "doc" / "corotet.1", r"^\.(?:B|BI|BR) (?:\\-h, )?(\\-\\-[a-z\\-]+)", "")):
            with self.subTest(file=file.name):
                found = re.findall(pattern, file.read_text(encoding="utf-8"), re.MULTILINE)
                names = {name if isinstance(name, str) else "".join(name) for name in found}
                self.assertEqual({prefix + name.replace("\\", "") for name in names}, options)

    def complete(self, *words):
        """The completions that bash offers for the last of these words after
        "corotet"."""
        words = ("corotet", *words)
        script = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
                  '_corotet corotet "${@: -1}" "${@: -2:1}"; printf "%s\\n" "${COMPREPLY[@]}"')
        path = f"{pathlib.Path(os.environ['COROTET_PROGRAM']).parent}:{os.environ['PATH']}"
        run = subprocess.run(["bash", "-c", script, "bash", COMPLETION / "corotet.bash", *words], cwd=self.folder, capture_output=True, text=True,
                             env={**os.environ, "PATH": path}, check=False)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return run.stdout.splitlines()

    def test_bash(self):
        for name in ("case.prm", "mesh.stl"):
            (self.folder / name).write_text("", encoding="utf-8")
        (self.folder / "results").mkdir()
        self.assertEqual(self.complete("--re"), ["--restart", "--report"])
        self.assertEqual(self.complete("mesh", "--"), ["--help", "--size", "--degree", "--feature-angle", "--out"])
        self.assertEqual(self.complete("--print-parameters", ""), ["prm", "json", "markdown", "schema"])
        self.assertEqual(self.complete("ca"), ["case.prm"])
        self.assertEqual(self.complete("me"), ["mesh", "mesh.stl"])
        self.assertEqual(self.complete("--output", ""), ["results"])
        self.assertEqual(self.complete("--set", "Discretization/Deg"), ["Discretization/Degree = "])
        self.assertEqual(self.complete("--set", '"Time integration/static/Load s'), ["Time integration/static/Load steps = "])
        self.assertIn("Type = ", self.complete("--set", ""))


if __name__ == "__main__":
    unittest.main()
