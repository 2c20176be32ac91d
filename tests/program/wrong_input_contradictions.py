# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Rows of wrong_inputs.py: values that are allowed separately, but contradict
each other, the mesh or physics; and wrong texts."""

from wrong_input_rows import wrong

DYNAMIC = "Time integration/Type = generalized-alpha"
STATIC = "Time integration/Type = static"
EXPLICIT = ("Time integration/Type = central difference", "Discretization/Mass = diagonal scaling", "Time integration/Time step = 0")
MODES = ("Type = modes", "Modes/Number = 2")
STUDY = ("Type = convergence study", "Convergence study/Degrees = 1", "Convergence study/Refinements = 0", "Convergence study/Reference = none",
         "Convergence study/Quantities = volume")
CHECKED = ("Verification/Source = theory", "Verification/Tolerance reason = round-off")
LONG = 3000 * "9"
FIXED, DISPLACEMENT, TRACTION, PRESSURE = ("Boundary conditions/" + name for name in ("Fixed", "Displacement", "Traction", "Pressure"))
ADAPTIVE = "Time integration/Adaptive step/"
# Entries with vectors, and the text around a vector behind " = ".
LOADS = {"Loads/Gravity": "{}", "Loads/Body force": "{}", "Loads/Point forces": "1 0 0: {}", TRACTION: "x-max: {}", "Supports/Dashpots": "x-max: {}",
         "Initial conditions/Displacement": "{}", "Initial conditions/Velocity": "{}", "Supports/Elastic": "x-max: {}"}


def formula_rows():
    """Texts that are no formulas, or that are not finite where and when they
    are needed."""
    kinds = (("one component", "1", "1 component", "3 are needed"), ("unknown name", "0; 0; sine(t)", "unknown name"),
             ("misspelt function", "0; 0; smooth_stepp(t, 0, 1)", 'did you mean "smooth_step"?'), ("open bracket", "0; 0; (1", "is no formula"),
             ("infinite", "0; 0; 1/0", "found infinity"), ("root of a negative number", "sqrt(-1); 0; 0", "found not a number"), ("empty component", "0; ; 0", "it is empty"),
             ("infinite at a point", "0; 0; 1/x^2", "found infinity"), ("far too long", "0; 0; " + LONG + "+", "characters)"), ("assignment", "0; 0; x=1", "assigns"),
             ("random", "0; 0; rand()", "depend"))
    for number, (entry, form) in enumerate(LOADS.items()):
        # The first entry has all kinds of mistakes; the others have some in
        # turn.
        for kind, text, *parts in kinds if number == 0 else [kinds[(2 * number + i) % len(kinds)] for i in range(2)]:
            if kind == "infinite at a point" and ("x-max" in form or "1 0 0" in form):
                text = text.replace("1/x^2", "1/(x-1)^2")
            if entry.startswith("Supports/"):
                # These entries check their values themselves, with other words.
                parts = [{"found infinity": "value inf", "found not a number": "nan"}.get(part, part) for part in parts]
            yield wrong(f"{entry}, {kind}", f"{entry} = {form.format(text)}", *parts)
    for entry, value in (("Loads/Gravity", "0; 0; 1/(1-t)"), (TRACTION, "x-max: 0; 0; log(1-t)"), (PRESSURE, "x-max: sqrt(0.5-t)"),
                         ("Loads/Point forces", "1 0 0: 0; 0; 1/(t-1)"), ("Loads/Body force", "0; 0; x/(t-1)")):
        yield wrong(f"{entry}, not finite at the end", f"{entry} = {value}", "not finite", "at t = 1", validate=False)
    yield wrong("load of statics, not finite", (STATIC, "Loads/Gravity = 0; 0; 1/(1-t)"), "not finite", "at t = 1")
    yield wrong("displacement, not finite", f"{DISPLACEMENT} = x-max: 1/0; 0; 0", "not finite", "inf")
    yield wrong("displacement, not finite at the end", f"{DISPLACEMENT} = x-max: 1/(1-t)-1; 0; 0", "t = 1", "inf")
    yield wrong("springs that pull", "Supports/Elastic normal = x-max: -1", "allowed: finite values, none below zero")
    yield wrong("springs that come to pull", "Supports/Elastic = x-max: 1-2*t; 0; 0", "-1", "at t = 1")
    yield wrong("dashpots that drive", "Supports/Dashpots = x-max: -1; 0; 0", "none below zero")


def boundary_rows():
    for entry in (FIXED, DISPLACEMENT, TRACTION, PRESSURE, "Supports/Elastic", "Supports/Elastic normal", "Supports/Dashpots"):
        value = "" if entry == FIXED else ": 0" if entry in (PRESSURE, "Supports/Elastic normal") else ": 0; 0; 1"
        yield wrong(f"{entry}, unknown boundary", f"{entry} = x-mix{value}", "found 'x-mix'", "did you mean 'x-min'?")
        if entry in (TRACTION, "Supports/Elastic"):
            yield wrong(f"{entry}, without colon", f"{entry} = x-max", "found 'x-max'", "allowed: 'boundary: value")
        if entry not in (FIXED, "Supports/Elastic"):
            yield wrong(f"{entry}, twice", f"{entry} = x-max{value}, 1{value}", "x-max", "found")
    yield wrong("fixed twice", f"{FIXED} = x-min, x-min", "two conditions")
    yield wrong("fixed, far too long", f"{FIXED} = {LONG}", "characters)")
    yield wrong("boundaries that do not meet", f"{FIXED} = x-min & x-max", "no node in common")
    yield wrong("edge of an unknown boundary", f"{FIXED} = x-min & top", "found 'top'")
    yield wrong("fixed and displaced", (f"{FIXED} = x-min", f"{DISPLACEMENT} = x-min: 1; 0; 0"), "two conditions", "'Fixed' and 'Displacement'")
    yield wrong("fixed and displaced at an edge", (f"{FIXED} = x-min", f"{DISPLACEMENT} = y-min: 1; 0; 0"), "common point", "found 0 and 1")
    yield wrong("displacements that part later", f"{DISPLACEMENT} = x-max: 0; t; 0, y-max: 0; 0; 0", "common point", "at t = 0.5")
    yield wrong("fixed and drawn", f"{TRACTION} = x-min: 1; 0; 0", "two conditions", "'Fixed' and 'Traction'")
    yield wrong("drawn and pressed", (f"{TRACTION} = x-max: 1; 0; 0", f"{PRESSURE} = x-max: 1"), "two conditions")
    yield wrong("two components", f"{DISPLACEMENT} = x-max: 0; 0", "found 2 components")
    yield wrong("traction free", f"{TRACTION} = x-max: free; 0; 0", "unknown name")
    for name, settings, said in (
            ("without supports", (f"{FIXED} =", STATIC), "move in any direction and rotate about any axis"),
            ("on an edge", (STATIC, f"{FIXED} = x-min & z-min"), "rotate about the axis through (0, 0.05, 0) along y"),
            ("on a corner", (STATIC, f"{FIXED} = x-min & y-min & z-min"), "rotate about any axis through (0, 0, 0)"),
            ("on rollers", (STATIC, f"{FIXED} =", f"{DISPLACEMENT} = z-min: free; free; 0"), "move along x and y")):
        settings = sorted(settings, key=lambda setting: setting.startswith(FIXED))
        yield wrong(f"statics {name}", settings, "statics needs a body that cannot move without strain", said, by_option=False)
    yield from place_rows()
    yield wrong("initial displacement off a support", "Initial conditions/Displacement = 1; 0; 0", "contradicts a support", "found 1 m in x", "0 m")
    yield wrong("initial displacement inside out", (f"{FIXED} =", "Initial conditions/Displacement = -2*x; 0; 0"), "inside out", "det F = -1")
    yield wrong("initial displacement off a moving support", (f"{DISPLACEMENT} = x-max: 0.1*cos(t); 0; 0", "Initial conditions/Displacement = 0.2*x; 0; 0"),
                "contradicts a support", "0.1 m")


def place_rows():
    """Rows about names of edges and corners."""
    edge, corner = "Selections/Edges = rim: x-max and z-max", "Selections/Corners = tip: x-max and y-max and z-max"
    for entry, selection, kind in ((TRACTION, edge, "an edge"), (PRESSURE, corner, "a corner"), ("Supports/Elastic", corner, "a corner"),
                                   ("Supports/Elastic normal", edge, "an edge"), ("Supports/Dashpots", edge, "an edge")):
        name = "rim" if selection == edge else "tip"
        value = "1" if entry in (PRESSURE, "Supports/Elastic normal") else "0; 0; 1"
        yield wrong(f"{entry}, on {kind}", (selection, f"{entry} = {name}: {value}"), f"which is {kind}", "allowed are boundaries")
    yield wrong("edge held twice", (edge, f"{FIXED} = rim, rim"), "component x of edge 'rim' has two conditions")
    yield wrong("edge that is misspelt", (edge, f"{FIXED} = x-min, rimm"), "no such boundary or edge: found 'rimm'", "did you mean 'rim'?")
    yield wrong("edge and side that part", (edge, f"{DISPLACEMENT} = x-max: 0; 0; t, rim: free; free; 0"), "places 'x-max' and 'rim'", "at t = 0.5")
    yield wrong("edge and corner that do not meet", (edge, "Selections/Corners = tip: x-min and z-min", f"{FIXED} = rim & tip"), "places have no node in common")
    for name, setting, *parts in (
            ("edges nowhere", "Edges = rim: sphere 0 0 9 1", "selection 'rim' has no edge", "m away"),
            ("corners nowhere", "Corners = tip: plane 7 0 0 1 0 0", "selection 'tip' has no corner", "is 6 m away"),
            ("edges too sharp", "Edges = rim: sharp 91", "the nearest to 'sharp 91' is 1 degrees away"),
            ("sharp corner", "Corners = tip: sharp", "a corner is not between two faces"), ("sharp face", "Boundaries = top: sharp", "no such boundary: found 'sharp'"),
            ("edges of a name that is taken", "Edges = x-min: sharp", "the mesh has this name"), ("edges without colon", "Edges = sharp", "allowed: 'name: selection"),
            ("edges of an unknown name", "Edges = rim: x-mix", "found 'x-mix'", "did you mean 'x-min'?")):
        yield wrong(name, f"Selections/{setting}", *parts)


def point_rows():
    for entry, value in (("Loads/Point forces", ": 0; 0; 1"), ("Output/Probes", ""), ("Output/Stress probes", "")):
        place = "{}" if value else "a: {}"
        write = lambda point: f"{entry} = {place.format(point)}{value}"
        far = ("distance of 14 m",) if value else ("14 m from its nearest node",)
        yield wrong(f"{entry}, far away", write("15 0 0"), "lies outside the body", *far)
        for kind, point in (("two numbers", "1 0"), ("four numbers", "1 0 0 0"), ("not a number", "1 0 nan"), ("infinite", "inf 0 0"), ("a word", "1 0 up"),
                            ("with commas", "1; 0; 0"), ("far too long", f"1 0 {LONG}x")):
            if kind in ("two numbers", "far too long") or entry == "Output/Probes":
                yield wrong(f"{entry}, point {kind}", write(point), "0" if kind == "with commas" else point[:20])
    for name, said in (("1st", "no digit first"), ("a b", "letters"), ("", "letters"), ("reaction", "columns of the history"), ("\u00e9", "letters")):
        yield wrong(f"probe called '{name}'", f"Output/Probes = {name}: 1 0 0", said)
    yield wrong("probes of one name", "Output/Probes = a: 1 0 0, a: 0 0 0", "two probes are called 'a'")
    yield wrong("stress probes of one name", "Output/Stress probes = a: 1 0 0, a: 0 0 0", "two probes are called 'a'")
    yield wrong("probe without a point", "Output/Probes = tip", "found 'tip'", "NAME: X Y Z")
    yield wrong("point force without a force", "Loads/Point forces = 1 0 0", "found '1 0 0'")


def material_rows():
    for entry, values in (("Young's modulus", ("0", "-1", "much", "nan", "inf", "", LONG + "x")), ("Density", ("0", "-1e3", "1e400", "a: 1")),
                          ("Poisson's ratio", ("0.5", "-1", "0.49999999", "2", "1, 2"))):
        for value in values:
            path = f"Material/{entry}"
            yield wrong(f"{path} = {value[:20]}", f"{path} = {value}", "allowed" if ":" not in value else "no such region")
    yield wrong("region without value", "Material/Density = body: 1000, body: 1000", "two values")
    yield wrong("no region", "Material/Density = steel: 1000", "found 'steel'", "body")
    for degree, said in ((2, "row-sum lumping with degree 2"), (3, "row-sum lumping with degree 3")):
        yield wrong(f"row sum, degree {degree}", (f"Discretization/Degree = {degree}", "Discretization/Mass = row sum"), said, "allowed")
    yield wrong("nodal quadrature, degree 1", ("Discretization/Degree = 1", "Discretization/Mass = nodal quadrature"), "allowed: degree 2")
    yield wrong("damping twice", ("Damping/Mass coefficient = 1", "Damping/Ratios = 0.1, 0.1", "Damping/Frequencies = 1, 2"), "given twice")
    yield wrong("one frequency", ("Damping/Ratios = 0.1, 0.1", "Damping/Frequencies = 1"), "two positive frequencies")
    yield wrong("frequencies that decrease", ("Damping/Ratios = 0.1, 0.1", "Damping/Frequencies = 2, 1"), "the lower one first")
    yield wrong("frequencies of zero", ("Damping/Ratios = 0.1, 0.1", "Damping/Frequencies = 0, 1"), "two positive frequencies")
    yield wrong("ratios without frequencies", "Damping/Ratios = 0.1, 0.1", "Damping/Frequencies", blamed=None)
    yield wrong("one ratio", ("Damping/Frequencies = 1, 2", "Damping/Ratios = 0.1"), "two ratios")
    yield wrong("ratios that cannot be", ("Damping/Frequencies = 1, 10", "Damping/Ratios = 0.01, 0.5"), "below zero would be needed")


def time_rows():
    yield wrong("end before start", ("Time integration/Start time = 1", "Time integration/End time = 0.5"), "after the start time 1")
    yield wrong("no duration", "Time integration/End time = 0", "after the start time 0")
    yield wrong("no step", "Time integration/Time step = 0", "allowed: a positive number")
    yield wrong("too many steps", "Time integration/Time step = 1e-12", "1e+12 steps", "at most 4000000000")
    yield wrong("steps lost in round-off", ("Time integration/Start time = 1e16", "Time integration/End time = 10000000000000002",
                                           "Time integration/Time step = 0.01"), "round-off of times", "1e+16 s")
    yield wrong("too many stable steps", (*EXPLICIT[:2], "Time integration/End time = 1e9", EXPLICIT[2]), "stable steps", "at most 4000000000")
    yield wrong("unstable step", (*EXPLICIT[:2], "Time integration/Time step = 1"), "unstable", "stable step")
    yield wrong("largest step below the smallest", (ADAPTIVE + "Largest step = 1e-3", ADAPTIVE + "Smallest step = 1e-2"), "at most the largest step")
    for kind in ("static", "backward Euler", "BDF2", "implicit midpoint", "central difference"):
        settings = (f"Time integration/Type = {kind}", *EXPLICIT[1:], ADAPTIVE + "Enabled = true")
        settings = settings if kind == "central difference" else (settings[0], settings[-1])
        yield wrong(f"adaptive steps of {kind}", settings, "estimate their error")
    # At beta = 1/6 the error estimate vanishes, and below 1/4 only small steps
    # are stable.
    for beta in ("0.16666666666666666", "0.1667", "0.2499"):
        yield wrong(f"adaptive steps of Newmark with beta = {beta}", ("Time integration/Type = Newmark", f"Time integration/Newmark/Beta = {beta}",
                                                                    ADAPTIVE + "Enabled = true"), "estimate their error", "beta of at least 1/4")
    yield wrong("target below round-off", ADAPTIVE + "Target error = 1e-15", "a number from 1e-12 to 1")
    yield wrong("linearly implicit statics", (STATIC, "Newton/Linearly implicit = true"), "a load step")


def solver_rows():
    quadrature = "Material/Rotation = quadrature points"
    degree = "Discretization/Degree = 2"
    yield wrong("assembled, exact tangent", "Linear solver/Operator = assembled", "matrix-free")
    yield wrong("assembled by quadrature", (degree, quadrature, "Newton/Tangent = frozen rotation", "Linear solver/Operator = assembled"), "matrix-free")
    yield wrong("conjugate gradients, not symmetric", (degree, "Linear solver/Method = conjugate gradients"), "automatic or gmres")
    yield wrong("minres, not symmetric", (degree, "Linear solver/Method = minres"), "automatic or gmres")
    yield wrong("conjugate gradients with a pressure", (degree, quadrature, f"{PRESSURE} = x-max: 1", "Linear solver/Method = conjugate gradients"),
                "automatic or gmres")
    yield wrong("modes: too many", (*MODES[:1], "Modes/Number = 1000"), "found 1000", "at most")
    yield wrong("modes: shift beyond all", (*MODES, "Modes/Shift = 1e300"), "found 1e+300", "above omega^2 of all modes")
    yield wrong("modes: restart", MODES[::-1], "--restart", arguments=("--restart",), by_option=False)


def dilatation_rows():
    vertices = "Material/Dilatation = vertices"
    yield wrong("vertices' dilatation, degree 2", ("Discretization/Degree = 2", vertices), "elements of degree 2", "allowed: 'cells', or degree 1")
    for kind in ("neo-Hookean", "Saint Venant-Kirchhoff"):
        yield wrong(f"vertices' dilatation, {kind}", ("Discretization/Degree = 1", f"Material/Type = {kind}", vertices), kind, "linear or corotational")


def exact_rows():
    exact = "Exact solution/Displacement"
    free = f"{FIXED} ="
    yield wrong("exact solution, two components", (free, f"{exact} = 0; 0"), "2 components")
    yield wrong("exact solution without derivative", (free, f"{exact} = abs(x); 0; 0"), "cannot be differentiated")
    yield wrong("exact solution, too deep", (free, f"{exact} = {101 * 'sin('}x{101 * ')'}; 0; 0"), "found parentheses 101 deep", "allowed are 100")
    yield wrong("exact solution, far too long", (free, f"{exact} = {99 * 'sin('}x{99 * ')'}; 0; 0"), "characters)", "is no formula")
    yield wrong("exact solution, not finite", (free, f"{exact} = 1/x; 0; 0"), "finite")
    yield wrong("exact solution and a load", (free, f"{exact} = x; 0; 0", "Loads/Gravity = 0; 0; -1"), "made from the exact solution")
    yield wrong("exact solution and a support", (f"{exact} = x; 0; 0", f"{FIXED} = x-min"), "made from the exact solution")
    yield wrong("exact solution, unknown boundary", (free, f"{exact} = x; 0; 0", "Exact solution/Displacement boundary = top"), "found 'top'")
    yield wrong("exact solution, boundary twice", (free, f"{exact} = x; 0; 0", "Exact solution/Displacement boundary = x-min, 0"), "twice")


def study_rows():
    yield wrong("study: nothing to compare", (*STUDY[:4], "Convergence study/Quantities ="), "nothing to compare")
    yield wrong("study: quantity twice", (*STUDY[:4], "Convergence study/Quantities = volume, volume"), "found 'volume' twice")
    yield wrong("study: quantity that is none", (*STUDY[:4], "Convergence study/Quantities = volume: much"), "found 'volume: much'")
    yield wrong("study: degrees twice", (*STUDY[2:], STUDY[0], "Convergence study/Degrees = 1, 1"), "given twice")
    yield wrong("study: refinements decrease", (*STUDY[3:], STUDY[0], "Convergence study/Refinements = 1, 0"), "do not increase")
    yield wrong("study: too many cells", (*STUDY[:2], *STUDY[3:], "Convergence study/Refinements = 0, 9"), "9 refinements", "at most 3e+08")
    yield wrong("study: too many cells of the finer run", (*STUDY[:2], STUDY[4], "Convergence study/Further refinements = 3",
                                                           "Convergence study/Reference = finer run", "Convergence study/Refinements = 0, 6"),
                "6 refinements and 3 more of the finer run")
    yield wrong("study: steps increase", (*STUDY, "Convergence study/Time steps = 0.01, 0.02"), "do not decrease")
    yield wrong("study: no step among several", (*STUDY, "Convergence study/Time steps = 0.01, 0"), "found 0 among several")
    yield wrong("study: a value that is no number", (*STUDY[:4], "Convergence study/Quantities = tip_z: nan"), "found 'tip_z: nan'")
    yield wrong("study: no exact solution", (*STUDY[:3], STUDY[4], "Convergence study/Reference = exact solution"), "Exact solution/Displacement is empty")
    yield wrong("study: modes and an exact solution", (*STUDY[:3], STUDY[4], "Convergence study/Run = modes", "Convergence study/Reference = exact solution"),
                "'exact solution' for modes")
    yield wrong("study: row sum of degree 2", (STUDY[0], *STUDY[2:], "Convergence study/Degrees = 2", "Convergence study/Masses = row sum"), "row-sum",
                blamed=None)


def check_rows():
    checks = "Verification/Checks"
    for name, text, said in (
            ("no name", "last time = 1 +- 1", "NAME: STATISTIC"), ("no relation", "a: last time", "NAME: STATISTIC"),
            ("unknown statistic", "a: median time = 1 +- 1", "found 'median'"), ("unknown column", "a: last tim = 1 +- 1", 'did you mean "time"?'),
            ("no formula", "a: last time + = 1 +- 1", "is no formula"), ("no tolerance", "a: last time = 1", "TOLERANCE"),
            ("tolerance of a bound", "a: last time < 1 +- 1", "TOLERANCE"), ("tolerance of zero", "a: last time = 1 +- 0", "a positive one"),
            ("% of zero", "a: last time = 0 +- 1 %", "what is not zero"), ("twice", "a: last time = 1 +- 1; a: last time = 1 +- 1", "called 'a'"),
            ("reference that varies", "a: last time = t +- 1", "is not constant"), ("name with a comma", "a, b: last time = 1 +- 1", "cannot be a check's name"),
            ("far too long", LONG, "characters)")):
        yield wrong(f"check: {name}", (*CHECKED, f"{checks} = {text}"), said)
    check = f"{checks} = a: last time = 1 +- 1"
    yield wrong("check without source", (check, CHECKED[1], "Verification/Source ="), "it is empty", by_option=False)
    yield wrong("check without reason", (check, CHECKED[0], "Verification/Tolerance reason ="), "it is empty", by_option=False)


def contradiction_rows():
    for rows in (formula_rows, boundary_rows, point_rows, material_rows, time_rows, solver_rows, dilatation_rows, exact_rows, study_rows, check_rows):
        yield from rows()
