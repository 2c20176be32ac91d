# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Rows of wrong_inputs.py: wrong files, and the messages of the command line
about them."""

from wrong_input_rows import SMALL, Row, parameter_file, wrong

# The corners of the first tetrahedron of a unit cube, and one more.
NODES = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1))
TETRAHEDRON, TRIANGLE = 4, 2


def mesh(elements, nodes=NODES, groups=(), version="2.2"):
    """The text of a .msh file of version 2.2: elements are (type, physical
    group, surface or volume, node, node, ...), groups (dimension, id, name)."""
    lines = ["$MeshFormat", f"{version} 0 8", "$EndMeshFormat"]
    if groups:
        lines += ["$PhysicalNames", str(len(groups)), *(f'{dimension} {number} "{name}"' for dimension, number, name in groups), "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(nodes)), *(f"{i} {' '.join(map(str, x))}" for i, x in enumerate(nodes, 1)), "$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{i} {kind} 2 {group} {part} {' '.join(map(str, of))}" for i, (kind, group, part, *of) in enumerate(elements, 1)]
    return "\n".join([*lines, "$EndElements"]) + "\n"


GOOD = (TETRAHEDRON, 1, 1, 1, 2, 3, 4)
GOOD_MESH = mesh([GOOD])
GEO = 'SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 1, 1, 1};\n'


def mesh_row(name, content, *parts, settings=(), file="x.msh", place="x.msh: ", **others):
    text, _ = parameter_file(["Mesh/Type = gmsh", f"Mesh/gmsh/File = {file}", *settings])
    files = {"case.prm": text}
    if content is not None:
        files[file] = content
    return Row(name, list(parts), place, ["case.prm", "--quiet", "--output", "results", "--validate"], files, **others)


def mesh_rows():
    third = NODES[:4] + ((0.25, 0.25, 0.0),)
    for name, content, *parts in (
            ("inverted cell", mesh([(4, 1, 1, 1, 3, 2, 4)]), "no positive volume", "(inverted)"),
            ("flat cell", mesh([(4, 1, 1, 1, 2, 3, 5)], third), "a flat one"),
            ("cell with a corner twice", mesh([(4, 1, 1, 1, 2, 3, 3)]), "a flat one"),
            ("two cells at one place", mesh([GOOD, GOOD]), "cells overlap", "2 cells on the same side"),
            ("three cells at a face", mesh([GOOD, (4, 1, 1, 2, 3, 4, 5), (4, 1, 1, 2, 3, 4, 6)], (*NODES, (2, 2, 2))), "cells overlap", "3 cells"),
            ("no cells", mesh([(2, 1, 1, 1, 2, 3)]), "no tetrahedra"),
            ("nothing in it", mesh([], ()), "x.msh"),
            ("missing node", mesh([(4, 1, 1, 1, 2, 3, 9)]), "x.msh"),
            ("infinite node", mesh([GOOD], (*NODES[:3], ("inf", 0, 0))), "finite"),
            ("node that is not a number", mesh([GOOD], (*NODES[:3], ("nan", 0, 0))), "finite"),
            ("hanging node", mesh([GOOD, (4, 1, 1, 5, 7, 6, 8)], (*NODES[:4], (0.25, 0.25, 0), (1, 0, -1), (0, 1, -1), (0, 0, -1))), "hanging node"),
            ("duplicate nodes", mesh([GOOD, (4, 1, 1, 5, 7, 6, 8)], (*NODES[:4], (1, 0, 0), (0, 0, 1), (0, 1, 0), (1, 1, 1))), "duplicate nodes"),
            ("pyramid", mesh([(7, 1, 1, 1, 2, 3, 4, 5)]), "cells other than tetrahedra", "'Pyramid 5'"),
            ("triangle beside the body", mesh([GOOD, (2, 2, 1, 1, 2, 5)]), "which is no face of a cell"),
            ("empty file", "", "must start with"), ("text", "tetrahedra, please\n", "must start with"),
            ("bytes", bytes(range(256)) * 20, "must start with"), ("unknown version", mesh([GOOD], version="7.3"), "x.msh"),
            ("cut off", GOOD_MESH[:GOOD_MESH.index("$EndElements") - 8], "$EndElements"), ("no elements", GOOD_MESH.split("$Elements")[0], "$Elements"),
            ("numbers of words", GOOD_MESH.replace("1 0 0\n", "one 0 0\n"), "x.msh"),
            ("more elements than said", GOOD_MESH.replace("$Elements\n1", "$Elements\n1000000000"), "x.msh"),
            ("fewer nodes than said", GOOD_MESH.replace("$Nodes\n5", "$Nodes\n500000000"), "x.msh")):
        yield mesh_row(f"mesh: {name}", content, *parts, place="x.msh")
    for name, line, *parts in (("command", 'SystemCall "true";', "'SystemCall', which runs a command"), ("writes", 'Save "y.msh";', "'Save'"),
                               ("reads outside", 'Include "/etc/passwd";', "outside of the folder"), ("ends gmsh", "Exit;", "ends gmsh"),
                               ("syntax", "Box(2) = {0, 0,", "gmsh"), ("unknown name", "Box(2) = {a, 0, 0, 1, 1, 1};", "gmsh")):
        yield mesh_row(f"geometry: {name}", GEO + line + "\n", *parts, file="x.geo", place="x.geo:3: ")
    yield mesh_row("geometry without volume", "Point(1) = {0, 0, 0};\n", "no tetrahedra", file="x.geo", place="x.geo: ")
    yield mesh_row("geometry without end", "For i In {1:1000000000}\nx = i;\nEndFor\n", "1 s", settings=("Mesh/gmsh/Time limit = 1",), file="x.geo",
                   place="case.prm:")
    at_file, option = "case.prm:6: Mesh/gmsh/File: ", "case.prm:11: Mesh/gmsh/"
    yield mesh_row("mesh that is not there", None, "there is no mesh file: found 'x.msh'", place=at_file)
    yield mesh_row("mesh with a long name", None, "File name too long", "(304 characters)", file=300 * "x" + ".msh", place=at_file)
    yield mesh_row("mesh in a file", None, "case.prm/x.msh: Not a directory", file="case.prm/x.msh", place=at_file)
    yield mesh_row("mesh of another kind", "a picture\n", "allowed are .msh, .geo, ", file="x.png", place=at_file)
    yield mesh_row("surface cut off", "solid\n", "ends before 'endsolid'", file="x.stl", place="x.stl: ")
    yield mesh_row("mesh that is a folder", None, "there is no mesh file", file=".", place=at_file)
    yield mesh_row("mesh without name", None, "found an empty name", file="", place=at_file)
    yield mesh_row("element size of a mesh", GOOD_MESH, "only a geometry", settings=("Mesh/gmsh/Element size = 1",), place=option + "Element size: ")
    yield mesh_row("degree of a mesh", GOOD_MESH, "a mesh has the degree of its cells", settings=("Mesh/gmsh/Geometry degree = 2",),
                   place=option + "Geometry degree: ")
    nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n"
    for name, content, line, *parts in (
            ("no tetrahedra", nodes, "", "the mesh has no tetrahedra"), ("no number", "*NODE\n1,0,x,0\n", "2: ", "found 'x'"),
            ("hexahedra", nodes + "*ELEMENT,TYPE=C3D8\n1,1,2,3,4,1,2,3,4\n", "", "1 of the type 'C3D8'"),
            ("unknown node", nodes + "*ELEMENT,TYPE=C3D4\n1,1,2,3,5\n", "7: ", "there is no node 5"),
            ("cut off", nodes + "*ELEMENT,TYPE=C3D4\n1,1,2,\n", "6: ", "too few nodes: found 2; needed are 4"),
            ("reads outside", "*INCLUDE, INPUT=/etc/passwd\n", "1: ", "outside of the folder"),
            ("includes itself", "*INCLUDE, INPUT=x.inp\n", "1: ", "include each other"),
            ("inverted", nodes + "*ELEMENT,TYPE=C3D4\n1,1,3,2,4\n", "", "cell")):
        yield mesh_row(f"Abaqus: {name}", content, *parts, file="x.inp", place=f"x.inp:{line}" if line else "x.inp: ")
    yield mesh_row("STEP of nothing", "ISO-10303-21;\nHEADER;\n", "gmsh", file="x.step", place="x.step: ")
    # A body of two parts, one of which is not held.
    apart = mesh([GOOD, (4, 2, 2, 5, 6, 7, 8), (2, 3, 1, 1, 2, 3)], (*NODES[:4], (5, 0, 0), (6, 0, 0), (5, 1, 0), (5, 0, 1)),
                 groups=((3, 1, "held"), (3, 2, "loose"), (2, 3, "base")))
    yield mesh_row("statics of two bodies", apart, "the part at (5.25, 0.25, 0.25) of region 'loose' can move in any direction",
                   settings=("Time integration/Type = static", "Discretization/Degree = 1", "Boundary conditions/Fixed = base"), place="case.prm:")
    yield mesh_row("line beside the body", mesh([GOOD, (1, 5, 1, 1, 5), (2, 3, 1, 1, 2, 3)], groups=((1, 5, "wire"), (2, 3, "base"))),
                   "no such boundary: found 'wire'; the mesh has the boundaries: base", settings=("Boundary conditions/Fixed = wire",), place="case.prm:")
    yield mesh_row("names with control characters", apart.replace("base", "a\x1b[2J\x07b"), "\\x1b[2J\\x07b", settings=("Boundary conditions/Fixed = base",),
                   place="case.prm:")
    for name, settings, *parts in (
            ("too many cells", "Mesh/box/Cells = 100000, 100000, 100000", "5e+15 tetrahedra", "3e+15 unknowns", "at most 1e8"),
            ("too many refinements", ("Mesh/box/Cells = 10, 10, 10", "Mesh/Refinements = 9"), "too many cells", "9 refinements"),
            ("no digits left", "Mesh/box/Origin = 1e17, 0, 0", "round-off of coordinates", "1e+17 m"),
            ("as thin as nothing", "Mesh/box/Size = 1e30, 1, 1e-30", "round-off of coordinates")):
        blames_origin = name == "as thin as nothing"
        row = wrong(f"box: {name}", settings, *(parts if not blames_origin else ()), blamed=None if blames_origin else -1)
        if blames_origin:
            row.place, row.parts = "case.prm: Mesh/box/Origin: " if "--set" not in row.arguments else "case.prm: Mesh/box/Origin: ", parts
        yield row


def table_rows():
    for name, content, *parts in (
            ("missing", None, "there is no table file"), ("empty", "", "at least 2 rows: found 0"), ("one row", "0, 1\n", "at least 2 rows: found 1"),
            ("three columns", "0, 1, 2\n", "found 3 columns"), ("one column", "0\n1\n", "found 1 columns"), ("decimal commas", "0,5; 1\n1,5; 2\n", "'0,5'"),
            ("not a number", "0, 1\n1, nan\n", "'nan'"), ("infinite", "0, 1\n1, inf\n", "'inf'"), ("decreases", "1, 1\n0, 1\n", "found 0 after 1"),
            ("stands still", "1, 1\n1, 2\n", "found 1 after 1"), ("far too long", "0, " + 5000 * "x" + "\n1, 2\n", "a table"), ("bytes", bytes(range(1, 256)), "\\x0e\\x0f")):
        row = wrong(f"table: {name}", "Tables/Linear = f: f.csv", *parts, files={} if content is None else {"f.csv": content})
        if content is not None:
            row.place, row.parts = "f.csv", parts
        yield row
    good = {"f.csv": "0, 1\n1, 2\n"}
    for name, value, *parts in (("taken", "sin: f.csv", "'sin'"), ("no name", "1f: f.csv", "no digit first"), ("twice", "f: f.csv, f: f.csv", "two tables"),
                                ("folder", "f: .", "there is no table file")):
        yield wrong(f"table: name {name}", f"Tables/Cubic = {value}", *parts, files=good)
    yield wrong("table: linear and cubic", ("Tables/Linear = f: f.csv", "Tables/Cubic = f: f.csv"), "two tables", files=good)
    yield wrong("table: unknown in a formula", ("Tables/Linear = f: f.csv", "Loads/Gravity = 0; 0; g(t)"), 'unknown name "g"', files=good)


def text_row(name, place, *parts, content=None, file="case.prm", more=None, arguments=(), **others):
    files = {**({} if content is None else {file: content}), **(more or {})}
    return Row(name, list(parts), place, [file, "--quiet", "--output", "results", "--validate", *arguments], files, **others)


def parameter_file_rows():
    for name, content, place, *parts in (
            ("entry misspelt", "subsection Loads\nset Gravty = 0; 0; 1\nend\n", "2: ", 'did you mean "Gravity"?'),
            ("entry of another section", "subsection Loads\nset Degree = 1\nend\n", "2: ", 'it belongs to "Discretization"'),
            ("section misspelt", "\n\nsubsection Lods\nend\n", "3: ", 'did you mean "Loads"?'),
            ("section as entry", "set Loads = 1\n", "1: ", '"Loads" is a subsection'), ("entry as section", "subsection Type\nend\n", "1: ", '"Type" is an entry'),
            ("no end", "subsection Loads\n", "1: ", 'an "end" is missing'), ("end too many", "end\n", "1: ", "no subsection to leave"),
            ("end with more", "subsection Loads\nend Loads\n", "2: ", "nothing may follow"), ("no name", "subsection\nend\n", "1: ", "without a name"),
            ("no statement", "gravity is 9.81\n", "1: ", "is no statement"), ("no value", "set Type\n", "1: ", "set Entry = value"),
            ("set nothing", "set = 1\n", "1: ", "set Entry = value"), ("set twice", "set Type = modes\n\nset Type = simulation\n", "3: ", "set twice, first in line 1"),
            ("include missing", "include other.prm\n", "1: ", "does not exist"), ("include itself", "include case.prm\n", "1: ", "more than 10 deep"),
            ("include a folder", "include .\n", "1: ", "is a folder"), ("include nothing", "include\n", "1: ", "does not exist"),
            ("deep", "".join(f"subsection s{i}\n" for i in range(1000)), "21: ", "nested too deeply"), ("bytes", bytes(range(128, 256)) * 100, "1: ", "no statement"),
            ("far too long", "set Type = " + 100000 * "x", "1: ", "(100000 characters)"), ("long name", "set " + 5000 * "x" + " = 1\n", "1: ", "(5000 characters)"),
            ("long line", 5000 * "x" + "\n", "1: ", "(5000 characters)"), ("control characters", "set Ty\x1b[31mpe\x07\x7f = 1\n", "1: ", "\\x1b[31mpe\\x07\\x7f"),
            ("control characters of two bytes", "set Ty\u009bpe = 1\n", "1: ", "Ty\\x9bpe"), ("value not in UTF-8", b"subsection Output\nset Directory = \xff\nend\n", "2: ", "UTF-8"),
            ("zero bytes", b"set Type\0 = modes\n", "1: ", "it has a zero byte")):
        yield text_row(f"prm: {name}", f"case.prm:{place}", *parts, content=content)
    for name, content, place, *parts in (
            ("no JSON", '{"Type": }', ":1: ", "no valid JSON"), ("cut off", '{"Type": "modes"', ":1: ", "no valid JSON"), ("empty", "", ":1: ", "no valid JSON"),
            ("list", '["Type"]', ": ", "one JSON object"), ("list as value", '{"Type": ["modes"]}', ":1: ", "is a list"), ("null", '{"Type": null}', ":1: ", "is null"),
            ("misspelt", '{"Tipe": "modes"}', ":1: ", 'did you mean "Type"?'), ("twice", '{"Type": "modes", "Type": "modes"}', ":1: ", '"Type" is set twice'),
            ("section twice", '{"Loads": {}, "Loads": {}}', ":1: ", '"Loads" is set twice'), ("deep", 1000 * '{"a":' + "1" + 1000 * "}", ": ", "nested too deeply"),
            ("line break in a name", '{"Ty\\npe": "modes"}', ":1: ", "Ty\\x0ape"), ("line break in a value", '{"Type": "mo\\ndes"}', ":1: ", "line break"),
            ("zero byte in a name", '{"Type\\u0000": "modes"}', ":1: ", "zero byte"), ("zero byte in a value", '{"Type": "modes\\u0000"}', ":1: ", "zero byte"),
            ("far too long", '{"Type": "' + 5000 * "x" + '"}', ":1: ", "(5000 characters)"), ("not in UTF-8", b'{"Type": "\xff"}', ":1: ", "no valid JSON")):
        yield text_row(f"json: {name}", "case.json" + place, *parts, content=content, file="case.json")
    head = '<?xml version="1.0"?>\n'
    for name, content, place, *parts in (
            ("no XML", "Type = modes", ":", "XML"), ("cut off", head + "<ParameterHandler><Type>", ":", "no valid XML"),
            ("another root", head + "<Parameters/>", ": ", "called ParameterHandler"), ("entities", '<!DOCTYPE a [<!ENTITY b "c">]>', ": ", "document type"),
            ("twice", head + "<ParameterHandler><Type>modes</Type><Type>modes</Type></ParameterHandler>", ":2: ", '"Type" is set twice'),
            ("misspelt", head + "<ParameterHandler><Tipe><value>1</value></Tipe></ParameterHandler>", ":2: ", 'did you mean "Type"?'),
            ("deep", 1000 * "<a>" + 1000 * "</a>", ": ", "nested too deeply")):
        yield text_row(f"xml: {name}", "case.xml" + place, *parts, content=content, file="case.xml")
    for name, file, content, *parts in (("missing", "none.prm", None, "no such file"), ("another kind", "case.txt", "", ".prm, .json and .xml"),
                                        ("no ending", "case", "", ".prm, .json and .xml"), ("long name", 300 * "x" + ".prm", None, "File name too long")):
        yield text_row(f"parameter file: {name}", (file if len(file) < 80 else file[:80]), *parts, content=content, file=file)
    yield text_row("parameter file: a folder", "case.prm", "cannot be read as a file", more={"case.prm/x": ""})


def command_line_rows():
    text = parameter_file(SMALL)[0]
    for number, (name, arguments, *parts) in enumerate((
            ("override without value", ("--set", "Type"), "--set: ", "not of the form"), ("override without name", ("--set", "= 1"), "--set: ", "not of the form"),
            ("override of nothing", ("--set", ""), "--set: ", "not of the form"), ("override far too long", ("--set", 5000 * "x"), "--set: ", "(5000 characters)"),
            ("override misspelt", ("--set", "Tipe = modes"), "--set: ", 'did you mean "Type"?'), ("override of a section", ("--set", "Loads = 1"), "--set: ", "is a subsection"),
            ("override in no section", ("--set", "Load/Gravity = 1"), "--set: ", 'did you mean "Loads"?'),
            ("override with a line break", ("--set", "Output/Directory = a\nb"), "--set: ", "line break"),
            ("override with a comment", ("--set", "Output/Directory = a#b"), "--set: ", "has a #"),
            ("override in the entry", ("--set", "Type/Type = modes"), "--set: ", "is an entry"),
            ("unknown option", ("--validat",), "command line: ", 'did you mean "--validate"?'), ("option without value", ("--set",), "command line: ", "--set"),
            ("unknown short option", ("-x",), "command line: ", '"-x"'), ("two files", ("case.prm",), "command line: ", "one file"),
            ("control characters", ("--\x1b[2J",), "command line: ", "\\x1b[2J"))):
        yield Row(f"command line: {name}", list(parts[1:]), parts[0], ["case.prm", "--quiet", "--output", "results", "--validate", *arguments], {"case.prm": text})
    yield Row("command line: no file", ["a parameter file is needed"], "command line: ", ["--validate"], {})
    yield Row("command line: style", ["prm, json, markdown, schema"], "command line: ", ["--print-parameters", "yaml"], {})


def output_rows():
    text = parameter_file(SMALL)[0]
    for name, directory, more, status, *parts in (
            ("not empty", "results", {"results/letter.txt": ""}, 1, "is not empty"), ("a file", "results", {"results": ""}, 1, "is a file"),
            ("below a file", "letter/results", {"letter": ""}, 1, "letter"), ("long name", 300 * "y", {}, 1, "(300 characters)", "File name too long"),
            ("no place for files", "/proc/corotet", {}, 3, "'/proc'")):
        for validate in ((), ("--validate",)):
            yield Row(f"output: {name} {' '.join(validate)}", list(parts), "--output: Output/Directory: " if status == 1 else "the output directory ",
                      ["case.prm", "--quiet", "--output", directory, *validate], {"case.prm": text, **more}, status)
    yield Row("output: overwrite what is no result", ["holds no results of corotet"], "--output: Output/Directory: ",
              ["case.prm", "--quiet", "--output", "results", "--set", "Output/Overwrite = true"], {"case.prm": text, "results/letter.txt": ""})
    # The second case makes its mesh until it runs out of memory: the limit is
    # low, so that this takes far less than the two seconds.
    for name, memory, cells, *parts in (("of a box", 2**30, "2000, 100, 90", "2000 x 100 x 90 cuboids would need at least", "found are 1.07 GB"),
                                        ("that runs out", 3 * 2**28, "100, 50, 50", "this process has", "may have no more than 0.805 GB")):
        row = wrong(f"memory {name}", ("Discretization/Degree = 1", f"Mesh/box/Cells = {cells}"), status=3, memory=memory)
        row.place, row.parts = "memory is too short: ", parts
        yield row


def file_rows():
    for rows in (mesh_rows, table_rows, parameter_file_rows, command_line_rows, output_rows):
        yield from rows()
