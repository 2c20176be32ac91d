# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""States of a run as files for other programs. A writer gets a Source and a path in a folder of its own, and returns the names of its files there,
the one that refers to the others last. Needs VTK, PyVista, h5py and NumPy."""

import errno
import io
import os
import xml.etree.ElementTree as xml

import h5py
import matplotlib
import numpy as np
import pyvista as pv
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonMisc import vtkErrorCode
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from commands import FIRST_COLUMNS, MARK, WrongInput
from fields import choose_arrays, choose_field, components, mean_of_cells
from lagrange import Surface, inside

LAGRANGE_TETRAHEDRON = 71


class Source:
    """What is exported: states of a run, the arrays wanted, and the displaced surface coloured by a field."""

    def __init__(self, run, states, fields, warp, subdivisions):
        self.run, self.states, self.warp = run, states, warp
        self.times = run.times[states]
        self.fields = fields
        self.subdivisions = subdivisions or run.degree
        self.surface = None
        self.advance = lambda: None

    def arrays(self):
        """Names at nodes and of cells."""
        return choose_arrays(self.run, self.fields)

    def point_table(self, state):
        """All columns at nodes in a state, by name."""
        columns = {}
        for name in self.arrays()[0]:
            data = self.run.point_data(name, state)
            parts = components(name, data.shape[1]) if data.ndim > 1 else []
            columns |= dict(zip(parts, data.T)) if parts else {name: data}
        return columns

    def make_surface(self):
        if self.surface is None:
            self.surface = Surface(self.run.cells, self.run.degree, self.subdivisions)
            self.colour_field = choose_field(self.run, self.fields[0] if self.fields else None)
        return self.surface

    def surface_points(self, state, factor=1.0):
        points = self.make_surface().at(self.run.points + factor * self.warp * self.run.displacement(state))
        if not (np.abs(points) <= np.finfo(np.float32).max).all():
            raise WrongInput(f"the displaced body is not finite at {self.run.times[state]:g}, with displacements multiplied by {self.warp:g}")
        return points

    def colour_values(self, state):
        """The field at the vertices of the surface; of what is a number of something, at the corners of triangles."""
        surface, values = self.make_surface(), self.colour_field.values(self.run, state)
        if self.flat():
            return np.repeat(values[surface.owners], 3)
        return surface.at(mean_of_cells(self.run, values) if self.colour_field.of_cells else values)

    def flat(self):
        return self.colour_field.is_number_of_something()

    def colour_range(self):
        ends = [(values.min(), values.max()) for values in map(self.colour_values, self.states)]
        return min(low for low, _ in ends), max(high for _, high in ends)


def colours_of(values, limits):
    """Red, green and blue in [0, 1] as screens have them."""
    low, high = limits
    share = (values - low) / (high - low) if high > low else np.zeros(len(values))
    return matplotlib.colormaps["viridis"](np.clip(share, 0, 1))[:, :3]


def numbered(path, n):
    """Names of so many files: that of the path if it is one."""
    return [path] if n == 1 else [path.with_name(f"{path.stem}_{i:04d}{path.suffix}") for i in range(n)]


def folder_of(path):
    """Of the files of several states, beside the .pvd that refers to them: not the name of the run, whose results may be there."""
    return path.with_name(f"{path.stem}_vtu")


def write_vtu(source, path):
    """VTK's files of unstructured grids, a Lagrange tetrahedron for each cell, points at rest; of several states a .pvd that has their times."""
    n = len(source.states)
    folder = folder_of(path) if n > 1 else path.parent
    folder.mkdir(exist_ok=True)
    files = numbered(folder / f"{path.stem}.vtu", n)
    for state, time, file in zip(source.states, source.times, files):
        write_grid(source, state, time, file)
        source.advance()
    if n == 1:
        return [files[0].name]
    root = xml.Element("VTKFile", type="Collection", version="0.1", byte_order="LittleEndian")
    root.append(xml.Comment(MARK))
    collection = xml.SubElement(root, "Collection")
    for time, file in zip(source.times, files):
        xml.SubElement(collection, "DataSet", timestep=repr(float(time)), part="0", file=f"{folder.name}/{file.name}")
    write_xml(root, path.with_suffix(".pvd"))
    return [f"{folder.name}/{file.name}" for file in files] + [path.with_suffix(".pvd").name]


