// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_with_degree_h
#define corotet_discretization_with_degree_h

#include <deal.II/base/exceptions.h>

#include <type_traits>

namespace corotet
{
  /**
   * Calls @p function with std::integral_constant<int, p> for a degree that is
   * known at run time only.
   */
  template <typename Function>
  void
  with_degree(const unsigned int p, const Function &function)
  {
    switch (p)
      {
        case 1:
          return function(std::integral_constant<int, 1>());
        case 2:
          return function(std::integral_constant<int, 2>());
        case 3:
          return function(std::integral_constant<int, 3>());
        default:
          Assert(false, dealii::ExcInternalError());
      }
  }
} // namespace corotet

#endif
