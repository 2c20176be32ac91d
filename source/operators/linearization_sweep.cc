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

    template <int n_nodes, Tangent tangent, typename IsCurved>
    __attribute__((flatten)) void
    linearize_at_points(const IsCurved          is_curved,
                        const ReferenceElement &reference,
                        const ElasticData      &data,
                        const unsigned int      first,
                        const unsigned int      end,
                        const double           *displacement,
                        double                 *linearization,
                        unsigned int           &n_clamped)
    {
      using Kernel = QuadratureKernel<n_nodes>;
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u;
          typename Kernel::Geometry    g;
          Kernel::load(data, batch, displacement, g, u);
          const V     mu = lanes(shapes.mu), lambda = lanes(shapes.lambda);
          const auto &rule =
            cell_rule(is_curved, reference, data.batches, batch);
          Writer numbers{
            linearization +
            linearization_start<IsCurved::value>(
              reference, data.batches, data.rotation, tangent, batch)};
          unsigned int clamped = 0;
          for (unsigned int q = 0; q < n_points(rule); ++q)
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

    template <int n_nodes, Rotation rotation, typename IsCurved>
    __attribute__((flatten)) void
    linearize_by_cell(const IsCurved          is_curved,
                      const ReferenceElement &reference,
                      const ElasticData      &data,
                      const unsigned int      first,
                      const unsigned int      end,
                      const double           *displacement,
                      double                 *linearization,
                      unsigned int           &n_clamped)
    {
      using Kernel = QuadratureKernel<n_nodes>;
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
          const auto &rule =
            cell_rule(is_curved, reference, data.batches, batch);
          Writer numbers{
            linearization +
            linearization_start<IsCurved::value>(
              reference, data.batches, rotation, Tangent::consistent, batch)};
          V R[3][3], B[3][3], S[6], G_inverse[6], moment[3]{};
          rotations_of(data, batch, R);
          Kernel::gradient(reference.centre, 0, g, u, B);
          add_transposed(R, B);
          symmetric_part(B, S);
          count(inverse_spin_tensor(S, G_inverse), shapes, n_clamped);
          numbers.write(G_inverse);
          if constexpr (rotation == Rotation::cell_centre_variational)
            numbers.write(S);
          for (unsigned int q = 0; q < n_points(rule); ++q)
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
                  add_moment(weight_at(rule, q) * lanes(shapes.volume),
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

    template <int n_nodes, Rotation rotation, Tangent tangent>
    void
    linearize(const ReferenceElement &reference,
              const ElasticData      &data,
              const unsigned int      first,
              const unsigned int      end,
              const double           *displacement,
              double                 *linearization,
              unsigned int           &n_clamped)
    {
      for_each_kind(data.batches,
                    first,
                    end,
                    [&](const auto begin, const auto stop, const auto curved) {
                      const auto run = [&](const auto &function) {
                        function(curved,
                                 reference,
                                 data,
                                 begin,
                                 stop,
                                 displacement,
                                 linearization,
                                 n_clamped);
                      };
                      using IsCurved = std::remove_const_t<decltype(curved)>;
                      if constexpr (rotation == Rotation::quadrature_points)
                        run(linearize_at_points<n_nodes, tangent, IsCurved>);
                      else
                        run(linearize_by_cell<n_nodes, rotation, IsCurved>);
                    });
    }
  } // namespace

  unsigned int
  linearization_size(const unsigned int n_points,
                     const Rotation     rotation,
                     const Tangent      tangent)
  {
    if (rotation == Rotation::quadrature_points)
      return (tangent == Tangent::consistent ? 15 : 9) * n_points;
    return (rotation == Rotation::cell_centre ? 6 : 15) + 9 * n_points;
  }

  std::size_t
  linearization_size(const ReferenceElement &reference,
                     const CellBatches      &batches,
                     const Rotation          rotation,
                     const Tangent           tangent)
  {
    std::size_t size =
      std::size_t(batches.n_owned_batches()) *
      linearization_size(n_points(reference.stiffness_rule), rotation, tangent);
    if (const CurvedBatches *curved = batches.curved())
      size += std::size_t(curved->n_batches()) *
              linearization_size(curved->n_points(), rotation, tangent);
    return batch_size * size;
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
                   result = linearize<decltype(kernel)::type::n_nodes,
                                      decltype(r)::value,
                                      decltype(t)::value>;
                 });
    return result;
  }
} // namespace corotet
