// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/cell_proportions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    // The inverse of the matrix whose columns lead from the corner (0, 0, 0) of
    // the regular tetrahedron with edges of length one to its other corners.
    Tensor<2, 3>
    inverse_of_regular_edges()
    {
      using std::numbers::sqrt2;
      using std::numbers::sqrt3;
      Tensor<2, 3> edges;
      edges[0][0] = 1;
      edges[0][1] = edges[0][2] = 0.5;
      edges[1][1]               = sqrt3 / 2;
      edges[1][2]               = sqrt3 / 6;
      edges[2][2]               = sqrt2 / sqrt3;
      return invert(edges);
    }

    // The stretches s1, s2, s3.
    std::array<double, 3>
    stretches(const std::array<Point<3>, 4> &vertices)
    {
      static const Tensor<2, 3> inverse = inverse_of_regular_edges();
      Tensor<2, 3>              edges;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int a = 0; a < 3; ++a)
          edges[a][i] = vertices[i + 1][a] - vertices[0][a];
      const Tensor<2, 3>          F = edges * inverse;
      const std::array<double, 3> squares =
        eigenvalues(dealii::symmetrize(F * transpose(F)));
      // In a flat cell, whose volume is positive, the smallest eigenvalue is
      // mostly round-off: the smallest stretch is computed from the
      // determinant. In a needle the middle one is round-off, too: both are
      // taken to be the same.
      constexpr double round_off = std::numeric_limits<float>::epsilon();
      const double     s0        = std::sqrt(squares[0]);
      const double     product   = std::abs(determinant(F)) / s0;
      const bool   is_known = squares[1] > round_off * round_off * squares[0];
      const double s1       = std::sqrt(is_known ? squares[1] : product);
      return {{s0, s1, product / s1}};
    }
  } // namespace

  CellProportions
  cell_proportions(const Discretization &discretization)
  {
    const MPI_Comm  comm = discretization.communicator();
    CellProportions result;
    // The number of cells, of flat and of stretched cells; the sum of
    // logarithms of ratios.
    std::array<double, 4> sums{};
    for (unsigned int cell = 0; cell < discretization.n_owned_cells(); ++cell)
      {
        const auto              nodes = discretization.cell_nodes(cell);
        std::array<Point<3>, 4> vertices;
        for (unsigned int i = 0; i < 4; ++i)
          vertices[i] = discretization.node_position(nodes[i]);
        const auto   s     = stretches(vertices);
        const double ratio = std::max(s[1] / s[2], s[0] / s[1]);
        sums[0] += 1;
        if (s[1] / s[2] > CellProportions::limit)
          ++sums[1];
        if (s[0] / s[1] > CellProportions::limit)
          ++sums[2];
        sums[3] += std::log(ratio);
        if (ratio > result.largest_ratio)
          {
            result.largest_ratio = ratio;
            result.place         = Point<3>(
              (vertices[0] + vertices[1] + vertices[2] + vertices[3]) / 4);
          }
      }
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums.data(), 4),
                                comm,
                                dealii::ArrayView<double>(sums.data(), 4));
    const auto largest =
      dealii::Utilities::MPI::min_max_avg(result.largest_ratio, comm);
    result.largest_ratio = largest.max;
    result.place =
      dealii::Utilities::MPI::broadcast(comm, result.place, largest.max_index);
    result.share_flat      = sums[1] / sums[0];
    result.share_stretched = sums[2] / sums[0];
    result.mean_ratio      = std::exp(sums[3] / sums[0]);
    return result;
  }

  std::string
  CellProportions::text() const
  {
    if (largest_ratio <= limit)
      return fmt::format("no cell is flat or stretched by more than {}", limit);
    return fmt::format("{:.3g} % of the cells are flat, {:.3g} % stretched (by "
                       "more than {}; most by {:.3g}, at ({:.4g}, {:.4g}, "
                       "{:.4g}))",
                       100 * share_flat,
                       100 * share_stretched,
                       limit,
                       largest_ratio,
                       place[0],
                       place[1],
                       place[2]);
  }
} // namespace corotet
