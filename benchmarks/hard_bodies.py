#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Linear solves of bodies that are hard for p-multigrid, thin, flat, stretched, nearly incompressible, of slivers and of two materials, by
all solvers: bodies that are clamped at x = 0 and bent by their weight, statics, to the program's tolerance. Run it inside of
scripts/toolchain:

    benchmarks/hard_bodies.py [--program PROGRAM] [--repetitions 2] [--ranks 1] [--quick] [--document]

Times are those of the matrix, the solver's set-up and the solution, of the
fastest run; memory is the most that the process has had. `bent` are the
iterations of the same solver for the body bent to a quarter of a circle, along
x, in the first linear solve from there, with the rotations of cells
(`corotational`); there is no figure where cells would be inverted. `amg` gets
1,000 iterations and 20 seconds; it and `direct` get one run, and have no figures
above 150,000 unknowns. --quick leaves out degree 3 and large bodies. --document
writes the table into doc/algorithms.md.
"""

import argparse
import functools
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkDelaunay3D
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

sys.dont_write_bytecode = True

from program_runs import bent_body, box, document, file, solve  # pylint: disable=wrong-import-position
from vtk_grids import tetrahedra_grid, vtk_points  # pylint: disable=wrong-import-position

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "doc" / "algorithms.md"
BEAM = box("4, 1, 1", "28, 7, 7")
# Unknowns above which whole matrices take gigabytes.
MOST_OF_MATRICES = 150000
# Name, mesh and Poisson's ratio of each body; the cells of the first are
# well-shaped.
BODIES = [
    ("beam of well-shaped cells", BEAM, 0.3),
    ("plate 1 x 1 x 0.01 of 10 x 10 x 1 cuboids", box("1, 1, 0.01", "10, 10, 1"), 0.3),
    ("the same of 20 x 20 x 1", box("1, 1, 0.01", "20, 20, 1"), 0.3),
    ("the same of 100 x 100 x 1", box("1, 1, 0.01", "100, 100, 1"), 0.3),
    ("plate 1 x 1 x 0.0025 of 40 x 40 x 1", box("1, 1, 0.0025", "40, 40, 1"), 0.3),
    ("plate 1 x 1 x 0.1 of 8 x 8 x 8, flat by 10", box("1, 1, 0.1", "8, 8, 8"), 0.3),
    ("plate 1 x 1 x 0.01 of 8 x 8 x 8, flat by 100", box("1, 1, 0.01", "8, 8, 8"), 0.3),
    ("bar 10 x 1 x 1 of 8 x 8 x 8, stretched by 10", box("10, 1, 1", "8, 8, 8"), 0.3),
    ("bar 100 x 1 x 1 of 8 x 8 x 8, stretched by 100", box("100, 1, 1", "8, 8, 8"), 0.3),
    ("the beam, Poisson's ratio 0.45", BEAM, 0.45),
    ("the beam, Poisson's ratio 0.49", BEAM, 0.49),
    ("the beam, Poisson's ratio 0.499", BEAM, 0.499),
    ("the beam, Poisson's ratio 0.4999", BEAM, 0.4999),
    ("slivers: Delaunay cells of random points", file("slivers.vtu"), 0.3),
    ("beam of gmsh's cells, not optimised", file("beam.msh"), 0.3),
]
MORE = """subsection Selections
  set Boundaries = held: box -1e-6 -1 -1 1e-6 2 2
end
subsection Material
  set Poisson's ratio = {poisson}
end
subsection Linear solver
  set Type               = {solver}
  set Maximum iterations = {most}
{options}end
"""
POINTS = "  subsection p-multigrid\n    set Vertex rotations = false\n  end\n"
# Name of each solver: type, further entries, most iterations, most seconds,
# most runs.
SOLVERS = {
    "points": ("p-multigrid", POINTS, 20000, None, 1),
    "p-multigrid": ("p-multigrid", "", 20000, None, 9),
    "automatic": ("automatic", "", 20000, None, 9),
    "direct": ("direct", "", 20000, None, 1),
    "amg": ("amg", "", 1000, 20, 1),
}
# Bends a body of a given length, whose middle is at z = middle, in one
# iteration of Newton's method with negligible inertia.
BENT = """subsection Initial conditions
  set Displacement = ({radius} - (z - {middle}))*sin(x/{radius}) - x; 0; {radius} - ({radius} - (z - {middle}))*cos(x/{radius}) - (z - {middle})
end
subsection Newton
  set Linearly implicit = true
  set Log every solve   = true
  set Tangent           = frozen rotation
