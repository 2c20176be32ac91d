# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Checks the pages of a site: each link leads to a page, a file or a place that exists, nothing is loaded from a network, and no page contains a path of
this machine."""

import html.parser
import pathlib
import re
import urllib.parse

from .tree import ROOT

LOADED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}
TEXTS = {".html", ".js", ".css", ".json", ".txt", ".svg", ".prm", ".md"}


class Page(html.parser.HTMLParser):
    """The links of a page, and the places in it that links can lead to."""

    def __init__(self, path):
        super().__init__()
        self.links, self.loaded, self.places, self.n_modules = [], [], set(), 0
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.n_modules += tag == "script" and attributes.get("type") == "module" and "src" in attributes
        self.places |= {attributes[name] for name in ("id", "name") if attributes.get(name)}
        for name in ("href", "src"):
            target = attributes.get(name)
            if target:
                (self.loaded if (tag, name) in LOADED else self.links).append(target)


def is_local(target):
    return not re.match(r"[a-z][a-z0-9+.-]*:|//", target)


def is_summary(site, page, file):
    """Whether a link of @p page to @p file is one of Doxygen's links to a summary in the same page. Doxygen leaves out the summary if all members are
    private, but not the link."""
    return page == file and page.is_relative_to(site / "api")


def broken_links(site, page, parsed, pages, without):
    """Yields a message for each broken link of a page. Links into the folders @p without are not looked at."""
    for target in parsed.links + parsed.loaded:
        if not is_local(target):
            continue
        path, _, place = urllib.parse.unquote(target).partition("#")
        path = path.partition("?")[0]
        file = (page.parent / path).resolve() if path else page
        if any(file.is_relative_to(site / folder) for folder in without):
            continue
        if not file.is_relative_to(site) or not file.is_file():
            yield f"{page.relative_to(site)}: {target} does not exist"
        elif place and file.suffix == ".html" and place not in pages[file].places and not is_summary(site, page, file):
            yield f"{page.relative_to(site)}: {target}: that page has no such place"


def mistakes(site, without=()):
    """All mistakes in a site as lines of text; folders of @p without may be missing."""
    site = pathlib.Path(site).resolve()
    pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        found += broken_links(site, path, page, pages, without)
        found += [f"{path.relative_to(site)}: a module of JavaScript, which browsers do not load from a folder" for _ in range(page.n_modules)]
        found += [f"{path.relative_to(site)}: {target} is loaded from a network" for target in page.loaded if not is_local(target) and
                  not target.startswith("data:")]
    here = {str(ROOT), str(pathlib.Path.home())} - {"/"}
    for path in sorted(site.rglob("*")):
        if path.is_file() and path.suffix in TEXTS:
            text = path.read_text(encoding="utf-8", errors="replace")
            found += [f"{path.relative_to(site)}: has a path of this machine, {word}" for word in here if re.search(rf"{re.escape(word)}(?![\w-])", text)]
    return found
