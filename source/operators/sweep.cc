// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/curved_kernel.h>
#include <corotet/operators/gather.h>
#include <corotet/operators/sweep.h>
#include <corotet/operators/with_kernel.h>

namespace corotet
{
  namespace
  {
    // Flat: what it calls becomes one piece of code with constants for counters
    // and registers for arrays; with calls it is six times slower.
    template <typename Kernel, typename T, Terms terms, typename IsCurved>
    __attribute__((flatten)) void
    run_form(const IsCurved,
             const FormData<T> &data,
             const unsigned int first,
             const unsigned int end,
             const T           *source,
             T                 *sums)
    {
      constexpr bool         with_stiffness = terms != Terms::mass;
      constexpr bool         with_mass      = terms != Terms::stiffness;
      constexpr unsigned int n              = n_lanes<T> / batch_size;
      for (unsigned int batch = first; batch < end; batch += n)
        {
          typename Kernel::NodalValues u, v;
          gather_batch<Kernel::n_nodes>(data.batches, batch, source, u);
          Simd<T> masses{};
          if constexpr (with_mass)
            masses = data.mass_factor *
                     load_aligned<n_lanes<T>>(data.masses[batch / n].mass);
          if constexpr (IsCurved::value)
            CurvedKernel<Kernel::n_nodes, T>::template apply<with_stiffness,
                                                             with_mass>(
              *data.batches.curved(),
              batch,
              data.coefficients + batch / n,
              T(1 / Kernel::stiffness_scale),
              masses * T(1 / Kernel::mass_scale),
              u,
              v);
          else
            Kernel::template apply<with_stiffness, with_mass>(
              data.coefficients + batch / n, masses, nullptr, u, v);
          scatter_add<Kernel::n_nodes>(v, data.batches.nodes(batch), sums);
        }
    }

    template <typename Kernel, typename T, Terms terms>
    void
    sweep_form(const FormData<T> &data,
               const unsigned int first,
               const unsigned int end,
               const T           *source,
               T                 *sums)
    {
      for_each_kind(data.batches,
                    first,
                    end,
                    [&](const auto begin, const auto stop, const auto curved) {
                      run_form<Kernel, T, terms>(
                        curved, data, begin, stop, source, sums);
                    });
    }

    // K_aa = (lambda + mu) D_aa + mu tr D at node i, with D the integral of
    // grad N_i (x) grad N_i.
    template <typename Kernel, typename T, Terms terms>
    __attribute__((flatten)) void
    run_diagonal(const std::false_type,
                 const FormData<T> &data,
                 const unsigned int first,
                 const unsigned int end,
                 T                 *sums)
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

    template <typename Kernel, typename T, Terms terms>
    __attribute__((flatten)) void
    run_diagonal(const std::true_type,
                 const FormData<T> &data,
                 const unsigned int first,
                 const unsigned int end,
                 T                 *sums)
    {
      constexpr bool         with_mass = terms != Terms::stiffness;
      constexpr unsigned int n         = n_lanes<T> / batch_size;
      for (unsigned int batch = first; batch < end; batch += n)
        {
          Simd<T> masses{}, v[Kernel::n_nodes][3];
          if constexpr (with_mass)
            masses = data.mass_factor *
                     load_aligned<n_lanes<T>>(data.masses[batch / n].mass);
          CurvedKernel<Kernel::n_nodes, T>::template diagonal<with_mass>(
            *data.batches.curved(),
            batch,
            data.coefficients[batch / n],
            masses,
            v);
          scatter_add<Kernel::n_nodes>(v, data.batches.nodes(batch), sums);
        }
    }

    template <typename Kernel, typename T, Terms terms>
    void
    sweep_diagonal(const FormData<T> &data,
                   const unsigned int first,
                   const unsigned int end,
                   const T *,
                   T *sums)
    {
      for_each_kind(data.batches,
                    first,
                    end,
                    [&](const auto begin, const auto stop, const auto curved) {
                      run_diagonal<Kernel, T, terms>(
                        curved, data, begin, stop, sums);
                    });
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
} // namespace corotet
