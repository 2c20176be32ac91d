# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes the page of references from doc/references.bib, in pybtex's plain style."""

import functools

from .tree import ROOT

BIBLIOGRAPHY = ROOT / "doc" / "references.bib"


@functools.cache
def bibliography():
    from pybtex.database import parse_file
    return parse_file(str(BIBLIOGRAPHY))


def keys():
    return list(bibliography().entries)


def write(pages):
    from pybtex.backends.markdown import Backend
    from pybtex.plugin import find_plugin
    style = find_plugin("pybtex.style.formatting", "unsrt")()
    lines = ["# References", "", "What pages and comments cite by its key. [The file for BibTeX](references.bib).", ""]
    for entry in sorted(style.format_bibliography(bibliography()), key=lambda entry: entry.key):
        lines += [f"## {entry.key}", "", entry.text.render(Backend(encoding="utf-8")).replace("\n", " "), ""]
    (pages / "doc" / "references.md").write_text("\n".join(lines), encoding="utf-8")
    (pages / "doc" / "references.bib").write_bytes(BIBLIOGRAPHY.read_bytes())
