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
   * A displacement on one mesh, to be evaluated at points of another mesh of
   * the same body: each rank has the part near the cells of the other mesh that
   * it owns. Cells of the first mesh must be straight.
   */
  class TransferredField
  {
  public:
    /// Transfers @p u on the mesh of @p source, with ghost entries up to date,
    /// to the ranks that own the cells of @p target there. Collective.
    TransferredField(const Discretization &source,
                     const Vector         &u,
                     const Discretization &target);
    ~TransferredField();

    /// The value in the cell that contains @p x or, by barycentric coordinates,
    /// is nearest to it, for a point in an owned cell of the other mesh. Fast
    /// if consecutive points are near each other. Not collective.
    PointDisplacement
    value(const dealii::Point<3> &x) const;

  private:
    struct Search;

    /// The reference coordinates of @p x in a cell.
    dealii::Point<3>
    reference_point(const unsigned int cell, const dealii::Point<3> &x) const;

    const dealii::FiniteElement<3> &fe;
    /// The number of values for each cell: vertex 0, the inverse of its
    /// Jacobian, values [node][component].
    unsigned int                  stride;
    std::vector<double>           data;
    std::unique_ptr<const Search> search;
    mutable unsigned int          last_cell = 0;
  };
} // namespace corotet

#endif
