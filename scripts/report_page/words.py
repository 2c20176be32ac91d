# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Describes in words, from the parameters, what was computed: in a sentence, and in a list of terms with explanations."""

import pathlib
import re

from .text import count, escape, plain, with_prefix

LAWS = {"linear": "linear elasticity", "corotational": "corotational elasticity", "Saint Venant-Kirchhoff": "the Saint Venant-Kirchhoff law",
        "neo-Hookean": "the neo-Hookean law"}


def value(text, unit=""):
    """The value of an entry in HTML: a number with its unit, or a formula as it was written."""
    shown = escape(text)
    try:
        factor, unit = with_prefix(abs(float(text)), unit or "-")
        shown = plain(float(f"{float(text) * factor:.12g}"))
    except ValueError:
        shown = f"<code>{shown}</code>"
    return shown + (f"&nbsp;{unit}" if unit else "")


def vector(text, unit):
    return f"<code>({escape('; '.join(part.strip() for part in text.split(';')))})</code>&nbsp;{unit}"


def is_zero(text):
    return not re.search(r"[^0.;,\s+-]", text)


def lead(run):
    entry = run.entry
    if not run.parameters:
        return "The file of parameters is missing: what was computed is not known."
    if run.kind == "modes":
        return f"The {value(entry('Modes/Number'))} lowest natural frequencies of an elastic body and its shapes of vibration."
    if run.kind == "study":
        against = {"exact solution": "an exact solution", "finer run": "a run on a finer mesh"}.get(entry("Convergence study/Reference"))
        varied = [f"degree {entry('Convergence study/Degrees')}", f"refinements {entry('Convergence study/Refinements')}"]
        varied += [f"{key.lower()} {entry(f'Convergence study/{key}')}" for key in ("Time steps", "Masses", "Rotations")
                   if entry(f"Convergence study/{key}")]
        return f"A convergence study: {escape('; '.join(varied))}" + (f"; compared with {against}." if against else ".")
    if run.is_static:
        steps = entry("Time integration/static/Load steps")
        return "The deformation of an elastic body at rest under its loads, " + ("in one step." if steps == "1" else f"in {value(steps)} load steps.")
    if not entry("Time integration/End time"):
        return "The motion of an elastic body."
    return f"The motion of an elastic body from {value(entry('Time integration/Start time'), 's')} to {value(entry('Time integration/End time'), 's')}."


def body(run):
    entry, summary = run.entry, run.summary
    kind = entry("Mesh/Type")
    if kind == "box":
        size, cells = (" × ".join(value(v.strip()) for v in entry(f"Mesh/box/{key}").split(",")) for key in ("Size", "Cells"))
        text = f"box of {size}&nbsp;m, {cells} cuboids of five tetrahedra"
    else:
        file = pathlib.PurePath(entry(f"Mesh/{kind}/File").strip('"')).name
        text = f"<code>{escape(file)}</code>"
        if not is_zero(entry(f"Mesh/{kind}/Element size")):
            size = float(entry(f"Mesh/{kind}/Element size")) * float(entry("Mesh/Scale") or 1)
            text += f", elements of {value(f'{size:.4g}', 'm')}"
        if entry(f"Mesh/{kind}/Geometry degree") not in ("1", ""):
            text += f", curved cells of degree {value(entry(f'Mesh/{kind}/Geometry degree'))}"
    if float(entry("Mesh/Scale") or 1) != 1:
        text += f", scaled by {value(entry('Mesh/Scale'))}"
    if run.kind != "study" and not is_zero(entry("Mesh/Refinements")):
        text += f", refined {count(int(entry('Mesh/Refinements')), 'time')}"
    yield "Body", text
    if "dofs" in summary:
        yield "Elements", (f"{count(summary['cells'], 'tetrahedron', 'tetrahedra')} of degree {summary['degree']}, {count(summary['nodes'], 'node')}, "
                           f"{count(summary['dofs'], 'unknown')}; mass matrix: {escape(entry('Discretization/Mass'))}")
    elif run.kind != "study":
        yield "Elements", f"tetrahedra of degree {value(entry('Discretization/Degree'))}"


def material(run):
    entry = run.entry
    law = LAWS.get(entry("Material/Type"), escape(entry("Material/Type")))
    if entry("Material/Type") == "corotational":
        law += f", a rotation for each {'cell' if entry('Material/Rotation').startswith('cell') else 'quadrature point'}"
    yield "Law", law
    modulus, ratio = entry("Material/Young's modulus"), entry("Material/Poisson's ratio")
    yield "Material", (f"Young’s modulus {value(modulus, 'Pa')}, Poisson’s ratio {value(ratio)}, "
                       f"density {value(entry('Material/Density'), 'kg/m³')}")


