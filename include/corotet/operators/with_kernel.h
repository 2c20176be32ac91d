// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_with_kernel_h
#define corotet_operators_with_kernel_h

#include <corotet/discretization/element.h>
#include <corotet/discretization/with_degree.h>
#include <corotet/operators/bubble_kernel.h>
#include <corotet/operators/factored_kernel.h>

#include <type_traits>

namespace corotet
{
  /// Calls @p function with std::type_identity of the cell kernel of an element
  /// that is known at run time only.
  template <typename T, typename Function>
  void
  with_kernel(const Element element, const Function &function)
  {
    if (element.has_bubbles())
      function(std::type_identity<BubbleKernel<T>>());
    else
      with_degree(element.degree(), [&](const auto p) {
        function(std::type_identity<FactoredKernel<decltype(p)::value, T>>());
      });
  }
} // namespace corotet

#endif
