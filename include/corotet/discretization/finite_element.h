// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_finite_element_h
#define corotet_discretization_finite_element_h

#include <corotet/discretization/element.h>

#include <deal.II/fe/fe.h>

namespace corotet
{
  /// deal.II's element for scalar functions; it lives as long as the program.
  const dealii::FiniteElement<3> &
  finite_element(const Element element);
} // namespace corotet

#endif
