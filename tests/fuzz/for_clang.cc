// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A function of deal.II whose mangled name differs between clang and GCC, which
// has compiled deal.II: the size of its result depends on a template argument.

#include <deal.II/base/symmetric_tensor.templates.h>

namespace dealii
{
  template std::array<std::pair<double, Tensor<1, 3>>,
                      std::integral_constant<int, 3>::value>
  eigenvectors(const SymmetricTensor<2, 3> &,
               const SymmetricTensorEigenvectorMethod);
} // namespace dealii
