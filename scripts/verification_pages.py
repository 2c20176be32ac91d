# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes doc/verification.md and doc/verification/*.md, a page for each verification deck, from the outcomes of scripts/verify."""

import re
import textwrap

import verification_pictures
from pictures import ROOT

INDEX = ROOT / "doc" / "verification.md"
FOLDER = ROOT / "doc" / "verification"
WIDTH = 140

HEAD = """
# Verification

Written by `scripts/verify --document`; do not edit. Every figure and every picture comes from a run of the program.

    make verify

runs the decks in `parameters/verification/`, cases with a known answer, and compares their results with it: {verdict}.
{time}

The section `Verification` of each deck has the checks, the source of the reference values and the reason of the tolerances. The program itself makes the
comparison whenever such a file is run, writes `verification.csv` beside the other results, and ends with status 2 if a check fails.

## Checks

A check is `NAME: STATISTIC FORMULA where CONDITION = REFERENCE +- TOLERANCE`, for example

    tip at P = 5: last -tip_z where time == 5 = 0.71379 +- 0.1 %

- The statistic is `first`, `last`, `min`, `max`, `mean` or `range` (the largest less the smallest value).
- Formula and condition may contain the columns of [`history.csv`](results.md#historycsv), of [`modes.csv`](results.md#modescsv) with `Type = modes`, or of
  [`study.csv`](studies.md#results) with `Type = convergence study`, in the syntax of all expressions. Only rows where the condition holds
  count; without `where`, all rows count.
- Reference and tolerance are numbers or formulas of numbers; a tolerance that ends in % is relative to the reference. `< REFERENCE` or `> REFERENCE` in place
  of `= REFERENCE +- TOLERANCE` is a bound. A check fails if its value is not a number, or if no row counts.
- Checks are separated by semicolons.

## Cases

The column "error" has the largest error among the checks of a case, in percent of its tolerance; bounds have no tolerance. The last column has the processor
time in seconds.

| | case | what it is | checks | error | pass | seconds |
| --- | --- | --- | ---: | ---: | --- | ---: |
"""


def comment_of(deck):
    comment = re.match(r"(?:#.*\n)+", deck.read_text(encoding="utf-8")).group(0)
    return re.sub(r"^# ?", "", comment, flags=re.MULTILINE)


def title_of(comment):
    """The first clause of a deck's comment, without the numbers that may follow in it."""
    sentence = re.split(r"[.:;]\s", " ".join(comment.split()) + " ")[0]
    return re.split(r", [^,]* = ", sentence)[0]


def error_of(outcome):
    """The largest ratio of error to tolerance among the checks of a deck, as a text."""
    ratios = []
    for row in outcome.rows:
        if row["tolerance"] not in ("above", "below"):
            tolerance = verification_pictures.evaluate(row["tolerance"].removesuffix("%").strip())
            ratios.append(abs(float(row["error"].removesuffix("%"))) / tolerance)
    if not ratios:
        return "-"
    return f"{100 * max(ratios):.0f} %" if max(ratios) >= 0.005 else "< 1 %"


def filled(text):
    """The text as a paragraph with lines of the right length. Names of other pages in it become links."""
    text = re.sub(r"\bdoc/(\w+\.md)", r"[doc/\1](../\1)", text)
    return textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False)


def passed(outcome):
    return "yes" if outcome.failed == 0 else f"**{outcome.failed} not**"


def index_row(outcome):
    name = outcome.deck.stem
    picture = f'<img src="pictures/verification/{name}.png" width="150" alt="">'
    seconds = f"{outcome.seconds:.0f}" if outcome.seconds >= 1 else "< 1"
    cells = [picture, f"[{name}](verification/{name}.md)", title_of(comment_of(outcome.deck)), len(outcome.rows), error_of(outcome), passed(outcome), seconds]
    return "| " + " | ".join(map(str, cells)) + " |"


def page(outcome, caption):
    """The page of a deck: its comment, its picture, its source, the reason of its tolerances, and the table of its checks."""
    name = outcome.deck.stem
    comment = comment_of(outcome.deck)
    text = re.sub(r"(?:^ +.*\n)+", lambda formulas: f"\n{textwrap.indent(formulas.group(0), '    ')}\n", comment, flags=re.MULTILINE)
    lines = [f"# {name}", "", text.strip(), "",
             f"![{title_of(comment)}](../pictures/verification/{name}.png)", "", filled(caption), "",
             filled(f"**Source.** {outcome.entry('Source')}."), "", filled(f"**Tolerances.** {outcome.entry('Tolerance reason')}."), "",
             "| quantity | computed | reference | error | tolerance | pass |", "| --- |" + " ---: |" * 4 + " --- |"]
    for _, *cells, good in outcome.table():
        lines.append("| " + " | ".join([*cells, good if good == "yes" else "**no**"]) + " |")
    deck = f"parameters/verification/{name}.prm"
    lines += ["", f"    scripts/toolchain scripts/verify {name}", "",
              f"runs [{deck}](../../{deck}) and shows this table. [All cases](../verification.md)."]
    return "\n".join(lines) + "\n"


def write(outcomes, verdict, time):
    """Writes the index and all pages, and draws their pictures. Removes pages and pictures of decks that no longer exist."""
    names = {outcome.deck.stem for outcome in outcomes}
    unknown = set(verification_pictures.LOOKS) - names
    assert not unknown, f"LOOKS of scripts/verification_pictures.py has decks that are no more: {', '.join(sorted(unknown))}"
    FOLDER.mkdir(parents=True, exist_ok=True)
    for outcome in outcomes:
        caption = verification_pictures.draw(outcome)
        (FOLDER / f"{outcome.deck.stem}.md").write_text(page(outcome, caption), encoding="utf-8")
    for file in [*FOLDER.glob("*.md"), *verification_pictures.FOLDER.glob("*.png")]:
        if file.stem not in names:
            file.unlink()
    head = HEAD.format(verdict=verdict, time=time).strip()
    INDEX.write_text("\n".join([head, *map(index_row, outcomes)]) + "\n", encoding="utf-8")
