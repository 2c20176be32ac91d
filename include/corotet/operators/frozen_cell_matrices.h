// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_frozen_cell_matrices_h
#define corotet_operators_frozen_cell_matrices_h

#include <corotet/discretization/cell_batches.h>
#include <corotet/discretization/nodes.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/operators/curved_kernel.h>
#include <corotet/operators/factored_kernel.h>

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <vector>

namespace corotet
{
  /**
   * The matrices of cells with frozen rotations: stiffness and consistent mass
   * of one element, for the cells of a batch side by side.
   *
   * @p nodes must outlive this object.
   */
  class FrozenCellMatrices
  {
  public:
    using V     = Simd<double>;
    using Block = V[3][3];

    explicit FrozenCellMatrices(const Nodes &nodes)
      : nodes(nodes)
      , reference(ReferenceElement::of(nodes.element()))
    {}

    /// Calls @p function(first cell, number of cells) for the local cells of
    /// each batch, with ghost cells.
    template <typename Function>
    void
    for_each_batch(const Function &function) const
    {
      const CellBatches &batches = nodes.batches();
      for (unsigned int batch = 0; batch < batches.n_batches(); ++batch)
        if (const auto [first, n] = batches.cells(batch); n > 0)
          function(first, n);
    }

    /// Calls @p function(i, j, K, m) for all pairs of nodes i <= j of the cells
    /// of a batch, from @p first on: K is the block of the stiffness, m the
    /// diagonal entry of the block of mass, computed with @p coefficients and
    /// @p masses.
    template <typename Function>
    void
    for_each_block(const unsigned int              first,
                   const CellCoefficients<double> &coefficients,
                   const V                         masses,
                   const Function                 &function)
    {
      const unsigned int batch  = nodes.batches().place(first).first;
      const auto        *curved = nodes.batches().curved();
      if (curved != nullptr && curved->has(batch))
        curved_blocks(*curved, batch, coefficients, masses, function);
      else
        straight_blocks(coefficients, masses, function);
    }

  private:
    // K = mu (lambda / mu D + D^T + tr D I).
    static COROTET_ALWAYS_INLINE void
    isotropic_block(const Block &D, const V lame_ratio, Block &K)
    {
      const V trace = D[0][0] + D[1][1] + D[2][2];
      static_for<9>([&](auto ab) {
        constexpr int a = ab / 3, b = ab % 3;
        K[a][b] = lame_ratio * D[a][b] + D[b][a];
        if constexpr (a == b)
          K[a][b] += trace;
      });
    }

    // The block of nodes i, j, with D the integral of grad N_i (x) grad N_j,
    // computed from the means of products of derivatives of N_i and N_j and the
    // gradients of the kernel.
    static COROTET_ALWAYS_INLINE void
    stiffness_block(const double *products,
                    const V (&g)[9],
                    const V lame_ratio,
                    Block  &K)
    {
      Block half, D;
      static_for<9>([&](auto kb) {
        constexpr std::size_t k = kb / 3, b = kb % 3;
        half[k][b] = products[3 * k] * g[b] + products[3 * k + 1] * g[3 + b] +
                     products[3 * k + 2] * g[6 + b];
      });
      static_for<9>([&](auto ab) {
        constexpr int a = ab / 3, b = ab % 3;
        D[a][b] =
          g[a] * half[0][b] + g[3 + a] * half[1][b] + g[6 + a] * half[2][b];
      });
      isotropic_block(D, lame_ratio, K);
    }

    template <typename Function>
    void
    straight_blocks(const CellCoefficients<double> &coefficients,
                    const V                         masses,
                    const Function                 &function) const
    {
      V g[9];
      for (unsigned int i = 0; i < 9; ++i)
        g[i] = load_aligned<batch_size>(coefficients.gradients[i]);
      const V ratio = load_aligned<batch_size>(coefficients.lame_ratio);
      for (unsigned int i = 0; i < reference.n_nodes; ++i)
        for (unsigned int j = i; j < reference.n_nodes; ++j)
          {
            Block K;
            stiffness_block(&reference.gradient_products(i, j, 0), g, ratio, K);
            function(i, j, K, V(masses * reference.mass(i, j)));
          }
    }

    template <typename Function>
    void
    curved_blocks(const CurvedBatches            &curved,
                  const unsigned int              batch,
                  const CellCoefficients<double> &coefficients,
                  const V                         masses,
                  const Function                 &function)
    {
      const unsigned int n = reference.n_nodes, n_points = curved.n_points();
      const auto        &values = curved.shapes().values;
      const V ratio = load_aligned<batch_size>(coefficients.lame_ratio);

      // Gradients of the shape functions at the points, and weights.
      point_gradients.resize(std::size_t(n_points) * n);
      point_weights.resize(n_points);
      for (unsigned int q = 0; q < n_points; ++q)
        {
          using Kernel = CurvedKernel<1, double>;
          const Kernel::Point point(curved, batch, q);
          V                   g[3][3];
          Kernel::gradients(point, coefficients, g);
          point_weights[q] = point.number(9);
          const double *dN = &curved.shapes().gradients(q, 0, 0);
          for (unsigned int i = 0; i < n; ++i, dN += 3)
            for (unsigned int a = 0; a < 3; ++a)
              point_gradients[q * n + i][a] =
                dN[0] * g[0][a] + dN[1] * g[1][a] + dN[2] * g[2][a];
        }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i; j < n; ++j)
          {
            Block D{}, K;
            V     mass{};
            for (unsigned int q = 0; q < n_points; ++q)
              {
                const auto &gi = point_gradients[q * n + i];
                const auto &gj = point_gradients[q * n + j];
                static_for<9>([&](auto ab) {
                  D[ab / 3][ab % 3] +=
                    point_weights[q] * gi[ab / 3] * gj[ab % 3];
                });
                mass +=
                  masses * point_weights[q] * (values[q][i] * values[q][j]);
              }
            isotropic_block(D, ratio, K);
            function(i, j, K, mass);
          }
    }

    const Nodes            &nodes;
    const ReferenceElement &reference;

    /// Data of the present curved batch, [point][node] and [point].
    dealii::AlignedVector<std::array<V, 3>> point_gradients;
    dealii::AlignedVector<V>                point_weights;
  };
} // namespace corotet

#endif
