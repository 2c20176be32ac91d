#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""From a scan to a page: a trefoil knot of 70,000 triangles in an STL file, held where it is highest, falls and dangles, with elements of
degree 2, corotational, on two ranks. How long does it take from the file to the page of the run, how large is the page, how fast does it
open in Chromium (which draws by software here), and how many states does it show in a second? Run it inside of scripts/toolchain:

    benchmarks/scan_to_report.py [--triangles N] [--ranks N] [--program PROGRAM] [--keep FOLDER] [--document]

The status is 1 if it takes three minutes or more, or the page has 15 MB or more. --document writes the table into doc/report.md.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "meshes"), str(ROOT / "tests" / "program")]

from browser import Browser  # pylint: disable=wrong-import-position
from make_surfaces import trefoil, write_stl  # pylint: disable=wrong-import-position
from program_runs import document, launcher  # pylint: disable=wrong-import-position

PAGE = ROOT / "doc" / "report.md"
MOST_SECONDS, MOST_BYTES = 180, 15e6
CASE = """include {root}/parameters/trefoil.prm
subsection Mesh
  subsection file
    set File         = scan.stl
    set Element size = 0.2 # of a tube of 1 cm: a scan has more triangles than a computation needs
  end
end
subsection Time integration
  set End time  = 0.2
  set Time step = 0.02
end
"""
# Counts the states that are shown while the page plays for some seconds.
PLAY = """const done = arguments[0], slider = report.player.slider;
let shown = 0, last = slider.value;
const begin = performance.now();
report.player.play();
const count = () => {
  if (slider.value !== last) { shown += 1; last = slider.value; }
  if (performance.now() - begin < 5000) requestAnimationFrame(count);
  else { report.player.stop(); done(shown / (performance.now() - begin) * 1000); }
};
requestAnimationFrame(count);"""


def run_case(program, folder, triangles, ranks):
    """The number of triangles, and the seconds from the file to the page."""
    n_around = round((triangles / 28) ** 0.5)
    corners = trefoil(14 * n_around, n_around, 0.5)
    write_stl(folder / "scan.stl", corners)
    (folder / "scan.prm").write_text(CASE.format(root=ROOT), encoding="utf-8")
    begin = time.monotonic()
    subprocess.run([*launcher(ranks), program, "scan.prm", "--output", "results", "--report", "--quiet"], cwd=folder, check=True)
    return len(corners), time.monotonic() - begin


def look(page):
    """Seconds until the page is ready, and states that it shows per second."""
    browser = Browser()
    try:
        browser.set_size(1280, 800)
        seconds = browser.open(page)
        browser.driver.set_script_timeout(60)
        return seconds, browser.driver.execute_async_script(PLAY)
    finally:
        browser.quit()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--triangles", type=int, default=70000, metavar="N")
    parser.add_argument("--ranks", type=int, default=2, metavar="N")
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "corotet"))
    parser.add_argument("--keep", metavar="FOLDER", help="for the file and the results")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(options.keep or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        triangles, seconds = run_case(os.path.abspath(options.program), folder, options.triangles, options.ranks)
        page = folder / "results" / "report.html"
        size = page.stat().st_size
        seconds_to_open, states = look(page)
        summary = json.loads((folder / "results" / "summary.json").read_text(encoding="utf-8"))
    rows = [("triangles in the STL file", f"{triangles:,}"), ("cells, unknowns", f"{summary['cells']:,}, {summary['dofs']:,}"),
            ("steps", summary["steps"]), ("from the file to the page", f"{seconds:.0f} s on {options.ranks} ranks"),
            ("of that: set-up, steps", f"{summary['wall_time']['setup']:.0f} s, {summary['wall_time']['assembly'] + summary['wall_time']['solve']:.0f} s"),
            ("size of the page", f"{size / 1e6:.1f} MB"), ("until it is ready in Chromium", f"{seconds_to_open:.1f} s"),
            ("states shown in a second", f"{states:.1f}")]
    lines = ["| from a scan to a page | |", "|---|---:|", *(f"| {name} | {value} |" for name, value in rows)]
    print("\n".join(lines))
    if options.document:
        document(PAGE, "scan", lines)
    return 0 if seconds < MOST_SECONDS and size < MOST_BYTES else 1


if __name__ == "__main__":
    sys.exit(main())
