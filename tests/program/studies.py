# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Convergence studies from the command line: their files, restarts and references."""

import csv
import json
import math
import os
import subprocess
import time
import unittest

from support import ProgramTest, parameter_text, read_history, read_summary
from restarts import contents

BOX = """
subsection Mesh
  subsection box
    set Cells = 2, 2, 2
  end
end
subsection Material
  set Type = linear
end
"""

EXACT = "set Type = convergence study\n" + BOX + """
subsection Exact solution
  set Displacement          = 0.1*sin(2*x+y)*exp(z); 0.1*x*y^2*z; 0.05*cos(2*x-z)
  set Displacement boundary = x-min, y-max
end
subsection Time integration
  set Type      = static
  set Time step = 1
end
subsection Linear solver
  set Tolerance = 1e-11
end
subsection Convergence study
  set Degrees     = 1, 2
  set Refinements = 0, 1
  set Pictures    = false
end
"""

# A study of one run with one step.
SMALL = {"Type": "convergence study", "Mesh/Type": "box", "Mesh/box/Size": "2, 1, 1", "Mesh/box/Cells": "2, 1, 1", "Material/Type": "linear",
         "Material/Young's modulus": "1e6", "Boundary conditions/Fixed": "x-min", "Loads/Gravity": "0; 0; -10", "Time integration/Type": "static",
         "Convergence study/Reference": "none", "Convergence study/Quantities": "elastic_energy", "Convergence study/Degrees": "1",
         "Convergence study/Refinements": "0", "Convergence study/Pictures": "false"}

PICTURES = {f"study_{norm}_over_{abscissa}.{ending}" for norm in ("l2", "h1", "energy") for abscissa in ("h", "dofs", "wall_time")
            for ending in ("svg", "png")}


