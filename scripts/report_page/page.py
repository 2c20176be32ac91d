# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Puts the parts of the page together, and writes the file."""

import dataclasses
import json
import math
import os
import pathlib
import re
import tempfile

from commands import check_folder, moved_to

from . import charts, tables, words
from .encode import Encoder
from .mesh import TimeSeries
from .parameters import differences, read_defaults
from .run import ReportError, read_run
from .text import count, escape

HERE = pathlib.Path(__file__).resolve().parent
THREE = pathlib.Path("/usr/share/javascript/three/three.min.js")
SCRIPTS = ("format", "colours", "store", "plot", "surface", "orbit", "pick", "view", "legend", "player", "kept", "report", "controls",
           "main")
MAX_BYTES = 15_000_000
ROOM_TO_SPARE = 60_000
KINDS = {"simulation": "simulation", "modes": "natural frequencies and modes", "study": "convergence study"}
MADE_BY = "Made by scripts/report of corotet"
LICENCE = "three.js r111, copyright 2010-2019 three.js authors, MIT licence: see its end"
MIT = """three.js is distributed under the MIT licence. Permission is hereby granted, free of charge, to any person obtaining a copy of this software
and associated documentation files (the "Software"), to deal in the Software without restriction, including without limitation the rights to use, copy,
modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do so,
subject to the following conditions: The above copyright notice and this permission notice shall be included in all copies or substantial portions of
the Software. THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF
MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM,
DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR
OTHER DEALINGS IN THE SOFTWARE."""


def fill(template, **values):
    """Replaces each {{name}} in the template by the value of that name. Each name must have a value, and each value a place."""
    found = set(re.findall(r"\{\{(\w+)\}\}", template))
    assert found == set(values), found ^ set(values)
    return re.sub(r"\{\{(\w+)\}\}", lambda match: values[match.group(1)], template)


def read(name):
    return (HERE / name).read_text(encoding="utf-8")


def scripts():
    """The page's own scripts, joined into one with a scope of its own."""
    text = "\n".join(read(f"js/{name}.js") for name in SCRIPTS)
    return f"(function () {{\n'use strict';\n{text}\n}}());"


def three():
    if not THREE.exists():
        raise ReportError(f"{THREE} is missing (Debian's package libjs-three)")
    text = THREE.read_text(encoding="utf-8")
    return f"/*! {LICENCE} */\n{text}\n/*\n{MIT}\n*/".replace("</script", "<\\/script")


def status(run):
    """The state of the run: a line if it is done, else a notice that nobody overlooks."""
    summary = run.summary
    reached = ""
    if run.kind == "simulation":
        reached = f" It reached t = {run.table['time'][-1]:.6g} s, step {run.table['step'][-1]:.0f}."
    message = escape(summary.get("message", "")).rstrip(".")
    notices = {"failed": ("failed", f"The computation failed: {message or 'the log says why'}.{reached}"),
               "stopped": ("open", f"The run was stopped: {message or '--restart goes on with it'}.{reached}"),
               "unfinished": ("open", f"The study is not finished: {summary.get('finished_runs')} of {summary.get('runs')} runs are done."),
               "running": ("open", f"The run is under way.{reached} This page shows what there was on {run.date}."),
               "killed": ("open", f"The run has not come to an end: it was killed, or its results were copied while it went on.{reached}")}
    if run.state in notices:
        kind, text = notices[run.state]
        return f'<p class="notice {kind}" role="alert" id="status" data-state="{run.state}">{text}</p>'
    parts = ["done"]
    if run.kind == "simulation":
        parts.append(count(summary["steps"], "step"))
    if "wall_time" in summary:
        parts.append(f"{summary['wall_time']['total']:.3g} s on {count(summary['ranks'], 'process', 'processes')}")
    parts.append(run.date)
    return f'<p class="status" id="status" data-state="{escape(run.state)}">{escape(" · ".join(parts))}</p>'


def section(name, title, html):
    return f'<section id="{name}">\n<h2>{title}</h2>\n{html}\n</section>'


