// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_orbit_form_h
#define corotet_operators_orbit_form_h

#include <corotet/base/simd.h>
#include <corotet/discretization/bernstein.h>
#include <corotet/discretization/reference_element.h>

namespace corotet
{
  /**
   * The coefficients of a polynomial in Bernstein form, and sums of them that
   * its values at the points of an orbit share, for the n polynomials of degree
   * 1 (4) and 2 (10); one cell per lane. With these sums, values of degree 2 at
   * 14 points (two orbits of vertices, one of edges) take 45 products and 24
   * sums in place of 140 products.
   *
   *   evaluate(orbit, values): values(i) becomes the value at point i of orbit.
   *
   * For the transposed operation, an object starts with zeros:
   *
   *   add(orbit, factors, values): adds what values contribute; the factors are
   *     the orbit's own or those with its weight;
   *   coefficients(c): c[i] becomes what has been added to polynomial i.
   */
  template <int n>
  class OrbitSums;

  template <>
  class OrbitSums<4>
  {
    using V       = Simd<double>;
    using Factors = std::array<double, PointOrbit::n_factors>;
    using Kind    = PointOrbit::Kind;

  public:
    OrbitSums() = default;

    explicit COROTET_ALWAYS_INLINE
    OrbitSums(const V (&c)[4])
      : all(c[0] + c[1] + c[2] + c[3])
    {
      static_for<4>([&](auto i) { vertex[i] = c[i]; });
    }

    template <typename Values>
    COROTET_ALWAYS_INLINE void
    evaluate(const PointOrbit &orbit, const Values &values) const
    {
      using tetrahedron::edges;
      const Factors &f    = orbit.factors;
      const V        base = f[0] * all;
      switch (orbit.kind)
        {
          case Kind::centre:
            values(0) = base;
            break;
          case Kind::vertices:
            static_for<4>([&](auto i) { values(i) = base + f[1] * vertex[i]; });
            break;
          case Kind::edges:
            static_for<6>([&](auto e) {
              values(e) =
                base + f[1] * (vertex[edges[e][0]] + vertex[edges[e][1]]);
            });
            break;
          case Kind::directed_edges:
            static_for<12>([&](auto i) {
              constexpr auto &edge = edges[i / 2];
              values(i)            = base + f[1] * vertex[edge[i % 2]] +
                          f[2] * vertex[edge[1 - i % 2]];
            });
            break;
        }
    }

    template <typename Values>
    COROTET_ALWAYS_INLINE void
    add(const PointOrbit &orbit, const Factors &f, const Values &values)
    {
      using tetrahedron::edges;
      V sum{};
      switch (orbit.kind)
        {
          case Kind::centre:
            sum = values(0);
            break;
          case Kind::vertices:
            static_for<4>([&](auto i) {
              sum += values(i);
              vertex[i] += f[1] * values(i);
            });
            break;
          case Kind::edges:
            static_for<6>([&](auto e) {
              const V product = f[1] * values(e);
              sum += values(e);
              vertex[edges[e][0]] += product;
              vertex[edges[e][1]] += product;
            });
            break;
          case Kind::directed_edges:
            static_for<12>([&](auto i) {
              constexpr auto &edge = edges[i / 2];
              sum += values(i);
              vertex[edge[i % 2]] += f[1] * values(i);
              vertex[edge[1 - i % 2]] += f[2] * values(i);
            });
            break;
        }
      all += f[0] * sum;
    }

    COROTET_ALWAYS_INLINE void
    coefficients(V (&c)[4]) const
    {
      static_for<4>([&](auto i) { c[i] = vertex[i] + all; });
    }

  private:
    V vertex[4] = {};
    V all{};
  };

  template <>
  class OrbitSums<10>
  {
    using V       = Simd<double>;
    using Factors = std::array<double, PointOrbit::n_factors>;
    using Kind    = PointOrbit::Kind;

  public:
    OrbitSums() = default;

    explicit COROTET_ALWAYS_INLINE
    OrbitSums(const V (&c)[10])
    {
      using tetrahedron::edges;
      static_for<4>([&](auto i) { vertex[i] = c[i]; });
      static_for<6>([&](auto e) {
        edge[e] = c[4 + e];
        edges_at[edges[e][0]] += edge[e];
        edges_at[edges[e][1]] += edge[e];
      });
      all_edges = edges_at[0] + edge[1] + edge[4] + edge[5];
      all = (vertex[0] + vertex[1]) + (vertex[2] + vertex[3]) + 2. * all_edges;
    }

