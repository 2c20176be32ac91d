// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/mpi.h>
#include <corotet/discretization/tetrahedron.h>
#include <corotet/operators/assembled_matrix.h>
#include <corotet/solvers/vertex_motions.h>

#include <limits>
#include <utility>

namespace corotet
{
  namespace
  {
    using V     = FrozenCellMatrices::V;
    using Block = FrozenCellMatrices::Block;

    // Of the spring that ties the rotation w of a vertex to that of the cells
    // around it, c int mu |w - curl u / 2|^2 in each cell. Iterations are the
    // same from 1e-6 to 1e-1; large ones keep the matrix well conditioned.
    constexpr double spring = 0.01;

    constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

    // The two patterns of a matrix: points of six unknowns, and two nodes for
    // each of them.
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
                  pattern.global_node(pattern.graph().columns[k]);
                rows.columns.push_back(2 * column);
                rows.columns.push_back(2 * column + 1);
              }
            rows.starts.push_back(rows.columns.size());
          }
      return std::make_shared<const BlockPattern>(rows, pattern.communicator());
    }

    // target += a b.
    void
    add_product(const Block &a, const Block &b, V (&target)[3][6])
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          target[i][3 + j] +=
            a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    }
  } // namespace

  // Lanes are cells of a batch.
  struct VertexMotions::CellMatrix
  {
    // Of the nodes of the quadratic element.
    Block K[10][10];
    V     mass[10][10];
    // Of the vertices.
    V A[4][4][6][6];
    // By vertices: their edges, and what their rotation moves the middle by.
    struct End
    {
      unsigned int edge;
      Block        X;
    };
    End ends[4][3];
    // Where they are [m].
    V vertices[4][3];

    CellMatrix();

    void
    set_ends(const unsigned int                         edge,
             const unsigned int                         lane,
             const std::array<dealii::Tensor<1, 3>, 2> &arms);
    V
    shear_stiffness(const V lame_ratio, V (&cofactors)[4][3]) const;
    void
    add_mass();
    void
    combine();
    void
    add_springs(const V size, const double length, const V (&cofactors)[4][3]);
  };

  VertexMotions::CellMatrix::CellMatrix()
  {
    for (unsigned int i = 0; i < 4; ++i)
      {
        unsigned int n = 0;
        for (unsigned int e = 0; e < 6; ++e)
          if (tetrahedron::edges[e][0] == static_cast<int>(i) ||
              tetrahedron::edges[e][1] == static_cast<int>(i))
            ends[i][n++].edge = e;
        for (End &end : ends[i])
          for (unsigned int a = 0; a < 3; ++a)
            end.X[a][a] = V{};
      }
  }

  void
  VertexMotions::CellMatrix::add_mass()
  {
    for (unsigned int i = 0; i < 10; ++i)
      for (unsigned int j = 0; j < 10; ++j)
        for (unsigned int a = 0; a < 3; ++a)
          K[i][j][a][a] += mass[i][j];
  }

  void
  VertexMotions::locate_blocks()
  {
    pattern            = block_pattern(vertices);
    problem.matrix     = std::make_unique<BlockMatrix>(twice(*pattern));
    problem.aggregates = pattern;
    block_places.resize(std::size_t(16) * vertices.n_local_cells());
    std::uint16_t *next = block_places.data();
    for (unsigned int c = 0; c < vertices.n_local_cells(); ++c)
      for (const unsigned int i : vertices.cell_nodes(c))
        for (const unsigned int j : vertices.cell_nodes(c))
          {
            if (i < vertices.n_owned_nodes())
              {
                const int column =
                  j < vertices.n_owned_nodes() ?
                    j :
                    pattern->local_node(vertices.global_node(j));
                const int place = pattern->place(i, column);
                AssertThrow(place <= std::numeric_limits<std::uint16_t>::max(),
                            dealii::ExcMessage(
                              "A row of the matrix is too long."));
                *next = place;
              }
            ++next;
          }
  }

  // X w = w x arm.
  void
  VertexMotions::CellMatrix::set_ends(
    const unsigned int                         edge,
    const unsigned int                         lane,
    const std::array<dealii::Tensor<1, 3>, 2> &arms)
  {
    for (unsigned int end = 0; end < 2; ++end)
      for (End &found : ends[tetrahedron::edges[edge][end]])
        if (found.edge == edge)
          for (unsigned int a = 0; a < 3; ++a)
            {
              const unsigned int b = (a + 1) % 3, c = (a + 2) % 3;
              found.X[a][b][lane] = arms[end][c];
              found.X[a][c][lane] = -arms[end][b];
            }
  }

  // Cofactors of the edges are gradients of the barycentric coordinates times
  // the determinant D. Returns mu times the volume over D squared: stiffness of
  // a vertex has the trace (4 + lambda / mu) mu volume |gradient|^2 for linear
  // functions, which the vertices' quadratic ones are close to.
  V
  VertexMotions::CellMatrix::shear_stiffness(const V lame_ratio,
                                             V (&cofactors)[4][3]) const
  {
    V edges[3][3];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int a = 0; a < 3; ++a)
        edges[i][a] = vertices[i + 1][a] - vertices[0][a];
    V trace{}, squares{};
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int a = 0; a < 3; ++a)
        {
          const auto        &s = edges[(i + 1) % 3], &t = edges[(i + 2) % 3];
          const unsigned int b = (a + 1) % 3, c = (a + 2) % 3;
          cofactors[i + 1][a] = s[b] * t[c] - s[c] * t[b];
        }
    for (unsigned int a = 0; a < 3; ++a)
      cofactors[0][a] = -(cofactors[1][a] + cofactors[2][a] + cofactors[3][a]);
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int a = 0; a < 3; ++a)
        {
          trace += K[i][i][a][a];
          squares += cofactors[i][a] * cofactors[i][a];
        }
    return trace /
           ((4 + lame_ratio) * (squares + std::numeric_limits<double>::min()));
  }

  void
  VertexMotions::CellMatrix::combine()
  {
    for (unsigned int j = 0; j < 4; ++j)
      {
        // K times the functions of vertex j.
        V products[10][3][6];
        for (unsigned int m = 0; m < 10; ++m)
          {
            auto &product = products[m];
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int b = 0; b < 3; ++b)
                {
                  product[a][b]     = K[m][j][a][b];
                  product[a][3 + b] = V{};
                }
            for (const End &end : ends[j])
              {
                const Block &block = K[m][4 + end.edge];
                for (unsigned int a = 0; a < 3; ++a)
                  for (unsigned int b = 0; b < 3; ++b)
                    product[a][b] += 0.5 * block[a][b];
                add_product(block, end.X, product);
              }
          }
        for (unsigned int i = 0; i < 4; ++i)
          {
            auto &block = A[i][j];
            for (unsigned int b = 0; b < 6; ++b)
              for (unsigned int a = 0; a < 3; ++a)
                {
                  block[a][b]     = products[i][a][b];
                  block[3 + a][b] = V{};
                }
            for (const End &end : ends[i])
              {
                const auto &product = products[4 + end.edge];
                for (unsigned int b = 0; b < 6; ++b)
                  for (unsigned int a = 0; a < 3; ++a)
                    {
                      block[a][b] += 0.5 * product[a][b];
                      block[3 + a][b] += end.X[0][a] * product[0][b] +
                                         end.X[1][a] * product[1][b] +
                                         end.X[2][a] * product[2][b];
                    }
              }
          }
      }
  }

  // size / 4 times the sum over the vertices of |D w - D curl u / 2|^2, with D
  // the determinant; @p length is what w is multiplied with.
  void
  VertexMotions::CellMatrix::add_springs(const V      size,
                                         const double length,
                                         const V (&cofactors)[4][3])
  {
    V determinant{};
    for (unsigned int a = 0; a < 3; ++a)
      determinant += cofactors[1][a] * (vertices[1][a] - vertices[0][a]);
    determinant = determinant / length;
    // Y u = half the cofactor x u.
    Block Y[4]{};
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int a = 0; a < 3; ++a)
        {
          const unsigned int b = (a + 1) % 3, c = (a + 2) % 3;
          Y[i][a][b] = -0.5 * cofactors[i][c];
          Y[i][a][c] = 0.5 * cofactors[i][b];
        }
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        for (unsigned int a = 0; a < 3; ++a)
          {
            for (unsigned int b = 0; b < 3; ++b)
              {
                A[i][j][a][b] +=
                  size * (Y[i][0][a] * Y[j][0][b] + Y[i][1][a] * Y[j][1][b] +
                          Y[i][2][a] * Y[j][2][b]);
                A[i][j][3 + a][b] -= 0.25 * size * determinant * Y[j][a][b];
                A[i][j][a][3 + b] -= 0.25 * size * determinant * Y[i][b][a];
              }
            if (i == j)
              A[i][j][3 + a][3 + a] += 0.25 * size * determinant * determinant;
          }
  }

  void
  VertexMotions::gather(const unsigned int first,
                        const unsigned int n_cells,
                        CellMatrix        &cells) const
  {
    // Lanes without a cell repeat the last one.
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
        const std::uint16_t *place =
          &block_places[std::size_t(16) * (first + lane)];
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = 0; j < 4; ++j, ++place)
            if (nodes[i] < vertices.n_owned_nodes())
              for (unsigned int a = 0; a < 6; ++a)
                {
                  double *const row =
                    problem.matrix->row(2 * nodes[i] + a / 3, a % 3) +
                    std::size_t(6) * *place;
                  for (unsigned int b = 0; b < 6; ++b)
                    if (!is_out(i, a) && !is_out(j, b))
                      row[b] += cells.A[i][j][a][b][lane];
                }
      }
  }

  // The blocks of a face follow each other, and faces have no edges of other
  // cells: each is a cell matrix of its own.
  void
  VertexMotions::add_surface(const SurfaceOperator<double> &surface,
                             CellMatrix                    &cells)
  {
    const auto clear = [&] {
      for (auto &row : cells.K)
        for (Block &block : row)
          for (auto &values : block)
            for (V &value : values)
              value = V{};
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
                                const V            mass) {
                              for (unsigned int a = 0; a < 3; ++a)
                                for (unsigned int b = 0; b < 3; ++b)
                                  cells->K[i][j][a][b] = cells->K[j][i][b][a] =
                                    c_K * K[a][b];
                              cells->mass[i][j] = cells->mass[j][i] = mass;
                            });
      gather(first, n_cells, *cells);
      V       cofactors[4][3];
      const V shear = cells->shear_stiffness(
        load_aligned<batch_size>(coefficients[batch].lame_ratio), cofactors);
      cells->add_mass();
      leave_out_prescribed(first, n_cells, *cells);
      cells->combine();
      cells->add_springs(spring * shear, length, cofactors);
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
