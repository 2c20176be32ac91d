// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/gather.h>
#include <corotet/operators/sweep.h>
#include <corotet/operators/with_kernel.h>

namespace corotet
{
  namespace
  {
    // Flat: what it calls becomes one piece of code with constants for counters
    // and registers for arrays; with calls it is six times slower.
    template <typename Kernel, typename T, Terms terms>
    __attribute__((flatten)) void
    sweep_form(const FormData<T> &data,
               const unsigned int first,
               const unsigned int end,
               const T           *source,
               T                 *sums)
    {
      constexpr unsigned int n = n_lanes<T> / batch_size;
      for (unsigned int batch = first; batch < end; batch += n)
        {
          typename Kernel::NodalValues u, v;
          gather_batch<Kernel::n_nodes>(data.batches, batch, source, u);
          Simd<T> masses{};
          if constexpr (terms != Terms::stiffness)
            masses = data.mass_factor *
                     load_aligned<n_lanes<T>>(data.masses[batch / n].mass);
          Kernel::template apply<terms != Terms::mass,
                                 terms != Terms::stiffness>(
            data.coefficients + batch / n, masses, nullptr, u, v);
          scatter_add<Kernel::n_nodes>(v, data.batches.nodes(batch), sums);
        }
    }

    // K_aa = (lambda + mu) D_aa + mu tr D at node i, with D the integral of
    // grad N_i (x) grad N_i.
    template <typename Kernel, typename T, Terms terms>
    __attribute__((flatten)) void
    sweep_diagonal(const FormData<T> &data,
                   const unsigned int first,
                   const unsigned int end,
                   const T *,
                   T *sums)
    {
      constexpr int          n_nodes  = Kernel::n_nodes;
      constexpr auto        &products = Kernel::diagonal_products;
      constexpr unsigned int n        = n_lanes<T> / batch_size;
      for (unsigned int batch = first; batch < end; batch += n)
        {
          const CellCoefficients<T> &cell = data.coefficients[batch / n];
          Simd<T>                    g[9], gg[6][3], v[n_nodes][3];
          static_for<9>([&](auto i) {
            g[i] = load_aligned<n_lanes<T>>(cell.gradients[i]);
          });
          static_for<3>([&](auto a) {
            static_for<3>([&](auto k) {
              gg[k][a]     = g[3 * k + a] * g[3 * k + a];
              gg[3 + k][a] = g[(3 * k + 3) % 9 + a] * g[(3 * k + 6) % 9 + a];
            });
          });
          const Simd<T> ratio =
            T(1) + load_aligned<n_lanes<T>>(cell.lame_ratio);
          Simd<T> masses{};
          if constexpr (terms != Terms::stiffness)
            masses = data.mass_factor *
                     load_aligned<n_lanes<T>>(data.masses[batch / n].mass);
          static_for<n_nodes>([&](auto i) {
            Simd<T> D[3] = {};
            static_for<3>([&](auto a) {
              static_for<6>(
                [&](auto s) { D[a] += T(products.gradient[i][s]) * gg[s][a]; });
            });
            const Simd<T> same =
              D[0] + D[1] + D[2] + T(products.mass[i]) * masses;
            static_for<3>([&](auto a) { v[i][a] = ratio * D[a] + same; });
          });
          scatter_add<n_nodes>(v, data.batches.nodes(batch), sums);
        }
    }

    // F = I + grad u at the centres of the cells.
    template <typename Kernel>
    COROTET_ALWAYS_INLINE void
    deformation_gradient(const CellShapes                   &shapes,
                         const typename Kernel::NodalValues &u,
                         Simd<double> (&F)[3][3])
    {
      Simd<double> by_xi[3][3];
      Kernel::centre_gradient(u, by_xi);
      static_for<3>([&](auto b) {
        static_for<3>([&](auto a) {
          Simd<double> sum = broadcast(a == b ? 1. : 0.);
          static_for<3>([&](auto k) {
            sum += by_xi[a][k] *
                   load_aligned<batch_size>(shapes.inverse_jacobian[3 * k + b]);
          });
          F[a][b] = sum;
        });
      });
    }

    // Rotates the gradients of the cells.
    COROTET_ALWAYS_INLINE void
    store_rotated(const Simd<double> (&R)[3][3],
                  const CellShapes         &shapes,
                  CellCoefficients<double> &coefficients)
    {
      const Simd<double> scale = load_aligned<batch_size>(shapes.scale);
      static_for<3>([&](auto k) {
        Simd<double> g[3];
        static_for<3>([&](auto b) {
          g[b] = scale *
                 load_aligned<batch_size>(shapes.inverse_jacobian[3 * k + b]);
        });
        static_for<3>([&](auto a) {
          store_aligned(R[a][0] * g[0] + R[a][1] * g[1] + R[a][2] * g[2],
                        coefficients.gradients[3 * k + a]);
        });
      });
    }

