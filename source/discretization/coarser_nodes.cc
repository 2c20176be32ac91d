// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/coarser_nodes.h>
#include <corotet/discretization/curved_batches.h>
#include <corotet/discretization/tetrahedron.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  namespace
  {
    constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

    // The number of the edge that joins two vertices of a cell.
    unsigned int
    edge_between(const int a, const int b)
    {
      for (unsigned int e = 0; e < 6; ++e)
        if ((tetrahedron::edges[e][0] == a && tetrahedron::edges[e][1] == b) ||
            (tetrahedron::edges[e][0] == b && tetrahedron::edges[e][1] == a))
          return e;
      return none;
    }

    // The quadratic Lagrange polynomials of a vertex and of the middle of an
    // edge, as functions of barycentric coordinates.
    constexpr double
    at_vertex(const double lambda)
    {
      return lambda * (2 * lambda - 1);
    }

    constexpr double
    at_middle(const double lambda_a, const double lambda_b)
    {
      return 4 * lambda_a * lambda_b;
    }
  } // namespace

  CoarserNodes::CoarserNodes(const Nodes &finer)
    : Nodes(finer.element().coarser())
    , finer(finer)
  {
    n_owned         = finer.n_owned_cells();
    n_local         = finer.n_local_cells();
    ghosted_cells   = finer.cells_with_ghosts();
    register_starts = finer.first_cells_of_registers();
    number_nodes();
    find_parents();
    make_batches();
    if (const CurvedBatches *curved = finer.batches().curved())
      cell_batches->set_curved(
        std::make_shared<const CurvedBatches>(element(), *curved));
  }

  void
  CoarserNodes::number_nodes()
  {
    // The keys of the nodes of all cells, one cell after another.
    std::vector<unsigned int> key_of_cell_node;
    for (unsigned int c = 0; c < finer.n_local_cells(); ++c)
      {
        const auto fine = finer.cell_nodes(c);
        for (unsigned int i = 0; i < 4; ++i)
          key_of_cell_node.push_back(fine[i]);
        if (finer.element().has_bubbles())
          for (unsigned int i = 4; i < 10; ++i)
            key_of_cell_node.push_back(fine[i]);
        else if (degree() == 2)
          for (unsigned int e = 0; e < 6; ++e)
            {
              // Of the two nodes on the edge, all ranks choose the same one.
              const unsigned int a = fine[4 + 2 * e], b = fine[5 + 2 * e];
              key_of_cell_node.push_back(
                finer.global_node(a) < finer.global_node(b) ? a : b);
            }
      }
    std::vector<unsigned char> is_key(finer.n_local_nodes(), 0);
    for (const unsigned int key : key_of_cell_node)
      is_key[key] = 1;

    unsigned int n_owned_nodes = 0;
    for (unsigned int n = 0; n < finer.n_owned_nodes(); ++n)
      {
        if (is_key[n] == 0)
          continue;
        ++n_owned_nodes;
        if (n < finer.first_shared_node())
          ++first_shared;
      }
    const MPI_Comm comm = finer.communicator();
    const auto [first, n_global] =
      dealii::Utilities::MPI::partial_and_total_sum<
        dealii::types::global_dof_index>(n_owned_nodes, comm);

    // Global numbers are exchanged in a vector of the finer nodes; doubles
    // represent them exactly.
    Vector global;
    finer.initialize_vector(global);
    auto next = first;
    for (unsigned int n = 0; n < finer.n_owned_nodes(); ++n)
      if (is_key[n])
        global.local_element(3 * n) = next++;
    global.update_ghost_values();

    dealii::IndexSet owned(3 * n_global), ghosts(3 * n_global);
    owned.add_range(3 * first, 3 * (first + n_owned_nodes));
    for (unsigned int n = finer.n_owned_nodes(); n < finer.n_local_nodes(); ++n)
      if (is_key[n])
        {
          const auto number = static_cast<dealii::types::global_dof_index>(
            global.local_element(3 * n));
          ghosts.add_range(3 * number, 3 * number + 3);
        }
    ghosts.compress();
    vector_partitioner =
      std::make_shared<const dealii::Utilities::MPI::Partitioner>(owned,
                                                                  ghosts,
                                                                  comm);

    keys.resize(n_local_nodes());
    std::vector<unsigned int> number_of_key(finer.n_local_nodes(), none);
    for (unsigned int n = 0; n < finer.n_local_nodes(); ++n)
      if (is_key[n])
        {
          const auto number = static_cast<dealii::types::global_dof_index>(
            global.local_element(3 * n));
          number_of_key[n] =
            vector_partitioner->global_to_local(3 * number) / 3;
          keys[number_of_key[n]] = n;
        }
    nodes_of_cells.reserve(key_of_cell_node.size());
    for (const unsigned int key : key_of_cell_node)
      nodes_of_cells.push_back(number_of_key[key]);
  }

  void
  CoarserNodes::find_parents()
  {
    using namespace tetrahedron;
    std::vector<unsigned char> is_done(finer.n_owned_nodes(), 0);
    const auto                 is_new = [&](const unsigned int fine) {
      return fine < finer.n_owned_nodes() && !std::exchange(is_done[fine], 1);
    };
    const bool         has_bubbles = finer.element().has_bubbles();
    const unsigned int n_same      = has_bubbles ? 10 : 4;
    for (unsigned int c = 0; c < n_owned; ++c)
      {
        const auto fine   = finer.cell_nodes(c);
        const auto coarse = cell_nodes(c);
        for (unsigned int i = 0; i < n_same; ++i)
          if (is_new(fine[i]))
            on_nodes.push_back({fine[i], {{coarse[i]}}});
        for (unsigned int e = 0; e < 6 && !has_bubbles; ++e)
          {
            const unsigned int a = coarse[edges[e][0]], b = coarse[edges[e][1]];
            if (degree() == 1)
              {
                if (is_new(fine[4 + e]))
                  on_middles.push_back({fine[4 + e], {{a, b}}});
                continue;
              }
            if (is_new(fine[4 + 2 * e]))
              on_thirds.push_back({fine[4 + 2 * e], {{a, b, coarse[4 + e]}}});
            if (is_new(fine[5 + 2 * e]))
              on_thirds.push_back({fine[5 + 2 * e], {{b, a, coarse[4 + e]}}});
          }
        const unsigned int first_face = has_bubbles ? 10 : 16;
        for (unsigned int f = 0; f < 4 && degree() == 2; ++f)
          if (is_new(fine[first_face + f]))
            {
              Parents<6> parents{fine[first_face + f], {}};
              for (unsigned int k = 0; k < 3; ++k)
                {
                  parents.coarse[k] = coarse[faces[f][k]];
                  parents.coarse[3 + k] =
                    coarse[4 +
                           edge_between(faces[f][k], faces[f][(k + 1) % 3])];
                }
              on_faces.push_back(parents);
            }
        if (has_bubbles && is_new(fine[14]))
          {
            in_cells.push_back({fine[14], {}});
            for (unsigned int i = 0; i < 10; ++i)
              in_cells.back().coarse[i] = coarse[i];
          }
      }
    // Sorts by fine nodes, as they are in memory.
    const auto sort = [](auto &list) {
      std::sort(list.begin(), list.end(), [](const auto &a, const auto &b) {
        return a.fine < b.fine;
      });
    };
    sort(on_nodes);
    sort(on_thirds);
    sort(on_middles);
    sort(on_faces);
    sort(in_cells);
  }

  template <typename Number, typename Function>
  void
  CoarserNodes::for_each_fine_node(const Function &function) const
  {
    const auto apply = [&](const auto &list, const auto &weights) {
      for (const auto &parents : list)
        function(parents.fine, parents.coarse, weights);
    };
    constexpr double third = 1. / 3;
    apply(on_nodes, std::array<Number, 1>{{1}});
    apply(on_middles, std::array<Number, 2>{{Number(0.5), Number(0.5)}});
    apply(on_thirds,
          std::array<Number, 3>{{Number(at_vertex(2 * third)),
                                 Number(at_vertex(third)),
                                 Number(at_middle(2 * third, third))}});
    std::array<Number, 6> on_face;
    for (unsigned int k = 0; k < 3; ++k)
      {
        on_face[k]     = at_vertex(third);
        on_face[3 + k] = at_middle(third, third);
      }
    apply(on_faces, on_face);
    std::array<Number, 10> in_cell;
    for (unsigned int k = 0; k < 10; ++k)
      in_cell[k] = k < 4 ? at_vertex(0.25) : at_middle(0.25, 0.25);
    apply(in_cells, in_cell);
  }

  std::vector<unsigned char>
  CoarserNodes::marks(const std::vector<unsigned char> &finer_marks) const
  {
    std::vector<unsigned char> result(std::size_t(3) * n_local_nodes());
    for (unsigned int n = 0; n < n_local_nodes(); ++n)
      for (unsigned int a = 0; a < 3; ++a)
        result[3 * n + a] = finer_marks[3 * keys[n] + a];
    return result;
  }

  template <typename Number>
  void
  CoarserNodes::prolongate_add(
    dealii::LinearAlgebra::distributed::Vector<Number>       &fine,
    const dealii::LinearAlgebra::distributed::Vector<Number> &coarse) const
  {
    Number *const       to   = fine.begin();
    const Number *const from = coarse.begin();
    for_each_fine_node<Number>(
      [&](const unsigned int n, const auto &parents, const auto &weights) {
        for (unsigned int a = 0; a < 3; ++a)
          {
            Number sum = 0;
            for (unsigned int k = 0; k < parents.size(); ++k)
              sum += weights[k] * from[3 * parents[k] + a];
            to[3 * n + a] += sum;
          }
      });
  }

  template <typename Number>
  void
  CoarserNodes::restrict_to(
    dealii::LinearAlgebra::distributed::Vector<Number>       &coarse,
    const dealii::LinearAlgebra::distributed::Vector<Number> &fine) const
  {
    coarse                   = 0;
    Number *const       to   = coarse.begin();
    const Number *const from = fine.begin();
    for_each_fine_node<Number>(
      [&](const unsigned int n, const auto &parents, const auto &weights) {
        for (unsigned int k = 0; k < parents.size(); ++k)
          for (unsigned int a = 0; a < 3; ++a)
            to[3 * parents[k] + a] += weights[k] * from[3 * n + a];
      });
    coarse.compress(dealii::VectorOperation::add);
  }

  template void
  CoarserNodes::prolongate_add(
    dealii::LinearAlgebra::distributed::Vector<float> &,
    const dealii::LinearAlgebra::distributed::Vector<float> &) const;
  template void
  CoarserNodes::prolongate_add(
    dealii::LinearAlgebra::distributed::Vector<double> &,
    const dealii::LinearAlgebra::distributed::Vector<double> &) const;
  template void
  CoarserNodes::restrict_to(
    dealii::LinearAlgebra::distributed::Vector<float> &,
    const dealii::LinearAlgebra::distributed::Vector<float> &) const;
  template void
  CoarserNodes::restrict_to(
    dealii::LinearAlgebra::distributed::Vector<double> &,
    const dealii::LinearAlgebra::distributed::Vector<double> &) const;
} // namespace corotet
