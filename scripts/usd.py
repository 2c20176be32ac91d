# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes the displaced surface as USD, with points and colours for each time. Needs Pixar's Python package pxr."""

from commands import MARK
from exports import colours_of

CODES_PER_SECOND = 24


def write_usd(source, path, seconds=None):
    from pxr import Gf, Usd, UsdGeom, Vt

    stage = Usd.Stage.CreateNew(str(path))
    stage.GetRootLayer().comment = MARK
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetTimeCodesPerSecond(CODES_PER_SECOND)
    mesh = UsdGeom.Mesh.Define(stage, "/body")
    stage.SetDefaultPrim(mesh.GetPrim())
    triangles = source.make_surface().simplices
    mesh.CreateFaceVertexCountsAttr([3] * len(triangles))
    mesh.CreateFaceVertexIndicesAttr(triangles.ravel().tolist())
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    points, extent = mesh.CreatePointsAttr(), mesh.CreateExtentAttr()
    colours = mesh.CreateDisplayColorPrimvar(UsdGeom.Tokens.faceVarying if source.flat() else UsdGeom.Tokens.vertex)
    limits = source.colour_range()
    first, last = source.times[0], source.times[-1]
    stretch = seconds / (last - first) if seconds and last > first else 1.0
    codes = [CODES_PER_SECOND * stretch * float(time) for time in source.times]
    stage.SetStartTimeCode(codes[0])
    stage.SetEndTimeCode(codes[-1])
    for state, code in zip(source.states, codes):
        places = source.surface_points(state)
        points.Set(Vt.Vec3fArray([Gf.Vec3f(*map(float, place)) for place in places]), code)
        extent.Set(Vt.Vec3fArray([Gf.Vec3f(*map(float, places.min(axis=0))), Gf.Vec3f(*map(float, places.max(axis=0)))]), code)
        colours.Set(Vt.Vec3fArray([Gf.Vec3f(*map(float, colour)) for colour in colours_of(source.colour_values(state), limits)]), code)
        source.advance()
    stage.GetRootLayer().Save()
    return [path.name]
