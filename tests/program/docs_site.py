#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""scripts/docs makes a site whose links all have a target and that needs no
network; and its check finds mistakes of both kinds.

The site is made without gallery and API, which take longer and have no content
of pages. It must have the content of the pages: a page for each section of
parameters with the program's entries, equations, links from keys to references.
In a browser, from the folder and without any network: equations are drawn, the
search finds the pages that have a word, colours follow the system's setting,
and all loaded files are in the site.
"""

import os
import re
import subprocess
import sys
import time
import unittest

from browser import Browser
from support import ROOT, ProgramTest

sys.path.insert(0, str(ROOT / "scripts"))
from docs_site import check, sources  # pylint: disable=wrong-import-position


class DocsSite(ProgramTest):

    def make(self, *words, status=0):
        command = [sys.executable, "-B", ROOT / "scripts" / "docs", "--no-gallery", "--no-api", "--program", os.environ["COROTET_PROGRAM"], *words]
        run = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, status, run.stdout + run.stderr)
        return run

    def has(self, path, *words):
        text = path.read_text(encoding="utf-8")
        self.assertEqual([word for word in words if word not in text], [], f"not in {path.name}")

    def test_site(self):
        site = self.folder / "site"
        beside = self.folder / "docs-pages" / "kept.txt"
        beside.parent.mkdir()
        beside.write_text("kept", encoding="utf-8")
        self.make("--out", site)
        # Nothing beside the site is touched, and no temporary files are left.
        self.assertEqual(beside.read_text(encoding="utf-8"), "kept")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["docs-pages", "site"])
        self.has(site / "doc" / "parameters" / "damping.html", "Stiffness coefficient", "alpha_K [s] of the stiffness in Rayleigh damping", "critical damping at 5 Hz",
                 '<span class="na"> Frequencies </span>', "shaken_mast")
        self.has(site / "doc" / "physics.html", "MathJax.js", r"\zeta = \frac{\alpha_M}{2 \omega} + \frac{\alpha_K \omega}{2}",
                 'href="references.html#chung1993"')
        self.assertTrue((site / "_static" / "mathjax" / "jax" / "output" / "SVG" / "jax.js").exists())
        self.has(site / "searchindex.js", "A STEP part", "Equations", "Parameter files", "Boundary conditions")
        # The site has a light and a dark style, chosen by the system and by the
        # reader, without JavaScript modules.
        self.has(site / "_static" / "styles" / "furo.css", 'body[data-theme="dark"]', "body:not([data-theme")
        self.has(site / "_static" / "scripts" / "furo.js", "root.Gumshoe", "cycleThemeOnce")
        # The commands of README.md are on the first page of the site.
        self.has(site / "index.html", "make run")
        self.check_in_browser(site)
        # A folder that is no site is not replaced.
        other = self.folder / "other"
        other.mkdir()
        (other / "kept.txt").write_text("kept", encoding="utf-8")
        self.assertIn("no site", self.make("--out", other, status=1).stderr)
        self.assertEqual((other / "kept.txt").read_text(encoding="utf-8"), "kept")
        self.assertIn("kept.txt is a file, and no site", self.make("--out", other / "kept.txt", status=1).stderr)

    def check_in_browser(self, site):
        browser = Browser()
        self.addCleanup(browser.quit)
        browser.set_size(400, 800)
        browser.set_media(prefers_color_scheme="dark")

        def wait_for(script):
            end = time.monotonic() + 30
            while not browser.run(script):
                self.assertLess(time.monotonic(), end, script)
                time.sleep(0.05)

        browser.driver.get((site / "doc" / "physics.html").as_uri())
        wait_for("return document.querySelectorAll('.MathJax_SVG').length >= document.querySelectorAll('.math').length")
        self.assertGreater(browser.run("return document.querySelectorAll('.math').length"), 100)
        self.assertEqual(browser.messages(), [])
        self.assertEqual([url for url in browser.requests() if not url.startswith(site.as_uri())], [])
        # Nothing is wider than the screen; the background is dark, and light if
        # the reader chooses that.
        self.assertLessEqual(browser.run("return document.documentElement.scrollWidth"), 400)
        ground = "return parseInt(getComputedStyle(document.body).backgroundColor.match(/[0-9]+/)[0])"
        self.assertLess(browser.run(ground), 60)
        browser.run("[...document.querySelectorAll('.theme-toggle')].find((one) => one.offsetParent).click()")
        self.assertGreater(browser.run(ground), 200)

        browser.driver.get((site / "search.html").as_uri() + "?q=dashpots")
        # Results appear one after another, so the test waits for them.
        found = "const found = [...document.querySelectorAll('#search-results li a')].map((one) => one.textContent);"
        wait_for(f"{found} return ['Equations', 'Supports'].every((title) => found.includes(title))")

    def test_check(self):
        # There is one mistake of each kind, and something that only looks like
        # one.
        (self.folder / "a.html").write_text('<p id="here"><a href="#here">1</a><a href="b.html#there">2</a><a href="https://example.org">3</a>'
                                            '<img src="data:image/png;base64,AAAA"><a href="a%20b.txt?x=1">4</a></p>', encoding="utf-8")
        (self.folder / "a b.txt").write_text("text", encoding="utf-8")
        (self.folder / "b.html").write_text('<p id="there"></p>', encoding="utf-8")
        self.assertEqual(check.mistakes(self.folder), [])
        (self.folder / "b.html").write_text('<p><a href="none.html">1</a><a href="a.html#nowhere">2</a><a href="../out.html">3</a>'
                                            f'<script src="https://example.org/a.js"></script><script type="module" src="a.html"></script>{ROOT}/build</p>',
                                            encoding="utf-8")
        found = check.mistakes(self.folder)
        for words in ("none.html does not exist", "a.html#nowhere: that page has no such place", "../out.html does not exist",
                      "https://example.org/a.js is loaded from a network", "has a path of this machine", "a module of JavaScript"):
            self.assertTrue(any(words in line for line in found), (words, found))
        # One more mistake is that a.html links to a place in b.html that no
        # longer exists.
        self.assertEqual(len(found), 7, found)

    def test_copies(self):
        # Keys become links, but not in code; links to parameters and to the
        # first page become those of the site.
        text = "As [chung1993, bonet2008, 6.4] say, `[chung1993]`.\n\n    [chung1993]\n"
        changed = sources.outside_code(text, lambda part: sources.with_references(part, "doc/physics.md"))
        self.assertIn("[chung1993](references.md#chung1993), [bonet2008](references.md#bonet2008), 6.4", changed)
        self.assertEqual(len(re.findall(r"(?m)`\[chung1993\]`|^ {4}\[chung1993\]$", changed)), 2)
        links = "[a](parameters.md#newton) [b](../README.md#cases) [c](https://example.org)"
        self.assertEqual(sources.with_links(links, "doc/physics.md", self.folder), "[a](parameters/newton.md) [b](../index.md#cases) [c](https://example.org)")


if __name__ == "__main__":
    unittest.main()
