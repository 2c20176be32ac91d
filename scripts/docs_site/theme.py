# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Two things that Debian's build of the theme Furo lacks.

- Its script is two modules of JavaScript, one of which imports the other. Browsers load modules from servers only, not from a folder. Together they are a
  script like any other: for the choice of light and dark, and for the mark in the contents of a page.
- Where the reader has chosen neither light nor dark, the system's choice should hold; the rules for that are missing, as a copy of those for dark.
"""

import re


def without_modules(site):
    scripts = site / "_static" / "scripts"
    text = (scripts / "furo.js").read_text(encoding="utf-8")
    if "import" in text:
        text = re.sub(r"^import .*$|^ *console\.log\(.*\);$", "", text, flags=re.MULTILINE)
        (scripts / "furo.js").write_text((scripts / "gumshoe-patched.js").read_text(encoding="utf-8") + text, encoding="utf-8")
        (scripts / "gumshoe-patched.js").unlink()
    for page in site.rglob("*.html"):
        if page.relative_to(site).parts[0] not in ("api", "gallery"):
            html = page.read_text(encoding="utf-8")
            page.write_text(html.replace('<script type="module" src=', "<script defer src="), encoding="utf-8")


def with_colours_of_system(site):
    path = site / "_static" / "styles" / "furo.css"
    text = path.read_text(encoding="utf-8")
    dark = re.search(r'body\[data-theme="?dark"?\] *(\{[^{}]*--color-background-primary[^{}]*\})', text)
    if dark and "body:not([data-theme" not in text:
        path.write_text(f'{text}\n@media not print {{ @media (prefers-color-scheme: dark) {{\nbody:not([data-theme="light"]) {dark.group(1)}\n}} }}\n',
                        encoding="utf-8")
