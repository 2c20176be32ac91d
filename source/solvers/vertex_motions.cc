// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/tetrahedron.h>
#include <corotet/solvers/vertex_motions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  VertexMotions::VertexMotions(const Nodes                      &quadratic,
                               const CoarserNodes               &vertices,
                               const std::vector<unsigned char> &is_prescribed)
    : quadratic(quadratic)
    , vertices(vertices)
    , is_prescribed(is_prescribed)
    , is_vertex_prescribed(vertices.marks(is_prescribed))
    , touches_prescribed(quadratic.n_local_cells())
  {
    vertices.initialize_vector(displacements);
    vertices.initialize_vector(rotations);
    for (const auto &middle : vertices.middles())
      middles.push_back({middle.fine, middle.coarse, {}});
    for (unsigned int c = 0; c < quadratic.n_local_cells(); ++c)
      for (const unsigned int node : quadratic.cell_nodes(c))
        for (unsigned int a = 0; a < 3; ++a)
          touches_prescribed[c] |= is_prescribed[3 * node + a];
    make_matrix();
  }

  void
  VertexMotions::find_places(const Discretization &discretization,
                             const Vector         &positions)
  {
    places.resize(quadratic.n_local_nodes());
    const auto at = [&](const unsigned int node) {
      dealii::Point<3> x;
      for (unsigned int a = 0; a < 3; ++a)
        x[a] = positions.local_element(3 * node + a);
      return x;
    };
    double length_of_edges = 0;
    for (unsigned int c = 0; c < quadratic.n_local_cells(); ++c)
      {
        const auto finest = discretization.cell_nodes(c);
        const auto nodes  = quadratic.cell_nodes(c);
        for (unsigned int i = 0; i < 4; ++i)
          places[nodes[i]] = at(finest[i]);
        for (unsigned int e = 0; e < 6; ++e)
          {
            const auto &a = places[nodes[tetrahedron::edges[e][0]]];
            const auto &b = places[nodes[tetrahedron::edges[e][1]]];
            auto       &x = places[nodes[4 + e]];
            if (discretization.degree() == 2)
              x = at(finest[4 + e]);
            else
              for (unsigned int i = 0; i < 3; ++i)
                x[i] =
                  (9 * (at(finest[4 + 2 * e])[i] + at(finest[5 + 2 * e])[i]) -
                   a[i] - b[i]) /
                  16;
            if (c < quadratic.n_owned_cells())
              length_of_edges += (b - a).norm();
          }
      }
    // The length is a power of two, so that it causes no round-off.
    const MPI_Comm comm = quadratic.communicator();
    const double   mean =
      dealii::Utilities::MPI::sum(length_of_edges, comm) /
      (6. * dealii::Utilities::MPI::sum(
              static_cast<double>(quadratic.n_owned_cells()), comm));
    length = mean > 0 ? std::ldexp(1., std::ilogb(mean)) : 1.;
  }

  std::array<dealii::Tensor<1, 3>, 2>
  VertexMotions::arms(const dealii::Point<3> &a,
                      const dealii::Point<3> &b,
                      const dealii::Point<3> &middle) const
  {
    const dealii::Tensor<1, 3> eighth = (b - a) / (8 * length);
    const dealii::Tensor<1, 3> half =
      ((middle - a) + (middle - b)) / (4 * length);
    return {{half + eighth, half - eighth}};
  }

  void
  VertexMotions::set_arms()
  {
    const auto place = [&](const unsigned int vertex) {
      return places[vertices.key(vertex)];
    };
    for (Middle &middle : middles)
      {
        const auto both = arms(place(middle.vertices[0]),
                               place(middle.vertices[1]),
                               places[middle.node]);
        for (unsigned int end = 0; end < 2; ++end)
          for (unsigned int a = 0; a < 3; ++a)
            middle.arms[end][a] = both[end][a];
      }
    problem.frames.resize(vertices.n_owned_nodes());
    for (unsigned int v = 0; v < problem.frames.size(); ++v)
      {
        PointFrame<6> &frame = problem.frames[v];
        frame.centre         = place(v);
        for (unsigned int m = 0; m < 6; ++m)
          frame.motions[m][m] = m < 3 ? 1. : length;
      }
  }

  void
  VertexMotions::prolongate_add(FloatVector &x, const float *coarse) const
  {
    for (unsigned int v = 0; v < vertices.n_owned_nodes(); ++v)
      for (unsigned int a = 0; a < 3; ++a)
        {
          displacements.local_element(3 * v + a) = coarse[6 * v + a];
          rotations.local_element(3 * v + a)     = coarse[6 * v + 3 + a];
        }
    displacements.update_ghost_values();
    rotations.update_ghost_values();
    vertices.prolongate_add(x, displacements);
    const float *const w = rotations.begin();
    float *const       y = x.begin();
    for (const Middle &middle : middles)
      for (unsigned int end = 0; end < 2; ++end)
        for (unsigned int a = 0; a < 3; ++a)
          {
            const unsigned int b = (a + 1) % 3, c = (a + 2) % 3;
            const float *const from = w + std::size_t(3) * middle.vertices[end];
            y[3 * middle.node + a] +=
              from[b] * middle.arms[end][c] - from[c] * middle.arms[end][b];
          }
    for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
      if (is_prescribed[i])
        y[i] = 0;
    displacements.zero_out_ghost_values();
    rotations.zero_out_ghost_values();
  }

  void
  VertexMotions::restrict_to(float *coarse, const FloatVector &r) const
  {
    vertices.restrict_to(displacements, r);
    rotations            = 0;
    float *const       w = rotations.begin();
    const float *const f = r.begin();
    for (const Middle &middle : middles)
      for (unsigned int end = 0; end < 2; ++end)
        for (unsigned int a = 0; a < 3; ++a)
          {
            const unsigned int b = (a + 1) % 3, c = (a + 2) % 3;
            w[3 * middle.vertices[end] + a] +=
              middle.arms[end][b] * f[3 * middle.node + c] -
              middle.arms[end][c] * f[3 * middle.node + b];
          }
    rotations.compress(dealii::VectorOperation::add);
    for (unsigned int v = 0; v < vertices.n_owned_nodes(); ++v)
      for (unsigned int a = 0; a < 3; ++a)
        {
          coarse[6 * v + a]     = is_vertex_prescribed[3 * v + a] != 0 ?
                                    0.f :
                                    displacements.local_element(3 * v + a);
          coarse[6 * v + 3 + a] = rotations.local_element(3 * v + a);
        }
  }
} // namespace corotet