def view_section(run, encoder, states):
    """The view in three dimensions, with notes on states, triangles and fields that it leaves out."""
    notes = []
    n = len(encoder.series.times)
    if encoder.is_thinned:
        notes.append(f"The surface is thinned: it has {count(encoder.n_triangles, 'triangle')}, of which the page draws "
                     f"{count(len(encoder.surface.triangles), 'triangle')} among the same nodes.")
    if len(states) + encoder.not_finite < n:
        what = "mode" if run.kind == "modes" else "state"
        notes.append(f"{count(len(states), what)} of {n} are in the page, so that it stays below {MAX_BYTES // 1_000_000} MB.")
    if encoder.not_finite:
        notes.append(f"{count(encoder.not_finite, 'state')} with numbers that are not finite {'is' if encoder.not_finite == 1 else 'are'} left out.")
    if encoder.not_finite_fields:
        notes.append("Left out, as some numbers are not finite: " + ", ".join(field.name.replace("_", " ") for field in encoder.not_finite_fields) + ".")
    if encoder.left_out:
        notes.append("Left out for size: " + ", ".join(field.name.replace("_", " ") for field in encoder.left_out) + ".")
    if run.kind == "modes":
        notes.append("A shape has no size of its own: here the largest displacement of a node is a hundredth of the body’s length, before the warp. "
                     "Colours are those of the largest deflection.")
    else:
        notes.append("Ranges are those of the surface; inside of the body values may be larger. The cut of the clip plane is a flat one: what is inside "
                     "of the body is not in the page.")
        if not encoder.series.has("PointData", "von_mises"):
            notes.append("Stress is that at the centres of cells; with Output/Stress = nodes it is recovered at the nodes.")
    words_of = {"modes": ("Phase of the vibration", "of this mode", "as written", ""),
                "simulation": ("Time", "of all states", "true scale", " and plots its history")}[run.kind]
    if len(states) < 3:
        words_of = (*words_of[:3], "")
    return fill(read("view.html"), slider=words_of[0], range_all=words_of[1], scale_button=words_of[2], history_hint=words_of[3], note=" ".join(notes))


def plots_section(all_charts):
    """The section of plots, with empty places that js/plot.js fills."""
    def places(some):
        return '<div class="charts">' + "".join(f'<figure class="chart" data-chart="{chart.name}"></figure>' for chart in some) + "</div>"

    first = [chart for chart in all_charts if not chart.is_secondary]
    rest = [chart for chart in all_charts if chart.is_secondary]
    html = places(first)
    if rest:
        html += f"<details><summary>{count(len(rest), 'more plot')}</summary>{places(rest)}</details>"
    thinned = max((chart.n_rows for chart in all_charts if not chart.log), default=0)
    if thinned > charts.MAX_ROWS:
        html += f'<p class="note">{count(thinned, "row")} of the history; of equal parts of it each curve has the least and the largest value.</p>'
    return html


def warnings_section(run):
    if not run.warnings:
        return "<p>None in the log.</p>"
    return "<ul class=\"warnings\">" + "".join(f"<li>{escape(line)}</li>" for line in run.warnings) + "</ul>"


def parameters_section(run):
    if not run.parameters:
        return "<p>parameters.prm is missing.</p>"
    defaults = read_defaults()
    if not defaults:
        return "<p>What differs from the defaults is not known here: the program corotet, which knows them, was not found beside scripts/report.</p>"
    different = differences(run.parameters, defaults)
    if not different:
        return "<p>None: all is as by default.</p>"
    return tables.parameters(different) + '<p class="note">Of the file as used, parameters.prm; running that repeats the run.</p>'


def sections_of(run, encoder, states, all_charts):
    """The sections of the page but the view, in order: (id, title, HTML)."""
    found = []
    if run.kind == "modes":
        found.append(("modes", "Frequencies", tables.modes(run)))
    if run.kind == "study":
        found.append(("study", "Runs", tables.study(run)))
    if all_charts:
        found.append(("plots", "Plots", plots_section(all_charts)))
    scalars, vectors = tables.final_state(run) if run.kind == "simulation" else ("", "")
    found.append(("results", "Results", f'<div class="columns">{scalars}{tables.size_and_cost(run)}</div>{vectors}'))
    if run.checks:
        missed = sum(row["pass"] != "yes" for row in run.checks)
        found.append(("checks", "Checks", (f'<p class="notice failed">{count(missed, "check")} of {len(run.checks)} missed.</p>' if missed else "")
                      + tables.checks(run)))
    found.append(("warnings", "Warnings", warnings_section(run)))
    found.append(("computed", "Computed", "<dl>" + "".join(f"<dt>{term}</dt><dd>{text}</dd>" for term, text in words.terms(run)) + "</dl>"))
    if encoder:
        found.append(("mesh", "Mesh quality", tables.quality(encoder.quality)))
    found.append(("parameters", "Parameters that differ from the defaults", parameters_section(run)))
    if run.log:
        found.append(("log", "Log", f"<details><summary>{count(len(run.log.splitlines()), 'line')}</summary><pre>{escape(run.log)}</pre></details>"))
    return found


