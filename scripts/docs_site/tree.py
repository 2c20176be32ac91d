# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The list of all pages of the site, in the order of its contents. A new page must be added here, and nowhere else."""

import pathlib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent

# The parts of the contents: {caption: pages}. README.md is not among them, as it is the first page of the site.
PARTS = {
    "First steps": ["doc/installation.md", "doc/tutorial.md", "gallery.md"],
    "Use": ["doc/command_line.md", "doc/parameter_files.md", "doc/parameters.md", "doc/meshes.md", "meshes/README.md", "doc/results.md",
            "doc/report.md", "doc/pictures.md", "doc/modes.md", "doc/studies.md", "doc/scaling.md", "doc/limits.md"],
    "Theory": ["doc/physics.md", "doc/rotations.md", "doc/curved.md", "doc/algorithms.md", "doc/references.md"],
    "Evidence": ["doc/verification.md", "doc/measurements.md", "doc/degrees.md", "doc/dynamics.md", "doc/stress.md", "doc/reliability.md",
                 "benchmarks/shapes.md"],
    "Extend": ["doc/library.md", "CONTRIBUTING.md", "api.md", "CHANGELOG.md"],
}

# Pages that have pages below them in the contents, each with the folder of these.
BELOW = {"doc/tutorial.md": "doc/tutorial", "doc/verification.md": "doc/verification", "doc/parameters.md": "doc/parameters"}

# Pages that are not files of the project: the modules in this folder write them. api.md is only a heading before Doxygen's pages.
WRITTEN = {"gallery.md", "doc/parameters.md", "doc/references.md", "api.md"}


def files():
    """Paths of all pages that are files of the project, README.md among them."""
    pages = ["README.md", *(page for part in PARTS.values() for page in part if page not in WRITTEN)]
    for page, folder in BELOW.items():
        if page not in WRITTEN:
            pages += [str(path.relative_to(ROOT)) for path in sorted((ROOT / folder).glob("*.md"))]
    return pages


def toctree(pages, caption=None):
    """The text that a page needs to list other pages in Sphinx's contents. Paths of pages are relative to the top folder."""
    lines = ["", "```{toctree}", ":hidden:", *([f":caption: {caption}"] if caption else []), "", *(f"/{page}" for page in pages), "```", ""]
    return "\n".join(lines)