    // Strain of the body at rest as the rotations see it, sym(R) - I, in the
    // kernel's units.
    template <typename Kernel>
    COROTET_ALWAYS_INLINE void
    strain_offset(const Simd<double> (&R)[3][3],
                  const CellShapes       &shapes,
                  typename Kernel::Strain offset)
    {
      const Simd<double> s =
        load_aligned<batch_size>(shapes.scale) * Kernel::strain_scale;
      static_for<3>([&](auto a) { offset[a] = s * (R[a][a] - 1.); });
      offset[3] = s * (R[1][2] + R[2][1]);
      offset[4] = s * (R[0][2] + R[2][0]);
      offset[5] = s * (R[0][1] + R[1][0]);
    }

    template <typename Kernel, bool rotate, bool with_force>
    __attribute__((flatten)) void
    sweep_elastic(ElasticData       &data,
                  const unsigned int first,
                  const unsigned int end,
                  const double      *source,
                  double            *sums)
    {
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u, v;
          gather_differences<Kernel::n_nodes>(data.batches, batch, source, u);
          Simd<double> R[3][3];
          if constexpr (rotate)
            {
              Simd<double> F[3][3];
              deformation_gradient<Kernel>(shapes, u, F);
              const PolarLanes lanes = polar_decomposition(F, R);
              data.counts.add(lanes, shapes);
              store_rotated(R, shapes, data.new_coefficients[batch]);
            }
          else
            rotations_of(data, batch, R);
          if constexpr (with_force)
            {
              typename Kernel::Strain offset;
              strain_offset<Kernel>(R, shapes, offset);
              Kernel::template apply<true, false, true>(
                &data.coefficients[batch], Simd<double>{}, &offset, u, v);
              scatter_add<Kernel::n_nodes>(v, data.batches.nodes(batch), sums);
            }
        }
    }

    template <bool rotate, bool with_force>
    ElasticSweep
    elastic_sweep(const Element element)
    {
      ElasticSweep result = nullptr;
      with_kernel<double>(element, [&](const auto kernel) {
        using Kernel = typename decltype(kernel)::type;
        result       = sweep_elastic<Kernel, rotate, with_force>;
      });
      return result;
    }
  } // namespace

  template <typename T>
  FormSweep<T>
  form_sweep(const Element element, const Terms terms)
  {
    FormSweep<T> result = nullptr;
    with_kernel<T>(element, [&](const auto kernel) {
      using Kernel = typename decltype(kernel)::type;
      result =
        terms == Terms::stiffness ? sweep_form<Kernel, T, Terms::stiffness> :
        terms == Terms::mass      ? sweep_form<Kernel, T, Terms::mass> :
                               sweep_form<Kernel, T, Terms::stiffness_and_mass>;
    });
    return result;
  }

  template <typename T>
  FormSweep<T>
  diagonal_sweep(const Element element, const Terms terms)
  {
    Assert(terms != Terms::mass, dealii::ExcNotImplemented());
    FormSweep<T> result = nullptr;
    with_kernel<T>(element, [&](const auto kernel) {
      using Kernel = typename decltype(kernel)::type;
      result       = terms == Terms::stiffness ?
                       sweep_diagonal<Kernel, T, Terms::stiffness> :
                       sweep_diagonal<Kernel, T, Terms::stiffness_and_mass>;
    });
    return result;
  }

  template FormSweep<double>
  form_sweep<double>(const Element, const Terms);
  template FormSweep<float>
  form_sweep<float>(const Element, const Terms);
  template FormSweep<double>
  diagonal_sweep<double>(const Element, const Terms);
  template FormSweep<float>
  diagonal_sweep<float>(const Element, const Terms);

  double
  stiffness_scale(const Element element)
  {
    double result = 0;
    with_kernel<double>(element, [&](const auto kernel) {
      result = decltype(kernel)::type::stiffness_scale;
    });
    return result;
  }

  double
  mass_scale(const Element element)
  {
    double result = 0;
    with_kernel<double>(element, [&](const auto kernel) {
      result = decltype(kernel)::type::mass_scale;
    });
    return result;
  }

  ElasticSweep
  rotation_sweep(const Element element)
  {
    return elastic_sweep<true, false>(element);
  }

  ElasticSweep
  force_sweep(const Element element)
  {
    return elastic_sweep<false, true>(element);
  }

  ElasticSweep
  rotation_and_force_sweep(const Element element)
  {
    return elastic_sweep<true, true>(element);
  }
} // namespace corotet