def conditions(run):
    """Describes supports, loads, damping and the initial state."""
    entry = run.entry

    def given(*pairs):
        return "; ".join(f"{name} <code>{escape(entry(path))}</code>" for name, path in pairs if entry(path))

    supports = given(("fixed:", "Boundary conditions/Fixed"), ("displacement in m:", "Boundary conditions/Displacement"),
                     ("springs in N/m³:", "Supports/Elastic"), ("normal springs in N/m³:", "Supports/Elastic normal"),
                     ("dashpots in N s/m³:", "Supports/Dashpots"))
    exact = entry("Exact solution/Displacement")
    if exact:
        made = entry("Exact solution/Manufacture") == "true"
        yield "Exact solution", f"u = <code>{escape(exact)}</code> m" + ("; loads, supports and initial state are made from it" if made else "")
    if supports or not exact:
        yield "Supports", supports or "none: the body is free"
    if run.is_modal:
        return
    contact = given(("obstacles, with lengths in m:", "Contact/Obstacles"), ("motions in m:", "Contact/Motions"), ("boundaries that touch:", "Contact/Boundaries"),
                    ("stiffness in N/m³:", "Contact/Stiffness"), ("friction:", "Contact/Friction"))
    if contact:
        friction = "" if is_zero(entry("Contact/Slip velocity")) else f"; slip velocity {value(entry('Contact/Slip velocity'), 'm/s')}"
        yield "Contact", contact + friction
    loads = [f"{name} {vector(entry(path), unit)}"
             for name, path, unit in (("gravity", "Loads/Gravity", "m/s²"), ("body force", "Loads/Body force", "N/m³"))
             if entry(path) and not is_zero(entry(path))]
    loads += [text for text in (given(("traction in Pa:", "Boundary conditions/Traction"), ("pressure in Pa:", "Boundary conditions/Pressure"),
                                      ("surface forces in N:", "Loads/Surface forces"), ("point forces in N:", "Loads/Point forces")),) if text]
    if loads or not exact:
        yield "Loads", "; ".join(loads) or "none"
    start = [f"{name} {vector(entry(path), unit)}" for name, path, unit in (("displacement", "Initial conditions/Displacement", "m"),
                                                                           ("velocity", "Initial conditions/Velocity", "m/s"))
             if entry(path) and not is_zero(entry(path))]
    if start:
        yield "Start", "; ".join(start)
    damping = [f"{name} {value(entry(path), unit)}" for name, path, unit in (("of the mass", "Damping/Mass coefficient", "1/s"),
                                                                            ("of the stiffness", "Damping/Stiffness coefficient", "s"))
               if entry(path) and not is_zero(entry(path))]
    if entry("Damping/Ratios"):
        damping.append(f"ratios <code>{escape(entry('Damping/Ratios'))}</code> at <code>{escape(entry('Damping/Frequencies'))}</code> Hz")
    if damping:
        yield "Damping", "; ".join(damping)


def methods(run):
    entry = run.entry
    kind = entry("Time integration/Type")
    if not run.is_modal and not run.is_static:
        if entry("Time integration/Adaptive step/Enabled") == "true":
            step = f"steps chosen for an error of {value(entry('Time integration/Adaptive step/Target error'))}"
        elif is_zero(entry("Time integration/Time step")):
            step = "steps as long as stability allows"
        else:
            step = f"steps of {value(entry('Time integration/Time step'), 's')}"
        yield "Time", f"{escape(kind)}, {step}" if kind != "static" else "statics"
    solver = escape(entry("Linear solver/Type"))
    yield "Linear solver", f"{solver}, {escape(entry('Linear solver/Operator'))}, tolerance {value(entry('Linear solver/Tolerance'))}"


def program(run):
    summary = run.summary
    if not summary:
        return
    text = f"corotet {escape(summary.get('version', ''))}, revision {escape(summary.get('git_revision', ''))}"
    if summary.get("dealii_version"):
        text += f"; deal.II {escape(summary['dealii_version'])}"
    yield "Program", f"{text}; {count(summary.get('ranks', 1), 'process', 'processes')}"


def terms(run):
    """The list under "Computed": (term, HTML)."""
    if not run.parameters:
        return list(program(run))
    return [*body(run), *material(run), *conditions(run), *methods(run), *program(run)]
