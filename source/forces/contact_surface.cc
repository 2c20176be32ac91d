// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/connected_parts.h>
#include <corotet/forces/contact_surface.h>
#include <corotet/operators/elasticity.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Twice the volume over the area of the surface, for each part [m]: the
    // thickness of a plate, and a third of that of a cube.
    std::vector<double>
    thicknesses(const ForceContext &context, const ConnectedParts &parts)
    {
      const Discretization &discretization = context.discretization;
      std::vector<double>   sums(std::size_t(2) * parts.n_parts);
      for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
        sums[2 * parts.part_of_cell[c]] += discretization.geometry(c).volume;
      for (const BoundaryFace &face : discretization.boundary_faces())
        for_each_surface_point(discretization,
                               context.reference,
                               face,
                               nullptr,
                               [&](const SurfacePoint &at) {
                                 sums[2 * parts.part_of_cell[face.cell] + 1] +=
                                   at.area.norm();
                               });
      dealii::Utilities::MPI::sum(sums, discretization.communicator(), sums);
      std::vector<double> result;
      for (unsigned int part = 0; part < parts.n_parts; ++part)
        result.push_back(2 * sums[2 * part] / sums[2 * part + 1]);
      return result;
    }
  } // namespace

  ContactSurface::ContactSurface(const ForceContext           &context,
                                 const std::set<unsigned int> &touching)
    : discretization(context.discretization)
    , reference(context.reference)
    , n_points(context.reference.face_rules[0].weights.size())
  {
    const ConnectedParts      parts(discretization);
    const std::vector<double> thickness = thicknesses(context, parts);
    const auto                lists     = {&discretization.boundary_faces(),
                                           &discretization.ghost_boundary_faces()};
    std::set<unsigned int>    ids       = touching;
    if (ids.empty())
      for (const auto *list : lists)
        for (const BoundaryFace &face : *list)
          ids.insert(face.boundary);
    for (const unsigned int id : ids)
      {
        const std::size_t first = faces.size();
        for (const auto *list : lists)
          for (const BoundaryFace &face : *list)
            if (face.boundary == id)
              add(face,
                  context.elasticity,
                  thickness[parts.part_of_cell[face.cell]]);
        boundaries.push_back({id, first, faces.size() - first});
      }
    nodes = face_nodes;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }

  void
  ContactSurface::add(const BoundaryFace &face,
                      const Elasticity   &elasticity,
                      const double        thickness)
  {
    double       area = 0;
    Tensor<1, 3> normal;
    Point<3>     on_face;
    for_each_surface_point(
      discretization, reference, face, nullptr, [&](const SurfacePoint &point) {
        areas.push_back(point.area.norm());
        area += areas.back();
        normal += point.area;
        on_face = point.at_rest;
      });
    const auto nodes = discretization.cell_nodes(face.cell);
    for (const unsigned int i : reference.face_nodes[face.face])
      face_nodes.push_back(nodes[i]);
    // The highest corner is the one that is not on the face.
    double height = 0;
    for (unsigned int i = 0; i < 4; ++i)
      height =
        std::max(height,
                 (on_face - discretization.node_position(nodes[i])) * normal);
    height /= normal.norm();
    const IsotropicMaterial &material = elasticity.material(face.cell);
    const double             youngs_modulus =
      2 * material.mu * (1 + poissons_ratio(material));
    const double size = std::max(height, std::sqrt(2 * area));
    const double thin = std::min(1., 3 * thickness / size);
    faces.push_back({face.cell,
                     face.face,
                     size,
                     10 * youngs_modulus / size * thin * thin * thin});
  }

  std::pair<double, double>
  ContactSurface::range_of_stiffness() const
  {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Face &face : faces)
      {
        least = std::min(least, face.stiffness);
        most  = std::max(most, face.stiffness);
      }
    const MPI_Comm comm = discretization.communicator();
    return {dealii::Utilities::MPI::min(least, comm),
            dealii::Utilities::MPI::max(most, comm)};
  }
} // namespace corotet
