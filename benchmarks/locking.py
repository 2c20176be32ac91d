#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Errors of displacement and pressure in nearly incompressible bodies: a cube whose displacement is given, most of it without change of
volume, with a pressure that does not depend on Poisson's ratio. Run it inside of scripts/toolchain:

    benchmarks/locking.py [--program build/release/corotet] [--document]

Errors are relative root mean squares: of the displacement over the nodes, of the mean normal stress at the points of the cells' quadrature
and, recovered, over the nodes.
--document writes the table into doc/physics.md.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy

sys.dont_write_bytecode = True

from program_runs import document  # pylint: disable=wrong-import-position

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "doc" / "physics.md"
RATIOS = (0.3, 0.45, 0.49, 0.499, 0.4999, 0.49999)
# Each element: degree, placement of the dilatation, refinements.
ELEMENTS = {
    "degree 1, `cells`": (1, "cells", 3),
    "degree 1, `vertices`": (1, "vertices", 3),
    "degree 2": (2, "cells", 2),
    "degree 3": (3, "cells", 1),
}
PRESSURE = 0.12  # The divergence is this times x over lambda.
CASE = """
subsection Mesh
  set Type = gmsh
  set Refinements = {refinements}
  subsection gmsh
    set File = {mesh}
  end
end
subsection Discretization
  set Degree = {degree}
end
subsection Material
  set Type            = linear
  set Dilatation      = {dilatation}
  set Young's modulus = 1
  set Poisson's ratio = {ratio}
  set Density         = 1
end
subsection Exact solution
  set Displacement          = 0.1*sin(2*x)*cos(2*y) + {half}*x^2; -0.1*cos(2*x)*sin(2*y); 0.05*sin(x+y)
  set Displacement boundary = x-min
end
subsection Time integration
  set Type = static
end
subsection Linear solver
  set Type = p-multigrid
end
subsection Output
  set Overwrite = true
  set Stress    = both
end
"""


def exact_displacement(x, y, half):
    return numpy.stack([0.1 * numpy.sin(2 * x) * numpy.cos(2 * y) + half * x**2, -0.1 * numpy.cos(2 * x) * numpy.sin(2 * y),
                        0.05 * numpy.sin(x + y)], axis=1)


def relative_error(found, exact):
    return numpy.linalg.norm(found - exact) / numpy.linalg.norm(exact)


def last_state(results, series):
    """Positions at rest, displacement and mean normal stress of the last
    state."""
    with h5py.File(results / series / "mesh.h5", "r") as mesh, h5py.File(max((results / series).glob("step_*.h5")), "r") as state:
        return mesh["Points"][:], state["PointData/displacement"][:], state["PointData/stress"][:, :3].mean(axis=1)


def solve(program, folder, ratio, element):
    """The number of unknowns, the iterations, and the errors of displacement,
    raw and recovered pressure."""
    degree, dilatation, refinements = element
    lame, mu = ratio / ((1 + ratio) * (1 - 2 * ratio)), 1 / (2 * (1 + ratio))
    half = PRESSURE / 2 / lame
    (folder / "case.prm").write_text(
        CASE.format(refinements=refinements, mesh=ROOT / "meshes" / "patch_cube.msh", degree=degree, dilatation=dilatation, ratio=ratio,
                    half=half), encoding="utf-8")
    subprocess.run([program.resolve(), "case.prm", "--output", "results", "--quiet"], cwd=folder, check=True)
    results = folder / "results"
    summary = json.loads((results / "summary.json").read_text(encoding="utf-8"))
    errors = []
    for series in ("stress_points", "solution"):
        points, displacement, pressure = last_state(results, series)
        errors.append(relative_error(pressure, (1 + 2 * mu / (3 * lame)) * PRESSURE * points[:, 0]))
    errors.insert(0, relative_error(displacement, exact_displacement(points[:, 0], points[:, 1], half)))
    return summary["dofs"], summary["final"]["linear_iterations"], errors


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "corotet")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    lines = ["| element | unknowns | Poisson's ratio | displacement | pressure in the cells | recovered | iterations |",
             "|---|---:|---:|---:|---:|---:|---:|"]
    with tempfile.TemporaryDirectory() as name:
        for element, choice in ELEMENTS.items():
            for ratio in RATIOS:
                unknowns, iterations, errors = solve(options.program, pathlib.Path(name), ratio, choice)
                shown = " | ".join(f"{float(f'{100 * error:.2g}'):g} %" for error in errors)
                lines.append(f"| {element} | {unknowns} | {ratio} | {shown} | {iterations} |")
                print(lines[-1], flush=True)
    if options.document:
        document(PAGE, "locking", lines)


if __name__ == "__main__":
    main()
