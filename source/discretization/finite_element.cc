// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/finite_element.h>
#include <corotet/mesh/curved_cells.h>

#include <deal.II/fe/fe_simplex_p_bubbles.h>

namespace corotet
{
  const dealii::FiniteElement<3> &
  finite_element(const Element element)
  {
    if (!element.has_bubbles())
      return map_element(element.degree());
    static const dealii::FE_SimplexP_Bubbles<3> bubbles(2);
    return bubbles;
  }
} // namespace corotet
