// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/vector_at.h>
#include <corotet/forces/nearby_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Points of a face of any degree are less than this many times as far from
    // its first node as the farthest node.
    constexpr double reach_of_face = 3;
  } // namespace

  NearbyFaces::NearbyFaces(const ContactSurface &surface,
                           const Obstacle       &obstacle)
    : surface(surface)
    , obstacle(obstacle)
    , last_u(surface.nodes.size())
    , slacks(surface.faces.size())
  {
    for (const ContactSurface::Face &face : surface.faces)
      least_skin += 0.1 * face.size / surface.faces.size();
  }

  double
  NearbyFaces::motion_since(const Vector &u, const Tensor<1, 3> &moved) const
  {
    // Also after values that are not numbers, as rejected steps may have them,
    // there is another search.
    double square = 0;
    for (std::size_t i = 0; i < last_u.size(); ++i)
      {
        const double of_node =
          (vector_at(u, surface.nodes[i]) - last_u[i]).norm_square();
        if (of_node > square || std::isnan(of_node))
          square = of_node;
      }
    return std::sqrt(square) + (moved - last_moved).norm();
  }

  double
  NearbyFaces::slack(const std::size_t   face,
                     const Vector       &u,
                     const Tensor<1, 3> &moved) const
  {
    const unsigned int *face_nodes = surface.nodes_of(face);
    const auto          place      = [&](const unsigned int k) {
      return surface.discretization.node_position(face_nodes[k]) +
             vector_at(u, face_nodes[k]);
    };
    const Point<3> first  = place(0);
    double         square = 0;
    for (unsigned int k = 1; k < surface.nodes_per_face(); ++k)
      {
        const double of_node = (place(k) - first).norm_square();
        if (of_node > square || std::isnan(of_node))
          square = of_node;
      }
    // When nodes move by d, the face comes nearer by d and grows by 2 d.
    return (obstacle.gap(first - moved).distance -
            reach_of_face * std::sqrt(square)) /
           (1 + 2 * reach_of_face);
  }

  void
  NearbyFaces::search(const Vector &u, const Tensor<1, 3> &moved)
  {
    for (std::size_t i = 0; i < last_u.size(); ++i)
      last_u[i] = vector_at(u, surface.nodes[i]);
    last_moved   = moved;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < slacks.size(); ++f)
      {
        slacks[f] = slack(f, u, moved);
        least     = std::min(least, slacks[f]);
      }
    skin = std::max(least_skin, least);
    list.clear();
    for (std::size_t f = 0; f < slacks.size(); ++f)
      if (!(slacks[f] >= skin))
        list.push_back(f);
  }

  const std::vector<unsigned int> &
  NearbyFaces::find(const Vector &u, const Tensor<1, 3> &moved)
  {
    if (!(motion_since(u, moved) < skin))
      search(u, moved);
    return list;
  }
} // namespace corotet
