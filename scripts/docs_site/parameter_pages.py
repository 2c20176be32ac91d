# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes a page for each section of parameters: the program's description of its entries, an example, and the cases that use the section.

The examples are doc/examples/SECTION.prm, parameter files that the program accepts. The comment at the start of such a file is the text before the
example.
"""

import re
import subprocess

from .sources import copy, write_page
from .tree import ROOT, toctree

EXAMPLES = ROOT / "doc" / "examples"

INDEX = """# All parameters

A page for each section of a parameter file, as the program describes it (`corotet --print-parameters`): entries with their defaults, what they allow and
what they mean, and an example. How a file is written is [another page](parameter_files.md).

| section | entries |
|---|---|
"""


def slug(section):
    """The name of a section's page, which is also the anchor of its heading in the list of all."""
    return re.sub(r"[^a-z0-9]+", "-", section.lower()).strip("-")


def sections(program):
    """The program's tables of entries, as {section: {heading: table}}. There is a heading for the section, and one for each of its subsections."""
    text = subprocess.run([program, "--print-parameters", "markdown"], check=True, capture_output=True, text=True).stdout
    found = {}
    for heading, table in re.findall(r"^## (.*?)\n\n(.*?)\n*(?=^## |\Z)", text, re.DOTALL | re.MULTILINE):
        found.setdefault(heading.split("/")[0], {})[heading] = table
    return found


def example(section):
    """The example of a section: the text of its first comment, and the lines of the parameter file after that."""
    comment, lines = re.match(r"((?:#[^\n]*\n)+)\n*(.*)", (EXAMPLES / f"{slug(section)}.prm").read_text(encoding="utf-8"), re.DOTALL).groups()
    return re.sub(r"^# ?", "", comment, flags=re.MULTILINE), lines


def users(section):
    """Paths of the ready cases and verification decks that have the section."""
    def uses(path):
        return re.search(rf"^subsection {re.escape(section)}$", path.read_text(encoding="utf-8"), re.MULTILINE)
    parameters = ROOT / "parameters"
    return [path for folder in (parameters, parameters / "verification") for path in sorted(folder.glob("*.prm")) if uses(path)]


def page(section, tables, pages):
    lines = [f"# {section}", ""]
    for heading, table in tables.items():
        lines += [*([f"## {heading.split('/', 1)[1]}", ""] if "/" in heading else []), table, ""]
    text, code = example(section)
    lines += ["## Example", "", text, "```prm", code.rstrip("\n"), "```", ""]
    links = []
    for path in users(section):
        name = path.relative_to(ROOT)
        copy(name, pages)
        links.append(f"[{path.stem}](../../{name})")
    if links:
        lines += ["## Files with this section", "", "Ready cases and verification decks: " + ", ".join(links) + ".", ""]
    return "\n".join(lines)


def write(program, pages):
    found = sections(program)
    index = INDEX
    for section, tables in found.items():
        write_page(pages, f"doc/parameters/{slug(section)}.md", page(section, tables, pages))
        names = [f"`{name}`" for table in tables.values() for name in re.findall(r"^\| ([^|]*?) \|", table, re.MULTILINE) if name not in ("Entry",)]
        index += f"| [{section}](parameters/{slug(section)}.md) | {', '.join(dict.fromkeys(names))} |\n"
    write_page(pages, "doc/parameters.md", index + toctree(f"doc/parameters/{slug(section)}" for section in found))
