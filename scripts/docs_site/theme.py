# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Mends two things that Debian's build of the theme Furo lacks.

- The script of the theme is two modules of JavaScript, one of which imports the other. Browsers load modules from servers only, not from a folder. So
  both modules are put into one plain script, which lets the reader choose light or dark, and marks the current place in the contents of a page.
- If the reader has chosen neither light nor dark, the system's choice should hold. The style rules for that are missing; they are made as a copy of the
  rules for dark.
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
