// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exchange.h>
#include <corotet/base/mpi.h>
#include <corotet/discretization/finite_element.h>
#include <corotet/studies/transferred_field.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    using BoundingBox = dealii::BoundingBox<3>;
    using Corners     = std::array<Point<3>, 2>;

    // The number of values of a cell before its nodal values.
    constexpr unsigned int n_geometry = 12;
    // The largest number of boxes that a rank sends to others.
    constexpr unsigned int n_boxes = 64;
    // The distance up to which points outside of the cells are found, relative
    // to the sum of the sides of a cell's box: finer cells follow a curved
    // shape that coarse cells cut off.
    constexpr double beyond = 0.1;

    // The smallest barycentric coordinate: negative outside.
    double
    depth(const Point<3> &xi)
    {
      return std::min({xi[0], xi[1], xi[2], 1 - xi[0] - xi[1] - xi[2]});
    }

    // The numbers of each owned cell: vertex 0, the inverse of its Jacobian,
    // the values [node][component].
    std::vector<double>
    cells_with_values(const Discretization &discretization,
                      const Vector         &u,
                      const unsigned int    stride)
    {
      std::vector<double> cells;
      cells.reserve(std::size_t(stride) * discretization.n_owned_cells());
      for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
        {
          const auto     nodes  = discretization.cell_nodes(c);
          const Point<3> origin = discretization.node_position(nodes[0]);
          const auto    &J      = discretization.geometry(c).inverse_jacobian;
          for (unsigned int a = 0; a < 3; ++a)
            cells.push_back(origin[a]);
          for (unsigned int k = 0; k < 3; ++k)
            for (unsigned int a = 0; a < 3; ++a)
              cells.push_back(J[k][a]);
          for (const unsigned int n : nodes)
            for (unsigned int a = 0; a < 3; ++a)
              cells.push_back(u.local_element(3 * n + a));
        }
      return cells;
    }

    BoundingBox
    box_of_cell(const double *const cell)
    {
      const Point<3>        origin(cell[0], cell[1], cell[2]);
      Tensor<2, 3>          G;
      std::vector<Point<3>> vertices{origin};
      for (unsigned int i = 0; i < 9; ++i)
        G[i / 3][i % 3] = cell[3 + i];
      const Tensor<2, 3> J = invert(G);
      for (unsigned int k = 0; k < 3; ++k)
        vertices.push_back(origin + Tensor<1, 3>({J[0][k], J[1][k], J[2][k]}));
      return BoundingBox(vertices);
    }

    // The boxes around pieces of the owned cells, whose order follows a curve
    // through the body: lower and upper corners.
    std::vector<Corners>
    boxes_of_pieces(const Discretization &discretization)
    {
      const unsigned int   n_cells      = discretization.n_owned_cells();
      const unsigned int   piece_length = (n_cells + n_boxes - 1) / n_boxes;
      std::vector<Corners> result;
      for (unsigned int first = 0; first < n_cells; first += piece_length)
        {
          std::vector<Point<3>> points;
          for (unsigned int c = first;
               c < std::min(first + piece_length, n_cells);
               ++c)
            for (const unsigned int n : discretization.cell_nodes(c))
              points.push_back(discretization.node_position(n));
          const auto [lower, upper] = BoundingBox(points).get_boundary_points();
          result.push_back({{lower, upper}});
        }
      return result;
    }

    // The numbers of those cells, of all ranks, that are near the owned cells
    // of @p target.
    std::vector<double>
    cells_at(std::vector<double>   own,
             const unsigned int    stride,
             const Discretization &target)
    {
      const MPI_Comm comm = target.communicator();
      if (dealii::Utilities::MPI::n_mpi_processes(comm) == 1)
        return own;
      std::vector<BoundingBox>  boxes;
      std::vector<unsigned int> ranks;
      const auto                of_ranks =
        dealii::Utilities::MPI::all_gather(comm, boxes_of_pieces(target));
      for (unsigned int rank = 0; rank < of_ranks.size(); ++rank)
        for (const auto &[lower, upper] : of_ranks[rank])
          {
            boxes.emplace_back(std::pair(lower, upper));
            ranks.push_back(rank);
          }
      const auto tree = dealii::pack_rtree_of_indices(boxes);

      std::map<unsigned int, std::vector<double>> sent;
      std::vector<std::size_t>                    near;
      std::set<unsigned int>                      to;
      for (std::size_t c = 0; c < own.size() / stride; ++c)
        {
          const auto  cell = own.begin() + c * stride;
          BoundingBox box  = box_of_cell(&*cell);
          box.extend(beyond * (box.side_length(0) + box.side_length(1) +
                               box.side_length(2)));
          near.clear();
          to.clear();
          tree.query(boost::geometry::index::intersects(box),
                     std::back_inserter(near));
          for (const std::size_t i : near)
            to.insert(ranks[i]);
          for (const unsigned int rank : to)
            sent[rank].insert(sent[rank].end(), cell, cell + stride);
        }
      own = {};
      for (auto &[rank, cells] : exchange_arrays(sent, comm))
        own.insert(own.end(), cells.begin(), cells.end());
      return own;
    }
  } // namespace

  struct TransferredField::Search
  {
    explicit Search(const std::vector<BoundingBox> &boxes)
      : boxes(boxes)
      , tree(dealii::pack_rtree_of_indices(this->boxes))
    {}

    const std::vector<BoundingBox> boxes;
    const decltype(dealii::pack_rtree_of_indices(
      std::vector<BoundingBox>())) tree;
  };

  TransferredField::TransferredField(const Discretization &source,
                                     const Vector         &u,
                                     const Discretization &target)
    : fe(finite_element(source.element()))
    , stride(n_geometry + 3 * source.n_nodes_per_cell())
    , data(cells_at(cells_with_values(source, u, stride), stride, target))
  {
    on_all_ranks(target.communicator(), [&] {
      AssertThrow(!data.empty() || target.n_owned_cells() == 0,
                  dealii::ExcMessage("The meshes are far apart."));
    });
    std::vector<BoundingBox> boxes;
    for (std::size_t c = 0; c < data.size() / stride; ++c)
      boxes.push_back(box_of_cell(data.data() + c * stride));
    search = std::make_unique<const Search>(boxes);
  }

  TransferredField::~TransferredField() = default;

  Point<3>
  TransferredField::reference_point(const unsigned int cell,
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
  TransferredField::value(const Point<3> &x) const
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
