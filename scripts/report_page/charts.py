# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Chooses the plots of a page, the columns of each, and their numbers. Rows are left out if there are more than a picture can show."""

import dataclasses
import math

from . import columns

MAX_ROWS = 1500
DIGITS = 9


@dataclasses.dataclass
class Chart:
    name: str
    title: str
    unit: str
    x_label: str
    x_unit: str
    series: list  # curves, each {"label", "x", "y"}; a curve without "x" takes that of the chart
    x: list = None
    log: bool = False
    points: bool = False
    n_rows: int = 0  # before thinning
    is_secondary: bool = False  # whether it is hidden until the reader opens that part of the page


def finite(value):
    return float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None


def thinned_rows(table, names):
    """Numbers of the rows to plot. If there are too many rows, these are the first and the last one, and from each of some equal parts of the table the
    rows with the smallest and with the largest value of each column."""
    n = len(table[names[0]])
    if n <= MAX_ROWS:
        return range(n)
    parts = MAX_ROWS // (2 * len(names))
    kept = {0, n - 1}
    for part in range(parts):
        rows = range(part * n // parts, (part + 1) * n // parts)
        for name in names:
            finite_rows = [i for i in rows if math.isfinite(table[name][i])]
            if finite_rows:
                kept |= {min(finite_rows, key=table[name].__getitem__), max(finite_rows, key=table[name].__getitem__)}
    return sorted(kept)


def history_chart(run, name, title, names, **others):
    table = run.table
    rows = thinned_rows(table, names)
    x_label = "load parameter t" if run.is_static else "time"
    series = [{"label": columns.name(column), "column": column, "y": [finite(table[column][i]) for i in rows]} for column in names]
    return Chart(name, title, columns.unit(names[0]), x_label, "s", series, [finite(table["time"][i]) for i in rows], n_rows=len(table["time"]), **others)


def is_flat_zero(table, column):
    return not any(table[column])


def history_charts(run):
    """The plots of a history: energies, probes, reactions and iterations, and less important ones as secondary plots."""
    table = run.table
    if len(table["time"]) < 3:
        return []
    charts = []

    def add(name, title, names, **others):
        names = [column for column in names if column in table]
        if names and not all(is_flat_zero(table, column) for column in names):
            charts.append(history_chart(run, name, title, names, **others))

    energies = [c for c in ("kinetic_energy", "elastic_energy", "dissipated_energy", "external_work") if c in table and not is_flat_zero(table, c)]
    add("energies", "Energies", energies)
    add("balance", "Energy balance: what is left over", ["energy_balance"])
    own = {"momentum", "angular_momentum", "reaction", "internal_moment"}
    for stem in columns.vectors(table):
        if columns.is_of_support(stem):
            support, _, what = stem.rpartition("_contact" if stem.endswith("_contact") else "_reaction")
            kind = "Force" if stem.endswith("_contact") else "Moment about the origin" if what else "Reaction"
            add(stem, f"{kind} of {support}", [f"{stem}_{c}" for c in "xyz"])
        elif stem not in own:
            add(f"probe-{stem}", f"Displacement of {stem}", [f"{stem}_{c}" for c in "xyz"])
    for column in table:
        if column.endswith("_von_mises"):
            add(f"stress-{column}", f"Von Mises stress at {column[:-len('_von_mises')]}", [column])
    add("contact", "Contact: energy of the pressure, work of friction", ["contact_energy", "friction_work"])
    add("reaction", "Reaction of the supports", [f"reaction_{c}" for c in "xyz"])
    add("iterations", "Iterations of each step", ["newton_iterations", "linear_iterations"], points=True)
    for name, title, names in (("displacement", "Largest displacement", ["max_displacement"]), ("momentum", "Momentum", [f"momentum_{c}" for c in "xyz"]),
                               ("angular", "Angular momentum about the origin", [f"angular_momentum_{c}" for c in "xyz"]),
                               ("volume", "Volume of the displaced body", ["volume"]), ("det", "Smallest det F", ["min_det_F"]),
                               ("dt", "Length of the steps", ["dt"]), ("wall", "Wall time", ["wall_time"])):
        add(name, title, names, is_secondary=True)
    return charts


def study_rows(run):
    names = list(run.table)
    return [dict(zip(names, values)) for values in zip(*run.table.values())]


def series_label(key):
    words = {"degree": lambda v: f"degree {v:.0f}", "refinements": lambda v: f"{v:.0f} refinements", "time_step": lambda v: f"dt = {v:g} s"}
    return ", ".join(words.get(name, str)(value) for name, value in key)


def study_chart(rows, error, abscissa, label):
    varied = "time_step" if abscissa == "time_step" else "refinements"
    groups = {}
    for row in rows:
        key = tuple((name, row[name]) for name in ("degree", "mass", "rotation", "refinements", "time_step") if name in row and name != varied)
        # Steps are shortened to divide the time of the run: their mean counts.
        value, x = row[f"{error}_error"], row["mean_time_step" if abscissa == "time_step" else abscissa]
        if isinstance(value, float) and isinstance(x, float) and value > 0 and x > 0:
            groups.setdefault(key, []).append((x, value / (row.get(f"{error}_reference") or 1)))
    is_relative = any(row.get(f"{error}_reference") for row in rows)
    series = [{"label": series_label(key), "x": [finite(x) for x, _ in group], "y": [finite(y) for _, y in group]} for key, group in groups.items()]
    title = columns.ERRORS.get(error, f"error of {columns.name(error)}") + (", relative" if is_relative else "")
    unit = "-" if is_relative else columns.any_unit(f"{error}_error")
    return Chart(f"{error}-{abscissa}", title[0].upper() + title[1:], unit, label, columns.any_unit(abscissa), series, log=True, points=True,
                 n_rows=len(rows))


def study_charts(run):
    """The plots of a convergence study: errors over the size of cells, unknowns and wall time, and over the time step if the study varies it."""
    rows = [row for row in study_rows(run) if row["status"] == "done"]
    errors = [name[:-len("_error")] for name in run.table if name.endswith("_error")]
    abscissas = [("h", "h, size of the cells"), ("dofs", "unknowns"), ("wall_time", "wall time")]
    if len({row["refinements"] for row in rows}) < 2:
        abscissas = []
    if len({row.get("time_step") for row in rows}) > 1:
        abscissas.insert(0, ("time_step", "time step"))
    charts = [study_chart(rows, error, abscissa, label) for k, (abscissa, label) in enumerate(abscissas) for error in errors]
    for chart in charts:
        chart.is_secondary = not chart.name.endswith(abscissas[0][0])
    return [chart for chart in charts if chart.series]


def charts_of(run):
    return {"simulation": history_charts, "study": study_charts, "modes": lambda run: []}[run.kind](run)
