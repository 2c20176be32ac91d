// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_transferred_field_h
#define corotet_studies_transferred_field_h

#include <corotet/base/vector.h>
#include <corotet/operators/error_norms.h>

#include <deal.II/fe/fe.h>

#include <memory>
#include <vector>

namespace corotet
{
  /**
   * A displacement on one mesh, to be evaluated where another mesh of the body
   * has cells: each rank has what lies at those of the other mesh that it owns.
   * Cells of the first one must be straight.
   */
  class TransferredField
  {
  public:
    /// @p u on the mesh of @p source, with ghost entries up to date, for the
    /// cells of @p target. Collective.
    TransferredField(const Discretization &source,
                     const Vector         &u,
                     const Discretization &target);
    ~TransferredField();

    /// The value in the cell that @p x is in, or is nearest to by barycentric
    /// coordinates, for a point in an owned cell of the other mesh. Fast for
    /// points that follow each other closely. Not collective.
    PointDisplacement
    value(const dealii::Point<3> &x) const;

  private:
    struct Search;

    /// Reference coordinates of @p x in a cell.
    dealii::Point<3>
    reference_point(const unsigned int cell, const dealii::Point<3> &x) const;

    const dealii::FiniteElement<3> &fe;
    /// Numbers for each cell: vertex 0, the inverse of its Jacobian, values
    /// [node][component].
    unsigned int                  stride;
    std::vector<double>           data;
    std::unique_ptr<const Search> search;
    mutable unsigned int          last_cell = 0;
  };
} // namespace corotet

#endif