    template <typename Values>
    COROTET_ALWAYS_INLINE void
    evaluate(const PointOrbit &orbit, const Values &values) const
    {
      using tetrahedron::edges;
      const Factors &f    = orbit.factors;
      const V        base = f[0] * all;
      switch (orbit.kind)
        {
          case Kind::centre:
            values(0) = base;
            break;
          case Kind::vertices:
            static_for<4>([&](auto i) {
              values(i) = base + f[1] * vertex[i] + f[2] * edges_at[i];
            });
            break;
          case Kind::edges:
            static_for<6>([&](auto e) {
              values(e) = base + f[1] * (all_edges - edge[opposite[e]]) +
                          f[2] * (vertex[edges[e][0]] + vertex[edges[e][1]]) +
                          f[3] * edge[e];
            });
            break;
          case Kind::directed_edges:
            {
              V first[4], second[4];
              static_for<4>([&](auto i) {
                first[i]  = base + f[2] * vertex[i] + f[3] * edges_at[i];
                second[i] = f[4] * vertex[i] + f[5] * edges_at[i];
              });
              static_for<6>([&](auto e) {
                constexpr int i = edges[e][0], j = edges[e][1];
                const V       both =
                  f[1] * (all_edges - edge[opposite[e]]) + f[6] * edge[e];
                values(2 * e)     = both + first[i] + second[j];
                values(2 * e + 1) = both + first[j] + second[i];
              });
              break;
            }
        }
    }

    template <typename Values>
    COROTET_ALWAYS_INLINE void
    add(const PointOrbit &orbit, const Factors &f, const Values &values)
    {
      using tetrahedron::edges;
      V sum{};
      switch (orbit.kind)
        {
          case Kind::centre:
            sum = values(0);
            break;
          case Kind::vertices:
            static_for<4>([&](auto i) {
              sum += values(i);
              vertex[i] += f[1] * values(i);
              edges_at[i] += f[2] * values(i);
            });
            break;
          case Kind::edges:
            {
              V at_vertices[4] = {};
              static_for<6>([&](auto e) {
                const V value = values(e);
                sum += value;
                at_vertices[edges[e][0]] += value;
                at_vertices[edges[e][1]] += value;
                edge[e] += f[3] * value;
                edge[opposite[e]] -= f[1] * value;
              });
              static_for<4>(
                [&](auto i) { vertex[i] += f[2] * at_vertices[i]; });
              all_edges += f[1] * sum;
              break;
            }
          case Kind::directed_edges:
            {
              V first[4] = {}, second[4] = {};
              static_for<6>([&](auto e) {
                constexpr int i = edges[e][0], j = edges[e][1];
                const V       forth = values(2 * e), back = values(2 * e + 1);
                const V       both = forth + back;
                first[i] += forth;
                second[j] += forth;
                first[j] += back;
                second[i] += back;
                sum += both;
                edge[e] += f[6] * both;
                edge[opposite[e]] -= f[1] * both;
              });
              static_for<4>([&](auto i) {
                vertex[i] += f[2] * first[i] + f[4] * second[i];
                edges_at[i] += f[3] * first[i] + f[5] * second[i];
              });
              all_edges += f[1] * sum;
              break;
            }
        }
      all += f[0] * sum;
    }

    COROTET_ALWAYS_INLINE void
    coefficients(V (&c)[10]) const
    {
      using tetrahedron::edges;
      static_for<4>([&](auto i) { c[i] = vertex[i] + all; });
      const V of_edges = all_edges + 2. * all;
      static_for<6>([&](auto e) {
        c[4 + e] =
          edge[e] + (edges_at[edges[e][0]] + edges_at[edges[e][1]]) + of_edges;
      });
    }

  private:
    /// The edge that shares no vertex with an edge.
    static constexpr int opposite[6] = {5, 3, 4, 1, 2, 0};

    V vertex[4] = {};
    V edge[6]   = {};
    /// Sum of the edges at each vertex.
    V edges_at[4] = {};
    V all_edges{};
    /// The sum of all vertices, and twice that of all edges.
    V all{};
  };
} // namespace corotet

#endif
