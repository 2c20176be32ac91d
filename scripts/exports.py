# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes states of a run as files for other programs. A writer gets a Source and a path in a temporary folder. It returns the names of the files that it
has written there; a file that refers to the others comes last. Needs VTK, h5py and NumPy, but not PyVista, whose import takes a second."""

import errno
import io
import os
import xml.etree.ElementTree as xml

import h5py
import matplotlib
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkCommonMisc import vtkErrorCode
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from commands import FIRST_COLUMNS, MARK, WrongInput
from fields import choose_arrays, choose_field, components, limits_of, mean_of_cells
from lagrange import Surface, inside

LAGRANGE_TETRAHEDRON = 71


class Source:
    """The data to export: states of a run, the wanted arrays, and the displaced surface coloured by a field."""

    def __init__(self, run, states, fields, warp, subdivisions):
        self.run, self.states, self.warp = run, states, warp
        self.times = run.times[states]
        self.fields = fields
        self.subdivisions = subdivisions or run.degree
        self.surface = None
        self.advance = lambda: None

    def arrays(self):
        """Two lists: names of the wanted arrays at nodes, and of those of cells."""
        return choose_arrays(self.run, self.fields)

    def point_table(self, state):
        """All wanted data at nodes in a state, as {name: column}; vectors and tensors have a column for each component."""
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
        """Values of the field at the vertices of the surface. A field of numbers of regions or ranks is not interpolated: it has a value for each
        corner of each triangle."""
        surface, values = self.make_surface(), self.colour_field.values(self.run, state)
        if self.flat():
            return np.repeat(values[surface.owners], 3)
        return surface.at(mean_of_cells(self.run, values) if self.colour_field.of_cells else values)

    def flat(self):
        return self.colour_field.is_number_of_something()

    def colour_range(self):
        return limits_of(self.colour_field.name, map(self.colour_values, self.states))


def colours_of(values, limits):
    """The colours of values between the limits: red, green and blue in [0, 1], as sent to screens (not linear in intensity)."""
    low, high = limits
    share = (values - low) / (high - low) if high > low else np.zeros(len(values))
    return matplotlib.colormaps["viridis"](np.clip(share, 0, 1))[:, :3]


def numbered(path, n):
    """Paths of n files: the path itself if n is 1, else the path with a number before its suffix."""
    return [path] if n == 1 else [path.with_name(f"{path.stem}_{i:04d}{path.suffix}") for i in range(n)]


def folder_of(path):
    """The folder for the .vtu files of several states, beside the .pvd that refers to them. Its name ends with _vtu, since a folder with the name of
    the run, and with its results, may be in the same place."""
    return path.with_name(f"{path.stem}_vtu")


def vtk_points(points):
    result = vtkPoints()
    result.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    return result


def vtk_cells(cells):
    """Cells with equally many nodes each, a row for each cell."""
    result = vtkCellArray()
    result.SetData(numpy_to_vtkIdTypeArray(np.arange(0, cells.size + 1, cells.shape[1]), deep=True),
                   numpy_to_vtkIdTypeArray(cells.ravel().astype(np.int64), deep=True))
    return result


def vtk_triangles(points, triangles):
    result = vtkPolyData()
    result.SetPoints(vtk_points(points))
    result.SetPolys(vtk_cells(triangles))
    return result


def write_vtu(source, path):
    """Writes VTK's files of unstructured grids, with a Lagrange tetrahedron for each cell and points at rest. Several states get a file each, and a .pvd
    with their times."""
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
    grid = vtkUnstructuredGrid()
    grid.SetPoints(vtk_points(run.points))
    grid.SetCells(LAGRANGE_TETRAHEDRON, vtk_cells(run.cells))
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
    """Writes a file by a writer of VTK. A failure raises OSError; VTK's own messages are not shown."""
    for who in (writer, writer.GetExecutive()):
        who.AddObserver("ErrorEvent", lambda *_: None)
    if writer.Write() != 1 or writer.GetErrorCode():
        is_full = writer.GetErrorCode() == vtkErrorCode.OutOfDiskSpaceError
        raise OSError(errno.ENOSPC if is_full else None, os.strerror(errno.ENOSPC) if is_full else "the file could not be written")


def write_xml(root, path):
    xml.indent(root)
    xml.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def write_stl(source, path):
    """Writes the displaced surface as triangles, binary, in single precision."""
    files = numbered(path, len(source.states))
    for state, file in zip(source.states, files):
        points = source.surface_points(state)
        writer = vtkSTLWriter()
        writer.SetFileName(str(file))
        writer.SetInputData(vtk_triangles(points.astype(np.float32), source.surface.simplices))
        writer.SetFileTypeToBinary()
        header = numpy_to_vtk(np.frombuffer(MARK.encode().ljust(80), np.uint8), deep=True)
        writer.SetBinaryHeader(header)
        write_by(writer)
        source.advance()
    return [file.name for file in files]


def write_obj(source, path):
    """Writes the displaced surface as text. With a field, the vertices have colours, in a form that many programs read."""
    files = numbered(path, len(source.states))
    triangles = source.make_surface().simplices
    coloured = bool(source.fields)
    limits = source.colour_range() if coloured else None
    # If colours jump between triangles, each triangle has vertices of its own.
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
    """Writes a row for each node: its place at rest and its data, with all digits."""
    files = numbered(path, len(source.states))
    points = source.run.points
    for state, file in zip(source.states, files):
        columns = source.point_table(state)
        table = np.column_stack([np.arange(len(points)), points, *columns.values()])
        np.savetxt(file, table, fmt=["%d"] + ["%.17g"] * (table.shape[1] - 1), delimiter=",", header=FIRST_COLUMNS + ",".join(columns), comments="")
        source.advance()
    return [file.name for file in files]


class FileOfHdf5(io.FileIO):
    """The file that HDF5 writes to. HDF5 crashes if a write fails: so write() always succeeds, and close() raises the first error."""

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
    """Writes XDMF 3, with the numbers in an HDF5 file beside it. Each component of a tensor is a scalar. The format has no cells of degree 3: each
    becomes 27 straight cells on the same nodes."""
    run = source.run
    heavy = path.with_suffix(".h5")
    pieces = inside(run.cells, 3, 3) if run.degree == 3 else None
    # Each vertex of a straight piece is a node of the cell: the one whose shape function is largest there.
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
    """Stores data, if any, under the name in the HDF5 file, and adds a reference to the data of that name to the XML element @p parent, if any."""
    if data is not None:
        file[name] = data
    if parent is None:
        return
    stored = file[name]
    kind = "Int" if stored.dtype.kind == "i" else "Float"
    xml.SubElement(parent, "DataItem", Format="HDF", NumberType=kind, Precision=str(stored.dtype.itemsize),
                   Dimensions=" ".join(map(str, stored.shape))).text = f"{heavy}:/{name}"
