#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The same parameter file gives the same results on one and on two ranks.

What differs is the order of sums and the linear solver's error. With a linear tolerance of 1e-11 and Newton's of 1e-10, the
histories must agree to 1e-8 relative: each column to the largest value in it (in its three components, for vectors), the
energy balance, which is a difference of energies, to the largest energy. Iterations and wall times may differ. VTK's reader
must accept both time series, which two ranks write together.
"""

import re
import unittest

from support import ROOT, ProgramTest, has_preconditioner, has_pt_scotch, parameter_text, read_history, read_summary, run_on

STRICT = ("Linear solver/Tolerance = 1e-11", "Newton/Residual tolerance = 1e-10", "Newton/Increment tolerance = 1e-10")
MAY_DIFFER = {"newton_iterations", "linear_iterations", "wall_time"}


def group(column):
    # These columns are zero up to round-off (moments only with rotations at
    # quadrature points), so they are compared with a quantity of the same unit.
    if column == "energy_balance" or column.startswith("internal_moment"):
        return "external_work"
    return re.sub("_[xyz]$", "", column)


class Ranks(ProgramTest):

    def test_report(self):
        # The script that makes the page runs on rank 0 and must not wait for
        # the other rank.
        for ranks in (1, 2):
            run = self.run_case("cantilever", f"page{ranks}", "Time integration/End time = 0.03", ranks=ranks, more=("--report",))
            self.assertIn("</html>", (run / "report.html").read_text(encoding="utf-8"))
        # A name that the script could take for an option.
        self.run_program(ROOT / "parameters" / "cantilever.prm", "--set", "Time integration/End time = 0.02", "--output=-x", "--report")
        self.assertTrue((self.folder / "-x" / "report.html").exists())
        # The page is one of the results, which may be replaced.
        self.run_case("cantilever", "page1", "Time integration/End time = 0.02", "Output/Overwrite = true")
        self.assertFalse((self.folder / "page1" / "report.html").exists())

    def check(self, preconditioner, *of_others, ranks=2):
        settings = (*STRICT, "Time integration/End time = 0.03", f"Linear solver/Type = {preconditioner}")
        one = self.run_case("cantilever", "one", *settings)
        two = self.run_case("cantilever", "two", *settings, *of_others, ranks=ranks)
        self.assertEqual((read_summary(one)["ranks"], read_summary(two)["ranks"]), (1, ranks))
        histories = [[{name: float(value) for name, value in row.items() if name not in MAY_DIFFER} for row in read_history(directory)]
                     for directory in (one, two)]
        self.assertEqual(len(histories[0]), len(histories[1]))
        sizes = {}
        for row in histories[0]:
            for name, value in row.items():
                sizes[group(name)] = max(sizes.get(group(name), 0), abs(value))
        for row, other in zip(*histories):
            for name, value in row.items():
                self.assertLessEqual(abs(other[name] - value), 1e-8 * sizes[group(name)], f"{name} in step {row['step']:g}")
        self.check_vtkhdf(one)
        self.check_vtkhdf(two)

    def test_direct(self):
        self.check("direct")

    @unittest.skipUnless(has_pt_scotch(), "built without PT-Scotch")
    def test_graph_partition(self):
        self.check("p-multigrid", "Mesh/Partitioner = PT-Scotch", ranks=3)
        log = (self.folder / "two" / "log.txt").read_text(encoding="utf-8")
        self.assertRegex(log, r"PT-Scotch: \d+ faces between ranks, along the curve \d+")

    def solutions(self, all_ranks, degree, cells, solver):
        """The final entries of the summary for linear statics of a beam, by
        ranks."""
        case = {"Mesh/Type": "box", "Mesh/box/Size": "4, 1, 1", "Mesh/box/Cells": cells, "Discretization/Degree": str(degree),
                "Material/Type": "linear", "Boundary conditions/Fixed": "x-min", "Loads/Gravity": "0; 0; -1",
                "Time integration/Type": "static", "Output/Overwrite": "true", "Linear solver/Type": "p-multigrid",
                "Linear solver/p-multigrid/Coarse solver": solver, "Linear solver/Tolerance": "1e-10"}
        (self.folder / "case.prm").write_text(parameter_text(case), encoding="utf-8")
        found = {}
        for ranks in all_ranks:
            run = run_on(ranks, ["case.prm", "--output", self.folder / "results", "--quiet"], self.folder, 120)
            self.assertEqual(run.returncode, 0, run.stderr)
            found[ranks] = read_summary(self.folder / "results")["final"]
        return found

    def test_iterations(self):
        # The solver does not depend on the parts of ranks: iterations differ
        # only because aggregates end at their borders.
        for degree, cells in ((1, "32, 8, 8"), (2, "16, 4, 4"), (3, "16, 4, 4")):
            found = {ranks: end["linear_iterations"] for ranks, end in self.solutions((1, 2, 7), degree, cells, "aggregation").items()}
            print(f"degree {degree}: {found}")
            self.assertLessEqual(max(found.values()), found[1] + 2)

    def test_ranks_without_nodes(self):
        # With 12 cells, a rank has one or two, and all nodes of some ranks
        # belong to others.
        for degree in (1, 2, 3):
            for solver in ("direct", "aggregation"):
                found = self.solutions((1, 5, 8), degree, "2, 1, 1", solver)
                for ranks, end in found.items():
                    self.assertAlmostEqual(end["elastic_energy"] / found[1]["elastic_energy"], 1, delta=1e-9, msg=f"{degree} {solver} {ranks}")

    def test_vertex_dilatation(self):
        """Dilatation at vertices depends on two layers of cells around a node:
        explicit and implicit steps, with each solver."""
        case = {"Mesh/Type": "box", "Mesh/box/Size": "4, 1, 1", "Mesh/box/Cells": "8, 2, 2", "Discretization/Degree": "1",
                "Material/Dilatation": "vertices", "Material/Poisson's ratio": "0.49", "Boundary conditions/Fixed": "x-min",
                "Loads/Gravity": "0; 0; -9.81", "Time integration/End time": "0.1", "Output/Probes": "tip: 4 1 1",
                "Output/Overwrite": "true", "Linear solver/Tolerance": "1e-11", "Newton/Residual tolerance": "1e-10"}
        explicit = {"Time integration/Type": "central difference", "Discretization/Mass": "diagonal scaling", "Time integration/Time step": "0"}
        aggregation = {"Linear solver/Type": "p-multigrid", "Linear solver/p-multigrid/Coarse solver": "aggregation"}
        for more in (explicit, aggregation, {"Linear solver/Type": "direct"}, {"Linear solver/Type": "jacobi"}):
            (self.folder / "case.prm").write_text(parameter_text({**case, **more}), encoding="utf-8")
            tips = {}
            for ranks in (1, 3, 7):
                run = run_on(ranks, ["case.prm", "--output", self.folder / "results", "--quiet"], self.folder, 120)
                self.assertEqual(run.returncode, 0, run.stderr)
                tips[ranks] = float(read_history(self.folder / "results")[-1]["tip_z"])
            for ranks, tip in tips.items():
                self.assertAlmostEqual(tip / tips[1], 1, delta=1e-8, msg=f"{more} {ranks}")

    def test_curved_cells(self):
        """Quadrature is not exact for these laws, so a straight cell must not
        use the rule of curved cells because it is beside one."""
        case = {"Mesh/Type": "gmsh", "Mesh/gmsh/File": ROOT / "meshes" / "sphere_octant.geo", "Mesh/gmsh/Geometry degree": "2",
                "Mesh/gmsh/Element size": "0.5", "Discretization/Degree": "2", "Material/Young's modulus": "1", "Output/Probes": "inside: 1 0 0",
                "Boundary conditions/Displacement": "x-min: 0; free; free, y-min: free; 0; free, z-min: free; free; 0",
                "Boundary conditions/Pressure": "inside: 0.1", "Linear solver/Tolerance": "1e-12", "Newton/Residual tolerance": "1e-11",
                "Newton/Increment tolerance": "1e-11", "Time integration/Type": "static", "Output/Overwrite": "true"}
        explicit = {"Time integration/Type": "central difference", "Discretization/Mass": "diagonal scaling", "Time integration/Time step": "0",
                    "Time integration/End time": "0.3", "Material/Density": "1"}
        laws = ({"Material/Type": "Saint Venant-Kirchhoff"}, {"Material/Type": "neo-Hookean"}, {"Material/Rotation": "quadrature points"},
                {"Material/Type": "Saint Venant-Kirchhoff", **explicit})
        shares = [(1, "Hilbert curve"), (2, "Hilbert curve"), (7, "Hilbert curve")] + [(3, "PT-Scotch")] * has_pt_scotch()
        for law in laws:
            (self.folder / "case.prm").write_text(parameter_text({**case, **law}), encoding="utf-8")
            ends = []
            for ranks, partitioner in shares:
                run = run_on(ranks, ["case.prm", "--output", self.folder / "results", "--quiet", "--set", f"Mesh/Partitioner = {partitioner}"],
                             self.folder, 120)
                self.assertEqual(run.returncode, 0, run.stderr)
                ends.append(read_history(self.folder / "results")[-1])
            for end in ends:
                for name in ("inside_x", "elastic_energy", "min_det_F", "volume"):
                    # The tolerance is the round-off of the solution, which
                    # statics finds to 1e-11, and of explicit steps.
                    self.assertAlmostEqual(float(end[name]) / float(ends[0][name]), 1, delta=1e-10, msg=f"{law} {name}")

    @unittest.skipUnless(has_preconditioner("amg"), "built without Epetra")
    def test_amg(self):
        self.check("amg")


if __name__ == "__main__":
    unittest.main()
