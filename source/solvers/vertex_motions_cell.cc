// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "vertex_motions_cell.h"

#include <corotet/discretization/tetrahedron.h>


namespace corotet
{
  namespace
  {
    using V     = FrozenCellMatrices::V;
    using Block = FrozenCellMatrices::Block;

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

  // Sets X with X w = w x arm.
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
  // the determinant D. Returns mu times the volume over D squared: the
  // stiffness of a vertex has the trace (4 + lambda / mu) mu volume
  // |gradient|^2 for linear functions, which the vertices' quadratic ones
  // resemble.
  V
  VertexMotions::CellMatrix::shear_stiffness(const V lame_ratio,
                                             V (&cofactors)[4][3]) const
  {
    V edges[3][3];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int a = 0; a < 3; ++a)
        edges[i][a] = vertices[i + 1][a] - vertices[0][a];
    V squares{};
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
        squares += cofactors[i][a] * cofactors[i][a];
    // In a cell that is crushed to a line or a point the cofactors are only
    // round-off.
    V lengths{};
    for (const auto &edge : edges)
      for (const V component : edge)
        lengths += component * component;
    return squares > 1e-30 * lengths * lengths ?
             trace() / ((4 + lame_ratio) * squares) :
             V{};
  }

  V
  VertexMotions::CellMatrix::trace() const
  {
    V sum{};
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int a = 0; a < 3; ++a)
        sum += K[i][i][a][a];
    return sum;
  }

  void
  VertexMotions::CellMatrix::combine()
  {
    for (unsigned int j = 0; j < 4; ++j)
      {
        // The products of K and the functions of vertex j.
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

  // Adds size / 4 times the sum over the vertices of |D w - D curl u / 2|^2,
  // with the determinant D; @p length is the factor of w. @p least resists
  // rotations in crushed cells, where D is zero.
  void
  VertexMotions::CellMatrix::add_springs(const V      size,
                                         const double length,
                                         const V (&cofactors)[4][3],
                                         const V least)
  {
    V determinant{};
    for (unsigned int a = 0; a < 3; ++a)
      determinant += cofactors[1][a] * (vertices[1][a] - vertices[0][a]);
    determinant    = determinant / length;
    const V spring = 0.25 * size * determinant * determinant;
    // Y u is half the cross product of the cofactor and u.
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
              A[i][j][3 + a][3 + a] += spring < least ? least : spring;
          }
  }
} // namespace corotet
