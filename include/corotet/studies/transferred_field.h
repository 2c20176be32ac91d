// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_gathered_field_h
#define corotet_studies_gathered_field_h

#include <corotet/base/vector.h>
#include <corotet/operators/error_norms.h>

#include <deal.II/fe/fe.h>

#include <memory>
#include <vector>

namespace corotet
{
  /**
   * A displacement that every rank has as a whole, to be evaluated anywhere:
   * for meshes that fit into the memory of one rank.
   */
  class GatheredField
  {
  public:
    /// @p u with ghost entries up to date. Collective.
    GatheredField(const Discretization &discretization, const Vector &u);
    ~GatheredField();

    /// The value in the cell that @p x is in, or is nearest to by barycentric
    /// coordinates. Fast for points that follow each other closely. Not
    /// collective.
    PointDisplacement
    value(const dealii::Point<3> &x) const;

  private:
    struct Search;

    /// Reference coordinates of @p x in a cell.
    dealii::Point<3>
    reference_point(const unsigned int cell, const dealii::Point<3> &x) const;

    const dealii::FiniteElement<3> &fe;
    /// Of each cell: vertex 0, the inverse of its Jacobian, values
    /// [node][component].
    std::vector<double>           data;
    unsigned int                  stride;
    std::unique_ptr<const Search> search;
    mutable unsigned int          last_cell = 0;
  };
} // namespace corotet

#endif