def write_grid(source, state, time, file):
    run = source.run
    cells = np.insert(run.cells, 0, run.cells.shape[1], axis=1).ravel()
    grid = pv.UnstructuredGrid(cells, np.full(len(run.cells), LAGRANGE_TETRAHEDRON, np.uint8), run.points)
    for names, data, read in zip(source.arrays(), (grid.GetPointData(), grid.GetCellData()), (run.point_data, run.cell_data)):
        for name in names:
            array = numpy_to_vtk(np.ascontiguousarray(read(name, state)), deep=True)
            array.SetName(name)
            data.AddArray(array)
    stamp = numpy_to_vtk(np.array([time]), deep=True)
    stamp.SetName("TimeValue")
    mark = vtkStringArray()
    mark.SetName(MARK)
    for array in (stamp, mark):
        grid.GetFieldData().AddArray(array)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(grid)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToNone()
    write_by(writer)


def write_by(writer):
    """By a writer of VTK; what it would say itself of a failure is in the error."""
    for who in (writer, writer.GetExecutive()):
        who.AddObserver("ErrorEvent", lambda *_: None)
    if writer.Write() != 1 or writer.GetErrorCode():
        is_full = writer.GetErrorCode() == vtkErrorCode.OutOfDiskSpaceError
        raise OSError(errno.ENOSPC if is_full else None, os.strerror(errno.ENOSPC) if is_full else "the file could not be written")


def write_xml(root, path):
    xml.indent(root)
    xml.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def write_stl(source, path):
    """The displaced surface as triangles, binary, single precision."""
    files = numbered(path, len(source.states))
    for state, file in zip(source.states, files):
        points = source.surface_points(state)
        writer = vtkSTLWriter()
        writer.SetFileName(str(file))
        writer.SetInputData(pv.PolyData(points.astype(np.float32), np.insert(source.surface.simplices, 0, 3, axis=1).ravel()))
        writer.SetFileTypeToBinary()
        header = numpy_to_vtk(np.frombuffer(MARK.encode().ljust(80), np.uint8), deep=True)
        writer.SetBinaryHeader(header)
        write_by(writer)
        source.advance()
    return [file.name for file in files]


def write_obj(source, path):
    """The displaced surface as text; with a field the vertices have colours, as many programs read them."""
    files = numbered(path, len(source.states))
    triangles = source.make_surface().simplices
    coloured = bool(source.fields)
    limits = source.colour_range() if coloured else None
    # Where colours jump, each triangle has vertices of its own.
    vertices = triangles.ravel() if coloured and source.flat() else np.arange(triangles.max() + 1)
    faces = np.arange(len(vertices)).reshape(-1, 3) if coloured and source.flat() else triangles
    for state, file in zip(source.states, files):
        rows = source.surface_points(state)[vertices]
        if coloured:
            rows = np.hstack([rows, colours_of(source.colour_values(state), limits)])
        with open(file, "w", encoding="ascii") as out:
            out.write(f"# {MARK}\n")
            np.savetxt(out, rows, fmt="v" + " %.9g" * rows.shape[1])
            np.savetxt(out, faces + 1, fmt="f %d %d %d")
        source.advance()
    return [file.name for file in files]


def write_csv(source, path):
    """A row for each node: its place at rest and all data there, with all digits."""
    files = numbered(path, len(source.states))
    points = source.run.points
    for state, file in zip(source.states, files):
        columns = source.point_table(state)
        table = np.column_stack([np.arange(len(points)), points, *columns.values()])
        np.savetxt(file, table, fmt=["%d"] + ["%.17g"] * (table.shape[1] - 1), delimiter=",", header=FIRST_COLUMNS + ",".join(columns), comments="")
        source.advance()
    return [file.name for file in files]