class Studies(ProgramTest):

    def study(self, text, *arguments, **others):
        (self.folder / "study.prm").write_text(text, encoding="utf-8")
        return self.run_program(self.folder / "study.prm", "--output", self.folder / "out", *arguments, **others)

    def rows(self):
        with open(self.folder / "out" / "study.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_files(self):
        """A study writes a row and a file for each run, the table in three formats, and pictures; results can be overwritten."""
        self.study(EXACT, "--set", "Convergence study/Pictures = true")
        out = self.folder / "out"
        rows = self.rows()
        self.assertEqual([(row["degree"], row["refinements"]) for row in rows], [("1", "0"), ("1", "1"), ("2", "0"), ("2", "1")])
        names = {f"degree_{row['degree']}_refinements_{row['refinements']}.{ending}" for row in rows for ending in ("json", "log")}
        self.assertEqual({path.name for path in (out / "rows").iterdir()}, names)
        self.assertEqual({path.name for path in out.glob("study_*")}, PICTURES)
        for path in out.glob("study_*.svg"):
            self.assertIn("</svg>", path.read_text(encoding="utf-8"))
        self.assertIn(r"\toprule", (out / "study.tex").read_text(encoding="utf-8"))
        self.assertIn("energy error  order", (out / "log.txt").read_text(encoding="utf-8"))
        summary = read_summary(out)
        self.assertEqual((summary["status"], summary["runs"], summary["failed_runs"]), ("done", 4, 0))
        for row in rows:
            # A single run with the same parameters has the same error.
            self.run_program(self.folder / "study.prm", "--output", self.folder / "single", "--set", "Output/Overwrite = true",
                             "--set", "Type = simulation", "--set", f"Discretization/Degree = {row['degree']}",
                             "--set", f"Mesh/Refinements = {row['refinements']}")
            errors = read_summary(self.folder / "single")["errors"]
            # Errors agree to round-off only, as memory may be aligned differently.
            for norm in ("L2", "H1", "energy"):
                self.assertAlmostEqual(float(row[f"{norm}_error"]) / errors[norm], 1, delta=1e-12)
        self.study(EXACT, "--set", "Output/Overwrite = true", "--set", "Convergence study/Degrees = 1")
        self.assertEqual(len(self.rows()), 2)

    def test_restart(self):
        """Finished runs are not repeated, others are made; a changed problem is another study, which does not replace the results."""
        self.study(EXACT, "--set", "Convergence study/Refinements = 0")
        rows = self.folder / "out" / "rows"
        (rows / "degree_2_refinements_0.json").unlink()
        kept = rows / "degree_1_refinements_0.json"
        result = json.loads(kept.read_text(encoding="utf-8"))
        result["result"]["errors"][0] = 0.125  # A mark that only this file has.
        kept.write_text(json.dumps(result), encoding="utf-8")
        self.study(EXACT, status=1)
        self.assertNotIn("another revision", self.study(EXACT, "--restart").stdout)
        self.assertEqual(float(self.rows()[0]["L2_error"]), 0.125)
        self.assertEqual(len(self.rows()), 4)
        kept.write_text(json.dumps({**result, "git_revision": "0"}), encoding="utf-8")
        self.assertEqual(self.study(EXACT, "--restart").stdout.count("degree_1_refinements_0.json: the result of another revision of corotet is kept"), 1)
        before = contents(self.folder / "out")
        for more in ((), ("--quiet",), ("--validate",)):
            errors = self.study(EXACT, "--restart", "--set", "Material/Poisson's ratio = 0.2", *more, status=1).stderr
            self.assertEqual(errors, "corotet: error: --set: Material/Poisson's ratio: --restart: found '0.2', but in "
                             f"'{self.folder / 'out'}' are results of another run, with '0.3'; allowed: another directory, or "
                             "Output/Overwrite = true to begin anew\n")
            self.assertEqual(contents(self.folder / "out"), before)
        self.study(EXACT, "--restart", "--set", "Material/Poisson's ratio = 0.2", "--set", "Output/Overwrite = true")
        self.assertNotEqual(float(self.rows()[0]["L2_error"]), 0.125)

    def test_bodies_that_change(self):
        """A selection by place may be another part of the body on finer meshes: there is one warning, for the first such run. Cuboids of
        1/2 have a side at x = 0.5, and none at 0.4."""
        for limit, expected in ((0.5, None), (0.4, ("the boundary 'patch' has 0.035 m^2 and had 0.01", "the region 'core' has"))):
            with self.subTest(limit=limit):
                run = self.study(EXACT, "--set", "Output/Overwrite = true", "--set", f"Selections/Regions = core: box -1 -1 -1 {limit} 2 2",
                                 "--set", f"Selections/Boundaries = patch: box -1 -1 -1 {limit} 2 1e-3 or x-max")
                log = (self.folder / "out" / "log.txt").read_text(encoding="utf-8")
                warnings = [line for line in log.splitlines() if "not of the same body" in line]
                self.assertEqual(len(warnings), 1 if expected else 0, log)
                for text in expected or ():
                    self.assertIn(text, warnings[0])
                    self.assertTrue(warnings[0].startswith("warning: degree_1_refinements_1: "), warnings[0])
                self.assertEqual((run.stdout + run.stderr).count("not of the same body"), len(warnings))

    def test_restart_of_another_study(self):
        """Entries of the runs belong to the study; its lists, and entries that they replace, do not."""
        self.run_small("Loads/Gravity = 0; 0; 0")
        before = contents(self.folder / "out")
        modes = ("Loads/Gravity = 0; 0; 0", "Convergence study/Run = modes", "Convergence study/Quantities = frequency_1", "Modes/Number = 1")
        self.assertIn("Convergence study/Run: --restart: found 'modes', but in 'out' are results of another run, with 'simulation'; ",
                      self.run_small(*modes, more=("--restart",), status=1).stderr)
        self.assertEqual(contents(self.folder / "out"), before)
        self.run_small("Loads/Gravity = 0; 0; 0", "Convergence study/Degrees = 1, 2", "Discretization/Degree = 1", "Mesh/Refinements = 1",
                       "Output/Stress probes = mid: 0.4 0.04 0.04", more=("--restart",))
        self.assertEqual(len(self.rows()), 2)

    def test_quantities_of_stress_and_iterations(self):
        """Stress at probes is a quantity, and iterations are those of all steps, however few have a row."""
        text = EXACT.replace("set Type      = static", "set Type      = static\n  subsection static\n    set Load steps = 3\n  end")
        probes = ("--set", "Output/Stress probes = mid: 0.4 0.04 0.04", "--set", "Convergence study/Quantities = mid_von_mises",
                  "--set", "Convergence study/Reference = none")
        self.study(text, *probes)
        rows = self.rows()
        self.assertTrue(all(float(row["mid_von_mises"]) > 0 for row in rows))
        self.study(text, *probes, "--set", "Output/Steps between rows = 3", "--set", "Output/Overwrite = true")
        for name in ("newton_iterations", "linear_iterations"):
            self.assertEqual([row[name] for row in self.rows()], [row[name] for row in rows], name)
        self.assertTrue(all(int(row["newton_iterations"]) >= 3 for row in rows))

    def test_damaged_result(self):
        """A damaged result is reported, and its run is repeated."""
        self.study(EXACT, "--set", "Convergence study/Refinements = 0")
        undisturbed = [float(row["L2_error"]) for row in self.rows()]
        kept = self.folder / "out" / "rows" / "degree_1_refinements_0.json"
        whole = kept.read_text(encoding="utf-8")
        for key, value in (("errors", []), ("cells", "many"), ("quantities", ["much"]), ("wall_times", 1)):
            result = json.loads(whole)
            result["result"][key] = value
            kept.write_text(json.dumps(result), encoding="utf-8")
            run = self.study(EXACT, "--restart", "--set", "Convergence study/Refinements = 0")
            self.assertIn("rows/degree_1_refinements_0.json: the result is damaged; the run is made again", run.stdout, key)
            for row, error in zip(self.rows(), undisturbed, strict=True):
                # Errors agree to round-off only, as memory may be aligned differently.
                self.assertAlmostEqual(float(row["L2_error"]) / error, 1, delta=1e-12)
            self.assertEqual(json.loads(kept.read_text(encoding="utf-8"))["result"].keys(), result["result"].keys())

    def test_restart_within_a_run(self):
        """The unfinished run continues from its checkpoint; results are those of an undisturbed study."""
        moving = {"Time integration/Type": "backward Euler", "Time integration/Time step": "0.25", "Exact solution/Displacement": "",
                  "Convergence study/Reference": "finer run", "Convergence study/Quantities": "elastic_energy", "Loads/Gravity": "0; 0; -10",
                  "Boundary conditions/Fixed": "x-min", "Convergence study/Pictures": "false"}
        overrides = [word for entry, value in moving.items() for word in ("--set", f"{entry} = {value}")]
        self.study(EXACT, *overrides)
        undisturbed = self.rows()
        files = {path.name for path in (self.folder / "out" / "rows").iterdir()}
        stopped = 0
        # The study is stopped after each step.
        status = 4
        arguments = ["--set", "Output/Overwrite = true"]
        while status == 4:
            self.assertLess(stopped, 100)
            run = self.study(EXACT, *overrides, *arguments, "--set", "Checkpoint/Wall time limit = 1e-6", status=None)
            status = run.returncode
            arguments = ["--restart"]
            stopped += status == 4
            self.assertIn(status, (0, 4), run.stderr)
        self.assertGreater(stopped, 10)
        again = self.rows()
        for row in (*undisturbed, *again):
            for name in [name for name in row if "time" in name and name != "time_step" or "memory" in name]:
                del row[name]
        self.assertEqual(again, undisturbed)
        self.assertEqual({path.name for path in (self.folder / "out" / "rows").iterdir()}, files)

    def test_ranks(self):
        """Two ranks find the same errors, to the solver's tolerance."""
        self.study(EXACT)
        alone = self.rows()
        self.study(EXACT, "--set", "Output/Overwrite = true", ranks=2)
        for one, two in zip(alone, self.rows()):
            self.assertEqual(one["dofs"], two["dofs"])
            for norm in ("L2", "H1", "energy"):
                self.assertAlmostEqual(float(two[f"{norm}_error"]) / float(one[f"{norm}_error"]), 1, delta=1e-6)

    def test_finer_run(self):
        """Errors relative to a finer run are those relative to the exact solution, if the finer run's own errors are small; on two ranks,
        too."""
        text = EXACT.replace("set Degrees     = 1, 2", "set Degrees     = 1, 2\n  set Quantities = elastic_energy")
        self.study(text)
        exact = self.rows()
        self.assertNotIn("elastic_energy_error", exact[0])
        for ranks in (1, 2):
            self.study(text, "--set", "Convergence study/Reference = finer run", "--set", "Output/Overwrite = true", ranks=ranks)
            finer = self.rows()
            for row, other in zip(exact, finer):
                # The error of the finer run, degree 2 with two refinements, is 0.03 of the smallest one here and 0.004 of the next.
                delta = 0.05 if row["degree"] == "2" and row["refinements"] == "1" else 0.01
                self.assertAlmostEqual(float(other["L2_error"]) / float(row["L2_error"]), 1, delta=4 * delta)
                self.assertAlmostEqual(float(other["elastic_energy"]) / float(row["elastic_energy"]), 1, delta=1e-9)
                self.assertGreater(float(other["elastic_energy_error"]), 0)

    def test_finer_run_in_time(self):
        """Errors in time are relative to a run with a fourth of the shortest step. BDF2's error is c dt^2, so the differences are c (dt^2
        - dt_0^2), and orders are log2(255 / 63) and log2(63 / 15); with the shortest step itself as dt_0 the last error would be
        round-off."""
        moving = {"Time integration/Type": "BDF2", "Exact solution/Displacement": "", "Convergence study/Reference": "finer run",
                  "Convergence study/Quantities": "elastic_energy", "Loads/Gravity": "0; 0; -10 * smooth_step(t, 0, 1)", "Boundary conditions/Fixed": "x-min",
                  "Time integration/End time": "1", "Convergence study/Time steps": "0.04, 0.02, 0.01", "Convergence study/Degrees": "1",
                  "Convergence study/Refinements": "0", "Convergence study/Further refinements": "0", "Material/Young's modulus": "1e4"}
        # Checks know the columns that study.csv will have, those of orders in time among them.
        moving.update({"Verification/Source": "none", "Verification/Tolerance reason": "none"})
        moving["Verification/Checks"] = "order: last L2_order_in_time = 2 +- 0.1; steps: last steps = 100 +- 1e-9; memory: min peak_memory_bytes > 1e6"
        self.study(EXACT, *(word for entry, value in moving.items() for word in ("--set", f"{entry} = {value}")))
        checks = (self.folder / "out" / "verification.csv").read_text(encoding="utf-8")
        self.assertEqual(checks.count(",yes\n"), 3, checks)
        log = (self.folder / "out" / "log.txt").read_text(encoding="utf-8")
        self.assertIn("time_step_0.0025", log)
        orders = [row["L2_order_in_time"] for row in self.rows()]
        for order, expected in zip(orders[1:], (math.log2(255 / 63), math.log2(63 / 15))):
            self.assertAlmostEqual(float(order), expected, delta=0.1)
        # Where no run has these steps, none is finer than the finest one.
        for other in ("Time integration/Type = static", "Time integration/Adaptive step/Enabled = true"):
            entries = {**moving, "Time integration/Type": "Newmark"}
            run = self.study(EXACT, *(word for entry, value in entries.items() for word in ("--set", f"{entry} = {value}")), "--set", other,
                             "--set", "Output/Overwrite = true", status=1)
            self.assertIn("Convergence study/Further refinements: found 0: the run of the highest degree", run.stderr)

    def test_steps_that_end_at_results(self):
        """Adaptive steps end at multiples of Time between results, like those of a single run: this load acts for a hundredth of the
        time."""
        entries = {**SMALL, "Discretization/Degree": "1", "Time integration/Type": "Newmark", "Time integration/Time step": "0.01",
                   "Time integration/Adaptive step/Enabled": "true",
                   "Loads/Gravity": "0; 0; -10 * half_sine(t, 0.7, 0.71)", "Output/Time between results": "0.005",
                   "Convergence study/Quantities": "step, external_work"}
        for kind, directory in (("convergence study", "out"), ("simulation", "single")):
            (self.folder / "case.prm").write_text(parameter_text({**entries, "Type": kind}), encoding="utf-8")
            self.run_program("case.prm", "--output", directory)
        (row,) = self.rows()
        last = read_history(self.folder / "single")[-1]
        self.assertEqual(float(row["step"]), float(last["step"]))
        self.assertGreater(float(row["external_work"]), 0)
        self.assertEqual(float(row["external_work"]), float(last["external_work"]))

    def test_lists_without_effect(self):
        run = self.run_small("Convergence study/Time steps = 1, 0.5", "Convergence study/Rotations = cell centre; quadrature points")
        for entry, choice in (("Time steps", '"Time integration/Type" is \'static\''), ("Rotations", '"Material/Type" is \'linear\'')):
            self.assertRegex(run.stdout, f"warning: [^\n]*no effect, as {choice}: Convergence study/{entry}\n")

    def test_restart_with_a_value_less(self):
        """Without a given value, a quantity is compared with that of the finer run again."""
        finer = ("Convergence study/Reference = finer run", "Convergence study/Refinements = 0, 1")
        self.run_small(*finer, "Convergence study/Quantities = elastic_energy: -123")
        self.check_restart(*finer, "Convergence study/Quantities = elastic_energy")

    def test_finer_run_of_another_body(self):
        """New vertices lie on the sphere, so runs have different volumes."""
        (self.folder / "ball.geo").write_text('SetFactory("OpenCASCADE");\nSphere(1) = {0, 0, 0, 1};\nPhysical Volume("ball") = {1};\n'
                                              'Physical Surface("skin") = {1};\nMeshSize{:} = 1;\n', encoding="utf-8")
        ball = ("Mesh/Type = gmsh", "Mesh/gmsh/File = ball.geo", "Boundary conditions/Fixed = skin", "Convergence study/Reference = finer run")
        self.assertRegex(self.run_small(*ball).stdout, r"warning: degree_1_refinements_0: the body has [\d.]+ m\^3, in the finer run [\d.]+ m\^3")

    def test_modes(self):
        """Frequencies are compared with c / (4 L), that of a clamped bar that cannot strain laterally: the orders are 2 p."""
        frequency = math.sqrt(1e6 * (1 - 0.3) / (1.3 * 0.4) / 1e3) / 4
        self.study("set Type = convergence study\n" + BOX.replace("set Cells = 2, 2, 2", "set Size = 1, 0.1, 0.1\n    set Cells = 4, 1, 1") + """
subsection Boundary conditions
  set Fixed        = x-min
  set Displacement = y-min: free; 0; free, y-max: free; 0; free, z-min: free; free; 0, z-max: free; free; 0
end
subsection Discretization
  set Mass = consistent
end
subsection Modes
  set Number = 1
end
subsection Convergence study
  set Run         = modes
  set Reference   = none
  set Degrees     = 1, 2
  set Refinements = 1, 2
  set Quantities  = frequency_1: FREQUENCY
  set Pictures    = false
end
""".replace("FREQUENCY", repr(frequency)))
        rows = self.rows()
        self.assertAlmostEqual(float(rows[1]["frequency_1_order"]), 2, delta=0.05)
        self.assertAlmostEqual(float(rows[3]["frequency_1_order"]), 4, delta=0.1)

    def run_small(self, *settings, more=(), **others):
        """Runs a study of one small run with these settings."""
        (self.folder / "small.prm").write_text(parameter_text(SMALL), encoding="utf-8")
        return self.run_program("small.prm", "--output", "out", *more, *[word for setting in settings for word in ("--set", setting)], **others)

    def check_restart(self, *settings):
        """The rows after a restart with these settings, which are those of a study that begins with them."""
        self.run_small(*settings, more=("--restart",))
        rows = self.numbers()
        self.run_small("Output/Overwrite = true", *settings)
        for row, other in zip(rows, self.numbers(), strict=True):
            # Energies agree to round-off only, as memory may be aligned differently.
            self.assertAlmostEqual(float(row["elastic_energy"]) / float(other["elastic_energy"]), 1, delta=1e-9)
            self.assertEqual({**row, "elastic_energy": ""}, {**other, "elastic_energy": ""})
        return rows

    def numbers(self):
        """The rows without columns that are not compared: times of clocks and memory."""
        return [{name: value for name, value in row.items() if name == "time_step" or not ("time" in name or "memory" in name)} for row in self.rows()]

    def test_restart_with_other_data(self):
        """A changed mesh file or table is another problem, also with the same name."""
        mesh, table = (self.folder / name for name in ("cube.geo", "rise.csv"))
        cube = 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 1, 1, 1};\nPhysical Volume("cube") = {1};\nPhysical Surface("x-min") = {1};\n'
        mesh.write_text(cube + "MeshSize{:} = 1;\n", encoding="utf-8")
        table.write_text("0, 0\n1, 1\n", encoding="utf-8")
        data = ("Mesh/Type = gmsh", "Mesh/gmsh/File = cube.geo", "Tables/Linear = rise: rise.csv", "Loads/Gravity = 0; 0; -10 * rise(t)")
        self.run_small(*data)
        first = self.numbers()
        table.write_text("0, 0\n1, 2\n", encoding="utf-8")
        second = self.check_restart(*data)
        # The body is linear and the load doubled, so the energy is four times as large.
        self.assertAlmostEqual(float(second[0]["elastic_energy"]) / float(first[0]["elastic_energy"]), 4, delta=1e-6)
        mesh.write_text(cube.replace("1, 1, 1}", "2, 1, 1}") + "MeshSize{:} = 1;\n", encoding="utf-8")
        third = self.check_restart(*data)
        self.assertGreater(float(third[0]["elastic_energy"]), 2 * float(second[0]["elastic_energy"]))

    def stop_study(self, name, *settings):
        """Sends SIGTERM as soon as there is a file of that name in rows/. Returns the summary."""
        (self.folder / "small.prm").write_text(parameter_text(SMALL), encoding="utf-8")
        process = subprocess.Popen([os.environ["COROTET_PROGRAM"], "small.prm", "--output", "out", *[word for setting in settings for word in ("--set", setting)]],
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while not list((self.folder / "out").glob(f"rows/{name}")) and process.poll() is None:
            time.sleep(0.001)
        process.terminate()
        out, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4, out + errors)
        return self.check_stopped(out, errors)

    def check_stopped(self, out, errors):
        """Checks that the reason is once on the terminal and once in the log. Returns the summary."""
        summary = read_summary(self.folder / "out")
        self.assertEqual(summary["status"], "stopped")
        self.assertEqual(errors, f"corotet: stopped: {summary['message']}\n")
        self.assertNotIn(summary["message"], out)
        self.assertEqual((self.folder / "out" / "log.txt").read_text(encoding="utf-8").count(summary["message"]), 1)
        return summary

    def test_restart_with_another_step(self):
        """The unfinished run begins anew, as it would otherwise belong to both studies."""
        moving = ("Time integration/Type = Newmark", "Time integration/End time = 2", "Checkpoint/Steps between checkpoints = 1")
        summary = self.stop_study("**/step_000003.json", *moving, "Time integration/Time step = 0.002", "Checkpoint/Keep = 1000")
        self.assertRegex(summary["message"], r"^step \d+ \(t = .* s\): SIGTERM; the run is saved, --restart goes on with it$")
        self.check_restart(*moving, "Time integration/Time step = 0.1")

    def test_stopped_between_runs(self):
        """A signal in the only step of a run ends the study before the next run."""
        runs = ("Convergence study/Degrees = 1, 2, 3", "Convergence study/Refinements = 0, 1", "Mesh/box/Cells = 8, 4, 4")
        summary = self.stop_study("*.log", *runs)
        self.assertRegex(summary["message"], "^[1-5] of 6 runs: SIGTERM; they are saved, --restart goes on with the others$")
        self.assertEqual(summary["finished_runs"], int(summary["message"][0]))
        self.check_restart(*runs)
        run = self.run_small(*runs, "Output/Overwrite = true", "Checkpoint/Wall time limit = 1e-6", status=4)
        self.assertIn("of 6 runs: the wall time limit; they are saved", self.check_stopped(run.stdout, run.stderr)["message"])
        self.check_restart(*runs)

    def check_failed(self, error, *rows):
        summary = read_summary(self.folder / "out")
        self.assertEqual(summary["status"], "failed")
        self.assertEqual(error, f"corotet: error: {summary['message']}\n")
        self.assertEqual([row["status"] for row in self.rows()], list(rows))
        return summary["message"]

    def test_runs_that_fail_at_their_start(self):
        """Runs fail in their first forces, or in a check that the coarsest mesh has passed."""
        moving = ("Time integration/Type = Newmark", "Time integration/End time = 0.1", "Time integration/Time step = 0.05")
        message = self.check_failed(self.run_small(*moving, "Initial conditions/Velocity = 0; 0; 1e200", "Boundary conditions/Fixed =", status=2).stderr, "failed")
        self.assertEqual(message, "1 of 1 runs of the study have failed")
        # Cells of half the size have half the stable step.
        explicit = ("Time integration/Type = central difference", "Discretization/Mass = diagonal scaling", "Time integration/End time = 0.006",
                    "Time integration/Time step = 0.006", "Convergence study/Refinements = 0, 1, 2, 3", "Output/Overwrite = true")
        message = self.check_failed(self.run_small(*explicit, status=2).stderr, "done", "done", "failed", "failed")
        self.assertEqual(message, "2 of 4 runs of the study have failed")

    def test_finer_run_that_fails(self):
        """The study ends with the finished runs, and tells why."""
        strong = ("Convergence study/Reference = finer run", "Material/Type = corotational", "Loads/Gravity = 0; 0; -1e5", "Newton/Maximum iterations = 2",
                  "Time integration/Maximum halvings = 0", "Convergence study/Refinements = 0, 1")
        message = self.check_failed(self.run_small(*strong, status=2).stderr, "failed")
        self.assertRegex(message, "^the finer run has failed: .*Newton's method")

    def test_failed_run(self):
        """A failed run is a row of the table; the other runs are made nevertheless."""
        error = self.study(EXACT, "--set", "Linear solver/Maximum iterations = 3", "--set", "Linear solver/Type = jacobi",
                           status=2).stderr
        self.assertIn("runs of the study have failed", error)
        self.assertEqual(len(self.rows()), 4)
        self.assertIn("failed", {row["status"] for row in self.rows()})
        self.assertEqual(read_summary(self.folder / "out")["status"], "failed")

    def test_no_data_in_any_spelling(self):
        """Where loads are made from the exact solution, a load of zero counts as none, however it is written."""
        settings = [word for entry in ("Loads/Gravity", "Loads/Body force", "Initial conditions/Displacement", "Initial conditions/Velocity")
                    for word in ("--set", f"{entry} = 0;0.0;-0")]
        self.study(EXACT, "--validate", *settings)

    def test_refusals(self):
        """Mistakes are found before the first run."""
        for setting, message in (
            ("Convergence study/Refinements = 1, 0", "Convergence study/Refinements: the values do not increase"),
            ("Convergence study/Degrees = 2, 2", "Convergence study/Degrees: a value is given twice"),
            ("Convergence study/Time steps = " + ", ".join(str(9999 - i) for i in range(9999)), "one for each combination of values; allowed are 10000"),
            ("Convergence study/Quantities = tip_z", "Convergence study/Quantities: the quantity 'tip_z' is unknown"),
            ("Convergence study/Quantities = momentum_x: a", "found 'momentum_x: a'; allowed: 'name' or 'name: number'"),
            ("Convergence study/Quantities = newton_iterations: 2", "found 'newton_iterations', of which every study has a column"),
            ("Convergence study/Masses = row sum", "row sum"),
            ("Exact solution/Displacement = abs(x); 0; 0", "it has the function 'abs'"),
            ("Exact solution/Displacement = ", "Exact solution/Displacement is empty"),
            ("Exact solution/Displacement boundary = top", "Exact solution/Displacement boundary"),
            ("Loads/Gravity = 0; 0; -9.81", "Loads/Gravity: found '0; 0; -9.81', but the data are made"),
            ("Initial conditions/Velocity = 0;0;x", "Initial conditions/Velocity: found '0;0;x', but the data are made from the exact solution; allowed: '0; 0; 0', or"),
            ("Convergence study/Run = modes", "found 'exact solution' for modes"),
            ("Output/Probes = q: 9 9 9", "Output/Probes: probe 'q' at (9, 9, 9) lies outside the body"),
            ("Output/Stress probes = q: 9 9 9", "Output/Stress probes: probe 'q' at (9, 9, 9) lies outside the body"),
        ):
            with self.subTest(setting):
                self.assertIn(message, self.study(EXACT, "--set", setting, status=1).stderr)
                self.assertFalse((self.folder / "out").exists())
        self.assertIn("--restart", self.study(EXACT, "--restart", "--set", "Type = modes", status=1).stderr)


if __name__ == "__main__":
    unittest.main()
