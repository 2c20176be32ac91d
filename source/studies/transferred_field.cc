// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/finite_element.h>
#include <corotet/studies/gathered_field.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    constexpr unsigned int n_geometry = 12;

    // Of the barycentric coordinates, the smallest: negative outside.
    double
    depth(const Point<3> &xi)
    {
      return std::min({xi[0], xi[1], xi[2], 1 - xi[0] - xi[1] - xi[2]});
    }
  } // namespace

  struct GatheredField::Search
  {
    explicit Search(const std::vector<dealii::BoundingBox<3>> &boxes)
      : boxes(boxes)
      , tree(dealii::pack_rtree_of_indices(this->boxes))
    {}

    const std::vector<dealii::BoundingBox<3>> boxes;
    const decltype(dealii::pack_rtree_of_indices(
      std::vector<dealii::BoundingBox<3>>())) tree;
  };

  GatheredField::GatheredField(const Discretization &discretization,
                               const Vector         &u)
    : fe(finite_element(discretization.element()))
    , stride(n_geometry + 3 * discretization.n_nodes_per_cell())
  {
    std::vector<double> own;
    own.reserve(std::size_t(stride) * discretization.n_owned_cells());
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        const auto     nodes  = discretization.cell_nodes(c);
        const Point<3> origin = discretization.node_position(nodes[0]);
        const auto    &J      = discretization.geometry(c).inverse_jacobian;
        for (unsigned int a = 0; a < 3; ++a)
          own.push_back(origin[a]);
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int a = 0; a < 3; ++a)
            own.push_back(J[k][a]);
        for (const unsigned int n : nodes)
          for (unsigned int a = 0; a < 3; ++a)
            own.push_back(u.local_element(3 * n + a));
      }
    for (const auto &part :
         dealii::Utilities::MPI::all_gather(discretization.communicator(), own))
      data.insert(data.end(), part.begin(), part.end());

    std::vector<dealii::BoundingBox<3>> boxes;
    for (std::size_t c = 0; c < data.size() / stride; ++c)
      {
        const double         *cell = data.data() + c * stride;
        const Point<3>        origin(cell[0], cell[1], cell[2]);
        Tensor<2, 3>          G;
        std::vector<Point<3>> vertices{origin};
        for (unsigned int i = 0; i < 9; ++i)
          G[i / 3][i % 3] = cell[3 + i];
        const Tensor<2, 3> J = invert(G);
        for (unsigned int k = 0; k < 3; ++k)
          vertices.push_back(origin +
                             Tensor<1, 3>({J[0][k], J[1][k], J[2][k]}));
        boxes.emplace_back(vertices);
      }
    search = std::make_unique<const Search>(boxes);
  }

  GatheredField::~GatheredField() = default;

  Point<3>
  GatheredField::reference_point(const unsigned int cell,
                                 const Point<3>    &x) const
  {
    const double *values = data.data() + std::size_t(cell) * stride;
    Point<3>      xi;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int a = 0; a < 3; ++a)
        xi[k] += values[3 + 3 * k + a] * (x[a] - values[a]);
    return xi;
  }

  PointDisplacement
  GatheredField::value(const Point<3> &x) const
  {
    namespace bgi     = boost::geometry::index;
    unsigned int cell = last_cell;
    double       best = depth(reference_point(cell, x));
    if (best < 0)
      {
        std::vector<std::size_t> candidates;
        search->tree.query(bgi::intersects(x), std::back_inserter(candidates));
        // Points on the surface may be outside of all boxes by round-off.
        if (candidates.empty())
          search->tree.query(bgi::nearest(x, 16),
                             std::back_inserter(candidates));
        for (const std::size_t candidate : candidates)
          if (const double d = depth(reference_point(candidate, x)); d > best)
            {
              best = d;
              cell = candidate;
            }
        last_cell = cell;
      }

    const Point<3>    xi = reference_point(cell, x);
    const double     *G  = data.data() + std::size_t(cell) * stride + 3;
    const double     *u  = G + 9;
    PointDisplacement result;
    Tensor<2, 3>      by_reference;
    for (unsigned int i = 0; i < fe.dofs_per_cell; ++i)
      {
        const double       N  = fe.shape_value(i, xi);
        const Tensor<1, 3> dN = fe.shape_grad(i, xi);
        for (unsigned int a = 0; a < 3; ++a)
          {
            result.value[a] += N * u[3 * i + a];
            by_reference[a] += u[3 * i + a] * dN;
          }
      }
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        for (unsigned int k = 0; k < 3; ++k)
          result.gradient[a][b] += by_reference[a][k] * G[3 * k + b];
    return result;
  }
} // namespace corotet
