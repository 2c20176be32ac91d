// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/point_search.h>
#include <corotet/output/probes.h>
#include <corotet/output/stress_probes.h>

#include <deal.II/base/mpi.h>

#include <set>

namespace corotet
{
  using dealii::SymmetricTensor;
  namespace mpi = dealii::Utilities::MPI;

  StressProbes::StressProbes(const std::vector<ProbePoint> &points,
                             const Discretization          &discretization,
                             const bool                     raw,
                             Log *const                     log)
    : comm(discretization.communicator())
    , raw(raw)
  {
    if (points.empty())
      return;
    const auto       &fe = discretization.finite_element().base_element(0);
    const PointSearch search(discretization);
    const NearbyCells nearby(discretization);
    // Locates a point; returns the number of cells with it, of all ranks.
    const auto locate = [&](const dealii::Point<3> &x) {
      const std::size_t n_before = located.size();
      for (const unsigned int c : nearby.cells(x))
        if (const auto xi = search.find(c, x))
          located.push_back({static_cast<unsigned int>(probe_names.size()),
                             c,
                             ReferenceElement::tabulate(fe, {*xi}, {1.})});
      return mpi::sum(located.size() - n_before, comm);
    };
    for (const ProbePoint &point : points)
      {
        const std::string entry = "Output/Stress probes";
        if (locate(point.position) == 0 &&
            locate(nearest_point_to_probe(
              point, entry, discretization, nearby, log)) == 0)
          refuse_probe(point, entry, discretization, nearby);
        probe_names.push_back(point.name);
      }
    std::set<unsigned int> each;
    for (const StressProbeInCell &probe : located)
      each.insert(probe.cell);
    cells.assign(each.begin(), each.end());
  }

  std::vector<SymmetricTensor<2, 3>>
  StressProbes::stresses(StressField &field) const
  {
    if (!raw)
      field.recover(cells);
    // For each probe and material: six sums over cells, and the number of
    // cells.
    const std::size_t   n_materials = field.law().n_materials();
    std::vector<double> sums(7 * n_materials * probe_names.size(), 0.);
    for (const StressProbeInCell &probe : located)
      {
        const SymmetricTensor<2, 3> sigma =
          raw ? field.raw(probe.cell, probe.point) :
                field.recovered(probe.cell,
                                {&probe.point.values(0, 0),
                                 probe.point.values.size(1)});
        double *const sum = &sums[7 * (n_materials * probe.probe +
                                       field.law().material_index(probe.cell))];
        for (unsigned int k = 0; k < 6; ++k)
          sum[k] += sigma.access_raw_entry(k);
        ++sum[6];
      }
    mpi::sum(sums, comm, sums);

    std::vector<SymmetricTensor<2, 3>> result(probe_names.size());
    for (unsigned int p = 0; p < result.size(); ++p)
      {
        unsigned int n_present = 0;
        for (unsigned int m = 0; m < n_materials; ++m)
          {
            const double *const sum = &sums[7 * (n_materials * p + m)];
            if (sum[6] == 0)
              continue;
            ++n_present;
            for (unsigned int k = 0; k < 6; ++k)
              result[p].access_raw_entry(k) += sum[k] / sum[6];
          }
        result[p] /= n_present;
      }
    return result;
  }
} // namespace corotet
