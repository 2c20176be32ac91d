// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/gather.h>
#include <corotet/operators/quadrature_kernel.h>
#include <corotet/operators/rotated_frame.h>
#include <corotet/operators/with_tangent.h>

namespace corotet
{
  namespace
  {
    using V = Simd<double>;

    // Stores numbers, one register after another.
    struct Writer
    {
      double *next;

      template <int n>
      COROTET_ALWAYS_INLINE void
      write(const V (&values)[n])
      {
        static_for<n>(
          [&](auto i) { store_aligned(values[i], next + i * batch_size); });
        next += n * batch_size;
      }

      COROTET_ALWAYS_INLINE void
      write(const V (&values)[3][3])
      {
        static_for<9>([&](auto i) {
          store_aligned(values[i / 3][i % 3], next + i * batch_size);
        });
        next += 9 * batch_size;
      }
    };

    COROTET_ALWAYS_INLINE void
    count(unsigned int clamped, const CellShapes &shapes, unsigned int &n)
    {
      if (__builtin_expect(clamped != 0, 0))
        for (unsigned int lane = 0; lane < batch_size; ++lane)
          n += (clamped >> lane & 1u) != 0 && shapes.volume[lane] > 0;
    }

    template <int n_nodes, Tangent tangent>
    __attribute__((flatten)) void
    linearize_at_points(const ReferenceElement &reference,
                        const ElasticData      &data,
                        const unsigned int      first,
                        const unsigned int      end,
                        const double           *displacement,
                        double                 *linearization,
                        unsigned int           &n_clamped)
    {
      using Kernel     = QuadratureKernel<n_nodes>;
      const auto &rule = reference.stiffness_rule;
      const auto  size =
        batch_size * linearization_size(reference, data.rotation, tangent);
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u;
          typename Kernel::Geometry    g;
          Kernel::load(data, batch, displacement, g, u);
          const V      mu = lanes(shapes.mu), lambda = lanes(shapes.lambda);
          Writer       numbers{linearization + size * std::size_t(batch)};
          unsigned int clamped = 0;
          for (unsigned int q = 0; q < rule.weights.size(); ++q)
            {
              V F[3][3], R[3][3];
              Kernel::gradient(rule, q, g, u, F);
              add_identity(F);
              polar_decomposition(F, R);
              numbers.write(R);
              if constexpr (tangent == Tangent::consistent)
                {
                  V S[6], T[6];
                  stretch(R, F, S);
                  clamped |= rotation_stiffness(lambda, mu, S, T);
                  numbers.write(T);
                }
            }
          count(clamped, shapes, n_clamped);
        }
    }

    template <int n_nodes, Rotation rotation>
    __attribute__((flatten)) void
    linearize_by_cell(const ReferenceElement &reference,
                      const ElasticData      &data,
                      const unsigned int      first,
                      const unsigned int      end,
                      const double           *displacement,
                      double                 *linearization,
                      unsigned int           &n_clamped)
    {
      using Kernel     = QuadratureKernel<n_nodes>;
      const auto &rule = reference.stiffness_rule;
      const auto  size =
        batch_size *
        linearization_size(reference, rotation, Tangent::consistent);
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u;
          typename Kernel::Geometry    g;
          gather_differences<Kernel::n_nodes>(data.batches,
                                              batch,
                                              displacement,
                                              u);
          load_rotated(data, batch, g);
          Writer numbers{linearization + size * std::size_t(batch)};
          V      R[3][3], B[3][3], S[6], G_inverse[6], moment[3]{};
          rotations_of(data, batch, R);
          Kernel::gradient(reference.centre, 0, g, u, B);
          add_transposed(R, B);
          symmetric_part(B, S);
          count(inverse_spin_tensor(S, G_inverse), shapes, n_clamped);
          numbers.write(G_inverse);
          if constexpr (rotation == Rotation::cell_centre_variational)
            numbers.write(S);
          for (unsigned int q = 0; q < rule.weights.size(); ++q)
            {
              Kernel::gradient(rule, q, g, u, B);
              add_transposed(R, B);
              numbers.write(B);
              if constexpr (rotation == Rotation::cell_centre_variational)
                {
                  V sigma[3][3];
                  stress_of_stretch(lanes(shapes.lambda),
                                    lanes(shapes.mu),
                                    B,
                                    sigma);
                  add_moment(rule.weights[q] * lanes(shapes.volume),
                             sigma,
                             B,
                             moment);
                }
            }
          if constexpr (rotation == Rotation::cell_centre_variational)
            {
              V n[3];
              symmetric_times(G_inverse, moment, n);
              numbers.write(n);
            }
        }
    }
  } // namespace

  unsigned int
  linearization_size(const ReferenceElement &reference,
                     const Rotation          rotation,
                     const Tangent           tangent)
  {
    const unsigned int n_points = reference.stiffness_rule.weights.size();
    if (rotation == Rotation::quadrature_points)
      return (tangent == Tangent::consistent ? 15 : 9) * n_points;
    return (rotation == Rotation::cell_centre ? 6 : 15) + 9 * n_points;
  }

  LinearizationSweep
  linearization_sweep(const Element  element,
                      const Rotation rotation,
                      const Tangent  tangent)
  {
    LinearizationSweep result = nullptr;
    with_tangent(element,
                 rotation,
                 tangent,
                 [&](const auto kernel, const auto r, const auto t) {
                   constexpr int      n_nodes = decltype(kernel)::type::n_nodes;
                   constexpr Rotation rotation = decltype(r)::value;
                   if constexpr (rotation == Rotation::quadrature_points)
                     result = linearize_at_points<n_nodes, decltype(t)::value>;
                   else
                     result = linearize_by_cell<n_nodes, rotation>;
                 });
    return result;
  }
} // namespace corotet
