// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_probes_h
#define corotet_output_probes_h

#include <corotet/base/log.h>
#include <corotet/discretization/discretization.h>
#include <corotet/discretization/nearby_cells.h>
#include <corotet/output/output_parameters.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace corotet
{
  /// The position of a probe that no cell contains: the nearest point of the
  /// body if it is near (nearest_point()) and there is a @p log, which says so.
  /// Throws the InputError, blamed on @p entry, otherwise. Collective.
  dealii::Point<3>
  nearest_point_to_probe(const ProbePoint     &probe,
                         const std::string    &entry,
                         const Discretization &discretization,
                         const NearbyCells    &nearby,
                         Log *const            log);

  /// Throws the InputError that no cell has @p probe of the entry @p entry.
  /// Collective.
  [[noreturn]] void
  refuse_probe(const ProbePoint     &probe,
               const std::string    &entry,
               const Discretization &discretization,
               const NearbyCells    &nearby);

  /**
   * Points of the undeformed body, anywhere in it, at which a displacement is
   * evaluated: u(x) = sum_i u_i N_i(x) in the cell that contains x.
   *
   * A point on several cells is evaluated in the cell that it is least outside
   * of, by round-off, on the lowest rank that has such a cell. The cell's nodes
   * and the values of N_i are computed once. @p discretization must outlive
   * this object.
   */
  class Probes
  {
  public:
    /// With a @p log, points that are slightly outside of the cells
    /// (PointSearch), such as those on a curved surface, are moved to the
    /// nearest point of the body. Throws InputError blamed on Output/Probes for
    /// other points. Collective.
    Probes(const std::vector<ProbePoint> &points,
           const Discretization          &discretization,
           Log *const                     log = nullptr);

    const std::vector<std::string> &
    names() const
    {
      return probe_names;
    }

    /// The displacement of each probe [m], on all ranks. Ghost entries of @p
    /// displacement must be up to date. Collective.
    std::vector<dealii::Tensor<1, 3>>
    displacements(const Vector &displacement) const;

  private:
    /// A probe that this rank evaluates.
    struct ProbeInCell
    {
      unsigned int              probe;
      std::vector<unsigned int> nodes;
      std::vector<double>       shape_values;
    };

    MPI_Comm                 comm;
    std::vector<std::string> probe_names;
    std::vector<ProbeInCell> located;
  };
} // namespace corotet

#endif
