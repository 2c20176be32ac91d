// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/finite_element.h>

#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_simplex_p_bubbles.h>

namespace corotet
{
  std::unique_ptr<dealii::FiniteElement<3>>
  make_finite_element(const Element element)
  {
    if (element.has_bubbles())
      return std::make_unique<dealii::FE_SimplexP_Bubbles<3>>(element.degree());
    return std::make_unique<dealii::FE_SimplexP<3>>(element.degree());
  }
} // namespace corotet
