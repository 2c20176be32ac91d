# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes the gallery: ready cases, which are run for it in a shorter form, each with a picture, a link to the page of the run, and the parameter file."""

import os
import re
import subprocess
import sys

from .sources import copy, write_page
from .tree import ROOT

# The cases of the gallery: for each, the settings that make it short, and the arguments of scripts/render for its picture.
CASES = {
    "cantilever": (["Time integration/End time = 0.8"], ["--time", "0.4", "--field", "von_mises", "--camera", "front"]),
    "spring": (["Time integration/End time = 0.3"], ["--time", "0.15", "--camera", "front"]),
    "twisted_beam": ([], []),
    "rubber_mount": ([], []),
    "bend_45": ([], []),
    "crushed_cube": ([], []),
    "tuning_fork_modes": ([], ["--time", "4"]),
    "plate_modes": ([], ["--time", "4"]),
}

HEAD = """# Gallery

{n} of the ready cases, each with the page that `--report` writes of a run: the moving body, plots, tables. Click a picture to open the page: turn the body
by dragging, play its motion, choose what its colours show ([all that it can do](doc/report.md)). {shorter}

"""


def title(text):
    """The first clause of the comment that begins a case's parameter file."""
    comment = " ".join(re.sub(r"^# ?", "", line) for line in re.match(r"(?:#.*\n)+", text).group(0).splitlines())
    return re.split(r"[.:;]\s", comment + " ")[0].strip()


def run_case(name, settings, picture, program, folder):
    """Runs the case, and writes the page of the run, NAME.html, and a picture, NAME.png, to the folder."""
    results = folder.parent.parent / "gallery-results"
    results.mkdir(exist_ok=True)
    overrides = [word for setting in settings for word in ("--set", setting)]
    # The log of the run shows the name of the case, so it is relative: the site must not contain paths of this machine.
    case = os.path.relpath(ROOT / "parameters" / f"{name}.prm", results)
    run_command(results, program.resolve(), case, "--quiet", "--output", name, *overrides)
    run_command(results, sys.executable, ROOT / "scripts" / "report", name, "--out", folder / f"{name}.html")
    run_command(results, sys.executable, ROOT / "scripts" / "render", name, *picture, "--warp", "auto", "--size", "480", "320",
                "--without", "legend", "time", "axes", "--out", folder / f"{name}.png")


def run_command(folder, *command):
    process = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if process.returncode != 0:
        sys.exit(f"docs: error: {' '.join(map(str, command))} ended with status {process.returncode}:\n{process.stderr}")


def write(program, pages, run=True):
    folder = pages / "extra" / "gallery"
    folder.mkdir(parents=True)
    cards, texts = [], []
    for name, (settings, picture) in CASES.items():
        text = (ROOT / "parameters" / f"{name}.prm").read_text(encoding="utf-8")
        if run:
            run_case(name, settings, picture, program, folder)
            cards.append(f'<a href="gallery/{name}.html"><img src="gallery/{name}.png" alt="" loading="lazy">'
                         f"<strong>{name}</strong><span>{title(text)}</span></a>")
        copy(f"parameters/{name}.prm", pages)
        changes = "; ".join(f"`{setting}`" for setting in settings)
        texts += [f"## {name}", "", title(text) + "." + (f" Shortened by {changes}." if changes else ""), "",
                  f"    make report PRM=parameters/{name}.prm", "", f"The [parameter file](parameters/{name}.prm):", "",
                  "```prm", text.rstrip("\n"), "```", ""]
    shorter = "Some were shortened for this page, as said below." if run else "This site was made without the pages of runs."
    grid = ['<div class="gallery">', *cards, "</div>", ""] if cards else []
    write_page(pages, "gallery.md", HEAD.format(n=len(CASES), shorter=shorter) + "\n".join([*grid, "", *texts]))
