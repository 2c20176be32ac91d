// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_vector_h
#define corotet_base_vector_h

#include <deal.II/lac/la_parallel_vector.h>

namespace corotet
{
  /**
   * A distributed vector of unknowns: three per node (x, y, z), contiguous.
   * Owned entries come first, then ghosts.
   */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /**
   * Euclidean norm. Other than Vector::l2_norm(), which stops the program in
   * debug mode, it is not finite if the vector is not. Collective.
   */
  double
  norm(const Vector &vector);
} // namespace corotet

#endif
