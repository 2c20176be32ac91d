// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_finite_element_h
#define corotet_discretization_finite_element_h

#include <corotet/discretization/element.h>

#include <deal.II/fe/fe.h>

#include <memory>

namespace corotet
{
  /// An element for scalar functions as deal.II has it.
  std::unique_ptr<dealii::FiniteElement<3>>
  make_finite_element(const Element element);
} // namespace corotet

#endif
