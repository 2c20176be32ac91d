// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/material/stress_measures.h>
#include <corotet/output/stress_tables.h>

#include <algorithm>

namespace corotet
{
  std::array<double, 6>
  in_vtk_order(const dealii::SymmetricTensor<2, 3> &tensor)
  {
    return {{tensor[0][0],
             tensor[1][1],
             tensor[2][2],
             tensor[0][1],
             tensor[1][2],
             tensor[0][2]}};
  }

  const std::vector<VtkhdfSeries::Table> &
  StressTables::tables()
  {
    static const std::vector<VtkhdfSeries::Table> result{
      {"stress", 6}, {"strain", 6}, {"von_mises", 0}, {"principal_stress", 3}};
    return result;
  }

  StressTables::StressTables(const FileOrder &order, const std::size_t n_points)
    : order(order)
    , n_points(n_points)
  {}

  void
  StressTables::add(const dealii::SymmetricTensor<2, 3> &sigma,
                    const dealii::SymmetricTensor<2, 3> &epsilon)
  {
    const auto append = [](std::vector<double> &table, const auto &numbers) {
      table.insert(table.end(), numbers.begin(), numbers.end());
    };
    append(values[0], in_vtk_order(sigma));
    append(values[1], in_vtk_order(epsilon));
    values[2].push_back(von_mises(sigma));
    append(values[3], principal_values(sigma));
  }

  void
  StressTables::write(Hdf5File &file) const
  {
    for (unsigned int t = 0; t < values.size(); ++t)
      order.write(file,
                  "PointData/" + tables()[t].name,
                  values[t].data(),
                  tables()[t].n_columns,
                  n_points);
  }
} // namespace corotet
