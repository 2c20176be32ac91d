# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes numbers and units for people, in HTML. The page's scripts write numbers by the same rules (js/format.js)."""

import html
import math

DIGITS = 5
PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
UNITS_WITH_PREFIX = {"Pa", "J", "m", "N", "N m", "s", "Hz", "B"}
MINUS, THIN_SPACE = "\u2212", "\u202f"


def escape(text):
    return html.escape(str(text))


def with_prefix(size, unit):
    """A factor and a unit for numbers up to @p size: 0.002 m are 2 mm."""
    if unit not in UNITS_WITH_PREFIX or not size or not math.isfinite(size):
        return 1, "" if unit == "-" else unit
    found = next(((value, prefix) for value, prefix in PREFIXES if size >= 0.99999 * value), None)
    if found is None or (unit == "s" and found[0] > 1):
        return 1, unit
    return 1 / found[0], found[1] + unit


def grouped(n):
    """A whole number, from 10 000 on in groups of three digits."""
    return f"{n:,}".replace(",", THIN_SPACE) if abs(n) >= 10_000 else str(n)


def plain(value, digits=DIGITS):
    """A number without a unit, written with a power of ten if it would have many zeros otherwise."""
    if not isinstance(value, (int, float)) or isinstance(value, bool):
        return escape(value)
    if not math.isfinite(value):
        return "not a number" if math.isnan(value) else "infinite"
    if value == int(value) and abs(value) < 1e7:
        text = grouped(int(value))
    elif 1e-3 <= abs(value) < 1e6:
        text = f"{value:.{digits}g}"
        if abs(value) >= 10**(digits - 1):
            text = grouped(round(value))
    else:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        if "." in mantissa:
            mantissa = mantissa.rstrip("0").rstrip(".")
        text = f"{mantissa}{THIN_SPACE}×{THIN_SPACE}10<sup>{int(exponent)}</sup>"
    return text.replace("-", MINUS)


def number(value, key="", digits=DIGITS):
    """A number as by plain(), in an element that also has all its digits, which are shown under the pointer. @p key is the name of the
    element."""
    if value is None:
        return "–"
    name = f' data-key="{escape(key)}"' if key else ""
    return f'<data value="{value!r}" title="{value!r}"{name}>{plain(value, digits)}</data>'


def quantity(value, unit, key="", digits=DIGITS):
    """A number with its unit. The prefix of the unit follows from the number."""
    if value is None:
        return "–"
    factor, shown = with_prefix(abs(value), unit)
    name = f' data-key="{escape(key)}"' if key else ""
    full = f"{value!r} {unit}" if unit != "-" else repr(value)
    return f'<data value="{value!r}" title="{escape(full)}"{name}>{plain(value * factor if factor != 1 else value, digits)}</data>' + \
        (f"&nbsp;{escape(shown)}" if shown else "")


def count(n, singular, plural=None):
    return grouped(n) + " " + (singular if n == 1 else plural or singular + "s")
