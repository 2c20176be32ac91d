// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/batch_sweep.h>
#include <corotet/operators/curved_kernel.h>
#include <corotet/operators/gather.h>
#include <corotet/operators/sweep.h>

namespace corotet
{
  namespace
  {
    // Computes K source and M source.
    template <typename Kernel, typename T, Terms terms>
    struct Form
    {
      using Data   = const FormData<T>;
      using Number = T;

      static constexpr bool         with_stiffness = terms != Terms::mass;
      static constexpr bool         with_mass      = terms != Terms::stiffness;
      static constexpr unsigned int n_batches      = n_lanes<T> / batch_size;

      static COROTET_ALWAYS_INLINE void
      fetch(Data &data, const unsigned int batch)
      {
        if constexpr (with_stiffness)
          fetch_object(data.coefficients + batch / n_batches);
        if constexpr (with_mass)
          fetch_object(data.masses + batch / n_batches);
      }

      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved,
            Data              &data,
            const unsigned int batch,
            const T           *source,
            T                 *sums)
      {
        typename Kernel::NodalValues u, v;
        gather_batch<Kernel::n_nodes>(data.batches, batch, source, u);
        Simd<T> masses{};
        if constexpr (with_mass)
          masses = data.mass_factor * load_aligned<n_lanes<T>>(
                                        data.masses[batch / n_batches].mass);
        if constexpr (IsCurved::value)
          CurvedKernel<Kernel::n_nodes, T>::template apply<with_stiffness,
                                                           with_mass>(
            *data.batches.curved(),
            batch,
            data.coefficients + batch / n_batches,
            T(1 / Kernel::stiffness_scale),
            masses * T(1 / Kernel::mass_scale),
            u,
            v);
        else
          Kernel::template apply<with_stiffness, with_mass>(
            data.coefficients + batch / n_batches, masses, nullptr, u, v);
        scatter_add<Kernel::n_nodes>(data.batches, batch, v, sums);
      }
    };

    // Computes the diagonal of K + mass_factor M: K_aa = (lambda + mu) D_aa +
    // mu tr D at node i, with D the integral of grad N_i (x) grad N_i.
    template <typename Kernel, typename T, Terms terms>
    struct Diagonal
    {
      using Data   = const FormData<T>;
      using Number = T;

      static constexpr bool         with_mass = terms != Terms::stiffness;
      static constexpr unsigned int n_batches = n_lanes<T> / batch_size;

      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved,
            Data              &data,
            const unsigned int batch,
            const T *,
            T *sums)
      {
        const CellCoefficients<T> &cell = data.coefficients[batch / n_batches];
        Simd<T>                    masses{};
        if constexpr (with_mass)
          masses = data.mass_factor * load_aligned<n_lanes<T>>(
                                        data.masses[batch / n_batches].mass);
        typename Kernel::NodalValues v;
        if constexpr (IsCurved::value)
          CurvedKernel<Kernel::n_nodes, T>::template diagonal<with_mass>(
            *data.batches.curved(), batch, cell, masses, v);
        else
          of_straight_cells(cell, masses, v);
        scatter_add<Kernel::n_nodes>(data.batches, batch, v, sums);
      }

    private:
      static COROTET_ALWAYS_INLINE void
      of_straight_cells(const CellCoefficients<T>    &cell,
                        const Simd<T>                 masses,
                        typename Kernel::NodalValues &v)
      {
        constexpr auto &products = Kernel::diagonal_products;
        Simd<T>         g[9], gg[6][3];
        static_for<9>(
          [&](auto i) { g[i] = load_aligned<n_lanes<T>>(cell.gradients[i]); });
        static_for<3>([&](auto a) {
          static_for<3>([&](auto k) {
            gg[k][a]     = g[3 * k + a] * g[3 * k + a];
            gg[3 + k][a] = g[(3 * k + 3) % 9 + a] * g[(3 * k + 6) % 9 + a];
          });
        });
        const Simd<T> ratio = T(1) + load_aligned<n_lanes<T>>(cell.lame_ratio);
        static_for<Kernel::n_nodes>([&](auto i) {
          Simd<T> D[3] = {};
          static_for<3>([&](auto a) {
            static_for<6>(
              [&](auto s) { D[a] += T(products.gradient[i][s]) * gg[s][a]; });
          });
          const Simd<T> same =
            D[0] + D[1] + D[2] + T(products.mass[i]) * masses;
          static_for<3>([&](auto a) { v[i][a] = ratio * D[a] + same; });
        });
      }
    };

    template <typename T, template <typename, typename, Terms> class Operation>
    FormSweep<T>
    sweep_of_terms(const Element element, const Terms terms)
    {
      return sweep_of_element<T>(
        element,
        [&]<typename Kernel>(const std::type_identity<Kernel>) -> FormSweep<T> {
          switch (terms)
            {
              case Terms::stiffness:
                return BatchSweep<Operation<Kernel, T, Terms::stiffness>>::run;
              case Terms::mass:
                return BatchSweep<Operation<Kernel, T, Terms::mass>>::run;
              default:
                return BatchSweep<
                  Operation<Kernel, T, Terms::stiffness_and_mass>>::run;
            }
        });
    }
  } // namespace

  template <typename T>
  FormSweep<T>
  form_sweep(const Element element, const Terms terms)
  {
    return sweep_of_terms<T, Form>(element, terms);
  }

  template <typename T>
  FormSweep<T>
  diagonal_sweep(const Element element, const Terms terms)
  {
    Assert(terms != Terms::mass, dealii::ExcNotImplemented());
    return sweep_of_terms<T, Diagonal>(element, terms);
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