end
"""
BEAM_OF_GMSH = """SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 4, 1, 1};
MeshSize {PointsOf {Volume {1};}} = 0.16;
Mesh.Optimize = 0;
Mesh.OptimizeNetgen = 0;
"""


def write_slivers(path, n_points):
    """Delaunay cells of random points in a box of 4 x 1 x 1 m, a quarter of
    them on its surface. Cells without volume are left out."""
    vtkObject.GlobalWarningDisplayOff()  # no warnings of degenerate triangles
    random, size = np.random.default_rng(1), np.array([4.0, 1.0, 1.0])
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * size
    on_surface = random.random((n_points // 4, 3)) * size
    for point in on_surface:
        axis = random.choice(3, p=[0.06, 0.47, 0.47])
        point[axis] = random.integers(2) * size[axis]
    positions = np.vstack([corners, on_surface, random.random((n_points - n_points // 4, 3)) * size])
    cloud = vtkPolyData()
    cloud.SetPoints(vtk_points(positions))
    delaunay = vtkDelaunay3D()
    delaunay.SetInputData(cloud)
    delaunay.SetTolerance(0)
    delaunay.Update()
    cells = vtk_to_numpy(delaunay.GetOutput().GetCells().GetConnectivityArray()).reshape(-1, 4)
    edges = positions[cells[:, 1:]] - positions[cells[:, :1]]
    volumes = np.linalg.det(edges)
    cells = np.where((volumes > 0)[:, None], cells, cells[:, [0, 2, 1, 3]])[np.abs(volumes) > 1e-9]
    used, numbers = np.unique(cells, return_inverse=True)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(tetrahedra_grid(positions[used], numbers.reshape(-1, 4)))
    writer.Write()


@functools.cache
def has_solver(program, name):
    """Whether this program has the solver: `amg` needs an optional part of the
    build."""
    parameters = subprocess.run([program, "--print-parameters", "markdown"], capture_output=True, text=True, check=True).stdout
    allowed = re.search(r"## Linear solver\n.*?\| Type \| [^|]* \| one of ([^|]*) \|", parameters, re.DOTALL).group(1)
    return name in allowed.split(", ")


def measure(options, folder, mesh, degree, poisson):
    """The fastest run of each solver."""
    found = {}
    too_large = False
    for name, (solver, entries, most, most_seconds, n_runs) in SOLVERS.items():
        if too_large and solver in ("direct", "amg") or not has_solver(options.program, solver):
            found[name] = None
            continue
        case = bent_body(mesh, degree, "held", MORE.format(poisson=poisson, solver=solver, options=entries, most=most))
        runs = [solve(options.program, folder, case, options.ranks, most_seconds) for _ in range(min(n_runs, options.repetitions))]
        found[name] = None if None in runs else min(runs, key=lambda run: run[2])
        too_large = found["points"] is not None and found["points"][0] > MOST_OF_MATRICES
    return found


def bent_iterations(options, folder, mesh, degree, poisson):
    size = re.search(r"Size  = ([\d.]+), [\d.]+, ([\d.]+)", mesh)
    length, height = map(float, size.groups()) if size else (4.0, 1.0)
    case = bent_body(mesh, degree, "held", MORE.format(poisson=poisson, solver="p-multigrid", options="", most=20000) +
                     BENT.format(radius=2 * length / np.pi, middle=height / 2))
    for entry, value, wanted in (("Type", "linear", "corotational"),
                                 ("Type", "static", "backward Euler\n  set End time = 1e6\n  set Time step = 1e6")):
        assert f"set {entry} = {value}\n" in case
        case = case.replace(f"set {entry} = {value}\n", f"set {entry} = {wanted}\n")
    try:
        if solve(options.program, folder, case, options.ranks) is None:
            return "-"
    except RuntimeError as error:
        if "inside out" in str(error):
            return "-"
        # A body that springs back in one linear step may gain energy that no
        # work explains.
        if "the motion is unstable" not in str(error):
            raise
    log = (folder / "results" / "log.txt").read_text(encoding="utf-8")
    return int(re.search(r"Newton 1 iterations, linear (\d+)", log).group(1))


def columns(run, *kinds):
    text = {"n": "{0[1]}", "s": "{0[2]:.2g}", "MB": "{0[3]:.0f}"}
    return ["-" if run is None else text[kind].format(run) for kind in kinds]


def table(options, folder):
    heads = ["body", "degree", "unknowns", "points alone: iterations", "`p-multigrid`: iterations", "bent", "seconds", "MB",
             "`automatic`: seconds", "for each unknown, beam = 1", "`direct`: seconds", "MB", "`amg`: iterations", "seconds", "MB"]
    lines = ["| " + " | ".join(heads) + " |", "|---|---|" + "---:|" * (len(heads) - 2)]
    of_beam = {}
    for name, mesh, poisson in BODIES:
        for degree in (1, 2, 3):
            if options.quick and (degree == 3 or "40" in mesh or "100, 100" in mesh):
                continue
            found = measure(options, folder, mesh, degree, poisson)
            unknowns = found["points"][0]
            each = found["automatic"][2] / unknowns
            of_beam.setdefault(degree, each)
            cells = [name if degree == 1 else "", degree, unknowns, *columns(found["points"], "n"),
                     *columns(found["p-multigrid"], "n"), bent_iterations(options, folder, mesh, degree, poisson),
                     *columns(found["p-multigrid"], "s", "MB"), *columns(found["automatic"], "s"), f"{each / of_beam[degree]:.2g}",
                     *columns(found["direct"], "s", "MB"), *columns(found["amg"], "n", "s", "MB")]
            lines.append("| " + " | ".join(map(str, cells)) + " |")
            print(lines[-1], flush=True)
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "corotet"))
    parser.add_argument("--repetitions", type=int, default=2)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        write_slivers(folder / "slivers.vtu", 1000 if options.quick else 4000)
        (folder / "beam.geo").write_text(BEAM_OF_GMSH, encoding="utf-8")
        subprocess.run(["gmsh", "-3", "beam.geo", "-o", "beam.msh", "-v", "1"], cwd=folder, check=True)
        lines = table(options, folder)
    if options.document:
        document(PAGE, "solvers", lines)
    return 0


if __name__ == "__main__":
    sys.exit(main())