def json_text(value):
    """The value as JSON that can stand in a script element: < is escaped."""
    return json.dumps(value, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")


def without_nan(value):
    """A copy of the value in which numbers that are not finite are None, which becomes null in JSON."""
    if isinstance(value, dict):
        return {name: without_nan(one) for name, one in value.items()}
    if isinstance(value, list):
        return [without_nan(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def page(folder):
    """The page of the run in the folder, as a text."""
    run = read_run(folder)
    encoder = Encoder(TimeSeries(folder), run.kind) if run.kind != "study" else None
    all_charts = charts.charts_of(run)
    description = {"kind": run.kind, "isStatic": run.is_static, "charts": [dataclasses.asdict(chart) for chart in all_charts]}

    def assemble(states, blocks):
        found = sections_of(run, encoder, states, all_charts)
        links = ([("view", "View")] if encoder else []) + [(name, title.split(" that")[0]) for name, title, _ in found]
        body = [view_section(run, encoder, states)] if encoder else []
        body += [section(*one) for one in found]
        about = f"<p>{MADE_BY} from {escape(run.name)}, {run.date}.</p>"
        if encoder:
            about += ("<p>Numbers of the view have 16 bits, an error of 1.5 × 10<sup>−5</sup> of the largest one of each state. Drawn with "
                      "three.js (MIT licence).</p>")
        return fill(read("page.html"), title=escape(run.name), kind=KINDS[run.kind], lead=words.lead(run), status=status(run), style=read("style.css"),
                    navigation="".join(f'<a href="#{name}">{title}</a>' for name, title in links), sections="\n".join(body), about=about,
                    description=json_text(without_nan(description)), blocks=blocks, three=three() if encoder else "", scripts=scripts())

    if not encoder:
        return assemble([], "")
    geometry, arrays = encoder.geometry()
    taken = len(assemble([], "").encode()) + len(geometry) + len(json_text(encoder.obstacles(encoder.series.times)))
    room = MAX_BYTES - ROOM_TO_SPARE - taken - 700 * len(encoder.series.times)
    states = encoder.states(room)
    if run.kind == "modes":
        for _, state in states:
            state["frequency"] = run.table["frequency"][state["index"]]
    description["view"] = encoder.describe([state for _, state in states], arrays)
    blocks = [("geometry", geometry)] + [(f"state-{k}", block) for k, (block, _) in enumerate(states)]
    return assemble([state for _, state in states], "\n".join(f'<script type="text/plain" id="{name}">{block}</script>' for name, block in blocks))


def check_place(out, overwrite):
    """Raises ReportError unless a page may be written at the path. A file that is no page of a run is replaced only if @p overwrite is set."""
    check_folder(out)
    if out.is_dir():
        raise ReportError(f"{out} cannot be written: it is a folder")
    if out.exists() and not overwrite and MADE_BY.encode() not in out.read_bytes():
        raise ReportError(f"{out} exists and is no page of a run; --overwrite replaces it")


def write_report(folder, out=None, overwrite=False):
    """Writes the page as a whole or not at all. Returns its path and its size [byte]."""
    if out:
        check_place(out, overwrite)
    text = page(folder).encode()
    # RUN/report.html is one of the files of the run, and is replaced whatever it is.
    out = out or folder / "report.html"
    check_place(out, overwrite=True)
    handle, name = tempfile.mkstemp(dir=out.parent, prefix=f".{out.name}.")
    with moved_to(out, name), os.fdopen(handle, "wb") as file:
        file.write(text)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(name, 0o666 & ~umask)
    return out, len(text)
