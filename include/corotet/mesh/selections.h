// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_selections_h
#define corotet_mesh_selections_h

#include <corotet/base/log.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace corotet
{
  struct LocalMesh;
  struct UsedNames;

  /**
   * The parameters of section Selections, as text: lists "name: selection".
   *
   * A selection combines shapes by "and", "or", "not" and parentheses:
   * - box x y z x y z: between two corners [m],
   * - sphere x y z r: around a point [m],
   * - cylinder x y z x y z r: around the axis between two points [m],
   * - plane x y z nx ny nz: through a point, with a normal,
   * - normal nx ny nz [angle]: where the outer normal has this direction,
   *   within an angle [degree],
   * - patch x y z [angle]: the smooth patch of the surface that is nearest to a
   *   point, up to edges where normals differ by more than an angle [degree],
   * - sharp [angle]: edges between faces whose normals differ by more than an
   *   angle [degree],
   * - a name of the mesh.
   *
   * A face or an edge of the surface is inside of a shape if all its corners
   * are, a cell if its centre is, all within a millionth of the body's
   * diagonal. Edges and vertices have the normals, patches and boundaries of
   * the faces that they belong to; vertices inside of the body have none of
   * these.
   */
  struct SelectionParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    bool
    are_given() const
    {
      return !(boundaries.empty() && regions.empty() && edges.empty() &&
               corners.empty());
    }

    std::string boundaries;
    std::string regions;
    std::string edges;
    std::string corners;
  };

  /**
   * Gives names to the selected parts of a mesh, in addition to existing names,
   * and logs the size of these parts. Throws InputError if a text is not a
   * selection, or if nothing is selected, then with the distance of the nearest
   * part. Collective.
   */
  void
  select(LocalMesh                 &mesh,
         UsedNames                 &names,
         const SelectionParameters &parameters,
         Log                       &log);
} // namespace corotet

#endif
