#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Damaged mesh files: meshes.py --damages N [--seed S]

Bytes of a mesh by gmsh (.msh 4.1 and 2.2, binary and as text) are changed at random. The program takes it, or refuses it with
status 1 and one line that names the file, in less than 10 s: whatever happens to gmsh. Needs the command gmsh; COROTET_PROGRAM is
the program.
"""

import argparse
import collections
import os
import pathlib
import random
import resource
import subprocess
import sys
import tempfile

BOX = 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 1, 2, 3};\nPhysical Volume("body") = {1};\nPhysical Surface("end") = {1};\n'


def damaged(data):
    data = bytearray(data)
    for _ in range(random.choice((1, 1, 2, 5, 20))):
        place = random.randrange(len(data))
        what = random.randrange(4)
        if what == 0:
            data[place] ^= 1 << random.randrange(8)
        elif what == 1:
            data[place] = random.randrange(256)
        elif what == 2:
            data[place:place + 8] = random.randrange(2**64).to_bytes(8, "little")
        else:
            del data[place:place + random.randrange(1, 9)]
    return bytes(data)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--damages", type=int, required=True)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    random.seed(options.seed)
    counts, wrong = collections.Counter(), 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "box.geo").write_text(BOX, encoding="utf-8")
        (folder / "case.prm").write_text("subsection Mesh\n set Type = gmsh\n subsection gmsh\n  set File = x.msh\n end\nend\n", encoding="utf-8")
        meshes = []
        for version in ("msh41", "msh22"):
            for binary in ([], ["-bin"]):
                subprocess.run(["gmsh", "-3", "-format", version, *binary, "-o", folder / "x.msh", folder / "box.geo"], check=True,
                               capture_output=True)
                meshes.append((folder / "x.msh").read_bytes())
        for number in range(options.damages):
            (folder / "x.msh").write_bytes(damaged(meshes[number % len(meshes)]))
            try:
                run = subprocess.run([os.environ["COROTET_PROGRAM"], "--validate", "--quiet", "case.prm"], cwd=folder, capture_output=True,
                                     text=True, errors="replace", timeout=10, check=False)
                status, errors = run.returncode, run.stderr
            except subprocess.TimeoutExpired:
                status, errors = "hangs", ""
            good = status == 0 and errors == "" or status == 1 and errors.count("\n") == 1 and "x.msh" in errors
            ending = "taken" if status == 0 else "gmsh crashed" if "crashed" in errors else "refused"
            counts[ending if good else "WRONG"] += 1
            if not good:
                wrong += 1
                print(f"number {number}: status {status}: {errors}", flush=True)
        # The peak memory in MiB, from kB, of the largest process.
        memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"{options.damages} damaged meshes: " + ", ".join(f"{n} {ending}" for ending, n in sorted(counts.items())) + f"; at most {memory:.0f} MiB")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