class FileOfHdf5(io.FileIO):
    """What HDF5 writes to. It crashes where it cannot: so the first error is kept, and raised at the end."""

    error = None

    def write(self, data):
        try:
            done = 0
            while done < len(data):
                done += super().write(memoryview(data)[done:])
        except OSError as error:
            self.error = self.error or error
        return len(data)

    def close(self):
        super().close()
        error, self.error = self.error, None
        if error:
            raise error


def write_xdmf(source, path):
    """XDMF 3 with its numbers in an HDF5 file beside. Tensors are scalars, component by component. Cells of degree 3, which the format has
    not, are 27 straight ones on the same nodes."""
    run = source.run
    heavy = path.with_suffix(".h5")
    pieces = inside(run.cells, 3, 3) if run.degree == 3 else None
    # Vertices of the pieces are nodes: which ones, their shape functions tell.
    cells = run.cells if pieces is None else pieces.nodes[pieces.piece, pieces.shapes[pieces.place].argmax(axis=1)][pieces.simplices]
    owners = np.arange(len(run.cells)) if pieces is None else pieces.owners
    root = xml.Element("Xdmf", Version="3.0")
    root.append(xml.Comment(MARK))
    domain = xml.SubElement(root, "Domain")
    series = xml.SubElement(domain, "Grid", Name="states", GridType="Collection", CollectionType="Temporal")
    with FileOfHdf5(heavy, "w+") as place, h5py.File(place, "w") as file:
        file.attrs["maker"] = MARK
        item(file, None, "mesh/cells", cells, heavy.name)
        item(file, None, "mesh/points", run.points, heavy.name)
        for i, (state, time) in enumerate(zip(source.states, source.times)):
            grid = xml.SubElement(series, "Grid", Name="body", GridType="Uniform")
            xml.SubElement(grid, "Time", Value=repr(float(time)))
            topology = xml.SubElement(grid, "Topology", TopologyType="Tetrahedron_10" if run.degree == 2 else "Tetrahedron", NumberOfElements=str(len(cells)),
                                      NodesPerElement=str(cells.shape[1]))
            item(file, topology, "mesh/cells", None, heavy.name)
            item(file, xml.SubElement(grid, "Geometry", GeometryType="XYZ"), "mesh/points", None, heavy.name)
            add_attributes(source, state, f"states/{i:04d}", file, grid, owners, heavy.name)
            source.advance()
    write_xml(root, path)
    return [heavy.name, path.name]


def add_attributes(source, state, place, file, grid, owners, heavy):
    at_nodes, of_cells = source.arrays()
    vectors = [name for name in at_nodes if name in ("displacement", "velocity")]
    for name in vectors:
        attribute = xml.SubElement(grid, "Attribute", Name=name, AttributeType="Vector", Center="Node")
        item(file, attribute, f"{place}/{name}", source.run.point_data(name, state), heavy)
    scalars = {name: values for name, values in source.point_table(state).items() if name.rsplit("_", 1)[0] not in vectors}
    for name, values in scalars.items():
        attribute = xml.SubElement(grid, "Attribute", Name=name, AttributeType="Scalar", Center="Node")
        item(file, attribute, f"{place}/{name}", values, heavy)
    for name in of_cells:
        shown = f"cells_{name}" if name in at_nodes else name
        attribute = xml.SubElement(grid, "Attribute", Name=shown, AttributeType="Scalar", Center="Cell")
        item(file, attribute, f"{place}/{shown}", source.run.cell_data(name, state)[owners], heavy)


def item(file, parent, name, data, heavy):
    """Writes data, if any, and refers to what is there by that name."""
    if data is not None:
        file[name] = data
    if parent is None:
        return
    stored = file[name]
    kind = "Int" if stored.dtype.kind == "i" else "Float"
    xml.SubElement(parent, "DataItem", Format="HDF", NumberType=kind, Precision=str(stored.dtype.itemsize),
                   Dimensions=" ".join(map(str, stored.shape))).text = f"{heavy}:/{name}"
