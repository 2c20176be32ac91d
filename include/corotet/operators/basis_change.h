// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_basis_change_h
#define corotet_operators_basis_change_h

#include <corotet/base/simd.h>
#include <corotet/discretization/bernstein.h>

namespace corotet
{
  /// Calls @p function(i) for i = 0 .. n - 1, on cells of degree p. The calls
  /// are unrolled, except at degree 3: kernels of that degree are long, and
  /// processors would wait longer for the code than for the numbers, which are
  /// in memory anyway.
  template <int p, int n, typename Function>
  COROTET_ALWAYS_INLINE void
  repeat(const Function &function)
  {
    if constexpr (p < 3)
      static_for<n>(function);
    else
      {
#pragma GCC unroll 1
        for (int i = 0; i < n; ++i)
          function(i);
      }
  }

  /**
   * Changes between values at the nodes of the element of degree p and
   * Bernstein coefficients, for n_lanes<T> cells.
   *
   * At degree 3 the contribution of an edge's vertices and nodes is divided
   * into the part that is even when the edge is reversed and the part that is
   * odd, and faces share the sums of edges: 36 products and 48 sums in place of
   * 88 products with sums for the entries of bernstein::from_lagrange. Degree 2
   * uses these entries.
   */
  template <int p, typename T>
  struct BasisChange
  {
    using V = Simd<T>;

    static constexpr int n_nodes = bernstein::size<p>;

    /// Bernstein coefficients from the values of one component at the nodes.
    static COROTET_ALWAYS_INLINE void
    to_bernstein(V (&u)[n_nodes])
    {
      if constexpr (p == 2)
        static_for<6>([&](auto e) {
          V sum{};
          static_for<n_nodes>([&](auto j) {
            constexpr double entry = bernstein::from_lagrange<p>[4 + e][j];
            if constexpr (entry != 0)
              sum += T(entry) * u[j];
          });
          u[4 + e] = sum;
        });
      if constexpr (p == 3)
        {
          V vertices[4], sums[6];
          static_for<4>([&](auto i) { vertices[i] = u[i]; });
          static_for<6>([&](auto e) {
            const V &first = vertices[tetrahedron::edges[e][0]];
            const V &last  = vertices[tetrahedron::edges[e][1]];
            V       &c     = u[first_node_of_edge(e)];
            V       &d     = u[first_node_of_edge(e) + 1];
            sums[e]        = c + d;
            const V even   = of_edge.even_edge * sums[e] +
                           of_edge.even_vertex * (first + last);
            const V odd =
              of_edge.odd_edge * (c - d) + of_edge.odd_vertex * (first - last);
            c = even + odd;
            d = even - odd;
          });
          static_for<4>([&](auto f) {
            constexpr auto &v = tetrahedron::faces[f];
            constexpr auto &e = tetrahedron::edges_of_faces[f];
            V              &c = u[16 + f];
            c                 = of_face.face * c +
                of_face.edge * (sums[e[0]] + sums[e[1]] + sums[e[2]]) +
                of_face.vertex *
                  (vertices[v[0]] + vertices[v[1]] + vertices[v[2]]);
          });
        }
    }

    /// The transpose of to_bernstein().
    static COROTET_ALWAYS_INLINE void
    to_lagrange_transposed(V (&v)[n_nodes])
    {
      if constexpr (p == 2)
        {
          V c[n_nodes];
          static_for<n_nodes>([&](auto i) { c[i] = v[i]; });
          static_for<n_nodes>([&](auto j) {
            V sum{};
            static_for<n_nodes>([&](auto i) {
              constexpr double entry = bernstein::from_lagrange<p>[i][j];
              if constexpr (entry == 1)
                sum += c[i];
              else if constexpr (entry != 0)
                sum += T(entry) * c[i];
            });
            v[j] = sum;
          });
        }
      if constexpr (p == 3)
        {
          // Sums for each vertex: the even and the odd parts of its edges, and
          // its faces. Sums for each edge: its faces.
          V even[4] = {}, odd[4] = {}, faces[4] = {}, faces_of_edges[6] = {};
          static_for<4>([&](auto f) {
            V &c = v[16 + f];
            static_for<3>([&](auto k) {
              faces_of_edges[tetrahedron::edges_of_faces[f][k]] += c;
              faces[tetrahedron::faces[f][k]] += c;
            });
            c = of_face.face * c;
          });
          static_for<6>([&](auto e) {
            constexpr int i          = tetrahedron::edges[e][0];
            constexpr int j          = tetrahedron::edges[e][1];
            V            &c          = v[first_node_of_edge(e)];
            V            &d          = v[first_node_of_edge(e) + 1];
            const V       sum        = c + d;
            const V       difference = c - d;
            even[i] += sum;
            even[j] += sum;
            odd[i] += difference;
            odd[j] -= difference;
            const V both =
              of_edge.even_edge * sum + of_face.edge * faces_of_edges[e];
            c = both + of_edge.odd_edge * difference;
            d = both - of_edge.odd_edge * difference;
          });
          static_for<4>([&](auto i) {
            v[i] += of_edge.even_vertex * even[i] +
                    of_edge.odd_vertex * odd[i] + of_face.vertex * faces[i];
          });
        }
    }

  private:
    static constexpr int
    first_node_of_edge(const int e)
    {
      return 4 + 2 * e;
    }

    /// At degree 3, the even and odd shares of an edge's vertices and nodes in
    /// its coefficients. Shares in the first coefficient are their sums, shares
    /// in the second one their differences.
    struct OfEdge
    {
      T even_vertex, odd_vertex, even_edge, odd_edge;
    };
    static constexpr OfEdge of_edge = [] {
      constexpr const auto &row   = bernstein::from_lagrange<3>[4];
      constexpr double      first = row[tetrahedron::edges[0][0]];
      constexpr double      last  = row[tetrahedron::edges[0][1]];
      return OfEdge{T((first + last) / 2),
                    T((first - last) / 2),
                    T((row[4] + row[5]) / 2),
                    T((row[4] - row[5]) / 2)};
    }();

    /// At degree 3, the shares of a face's vertices, nodes on edges and node in
    /// its coefficient.
    struct OfFace
    {
      T vertex, edge, face;
    };
    static constexpr OfFace of_face = [] {
      constexpr const auto &row = bernstein::from_lagrange<3>[16];
      return OfFace{
        T(row[tetrahedron::faces[0][0]]),
        T(row[first_node_of_edge(tetrahedron::edges_of_faces[0][0])]),
        T(row[16])};
    }();
  };
} // namespace corotet

#endif
