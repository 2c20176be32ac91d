#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The documentation is correct where a program can check it: parameters,
columns, links, citations, the list of cases."""

import re
import sys
import unittest

from support import (CASES, COLUMNS, COLUMNS_AFTER_PROBES, MODES_COLUMNS, MODES_SUMMARY_KEYS, ROOT, SUMMARY_KEYS, ProgramTest,
                     has_preconditioner)

sys.path.insert(0, str(ROOT / "scripts"))
from docs_site import parameter_pages, tree  # pylint: disable=wrong-import-position

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "benchmarks" / "shapes.md", ROOT / "meshes" / "README.md",
         *sorted((ROOT / "doc").rglob("*.md"))]


class Documentation(ProgramTest):

    @unittest.skipUnless(has_preconditioner("amg"), "built without Epetra, whose parameters the documentation has")
    def test_parameters(self):
        self.assertEqual((ROOT / "doc" / "parameters.md").read_text(encoding="utf-8"),
                         self.run_program("--print-parameters", "markdown").stdout,
                         "doc/parameters.md is outdated: write the output of --print-parameters markdown to it")

    def test_results(self):
        text = (ROOT / "doc" / "results.md").read_text(encoding="utf-8")
        names = [re.sub("_[xyz]$", "", name) for name in COLUMNS + COLUMNS_AFTER_PROBES + MODES_COLUMNS] + SUMMARY_KEYS
        names += MODES_SUMMARY_KEYS
        self.assertEqual([name for name in names if f"`{name}" not in text], [])

    def test_links(self):
        for page in PAGES:
            for target in re.findall(r"\]\(([^)#:]+)[^):]*\)|src=\"([^\"]+)\"", page.read_text(encoding="utf-8")):
                path = page.parent / "".join(target)
                self.assertTrue(path.exists(), f"{page.name} refers to {path}")

    def test_names_of_files(self):
        # Files of the project, headers in their folders, and targets of make
        # that pages name must exist.
        targets = re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
        missing = []
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            for name in re.findall(r"`(?:scripts/toolchain )?((?:scripts|benchmarks|tests|parameters|meshes|doc|cmake)/[\w./-]+)", text):
                if not re.search("NAME|SECTION|LAYER", name) and not (ROOT / name).exists():
                    missing.append((page.name, name))
            for name in re.findall(r"`([a-z_]+/\w+\.h)`", text):
                if not any((ROOT / folder / name).exists() for folder in ("include/corotet", "include", "tests", ".")):
                    missing.append((page.name, name))
            missing += [(page.name, f"make {target}") for target in re.findall(r"`make ([a-z]+)", text) if target not in targets]
        self.assertEqual(missing, [])

    def test_contents_of_site(self):
        # The site has all pages.
        self.assertEqual(sorted(tree.files()), sorted(str(page.relative_to(ROOT)) for page in [*PAGES, ROOT / "CHANGELOG.md"]
                                                      if str(page.relative_to(ROOT)) != "doc/parameters.md"))

    def test_examples(self):
        # Each section of parameters has an example, which the program accepts
        # and which sets an entry of the section; there are no others.
        sections = re.findall(r"^## ([^/\n]*)$", (ROOT / "doc" / "parameters.md").read_text(encoding="utf-8"), re.MULTILINE)
        files = [parameter_pages.EXAMPLES / f"{parameter_pages.slug(section)}.prm" for section in sections]
        self.assertEqual(sorted(parameter_pages.EXAMPLES.iterdir()), sorted(files))
        for section, file in zip(sections, files):
            text = file.read_text(encoding="utf-8")
            self.assertRegex(text, r"\A# ")
            self.assertRegex(text, rf"(?m)^subsection {section}$" if section != "Top level" else "(?m)^set ")
            self.run_program(file, "--validate", "--quiet")

    def test_tutorial(self):
        """The code on the page about the library is that of the project that a
        test builds and runs."""
        project = ROOT / "tests" / "external"
        sources = [file.read_text(encoding="utf-8") for file in project.iterdir()]
        blocks = re.findall("```(?:cpp|cmake)\n(.*?)```", (ROOT / "doc" / "library.md").read_text(encoding="utf-8"), re.DOTALL)
        self.assertGreaterEqual(len(blocks), 5)
        self.assertEqual([block for block in blocks if not any(block in source for source in sources)], [])

    def test_citations(self):
        # Citations have keys of a name and a year, as in [chung1993,
        # newmark1959] on pages and "@cite chung1993" in comments.
        keys = set(re.findall(r"@\w+\{(\w+),", (ROOT / "doc" / "references.bib").read_text(encoding="utf-8")))
        cited = set()
        for page in PAGES:
            for list_of_keys in re.findall(r"\[([a-z]+\d{4}(?:, [a-z]+\d{4})*)\](?!\()", page.read_text(encoding="utf-8")):
                cited |= set(list_of_keys.split(", "))
        for folder in ("include", "source"):
            for file in sorted((ROOT / folder).rglob("*.*")):
                cited |= set(re.findall(r"@cite (\w+)", file.read_text(encoding="utf-8")))
        self.assertLessEqual(cited, keys)

    def test_cases(self):
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        self.assertEqual([case.name for case in CASES if f"`{case.name}`" not in text], [])

    def test_verification(self):
        # Each deck has a page with a picture and a line of the index, and there
        # are no others.
        decks = sorted(deck.stem for deck in (ROOT / "parameters" / "verification").glob("*.prm"))
        pages = ROOT / "doc" / "verification"
        pictures = ROOT / "doc" / "pictures" / "verification"
        self.assertEqual(sorted(page.stem for page in pages.glob("*.md")), decks)
        self.assertEqual(sorted(picture.stem for picture in pictures.iterdir()), decks)
        index = (ROOT / "doc" / "verification.md").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"\]\(verification/(\w+)\.md\)", index), decks)
        for deck in decks:
            text = (pages / f"{deck}.md").read_text(encoding="utf-8")
            self.assertTrue(text.startswith(f"# {deck}\n"), deck)
            self.assertIn(f"](../pictures/verification/{deck}.png)", text)


if __name__ == "__main__":
    unittest.main()
