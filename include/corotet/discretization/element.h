// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_element_h
#define corotet_discretization_element_h

namespace corotet
{
  /**
   * A finite element on tetrahedra: the polynomials of degree p = 1, 2, 3
   * (FE_SimplexP), or those of degree 2 with five bubbles
   * (FE_SimplexP_Bubbles): 27 lambda_a lambda_b lambda_c for each face, and 256
   * lambda_0 lambda_1 lambda_2 lambda_3. With the bubbles, quadrature at the
   * nodes has positive weights and a diagonal mass matrix of full order
   * (Geevers, Mulder, van der Vegt 2018, @cite geevers2018).
   */
  class Element
  {
  public:
    constexpr Element(const unsigned int degree)
      : p(degree)
    {}

    static constexpr Element
    quadratic_with_bubbles()
    {
      Element element(2);
      element.bubbles = true;
      return element;
    }

    /// The highest degree of which the element has all polynomials.
    constexpr unsigned int
    degree() const
    {
      return p;
    }

    constexpr bool
    has_bubbles() const
    {
      return bubbles;
    }

    /// The number of nodes: 4, 10, 20; 15 with bubbles.
    constexpr unsigned int
    n_nodes() const
    {
      return bubbles ? 15 : (p + 1) * (p + 2) * (p + 3) / 6;
    }

    /// The next coarser element, whose functions are among this element's: the
    /// same without bubbles, or degree p - 1.
    constexpr Element
    coarser() const
    {
      return Element(bubbles ? p : p - 1);
    }

  private:
    unsigned int p;
    bool         bubbles = false;
  };
} // namespace corotet

#endif
