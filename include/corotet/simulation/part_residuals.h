// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_part_residuals_h
#define corotet_simulation_part_residuals_h

#include <corotet/discretization/connected_parts.h>

#include <memory>
#include <vector>

namespace corotet
{
  /**
   * Residuals of the parts of a body that are not connected with each other,
   * each in terms of its own forces. Norms over the whole body hide what is
   * left of the forces on a small or soft part beside a large or stiff one.
   */
  class PartResiduals
  {
  public:
    /// An object for a mesh of several parts; null if it has one. Collective.
    static std::unique_ptr<PartResiduals>
    of_several(const Discretization &discretization);

    /// Begins a stage.
    void
    start()
    {
      scales.assign(parts.n_parts, 0.);
    }

    /// Takes the sizes of the terms whose sum the residual is [N]; null stands
    /// for a term that is zero. Collective.
    void
    take(const std::vector<const Vector *> &terms);

    /// A part, and the ratio of its residual to its forces [-].
    struct Worst
    {
      double       ratio = 0;
      unsigned int part  = 0;
    };

    /// The part with the largest ratio. Residuals @p r [N] count at nodes where
    /// they are too large to be the round-off of the displacement @p u [m]; @p
    /// squares_of_stiffness are those of ForceRoundOff. Collective.
    Worst
    worst(const Vector              &r,
          const Vector              &u,
          const std::vector<double> &squares_of_stiffness) const;

    dealii::Point<3>
    centre(const unsigned int part) const
    {
      return parts.centres[part];
    }

  private:
    /// Collective.
    explicit PartResiduals(const Discretization &discretization);

    const MPI_Comm       comm;
    const ConnectedParts parts;
    /// A small share of the largest force term of each part in this stage, and
    /// the largest one in the last call of take() [N].
    std::vector<double> scales, forces;
  };
} // namespace corotet

#endif
