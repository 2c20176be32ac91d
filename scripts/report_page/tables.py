# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes the tables and histograms of the page, in HTML that needs no script."""

import math

import numpy as np

from . import columns
from .run import last_row
from .text import MINUS, count, escape, number, plain, quantity, with_prefix

# Vectors in the history that belong to the whole body.
OF_BODY = ("momentum", "angular_momentum", "reaction", "internal_moment")
COUNTS = ("step", "newton_iterations", "linear_iterations", "inverted_cells", "degenerate_cells", "robust_rotations", "clamped_cells", "parts",
          "rejected_steps")


def table(head, rows, caption="", classes=""):
    """A table in HTML. @p head and each of the rows are lists of HTML; the first cell of a row is its heading."""
    head_html = "".join(f'<th scope="col">{cell}</th>' for cell in head)
    body = "\n".join(f'<tr><th scope="row">{row[0]}</th>' + "".join(f"<td>{cell}</td>" for cell in row[1:]) + "</tr>" for row in rows)
    caption = f"<caption>{caption}</caption>" if caption else ""
    head_html = f"<thead><tr>{head_html}</tr></thead>" if head else ""
    return f'<div class="scroll"><table class="{classes}">{caption}{head_html}<tbody>\n{body}\n</tbody></table></div>'


def pairs(rows, caption):
    return table([], [[name, value] for name, value in rows], caption, "pairs")


def final_state(run):
    """Two tables of the last state: one of scalars, and one of vectors with their components side by side."""
    final = last_row(run)
    vectors = columns.vectors(final)
    of_vectors = {f"{stem}_{c}" for stem in vectors for c in "xyz"}
    left_out = of_vectors | {"wall_time"}
    scalars = [[escape(columns.name(name)),
                number(value, f"final.{name}") if name in COUNTS else quantity(value, columns.unit(name), f"final.{name}")]
               for name, value in final.items() if name not in left_out]
    rows = []
    for stem in vectors:
        unit = columns.unit(f"{stem}_x")
        values = [final[f"{stem}_{c}"] for c in "xyz"]
        factor, shown = with_prefix(max((abs(v) for v in values if v is not None), default=0), unit)
        if stem in OF_BODY:
            known = columns.NAMES[stem]
        elif columns.is_of_support(stem):
            known = columns.name(stem)
        else:
            # All other vectors are displacements of probes, whatever their names are.
            known = f"displacement of {stem}"
        cells = [f'<data value="{v!r}" title="{v!r} {unit}" data-key="final.{escape(stem)}_{c}">{plain(v * factor)}</data>' if v is not None else "–"
                 for v, c in zip(values, "xyz")]
        rows.append([escape(known), *cells, escape(shown)])
    return pairs(scalars, "Last state"), table(["", "x", "y", "z", "unit"], rows, "Vectors of the last state", "numbers vectors") if rows else ""


def size_and_cost(run):
    summary = run.summary
    size = [[columns.name(key), quantity(summary[key], columns.any_unit(key), key)]
            for key in ("cells", "nodes", "dofs", "degree", "mesh_volume", "total_mass") if key in summary]
    cost = [[columns.name(key), quantity(summary[key], columns.any_unit(key), key)]
            for key in ("steps", "end_time", "modes", "runs", "finished_runs", "failed_runs", "preconditioner_builds", "ranks", "peak_memory_bytes",
                        "largest_rotation_difference") if key in summary]
    if isinstance(summary.get("wall_time"), dict):
        cost += [[f"wall time, {escape(part)}", quantity(value, "s", f"wall_time.{part}")] for part, value in summary["wall_time"].items()]
    errors = []
    if "error_estimate" in summary:
        errors.append(["estimated error of the stress, energy norm", quantity(summary["error_estimate"]["energy_norm"], "J^½",
                                                                              "error_estimate.energy_norm")])
        errors.append(["the same, relative", number(summary["error_estimate"]["relative"], "error_estimate.relative")])
    for norm, value in summary.get("errors", {}).items():
        errors.append([f"error in {escape(norm)}", number(value, f"errors.{norm}")])
        errors.append([f"exact solution in {escape(norm)}", number(summary["exact_norms"][norm], f"exact_norms.{norm}")])
    parts = [pairs(rows, caption) for rows, caption in ((size, "Size"), (cost, "Course and cost"), (errors, "Errors")) if rows]
    return "".join(parts)


def modes(run):
    """The table of frequencies. Its first column has buttons that show the modes."""
    t = run.table
    rows = []
    for i in range(len(t["mode"])):
        shares = [f'<data value="{t[f"mass_share_{c}"][i]!r}">{100 * t[f"mass_share_{c}"][i]:.1f}</data>' for c in "xyz"]
        rows.append([f'<button type="button" class="mode" data-mode="{i}" aria-pressed="false">{t["mode"][i]:.0f}</button>',
                     quantity(t["frequency"][i], "Hz", f"frequencies.{i}"), number(t["modal_mass"][i], digits=4), *shares,
                     number(t["residual"][i], digits=2)])
    note = "A mode’s button shows its shape. In x, y and z: the shares of the mass that take part when supports shake in this direction."
    return f'<p class="note">{note}</p>' + table(["mode", "frequency", "modal mass [kg m²]", "x [%]", "y [%]", "z [%]", "residual"], rows, classes="numbers")


