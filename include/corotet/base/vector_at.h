// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_vector_at_h
#define corotet_base_vector_at_h

#include <corotet/base/vector.h>

#include <deal.II/base/tensor.h>

namespace corotet
{
  /// The three entries of a local node.
  inline dealii::Tensor<1, 3>
  vector_at(const Vector &vector, const unsigned int node)
  {
    return dealii::Tensor<1, 3>({vector.local_element(3 * node),
                                 vector.local_element(3 * node + 1),
                                 vector.local_element(3 * node + 2)});
  }
} // namespace corotet

#endif
