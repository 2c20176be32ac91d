// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_values_by_place_h
#define corotet_discretization_values_by_place_h

#include <corotet/discretization/discretization.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace corotet
{
  /**
   * Fills @p values, a vector of the displacement's unknowns, with numbers in
   * [-1, 1] without pattern, which depend only on the nodes' places in the
   * body: they are the same on any number of ranks and in any units. They are
   * smooth functions of the place, so that round-off in positions, which nodes
   * other than vertices have, is amplified to 1e7 roundings of doubles, less
   * than one of floats. A start for eigenvalue estimates. Collective.
   */
  template <typename T>
  void
  fill_by_place(dealii::LinearAlgebra::distributed::Vector<T> &values,
                const Discretization                          &discretization);
} // namespace corotet

#endif
