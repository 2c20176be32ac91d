// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The parts of the discretization for curved cells.

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/discretization/curved_batches.h>
#include <corotet/discretization/discretization.h>
#include <corotet/mesh/curved_cells.h>

#include <fmt/format.h>

#include <algorithm>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // The number of consecutive cells that may be reordered: few enough to be
    // near each other, many enough for runs of one kind to be long.
    constexpr unsigned int window = 32 * n_lanes<float>;

    // Moves cells of one kind that wait for a place to the end of @p order: as
    // many as fill whole registers, or all of them.
    void
    move_registers(std::vector<unsigned int> &waiting,
                   std::vector<unsigned int> &order,
                   const bool                 all)
    {
      const auto n = static_cast<std::ptrdiff_t>(
        all ? waiting.size() :
              waiting.size() - waiting.size() % n_lanes<float>);
      order.insert(order.end(), waiting.begin(), waiting.begin() + n);
      waiting.erase(waiting.begin(), waiting.begin() + n);
    }
  } // namespace

  void
  Discretization::gather_curved(std::vector<unsigned int> &cells)
  {
    std::vector<unsigned int> order, straight, curved;
    order.reserve(cells.size());
    const auto gather = [&](const unsigned int begin, const unsigned int end) {
      register_starts.push_back(begin);
      // Curved cells come last in a window, first in the next one and so on, so
      // that runs of one kind are longer.
      bool curved_first = false;
      for (unsigned int c = begin; c < end; c += window)
        {
          const unsigned int next = std::min(c + window, end);
          for (unsigned int k = c; k < next; ++k)
            (mesh_pointer->curved_nodes(cells[k]).empty() ? straight : curved)
              .push_back(cells[k]);
          move_registers(curved_first ? curved : straight, order, next == end);
          if (next == end)
            register_starts.push_back(order.size());
          move_registers(curved_first ? straight : curved, order, next == end);
          curved_first = !curved_first;
        }
    };
    const auto [first, second] = ghosted_cells;
    if (first < second)
      {
        gather(0, first);
        gather(first, second);
        gather(second, n_owned);
      }
    else
      gather(0, n_owned);
    gather(n_owned, cells.size());
    cells = std::move(order);
  }

  void
  Discretization::curve_positions()
  {
    const unsigned int q = mesh_pointer->geometry_degree();
    const unsigned int r = std::min(q, degree());
    // Maps from degree q to its interpolant of degree r (for r = q the same
    // map), and from there to the element's nodes.
    const MapAtPoints at_r(q, map_points(r));
    const MapAtPoints at_nodes(r, fe.base_element(0).get_unit_support_points());
    std::vector<Point<3>> nodes(at_r.n_points());
    curved_cells.resize(n_local_cells());
    curved_geometries.resize(n_local_cells());
    for (unsigned int c = 0; c < n_local_cells(); ++c)
      {
        const auto curve = mesh_pointer->curved_nodes(local_mesh_cells[c]);
        if (curve.empty())
          continue;
        for (unsigned int v = 0; v < 4; ++v)
          Assert(curve[v].distance(node_position(cell_nodes(c)[v])) <=
                   1e-10 * std::cbrt(std::abs(geometry(c).volume)),
                 dealii::ExcInternalError());
        curved_cells[c] = 1;
        for (unsigned int i = 0; i < nodes.size(); ++i)
          nodes[i] = at_r.position(curve.data(), i);
        for (unsigned int i = 0; i < n_cell_nodes; ++i)
          {
            const Point<3> x = at_nodes.position(nodes.data(), i);
            for (unsigned int a = 0; a < 3; ++a)
              positions.local_element(3 * cell_nodes(c)[i] + a) = x[a];
          }
      }
  }

  void
  Discretization::set_up_curved_cells()
  {
    const auto curved =
      std::make_shared<CurvedBatches>(element(), *cell_batches, curved_cells);
    const auto &rule = curved->shapes();
    const auto  centre =
      ReferenceElement::tabulate(element(), {Point<3>(0.25, 0.25, 0.25)}, {1.});
    on_all_ranks(communicator(), [&] {
      std::vector<Tensor<2, 3>> J(rule.weights.size());
      for (unsigned int c = 0; c < curved_cells.size(); ++c)
        if (curved_cells[c])
          {
            const Tensor<2, 3> J_centre = jacobian(c, centre, 0);
            double             smallest = determinant(J_centre), volume = 0;
            for (unsigned int q = 0; q < J.size(); ++q)
              {
                J[q] = jacobian(c, rule, q);
                volume += rule.weights[q] * determinant(J[q]) / 6;
                smallest = std::min(smallest, determinant(J[q]));
              }
            if (!(smallest > 0))
              throw InputError(
                "Discretization/Degree",
                fmt::format("a curved cell at ({:.6g}, {:.6g}, {:.6g}) is "
                            "folded: found a Jacobian determinant of {:.3g} "
                            "times its mean at a quadrature point of degree "
                            "{}; it must be positive, so make the mesh finer "
                            "there",
                            node_position(cell_nodes(c)[0])[0],
                            node_position(cell_nodes(c)[0])[1],
                            node_position(cell_nodes(c)[0])[2],
                            smallest / (6 * std::abs(volume)),
                            degree()));
            curved_geometries[c] = {invert(J_centre), volume, region(c)};
            for (unsigned int q = 0; q < J.size(); ++q)
              curved->set(cell_batches->place(c),
                          q,
                          invert(J[q]) * J_centre,
                          rule.weights[q] * determinant(J[q]) / (6 * volume));
          }
    });
    if (curved->n_batches() > 0)
      cell_batches->set_curved(curved);
  }
} // namespace corotet