def checks(run):
    rows = [[escape(row["quantity"]), number(row["computed"]), number(row["reference"]), escape(row["error"]).replace("-", MINUS), escape(row["tolerance"]),
             f'<span class="{"pass" if row["pass"] == "yes" else "miss"}">{escape(row["pass"])}</span>'] for row in run.checks]
    source, reason = run.entry("Verification/Source"), run.entry("Verification/Tolerance reason")
    notes = "".join(f"<p>{title}: {escape(text)}.</p>" for title, text in (("Reference", source), ("Why this tolerance", reason)) if text)
    return table(["quantity", "computed", "reference", "error", "tolerance", "pass"], rows, classes="numbers checks") + notes


STUDY_COLUMNS = ("degree", "mass", "rotation", "refinements", "time_step", "status", "cells", "dofs", "h")


def study(run):
    names = [name for name in STUDY_COLUMNS if name in run.table and not (name == "status" and set(run.table[name]) == {"done"})]
    names += [name for name in run.table if name.endswith(("_error", "_order", "_order_in_time"))]
    names += [name for name in ("newton_iterations", "linear_iterations", "wall_time") if name in run.table]
    used = ("_reference", "_error", "_order", "_time", "_iterations", "_memory_bytes")
    quantities = [name for name in run.table if name not in (*names, *STUDY_COLUMNS, "nodes", "steps") and not name.endswith(used)]

    def cell(name, value):
        if isinstance(value, str):
            return escape(value) if value not in ("nan", "") else ""
        if not math.isfinite(value):
            return ""
        if name.endswith(("_order", "_in_time")):
            return f'<data value="{value!r}">{value:.2f}</data>'.replace(">-", f">{MINUS}")
        return number(int(value) if value == int(value) else value, digits=3 if name.endswith("_time") else 4)

    units = {name: columns.any_unit(name) for name in names + quantities}
    shown = names + quantities
    head = [escape(name if name == "h" else columns.name(name)) + (f" [{units[name]}]" if units[name] != "-" else "") for name in shown]
    rows = [[cell(name, run.table[name][i]) for name in shown] for i in range(len(run.table["degree"]))]
    return table(head, rows, classes="numbers study")


def parameters(differences):
    rows = [[f"<code>{escape(d.entry)}</code>", f"<code>{escape(d.value) or 'empty'}</code>", f"<code>{escape(d.default) or 'empty'}</code>",
             escape(d.meaning)] for d in differences]
    return table(["entry", "value", "default", "meaning"], rows, classes="parameters")


def histogram(values, bins, title, note):
    """A histogram in SVG: bars show how many cells have a value in each interval."""
    counts, edges = np.histogram(values, bins=bins)
    width, height, bottom = 320, 120, 18
    step = width / len(counts)
    bars = []
    for i, n in enumerate(counts):
        bar = max(height * n / counts.max(), 1 if n else 0)
        bars.append(f'<rect x="{i * step + 0.5:.1f}" y="{height - bar:.1f}" width="{step - 1:.1f}" height="{bar:.1f}">'
                    f"<title>{edges[i]:.4g} to {edges[i + 1]:.4g}: {count(int(n), 'cell')}</title></rect>")
    labels = [(0, "start", edges[0]), (width / 2, "middle", (edges[0] + edges[-1]) / 2), (width, "end", edges[-1])]
    texts = "".join(f'<text x="{x:.0f}" y="{height + bottom - 4}" text-anchor="{anchor}">{value:.3g}</text>' for x, anchor, value in labels)
    return (f'<figure class="histogram"><figcaption>{title}</figcaption><svg viewBox="0 0 {width} {height + bottom}" role="img" '
            f'aria-label="{title}"><g>{"".join(bars)}</g><line x1="0" x2="{width}" y1="{height}" y2="{height}"/>{texts}</svg><p>{note}</p></figure>')


def quality(q):
    """Histograms of the angles and aspect ratios of the cells."""
    worst, largest = q.angles.min(), min(q.aspects.max(), 1e6)
    return '<div class="pair">' + histogram(
        q.angles, np.linspace(0, 72, 37), "Smallest dihedral angle of the cells [degrees]",
        f"{number(float(worst), 'quality.angle', 4)} at least, {plain(float(np.median(q.angles)), 4)} in half of the cells or more; "
        "70.53 in a regular tetrahedron") + histogram(
        q.aspects[q.aspects <= largest], np.linspace(1, max(1.05 * largest, 2), 37), "Aspect ratio of the cells [-]",
        f"{number(float(q.aspects.max()), 'quality.aspect', 4)} at most, {plain(float(np.median(q.aspects)), 4)} in half of the cells or less; "
        "longest edge over 2√6 times the inscribed radius, 1 in a regular tetrahedron") + "</div>"
