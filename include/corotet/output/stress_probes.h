// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_stress_probes_h
#define corotet_output_stress_probes_h

#include <corotet/operators/stress_field.h>
#include <corotet/output/output_parameters.h>

#include <string>
#include <vector>

namespace corotet
{
  /**
   * Points of the undeformed body, anywhere in it, at which stress is
   * evaluated: the recovered stress or the raw one, that of the displacement.
   * Where cells meet, the result is the mean over the cells of each material,
   * and then the mean over the materials, so that the distribution over ranks
   * makes no difference.
   *
   * @p discretization must outlive this object.
   */
  class StressProbes
  {
  public:
    /// With a @p log, points that are slightly outside are moved to the nearest
    /// point of the body, as in Probes. Throws InputError blamed on
    /// Output/Stress probes for other points. Collective.
    StressProbes(const std::vector<ProbePoint> &points,
                 const Discretization          &discretization,
                 const bool                     raw = false,
                 Log *const                     log = nullptr);

    const std::vector<std::string> &
    names() const
    {
      return probe_names;
    }

    /// The stress of each probe [Pa], on all ranks. Recovers the stress if that
    /// is needed and not done yet. Collective.
    std::vector<dealii::SymmetricTensor<2, 3>>
    stresses(StressField &field) const;

  private:
    /// A probe in an owned cell.
    struct StressProbeInCell
    {
      unsigned int                  probe;
      unsigned int                  cell;
      ReferenceElement::PointValues point;
    };

    MPI_Comm                       comm;
    bool                           raw;
    std::vector<std::string>       probe_names;
    std::vector<StressProbeInCell> located;
    /// The cells of these probes, each once.
    std::vector<unsigned int> cells;
  };
} // namespace corotet

#endif
