#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Kills runs while they write, again and again, and checks that every finished result can be read.

    check_killed.py TEST_EXECUTABLE

The runs are test VtkhdfWriter.RunWithoutEnd of the executable, on one rank and (where there is an mpirun) on two. All ranks
are killed (SIGKILL) after some results, at moments that differ.
"""
import contextlib
import glob
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))


def environment(folder):
    """The environment without variables that tell a process that it belongs to
    the MPI run which started this script."""
    keep = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("OMPI_", "PMIX_", "PRTE_", "PMI_")) or name.startswith("OMPI_ALLOW")
    }
    return keep | {"COROTET_TEST_RUN_WITHOUT_END": folder}


def n_results(folder):
    return len(glob.glob(os.path.join(folder, "run", "solution", "step_*.h5")))


def run_and_kill(executable, n_ranks, n_steps, delay):
    with tempfile.TemporaryDirectory() as folder:
        command = [executable, "--gtest_filter=VtkhdfWriter.RunWithoutEnd"]
        if n_ranks > 1:
            command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(n_ranks)] + command
        run = subprocess.Popen(command, env=environment(folder), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while n_results(folder) < n_steps:
            if run.poll() is not None or time.monotonic() > deadline:
                run.kill()
                sys.exit(f"check_killed: {command} did not write")
            time.sleep(0.001)
        time.sleep(delay)
        pids = [int(open(path).read()) for path in glob.glob(os.path.join(folder, "pid_*"))]
        assert len(pids) == n_ranks
        for pid in pids:
            # When one rank is dead, mpirun ends the others, perhaps before this
            # loop does.
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        run.wait()
        check = [sys.executable, os.path.join(HERE, "check_vtkhdf.py"), os.path.join(folder, "run"), "--killed", "--test-field"]
        if subprocess.run(check).returncode != 0:
            sys.exit(f"check_killed: not readable after {n_steps} steps on {n_ranks} ranks")


def main():
    for n_ranks in [1, 2] if shutil.which("mpirun") else [1]:
        for i in range(4 - n_ranks):
            # Steps take some milliseconds, so each run is killed at another
            # moment of a step.
            run_and_kill(sys.argv[1], n_ranks, 3 + 7 * i, 0.0013 * i)


if __name__ == "__main__":
    main()
