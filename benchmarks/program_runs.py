# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Tools that the scripts of this folder share to run the program: cases, runs
on several ranks, linear solves, and tables in pages."""

import json
import os
import subprocess

BENT_BODY = """subsection Mesh
{mesh}end
subsection Discretization
  set Degree = {degree}
end
subsection Material
  set Type = linear
end
subsection Boundary conditions
  set Fixed = {held}
end
subsection Loads
  set Gravity = 0; 0; -1
end
subsection Time integration
  set Type = static
end
subsection Output
  set Overwrite = true
end
{more}"""
# Entries to add to a case: degree 1 is solved like a large body, by
# aggregation.
BY_AGGREGATION = """subsection Linear solver
  set Type = p-multigrid
  subsection p-multigrid
    set Coarse solver = aggregation
  end
end
"""


def box(size, cells):
    """The entries of a box mesh; both arguments are three numbers as text."""
    return f"  set Type = box\n  subsection box\n    set Size  = {size}\n    set Cells = {cells}\n  end\n"


def file(name):
    """The entries of a mesh from a file."""
    return f"  set Type = file\n  subsection file\n    set File = {name}\n  end\n"


def bent_body(mesh, degree, held, more=""):
    """A parameter file for linear statics of a body that is held at one place
    and bent by its weight, with `more` sections added."""
    return BENT_BODY.format(mesh=mesh, degree=degree, held=held, more=more)


def launcher(ranks):
    """The words before a program that start it on so many ranks. If there are
    more ranks than cores, waiting ranks yield to others."""
    if ranks == 1:
        return []
    sharing = ["--oversubscribe", "--mca", "mpi_yield_when_idle", "1"] if ranks > os.cpu_count() else []
    return ["mpirun", "--bind-to", "none", *sharing, "-np", str(ranks)]


def solve(program, folder, case, ranks, most_seconds=None):
    """Runs the text of a parameter file. Returns unknowns, iterations, seconds
    of assembly, set-up of the solver and solution, and MB; None if it takes too
    long, or too many iterations."""
    (folder / "case.prm").write_text(case, encoding="utf-8")
    command = [*launcher(ranks), os.path.abspath(program), "case.prm", "--output", "results", "--quiet"]
    try:
        done = subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False,
                              timeout=most_seconds)
    except subprocess.TimeoutExpired:
        return None
    if done.returncode != 0:
        if "the linear solver stopped" not in done.stderr:
            raise RuntimeError(f"{done.stderr}\n{case}")
        return None
    summary = json.loads((folder / "results" / "summary.json").read_text(encoding="utf-8"))
    times = summary["wall_time"]
    return summary["dofs"], summary["final"]["linear_iterations"], times["assembly"] + times["solve"], summary["peak_memory_bytes"] / 1e6


def document(page, mark, lines):
    """Puts the lines between the marks of that name in the page, a Path."""
    begin, end = f"<!-- {mark} -->", f"<!-- end of {mark} -->"
    before, rest = page.read_text(encoding="utf-8").split(begin)
    page.write_text("\n".join([before + begin, *lines, end + rest.split(end)[1]]), encoding="utf-8")
