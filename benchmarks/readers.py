#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""How much memory and time does reading a file take, in every format, and what becomes of one that was cut off? Large files are made by
gmsh and here, and read by `corotet mesh`. Run it inside of scripts/toolchain:

    benchmarks/readers.py [--cells N] [--program PROGRAM] [--keep FOLDER] [--document]

Memory is the sum of the peaks of all processes that exist at the same time,
where it is largest, less that for a mesh of a few cells. Surfaces have a hole,
so that they are read and checked, and refused before anything is meshed; shapes
of CAD are meshed coarsely, which belongs to their figures. The status is 1 if
reading takes more than ten times the file's size and 200 MB, or a file that was
cut off in its middle is not refused in one line that names it. --document
writes the table into doc/meshes.md.
"""

import argparse
import itertools
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "meshes"))

from make_surfaces import write_stl  # pylint: disable=wrong-import-position
from program_runs import document  # pylint: disable=wrong-import-position
from vtk_grids import tetrahedra_grid  # pylint: disable=wrong-import-position

PAGE = ROOT / "doc" / "meshes.md"
ALLOWED_FACTOR, ALLOWED_BYTES = 10, 200e6

# Name, ending, and arguments of gmsh.
MESHES = [("gmsh 2.2, text", "msh", "-format", "msh22"), ("gmsh 2.2, binary", "msh", "-format", "msh22", "-bin"),
          ("gmsh 4.0, text", "msh", "-format", "msh40"), ("gmsh 4.1, text", "msh", "-format", "msh41"),
          ("gmsh 4.1, binary", "msh", "-format", "msh41", "-bin"), ("Abaqus, CalculiX", "inp", "-format", "inp"),
          ("Nastran", "bdf", "-format", "bdf"), ("UNV", "unv", "-format", "unv"), ("VTK legacy, text", "vtk", "-format", "vtk"),
          ("Medit", "mesh", "-format", "mesh"), ("CGNS", "cgns", "-format", "cgns")]
SHAPES = [("STEP", "step"), ("BREP", "brep"), ("IGES", "iges")]
MESHED_BOX = """SetFactory("OpenCASCADE");
Box(1) = {{0, 0, 0, 1, 1, 1}};
Transfinite Curve {{:}} = {n} + 1;
Transfinite Surface {{:}};
Transfinite Volume {{1}};
Physical Volume("body") = {{1}};
Physical Surface("foot") = {{1}};
"""
# Boxes with a hole in each.
PLATES = """SetFactory("OpenCASCADE");
n = {n};
For i In {{0 : n - 1}}
  For j In {{0 : n - 1}}
    k = i * n + j + 1;
    Box(k) = {{2 * i, 2 * j, 0, 1, 1, 1}};
    Cylinder(100000 + k) = {{2 * i + 0.5, 2 * j + 0.5, -1, 0, 0, 3, 0.3}};
    BooleanDifference{{ Volume{{k}}; Delete; }}{{ Volume{{100000 + k}}; Delete; }}
  EndFor
