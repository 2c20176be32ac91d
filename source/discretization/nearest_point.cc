// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/nearest_point.h>
#include <corotet/discretization/point_search.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;
  namespace mpi = dealii::Utilities::MPI;

  namespace
  {
    // The largest distance from a cell, in heights of the cell.
    constexpr double near = 0.2;

    using Barycentric = std::array<double, 4>;

    // The barycentric coordinates of the point of a tetrahedron that is nearest
    // to the origin. The nearest point on the line or plane of each vertex,
    // edge, face and of the inside is a candidate if it lies in the
    // tetrahedron.
    Barycentric
    nearest_to_origin(const std::array<Tensor<1, 3>, 4> &vertices)
    {
      Barycentric best{};
      double      least = std::numeric_limits<double>::infinity();
      for (unsigned int subset = 1; subset < 16; ++subset)
        {
          std::array<unsigned int, 4> of_subset{};
          unsigned int                n = 0;
          for (unsigned int v = 0; v < 4; ++v)
            if ((subset >> v) % 2 == 1)
              of_subset[n++] = v;
          // Normal equations for the way along the edges from the first vertex.
          // Missing edges have the equation 0 = 0 of an identity matrix.
          const auto  &origin = vertices[of_subset[0]];
          Tensor<2, 3> products;
          Tensor<1, 3> right;
          for (unsigned int k = 0; k < 3; ++k)
            if (k + 1 < n)
              {
                const auto edge_k = vertices[of_subset[k + 1]] - origin;
                right[k]          = -(edge_k * origin);
                for (unsigned int l = 0; l + 1 < n; ++l)
                  products[k][l] =
                    edge_k * (vertices[of_subset[l + 1]] - origin);
              }
            else
              products[k][k] = 1;
          const Tensor<1, 3> along = invert(products) * right;
          Barycentric        lambda{};
          lambda[of_subset[0]] = 1;
          for (unsigned int k = 1; k < n; ++k)
            {
              lambda[of_subset[k]] = along[k - 1];
              lambda[of_subset[0]] -= along[k - 1];
            }
          if (!(*std::min_element(lambda.begin(), lambda.end()) >= 0))
            continue;
          Tensor<1, 3> x;
          for (unsigned int v = 0; v < 4; ++v)
            x += lambda[v] * vertices[v];
          if (x.norm_square() < least)
            {
              least = x.norm_square();
              best  = lambda;
            }
        }
      return best;
    }

    // The point of the cell that is nearest to x. In a curved cell this is
    // iterated with the straight cell that touches it at the last point found,
    // which converges if the distance of x is small compared with the radius of
    // curvature.
    Point<3>
    nearest_point_of_cell(const Discretization &discretization,
                          const unsigned int    cell,
                          const Point<3>       &x)
    {
      const auto  nodes = discretization.cell_nodes(cell);
      const auto &fe    = discretization.finite_element().base_element(0);
      std::array<Tensor<1, 3>, 4> vertices;
      for (unsigned int v = 0; v < 4; ++v)
        vertices[v] = discretization.node_position(nodes[v]) - x;
      // The tolerance is far below the size of a cell; each iteration gains a
      // power of ten and more if x is near.
      constexpr double round_off = 1e-13;
      Point<3>         xi, best;
      double           least = std::numeric_limits<double>::infinity();
      for (unsigned int k = 0; k < 50; ++k)
        {
          const Barycentric lambda = nearest_to_origin(vertices);
          const Point<3>    before = xi;
          xi                       = Point<3>(lambda[1], lambda[2], lambda[3]);
          Tensor<1, 3> difference;
          Tensor<2, 3> J;
          for (unsigned int i = 0; i < nodes.size(); ++i)
            {
              const Tensor<1, 3> X = discretization.node_position(nodes[i]) - x;
              difference += fe.shape_value(i, xi) * X;
              J += outer_product(X, fe.shape_grad(i, xi));
            }
          // Stops when distances differ by round-off alone.
          if (!(difference.norm() < (1 + round_off) * least))
            break;
          least = difference.norm();
          best  = x + difference;
          if (!discretization.is_curved(cell) ||
              (k > 0 && xi.distance(before) < round_off))
            break;
          for (unsigned int v = 0; v < 4; ++v)
            {
              Point<3> corner;
              if (v > 0)
                corner[v - 1] = 1;
              vertices[v] = difference + J * (corner - xi);
            }
        }
      return best;
    }

    // Like nearest_point(), but among this rank's owned cells. Not collective.
    std::optional<Point<3>>
    nearest_owned_point(const Discretization &discretization,
                        const NearbyCells    &nearby,
                        const Point<3>       &x)
    {
      std::optional<Point<3>> result;
      const PointSearch       search(discretization);
      for (const unsigned int c : nearby.cells(x, near))
        {
          if (search.find(c, x))
            return x;
          const Point<3> &origin =
            discretization.node_position(discretization.cell_nodes(c)[0]);
          const Tensor<1, 3> xi =
            discretization.geometry(c).inverse_jacobian * (x - origin);
          if (!(std::min({xi[0], xi[1], xi[2], 1 - xi[0] - xi[1] - xi[2]}) >
                -near))
            continue;
          const Point<3> found = nearest_point_of_cell(discretization, c, x);
          if (!result || x.distance(found) < x.distance(*result))
            result = found;
        }
      return result;
    }
  } // namespace



  std::optional<Point<3>>
  nearest_point(const Discretization &discretization,
                const NearbyCells    &nearby,
                const Point<3>       &x)
  {
    const MPI_Comm   comm     = discretization.communicator();
    const auto       own      = nearest_owned_point(discretization, nearby, x);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double     distance = own ? x.distance(*own) : infinity;
    const double     least    = mpi::min(distance, comm);
    if (least == infinity)
      return {};
    const unsigned int rank   = mpi::this_mpi_process(comm);
    const unsigned int nobody = mpi::n_mpi_processes(comm);
    const unsigned int owner =
      mpi::min(distance == least ? rank : nobody, comm);
    return mpi::broadcast(comm, own.value_or(Point<3>()), owner);
  }
} // namespace corotet
