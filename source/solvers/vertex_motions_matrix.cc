// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/tetrahedron.h>
#include <corotet/operators/assembled_matrix.h>
#include <corotet/solvers/vertex_motions.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "vertex_motions_cell.h"

namespace corotet
{
  namespace
  {
    // The factor c of the spring that ties the rotation w of a vertex to that
    // of the cells around it, c int mu |w - curl u / 2|^2 in each cell.
    // Iterations are the same from 1e-6 to 1e-1; large factors keep the matrix
    // well conditioned.
    constexpr double spring = 0.01;
    // The smallest spring, relative to the trace of stiffness and mass, for
    // crushed cells and short steps: enough to exceed round-off.
    constexpr double least_spring = 1e-12;

    constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

    // The pattern with two nodes for each one.
    std::shared_ptr<const BlockPattern>
    twice(const BlockPattern &pattern)
    {
      NodeGraph rows;
      for (int i = 0; i < pattern.n_owned(); ++i)
        for (unsigned int half = 0; half < 2; ++half)
          {
            for (int k = pattern.graph().starts[i];
                 k < pattern.graph().starts[i + 1];
                 ++k)
              {
                const int column =
                  pattern.nodes().global_node(pattern.graph().columns[k]);
                rows.columns.push_back(2 * column);
                rows.columns.push_back(2 * column + 1);
              }
            rows.starts.push_back(rows.columns.size());
          }
      return std::make_shared<const BlockPattern>(rows, pattern.communicator());
    }
  } // namespace

  void
  VertexMotions::make_matrix()
  {
    pattern            = block_pattern(vertices);
    places_of_blocks   = BlockPlaces(vertices, *pattern);
    problem.matrix     = std::make_unique<BlockMatrix>(twice(*pattern));
    problem.aggregates = pattern;
  }