EndFor
"""


def gmsh(folder, geometry, target, *arguments):
    (folder / "made.geo").write_text(geometry, encoding="utf-8")
    subprocess.run(["gmsh", folder / "made.geo", *arguments, "-o", target, "-v", "0"], check=True)


def open_sphere(n):
    """Points and triangles of a sphere of n by n quadrilaterals, without its caps."""
    theta, phi = np.meshgrid(np.linspace(0.1, np.pi - 0.1, n + 1), np.linspace(0, 2 * np.pi, n, endpoint=False), indexing="ij")
    points = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a, b, c, d = i * n + j, (i + 1) * n + j, (i + 1) * n + (j + 1) % n, i * n + (j + 1) % n
    return points, np.concatenate([np.stack([a, b, c], axis=-1).reshape(-1, 3), np.stack([a, c, d], axis=-1).reshape(-1, 3)])


def write_surfaces(folder, n):
    """Writes files of all surface formats; returns them by name."""
    points, triangles = open_sphere(n)
    files = {name: folder / f"surface_{i}.{name.split()[0].lower().rstrip(',')}"
             for i, name in enumerate(("STL, text", "STL, binary", "PLY, text", "PLY, binary", "OBJ", "OFF"))}
    corners = points[triangles].astype("<f4")
    with open(files["STL, text"], "w", encoding="ascii") as file:
        file.write("solid ball\n")
        for one in corners:
            file.write("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {x:.7g} {y:.7g} {z:.7g}\n" for x, y, z in one) + "endloop\nendfacet\n")
        file.write("endsolid ball\n")
    write_stl(files["STL, binary"], corners)
    head = "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {}\n" \
           "property list uchar int vertex_indices\nend_header\n"
    vertices = "".join(f"{x:.7g} {y:.7g} {z:.7g}\n" for x, y, z in points)
    faces = "".join(f"3 {a} {b} {c}\n" for a, b, c in triangles)
    files["PLY, text"].write_text(head.format("ascii", len(points), len(triangles)) + vertices + faces, encoding="ascii")
    rows = np.zeros(len(triangles), dtype=[("n", "u1"), ("corners", "<i4", 3)])
    rows["n"], rows["corners"] = 3, triangles
    files["PLY, binary"].write_bytes(head.format("binary_little_endian", len(points), len(triangles)).encode() +
                                     points.astype("<f4").tobytes() + rows.tobytes())
    files["OBJ"].write_text("".join(f"v {x:.7g} {y:.7g} {z:.7g}\n" for x, y, z in points) +
                            "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles), encoding="ascii")
    files["OFF"].write_text(f"OFF\n{len(points)} {len(triangles)} 0\n" + vertices + faces, encoding="ascii")
    return files


def box(n):
    """Points and tetrahedra of a unit cube of n^3 cubes."""
    number = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    points = np.stack(np.meshgrid(*[np.linspace(0, 1, n + 1)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    tetrahedra = []
    for order in itertools.permutations(range(3)):
        corners = np.cumsum([(0, 0, 0), *np.eye(3, dtype=int)[list(order)]], axis=0)
        if np.linalg.det(corners[1:]) < 0:
            corners = corners[[0, 2, 1, 3]]
        tetrahedra.append(np.stack([number[a:n + a, b:n + b, c:n + c].ravel() for a, b, c in corners], axis=-1))
    return points, np.concatenate(tetrahedra)


def write_med(file, points, tetrahedra):
    """Writes a mesh with one group of cells. The structure is that of MED 4.1
    (https://docs.salome-platform.org)."""
    step = "-0000000000000000001-0000000000000000001"
    with h5py.File(file, "w", track_order=True) as med:
        med.create_group("INFOS_GENERALES").attrs.update({"MAJ": np.int32(4), "MIN": np.int32(1), "REL": np.int32(0)})
        mesh = med.create_group("ENS_MAA/box")
        blanks = np.bytes_(" " * 48)
        mesh.attrs.update({"DIM": np.int32(3), "ESP": np.int32(3), "REP": np.int32(0), "UNT": np.bytes_(" "), "UNI": blanks, "SRT": np.int32(1),
                           "NOM": blanks, "DES": np.bytes_(" "), "TYP": np.int32(0)})
        state = mesh.create_group(step)
        state.attrs.update({"CGT": np.int32(1), "NDT": np.int32(-1), "NOR": np.int32(-1), "PDT": -1.0})
        for name, group, data, columns in (("NOE", "", points, "COO"), ("MAI/TE4", "", tetrahedra[:, [0, 2, 1, 3]] + 1, "NOD")):
            part = state.create_group(name)
            part.attrs.update({"CGT": np.int32(1), "CGS": np.int32(1), "PFL": np.bytes_("MED_NO_PROFILE_INTERNAL"), "GEO": np.int32(304)})
            values = part.create_dataset(columns, data=data.T.ravel().astype(np.int32 if data is not points else float))
            values.attrs.update({"CGT": np.int32(1), "NBR": np.int32(len(data))})
            families = part.create_dataset("FAM", data=np.full(len(data), -1 if name.startswith("MAI") else 0, np.int32))
            families.attrs.update({"CGT": np.int32(1), "NBR": np.int32(len(data))})
        state["MAI"].attrs["CGT"] = np.int32(1)
        family = med.create_group("FAS/box/ELEME", track_order=True).create_group("FAM_-1_body", track_order=True)
        family.attrs["NUM"] = np.int32(-1)
        group = family.create_group("GRO")
        group.attrs["NBR"] = np.int32(1)
        group.create_dataset("NOM", (1,), dtype="80int8")[0] = np.frombuffer(b"body".ljust(80, b"\0"), dtype=np.int8)
        med.create_group("FAS/box/FAMILLE_ZERO").attrs["NUM"] = np.int32(0)


def write_vtk_files(folder, points, tetrahedra):
    """Writes files of both formats with VTK; returns them by name."""
    grid = tetrahedra_grid(points, tetrahedra)
    files = {"VTK legacy, binary": folder / "bytes.vtk", "VTU, raw": folder / "raw.vtu", "VTU, compressed": folder / "compressed.vtu"}
    for name, file in files.items():
        writer = vtkXMLUnstructuredGridWriter() if file.suffix == ".vtu" else vtkUnstructuredGridWriter()
        writer.SetInputData(grid)
        writer.SetFileName(str(file))
        if file.suffix == ".vtk":
            writer.SetFileTypeToBinary()
        elif name.endswith("raw"):
            writer.SetDataModeToAppended()
            writer.EncodeAppendedDataOff()
            writer.SetCompressorTypeToNone()
        writer.Write()
    return files


def family(process):
    """A process and all processes that it has started."""
    members, found = [], [process]
    while found:
        members += found
        text = ""
        for one in found:
            try:
                text += pathlib.Path(f"/proc/{one}/task/{one}/children").read_text(encoding="ascii")
            except OSError:
                pass
        found = [int(word) for word in text.split()]
    return members


def peak(process, parent):
    """The peak memory of a process [bytes]; 0 as long as it is a copy of its
    parent that is about to start another program."""
    try:
        if process != parent and os.readlink(f"/proc/{process}/exe") == os.readlink(f"/proc/{parent}/exe"):
            return 0
        for line in pathlib.Path(f"/proc/{process}/status").read_text(encoding="ascii").splitlines():
            if line.startswith("VmHWM:"):
                return 1024 * int(line.split()[1])
    except OSError:
        pass
    return 0


def read(program, file, *arguments):
    """Exit status, error text, memory [bytes] and processor time [s] of reading
    a file."""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as said:
        run = subprocess.Popen([program, "mesh", file, *arguments], stdout=subprocess.DEVNULL, stderr=said)
        most = 0
        while True:
            most = max(most, sum(peak(process, run.pid) for process in family(run.pid)))
            ended, status, usage = os.wait4(run.pid, os.WNOHANG)
            if ended:
                break
            time.sleep(0.005)
        run.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        return run.returncode, said.read().strip(), most, usage.ru_utime + usage.ru_stime


def tried(program, at_start, name, file, expected_status, *arguments):
    """A row of the table, and whether all requirements are met. at_start is the
    memory for a small mesh."""
    status, said, memory, seconds = read(program, file, *arguments)
    memory -= at_start
    size = file.stat().st_size
    if status != expected_status:
        print(f"{name}: status {status}, expected {expected_status}: {said}")
    half = file.with_stem(file.stem + "_half")
    half.write_bytes(file.read_bytes()[:size // 2])
    status_of_half, said_of_half, _, _ = read(program, half, *arguments)
    refused = status_of_half == 1 and said_of_half.count("\n") == 0 and said_of_half.startswith(f"corotet: error: {half}")
    if not refused:
        print(f"{name}, cut off: status {status_of_half}: {said_of_half[:500]}")
    allowed = ALLOWED_FACTOR * size + ALLOWED_BYTES
    message = said_of_half.replace(f"corotet: error: {half}", "").lstrip(":").replace(f"{half}", half.name)
    row = (f"| {name} | {size / 1e6:.0f} | {memory / 1e6:.0f} | {allowed / 1e6:.0f} | {seconds:.1f} | "
           f"{'`' + message.replace('|', '/')[:110] + '`' if refused else '**not refused**'} |")
    print(row, flush=True)
    return row, status == expected_status and refused and memory <= allowed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, default=300000, metavar="N", help="of meshes; half as many triangles, and a 5000th shapes")
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "corotet"))
    parser.add_argument("--keep", metavar="FOLDER", help="for the files")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    results = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(options.keep or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        gmsh(folder, MESHED_BOX.format(n=2), folder / "small.msh", "-3", "-format", "msh41")
        small = folder / "small_surface"
        small.mkdir(exist_ok=True)
        with_gmsh, alone, with_vtk = (read(program, file)[2] for file in (folder / "small.msh", write_surfaces(small, 8)["STL, binary"],
                                                                          write_vtk_files(small, *box(2))["VTU, raw"]))
        print(f"At the start: {with_gmsh / 1e6:.0f} MB with gmsh's process, {alone / 1e6:.0f} MB without, {with_vtk / 1e6:.0f} MB with VTK's")
        n = round((options.cells / 6) ** (1 / 3))
        meshed_box = MESHED_BOX.format(n=n)
        for i, (name, ending, *arguments) in enumerate(MESHES):
            file = folder / f"mesh_{i}.{ending}"
            gmsh(folder, meshed_box, file, "-3", *arguments)
            results.append(tried(program, {"inp": alone, "vtk": with_vtk}.get(ending, with_gmsh), name, file, 0))
        points, tetrahedra = box(n)
        write_med(folder / "box.med", points, tetrahedra)
        files = {"MED": folder / "box.med", **write_vtk_files(folder, points, tetrahedra)}
        for name, file in files.items():
            results.append(tried(program, with_gmsh if name == "MED" else with_vtk, name, file, 0))
        for name, file in write_surfaces(folder, round((options.cells / 4) ** 0.5)).items():
            results.append(tried(program, alone, name, file, 1))
        for name, ending in SHAPES:
            file = folder / f"shapes.{ending}"
            gmsh(folder, PLATES.format(n=round((options.cells / 5000) ** 0.5)), file, "-0")
            results.append(tried(program, with_gmsh, name, file, 0, "--size", "1"))
    if options.document:
        head = ["| format | file [MB] | memory [MB] | allowed [MB] | seconds | cut off in its middle |", "|---|---:|---:|---:|---:|---|"]
        document(PAGE, "readers", [*head, *(row for row, _ in results)])
    return 0 if all(good for _, good in results) else 1


if __name__ == "__main__":
    sys.exit(main())
