// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_stress_tables_h
#define corotet_output_stress_tables_h

#include <corotet/output/file_order.h>
#include <corotet/output/vtkhdf_series.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <string>
#include <vector>

namespace corotet
{
  /// The names of the components of a symmetric tensor in VTK's order.
  inline const std::array<std::string, 6> vtk_components{
    {"xx", "yy", "zz", "xy", "yz", "xz"}};

  /// The components of a symmetric tensor in VTK's order.
  std::array<double, 6>
  in_vtk_order(const dealii::SymmetricTensor<2, 3> &tensor);

  /**
   * Tables of stress for a time series: stress and strain (six columns in
   * VTK's order), von_mises (a list) and principal_stress (three columns,
   * largest first).
   */
  class StressTables
  {
  public:
    /// The names and numbers of columns of the tables.
    static const std::vector<VtkhdfSeries::Table> &
    tables();

    /// Tables of nodes, or of cells that have @p n_points points each. @p order
    /// must outlive this object.
    explicit StressTables(const FileOrder  &order,
                          const std::size_t n_points = 1);

    /// Adds the next owned node or point: its stress [Pa] and strain [-].
    void
    add(const dealii::SymmetricTensor<2, 3> &sigma,
        const dealii::SymmetricTensor<2, 3> &epsilon);

    /// Writes all rows to group PointData of @p file. Collective.
    void
    write(Hdf5File &file) const;

  private:
    const FileOrder  &order;
    const std::size_t n_points;
    /// The values of each table, in the order of tables().
    std::array<std::vector<double>, 4> values;
  };
} // namespace corotet

#endif
