# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""How Sphinx makes the site of the documentation from the pages that scripts/docs has put together.

Everything that pages need is in the site: it opens from a folder, without a network.
"""

import re

from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Operator, String, Text


class ParameterFileLexer(RegexLexer):
    """Parameter files of ParameterHandler, for the colours of code."""

    name, aliases, filenames = "prm", ["prm"], ["*.prm"]
    tokens = {
        "root": [
            (r"#.*$", Comment),
            (r"(\s*)(subsection)([^\n#]*)", bygroups(Text, Keyword, Name.Namespace)),
            (r"(\s*)(end)\b", bygroups(Text, Keyword)),
            (r"(\s*)(include)([^\n#]*)", bygroups(Text, Keyword, String)),
            (r"(\s*)(set)(\s[^=\n]*)(=)((?:[^\n#\\]|\\\n|\\)*)", bygroups(Text, Keyword, Name.Attribute, Operator, String)),
            (r"[^\n]+|\n", Text),
        ]
    }


def setup(app):
    app.add_lexer("prm", ParameterFileLexer)
    return {"parallel_read_safe": True}


with open("version.txt", encoding="utf-8") as file:
    release = version = re.sub(r"\s", "", file.read())
project = "corotet"
author = "the corotet authors"
copyright = "2026, the corotet authors"  # pylint: disable=redefined-builtin

extensions = ["myst_parser", "sphinx.ext.mathjax"]
root_doc = "index"
exclude_patterns = ["extra", "static"]
language = "en"
highlight_language = "none"

# Links to headings of other pages; equations between dollar signs, or in blocks of the language "math", as repository
# browsers show them.
myst_enable_extensions = ["dollarmath", "html_image"]
myst_dmath_double_inline = False
myst_fence_as_directive = ["math"]
myst_heading_anchors = 4
# A page of plain Markdown may begin with a heading of the second level.
suppress_warnings = ["myst.header"]

html_theme = "furo"
html_title = f"corotet {release}"
html_static_path = ["static"]
html_extra_path = ["extra"]
html_css_files = ["corotet.css"]
html_copy_source = False
html_show_sphinx = False
html_theme_options = {"navigation_with_keys": True}

# MathJax 2 as Debian has it; scalable pictures in place of fonts, which browsers do not load from folders.
mathjax_path = "mathjax/MathJax.js"
mathjax2_config = {
    "jax": ["input/TeX", "output/SVG"],
    "extensions": ["tex2jax.js"],
    "TeX": {"extensions": ["AMSmath.js", "AMSsymbols.js", "noErrors.js", "noUndefined.js"]},
    "SVG": {"font": "TeX", "scale": 90},
    "tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]], "processClass": "math", "ignoreClass": ".*"},
    "showMathMenu": False,
    "messageStyle": "none",
}
