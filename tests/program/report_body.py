# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Results of a body with many triangles, made without the program: only what
scripts/report reads."""

import h5py
import numpy as np

SIZE = (1, 1, 0.05)
AROUND = (4, 6, 2, 3, 1, 5, 4)  # corners of a cuboid around its diagonal from 0 to 7


def plate(n_cells):
    """The points and linear tetrahedra of a plate of cuboids with six cells
    each."""
    n = np.array(n_cells) + 1
    points = np.stack(np.meshgrid(*[np.linspace(0, size, k) for size, k in zip(SIZE, n)], indexing="ij"), axis=-1).reshape(-1, 3)
    numbers = np.arange(n.prod()).reshape(n)
    nx, ny, nz = n_cells
    corners = np.stack([numbers[i:nx + i, j:ny + j, k:nz + k].ravel() for i in (0, 1) for j in (0, 1) for k in (0, 1)], axis=1)
    cells = np.concatenate([corners[:, [0, a, b, 7]] for a, b in zip(AROUND, AROUND[1:])])
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    turned = np.linalg.det(edges) < 0
    cells[turned] = cells[turned][:, [0, 2, 1, 3]]
    return points, cells


def write_plate(folder, n_cells, n_states):
    """Writes a folder of results with random states; returns the number of
    triangles of the surface."""
    folder.mkdir()
    points, cells = plate(n_cells)
    times, random = np.linspace(0, 1, n_states), np.random.default_rng(1)
    with h5py.File(folder / "solution.vtkhdf", "w") as file:
        root, steps = file.create_group("VTKHDF"), file.create_group("VTKHDF/Steps")
        root["Points"], root["Connectivity"], root["Offsets"] = points, cells.ravel(), np.arange(0, cells.size + 1, 4)
        steps["Values"], root["CellData/region"], steps["CellDataOffsets/region"] = times, np.ones(len(cells), "i4"), np.zeros(n_states, int)
        for name in ("displacement", "velocity"):
            root[f"PointData/{name}"] = 0.01 * random.standard_normal((n_states * len(points), 3))
            steps[f"PointDataOffsets/{name}"] = len(points) * np.arange(n_states)
        for name in ("von_mises", "rotation_angle", "det_F"):
            root[f"CellData/{name}"] = random.random(n_states * len(cells))
            steps[f"CellDataOffsets/{name}"] = len(cells) * np.arange(n_states)
    (folder / ".corotet").write_text("Results of corotet.\n", encoding="utf-8")
    (folder / "parameters.prm").write_text("set Type = simulation\n", encoding="utf-8")
    (folder / "history.csv").write_text("step,time\n" + "".join(f"{i},{time!r}\n" for i, time in enumerate(times.tolist())), encoding="utf-8")
    nx, ny, nz = n_cells
    return 4 * (nx * ny + ny * nz + nz * nx)
