// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A function of deal.II whose name clang and GCC, which has compiled deal.II,
// spell differently: the size of what it returns depends on an argument of the
// template.

#include <deal.II/base/symmetric_tensor.templates.h>

namespace dealii
{
  template std::array<std::pair<double, Tensor<1, 3>>,
                      std::integral_constant<int, 3>::value>
  eigenvectors(const SymmetricTensor<2, 3> &,
               const SymmetricTensorEigenvectorMethod);
} // namespace dealii
