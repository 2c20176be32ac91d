// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/curved_batches.h>
#include <corotet/operators/cellwise_operator.h>

namespace corotet
{
  template <typename T>
  CellwiseOperator<T>::CellwiseOperator(const Nodes              &nodes,
                                        std::vector<unsigned int> prescribed)
    : cell_loop(nodes)
    , prescribed(std::move(prescribed))
    , saved(this->prescribed.size())
    , data{nodes.batches(), nullptr, nullptr, 0}
  {
    if (const CurvedBatches *curved = nodes.batches().curved();
        curved != nullptr && std::is_same_v<T, float>)
      curved->make_floats();
  }

  template <typename T>
  void
  CellwiseOperator<T>::set_terms(const double               c_K,
                                 const CellCoefficients<T> *coefficients,
                                 const double               c_M,
                                 const CellMasses<T>       *masses,
                                 const VectorType          *lumped_mass)
  {
    const Element element    = nodes().element();
    const bool    consistent = c_M != 0 && lumped_mass == nullptr;
    const Terms   terms =
      consistent ? Terms::stiffness_and_mass : Terms::stiffness;
    sweep             = form_sweep<T>(element, terms);
    diagonal_sweep    = corotet::diagonal_sweep<T>(element, terms);
    unit              = c_K;
    scale             = c_K * stiffness_scale(element);
    lumped            = c_M;
    this->lumped_mass = c_M != 0 ? lumped_mass : nullptr;
    data.coefficients = coefficients;
    data.masses       = masses;
    data.mass_factor  = consistent ? c_M / c_K : 0;
  }

  template <typename T>
  void
  CellwiseOperator<T>::set_surface(const SurfaceOperator<T> *surface)
  {
    this->surface = surface;
    if (surface != nullptr && surface_product.size() == 0)
      nodes().initialize_vector(surface_product);
  }

  template <typename T>
  void
  CellwiseOperator<T>::compute_diagonal()
  {
    const FormData<T> &data = this->data;
    if (diagonal_of_A.size() == 0)
      nodes().initialize_vector(diagonal_of_A);
    diagonal_of_A.zero_out_ghost_values();
    cell_loop.run(
      diagonal_of_A,
      [&](const auto &chunk, const T *source, T *sums) {
        diagonal_sweep(data, chunk.first, chunk.end, source, sums);
      },
      [&](const unsigned int i, auto y) {
        y *= unit;
        if (lumped_mass != nullptr)
          y += lumped * load_as<decltype(y)>(lumped_mass->begin() + i);
        store_to(y, diagonal_of_A.begin() + i);
      });
  }

  template <typename T>
  template <typename Store>
  void
  CellwiseOperator<T>::apply(const VectorType &src, const Store &store) const
  {
    FormData<T> data = this->data;
    data.mass_factor *=
      mass_scale(nodes().element()) / stiffness_scale(nodes().element());
    const auto add = [&](const auto &chunk, const T *source, T *sums) {
      sweep(data, chunk.first, chunk.end, source, sums);
    };
    if (surface != nullptr)
      {
        // This comes before the sweep, which may change the source.
        const bool fetch = !src.has_ghost_elements();
        if (fetch)
          src.update_ghost_values();
        surface->add(surface_product, src);
        const T *const diagonal =
          lumped_mass != nullptr ? lumped_mass->begin() : nullptr;
        cell_loop.run(src, add, [&](const unsigned int i, const auto y) {
          using V = decltype(y + y);
          V sum   = y * scale + load_as<V>(surface_product.begin() + i);
          if (diagonal != nullptr)
            sum +=
              lumped * load_as<V>(diagonal + i) * load_as<V>(src.begin() + i);
          store(i, sum);
        });
        // The next product may have other rows.
        surface->set_zero(surface_product);
        if (fetch)
          src.zero_out_ghost_values();
      }
    else if (lumped_mass == nullptr)
      cell_loop.run(src, add, [&](const unsigned int i, const auto y) {
        store(i, y * scale);
      });
    else
      cell_loop.run(src, add, [&](const unsigned int i, const auto y) {
        using V = decltype(y + y);
        store(i,
              y * scale + lumped * load_as<V>(lumped_mass->begin() + i) *
                            load_as<V>(src.begin() + i));
      });
  }

  template <typename T>
  void
  CellwiseOperator<T>::vmult(VectorType &dst, const VectorType &src) const
  {
    // Prescribed entries of the source are set aside for the product.
    T *const source = const_cast<VectorType &>(src).begin();
    T *const result = dst.begin();
    for (unsigned int k = 0; k < prescribed.size(); ++k)
      {
        const unsigned int i = prescribed[k];
        saved[k]             = source[i];
        source[i]            = 0;
      }
    apply(src,
          [&](const unsigned int i, const auto y) { store_to(y, result + i); });
    const unsigned int n_owned      = dst.locally_owned_size();
    const bool         has_diagonal = diagonal_of_A.size() > 0;
    for (unsigned int k = 0; k < prescribed.size(); ++k)
      {
        const unsigned int i = prescribed[k];
        source[i]            = saved[k];
        if (i < n_owned)
          result[i] =
            has_diagonal ? diagonal_of_A.local_element(i) * saved[k] : T(0);
      }
  }

  template <typename T>
  void
  CellwiseOperator<T>::residual(VectorType       &r,
                                const VectorType &b,
                                const VectorType &x) const
  {
    T *const       result = r.begin();
    const T *const rhs    = b.begin();
    apply(x, [&](const unsigned int i, const auto y) {
      store_to(load_as<decltype(y + y)>(rhs + i) - y, result + i);
    });
    const unsigned int n_owned = r.locally_owned_size();
    for (const unsigned int i : prescribed)
      if (i < n_owned)
        result[i] = 0;
  }

  template <typename T>
  void
  CellwiseOperator<T>::chebyshev_step(VectorType       &x,
                                      VectorType       &d,
                                      const VectorType &b,
                                      const VectorType &inverse_diagonal,
                                      const T           beta,
                                      const T           alpha) const
  {
    T *const       X       = x.begin();
    T *const       D       = d.begin();
    const T *const B       = b.begin();
    const T *const inverse = inverse_diagonal.begin();
    apply(x, [&](const unsigned int i, const auto y) {
      using V      = decltype(y + y);
      const V step = beta * load_as<V>(D + i) +
                     alpha * load_as<V>(inverse + i) * (load_as<V>(B + i) - y);
      store_to(step, D + i);
      store_to(load_as<V>(X + i) + step, X + i);
    });
  }

  template class CellwiseOperator<double>;
  template class CellwiseOperator<float>;
} // namespace corotet
