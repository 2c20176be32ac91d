# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Puts the project's pages together for Sphinx: copies in which links lead to pages of the site.

The pages remain plain Markdown. What is changed in the copies:
- README.md is called index.md, since it is the first page of the site;
- links into the list of parameters lead to the page of the section;
- keys of references, as [chung1993], become links to the page of references;
- other files of the project that pages link to are copied, and can be downloaded.
"""

import os
import pathlib
import re
import shutil

from .references import keys
from .tree import BELOW, PARTS, ROOT, WRITTEN, files, toctree

# The link to Doxygen's pages is written in HTML, because Sphinx does not know these pages.
API = """# Classes and functions

<p><a href="api/index.html">The reference of classes, functions and files</a></p>

is made by Doxygen from the comments of the headers in `include/corotet/`: what goes in and out, equations and their sources, units, errors. Of these,
[`corotet/corotet.h`](doc/library.md) and what it includes are installed; all others are private.
"""

MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
MATHJAX_PARTS = ["MathJax.js", "extensions/*.js", "extensions/TeX", "jax/element", "jax/input/TeX", "jax/output/SVG"]


def version():
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(corotet VERSION ([\d.]+)", text).group(1)


def outside_code(text, change):
    """The text, with the function change applied to all parts that are not code."""
    parts = re.split(r"(^```.*?^```$|^ {4}[^\n]*$|`[^`\n]*`)", text, flags=re.DOTALL | re.MULTILINE)
    return "".join(part if i % 2 else change(part) for i, part in enumerate(parts))


def with_references(text, page):
    """The text, with keys of references in brackets made links: [key], [key, key], [key, 2.7], [key; key]."""
    target = os.path.relpath("doc/references.md", os.path.dirname(page))
    known = "|".join(keys())

    def link(match):
        return "[" + re.sub(rf"\b({known})\b", rf"[\1]({target}#\1)", match.group(1)) + "]"
    return re.sub(rf"\[((?:{known})\b[^\]\[]*)\](?!\()", lambda match: "\\" + link(match)[:-1] + "\\]", text)


def with_links(text, page, pages):
    """The text, with links between pages changed to those of the site. Other files that the text links to are copied to the same place in the
    site."""
    folder = os.path.dirname(page)

    def target(match):
        path, anchor = match.group(1), match.group(2) or ""
        full = os.path.normpath(os.path.join(folder, path))
        if full == "README.md":
            full = "index.md"
        elif full == "doc/parameters.md" and anchor:
            full, anchor = f"doc/parameters/{anchor[1:]}.md", ""
        elif not full.endswith(".md") or full not in [*files(), *WRITTEN]:
            copy(full, pages)
        return f"]({os.path.relpath(full, folder or '.')}{anchor})"
    text = re.sub(r'<img src="([^"]+)"', lambda match: copy(os.path.normpath(os.path.join(folder, match.group(1))), pages) or match.group(0), text)
    return re.sub(r"\]\(([^)#:\s]+)(#[^)]*)?\)", target, text)


def copy(path, pages):
    destination = pages / path
    destination.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(ROOT / path, destination)


def write_page(pages, path, text):
    file = pages / path
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")


def put_together(pages):
    for page in files():
        text = (ROOT / page).read_text(encoding="utf-8")
        text = outside_code(text, lambda part, page=page: with_links(with_references(part, page), page, pages))
        if page in BELOW:
            text += toctree(str(path.relative_to(ROOT)) for path in sorted((ROOT / BELOW[page]).glob("*.md")))
        if page == "README.md":
            page, text = "index.md", text + "".join(toctree(part, caption) for caption, part in PARTS.items())
        write_page(pages, page, text)
    write_page(pages, "api.md", API)
    write_page(pages, "version.txt", version() + "\n")
    static = pages / "static"
    static.mkdir()
    shutil.copyfile(ROOT / "doc" / "site" / "corotet.css", static / "corotet.css")
    shutil.copyfile(ROOT / "doc" / "site" / "conf.py", pages / "conf.py")
    copy_mathjax(static / "mathjax")


def copy_mathjax(folder):
    """Copies the parts of MathJax that draw equations as scalable pictures."""
    for pattern in MATHJAX_PARTS:
        for path in MATHJAX.glob(pattern):
            destination = folder / path.relative_to(MATHJAX)
            destination.parent.mkdir(parents=True, exist_ok=True)
            (shutil.copytree if path.is_dir() else shutil.copyfile)(path, destination)
