// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/curved_batches.h>

#include <deal.II/base/exceptions.h>

namespace corotet
{
  CurvedBatches::CurvedBatches(const Element                     element,
                               const CellBatches                &batches,
                               const std::vector<unsigned char> &is_curved)
    : shape_functions(ReferenceElement::curved_rule(element))
    , maps(std::make_shared<Maps>())
  {
    set_shapes();
    maps->index.resize((batches.n_batches() + floats_per_batch - 1) /
                         floats_per_batch,
                       none);
    for (unsigned int cell = 0; cell < is_curved.size(); ++cell)
      if (is_curved[cell])
        maps->index[batches.place(cell).first / floats_per_batch] = 0;
    for (unsigned int cell = 0; cell < is_curved.size(); ++cell)
      AssertThrow(is_curved[cell] || !has(batches.place(cell).first),
                  dealii::ExcInternalError());
    for (unsigned int &index : maps->index)
      if (index != none)
        index = maps->n_registers++;

    const std::size_t n = std::size_t(n_batches()) * n_points();
    maps->numbers.resize_fast(n * n_numbers * batch_size);
    double *next = maps->numbers.data();
    for (std::size_t i = 0; i < n; ++i)
      for (unsigned int k = 0; k < n_numbers; ++k)
        for (unsigned int lane = 0; lane < batch_size; ++lane)
          {
            if (k == 9)
              *next = shape_functions.weights[i % n_points()];
            else
              *next = k % 4 == 0 ? 1 : 0;
            ++next;
          }
  }

  CurvedBatches::CurvedBatches(const Element        element,
                               const CurvedBatches &other)
    : shape_functions(ReferenceElement::tabulate(element,
                                                 other.shape_functions.points,
                                                 other.shape_functions.weights))
    , maps(other.maps)
  {
    set_shapes();
  }

  void
  CurvedBatches::set_shapes()
  {
    const unsigned int n_nodes = shape_functions.values.size(1);
    for (unsigned int q = 0; q < n_points(); ++q)
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          shapes_double.push_back(shape_functions.values[q][i]);
          for (unsigned int k = 0; k < 3; ++k)
            shapes_double.push_back(shape_functions.gradients[q][i][k]);
        }
    shapes_float.assign(shapes_double.begin(), shapes_double.end());
  }

  void
  CurvedBatches::set(const std::pair<unsigned int, unsigned int> &place,
                     const unsigned int                           point,
                     const dealii::Tensor<2, 3>                  &matrix,
                     const double                                 weight)
  {
    const auto [batch, lane] = place;
    double *const first =
      maps->numbers.data() +
      (static_cast<std::size_t>(index(batch)) * n_points() + point) *
        n_numbers * batch_size +
      lane;
    for (unsigned int k = 0; k < 9; ++k)
      first[std::size_t(k) * batch_size] = matrix[k / 3][k % 3];
    first[std::size_t(9) * batch_size] = weight;
  }

  void
  CurvedBatches::make_floats() const
  {
    if (!maps->float_numbers.empty())
      return;
    maps->float_numbers.resize_fast(maps->numbers.size());
    const std::size_t n = std::size_t(n_points()) * n_numbers;
    for (unsigned int batch = 0; batch < n_batches(); ++batch)
      for (std::size_t k = 0; k < n; ++k)
        for (unsigned int lane = 0; lane < batch_size; ++lane)
          maps->float_numbers
            [(batch / floats_per_batch * n + k) * n_lanes<float> +
             std::size_t(batch % floats_per_batch) * batch_size + lane] =
            maps->numbers[(batch * n + k) * batch_size + lane];
  }
} // namespace corotet