  void
  VertexMotions::gather(const unsigned int first,
                        const unsigned int n_cells,
                        CellMatrix        &cells) const
  {
    // Lanes without a cell repeat the last cell.
    for (unsigned int lane = 0; lane < batch_size; ++lane)
      {
        const auto nodes =
          quadratic.cell_nodes(first + std::min(lane, n_cells - 1));
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int a = 0; a < 3; ++a)
            cells.vertices[i][a][lane] = places[nodes[i]][a];
        for (unsigned int e = 0; e < 6; ++e)
          cells.set_ends(e,
                         lane,
                         arms(places[nodes[tetrahedron::edges[e][0]]],
                              places[nodes[tetrahedron::edges[e][1]]],
                              places[nodes[4 + e]]));
      }
  }

  void
  VertexMotions::leave_out_prescribed(const unsigned int first,
                                      const unsigned int n_cells,
                                      CellMatrix        &cells) const
  {
    for (unsigned int lane = 0; lane < n_cells; ++lane)
      {
        if (touches_prescribed[first + lane] == 0)
          continue;
        const auto nodes = quadratic.cell_nodes(first + lane);
        for (unsigned int i = 0; i < 10; ++i)
          for (unsigned int a = 0; a < 3; ++a)
            if (is_prescribed[3 * nodes[i] + a])
              for (unsigned int j = 0; j < 10; ++j)
                for (unsigned int b = 0; b < 3; ++b)
                  cells.K[i][j][a][b][lane] = cells.K[j][i][b][a][lane] = 0;
      }
  }

  void
  VertexMotions::add(const unsigned int first,
                     const unsigned int n_cells,
                     const CellMatrix  &cells)
  {
    for (unsigned int lane = 0; lane < n_cells; ++lane)
      {
        const auto nodes   = vertices.cell_nodes(first + lane);
        const bool touches = touches_prescribed[first + lane] != 0;
        const auto is_out  = [&](const unsigned int i, const unsigned int a) {
          return touches && a < 3 && is_vertex_prescribed[3 * nodes[i] + a];
        };
        std::size_t block = std::size_t(16) * (first + lane);
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < 4; ++j, ++block)
            if (nodes[i] < vertices.n_owned_nodes())
              for (unsigned int a = 0; a < 6; ++a)
                {
                  double *const row =
                    problem.matrix->row(2 * nodes[i] + a / 3, a % 3) +
                    std::size_t(6) * places_of_blocks[block];
                  for (unsigned int b = 0; b < 6; ++b)
                    if (!is_out(i, a) && !is_out(j, b))
                      row[b] += cells.A[i][j][a][b][lane];
                }
      }
  }

  // The blocks of a face follow each other, and faces have no edges of other
  // cells, so each face is treated as a cell matrix of its own.
  void
  VertexMotions::add_surface(const SurfaceOperator<double> &surface,
                             CellMatrix                    &cells)
  {
    const auto clear = [&] {
      for (auto &row : cells.K)
        for (auto &block : row)
          for (auto &values : block)
            for (auto &value : values)
              value = FrozenCellMatrices::V{};
    };
    unsigned int cell  = none;
    const auto   flush = [&] {
      if (cell == none)
        return;
      gather(cell, 1, cells);
      leave_out_prescribed(cell, 1, cells);
      cells.combine();
      add(cell, 1, cells);
    };
    clear();
    surface.for_each_block([&](const unsigned int c,
                               const unsigned int i,
                               const unsigned int j,
                               const auto        &S) {
      if (c != cell)
        {
          flush();
          clear();
          cell = c;
        }
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          {
            cells.K[i][j][a][b][0] += S[a][b];
            if (i != j)
              cells.K[j][i][b][a][0] += S[a][b];
          }
    });
    flush();
  }

  void
  VertexMotions::update(
    const Discretization                                  &discretization,
    const Vector                                          &positions,
    const double                                           c_K,
    const dealii::AlignedVector<CellCoefficients<double>> &coefficients,
    const double                                           c_M,
    const dealii::AlignedVector<CellMasses<double>>       &masses,
    const SurfaceOperator<double>                         *surface)
  {
    find_places(discretization, positions);
    set_arms();
    problem.matrix->set_zero();
    FrozenCellMatrices frozen(quadratic);
    const auto         cells = std::make_unique<CellMatrix>();
    frozen.for_each_batch([&](const unsigned int first,
                              const unsigned int n_cells) {
      const unsigned int batch = quadratic.batches().place(first).first;
      frozen.for_each_block(first,
                            coefficients[batch],
                            c_M * load_aligned<batch_size>(masses[batch].mass),
                            [&](const unsigned int i,
                                const unsigned int j,
                                const auto        &K,
                                const auto         mass) {
                              for (unsigned int a = 0; a < 3; ++a)
                                for (unsigned int b = 0; b < 3; ++b)
                                  cells->K[i][j][a][b] = cells->K[j][i][b][a] =
                                    c_K * K[a][b];
                              cells->mass[i][j] = cells->mass[j][i] = mass;
                            });
      gather(first, n_cells, *cells);
      FrozenCellMatrices::V cofactors[4][3];
      const auto            shear = cells->shear_stiffness(
        load_aligned<batch_size>(coefficients[batch].lame_ratio), cofactors);
      // In short steps the mass is far larger than the stiffness.
      cells->add_mass();
      const FrozenCellMatrices::V least = least_spring * cells->trace();
      leave_out_prescribed(first, n_cells, *cells);
      cells->combine();
      cells->add_springs(spring * shear, length, cofactors, least);
      add(first, n_cells, *cells);
    });
    if (surface != nullptr)
      add_surface(*surface, *cells);
    for (unsigned int v = 0; v < vertices.n_owned_nodes(); ++v)
      for (unsigned int a = 0; a < 3; ++a)
        if (is_vertex_prescribed[3 * v + a])
          problem.matrix->diagonal(6 * v + a) = 1;
  }
} // namespace corotet
