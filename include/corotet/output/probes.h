// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_probes_h
#define corotet_output_probes_h

#include <corotet/discretization/discretization.h>
#include <corotet/output/output_parameters.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace corotet
{
  /// Throws the InputError, blamed on @p entry, for a probe at @p x that is
  /// outside the body. Collective.
  [[noreturn]] void
  throw_outside_of_body(const std::string      &entry,
                        const std::string      &name,
                        const dealii::Point<3> &x,
                        const Discretization   &discretization);

  /**
   * Points of the undeformed body, anywhere in it, at which a displacement is
   * evaluated: u(x) = sum_i u_i N_i(x) in the cell that contains x.
   *
   * A point on several cells is evaluated in one that it is least outside of,
   * by round-off, on the lowest rank that has such a one. The cell's nodes and
   * the values of N_i are found once. @p discretization must outlive this
   * object.
   */
  class Probes
  {
  public:
    /// Throws InputError blamed on Output/Probes if a point is outside the
    /// body (PointSearch). Collective.
    Probes(const std::vector<ProbePoint> &points,
           const Discretization          &discretization);

    const std::vector<std::string> &
    names() const
    {
      return probe_names;
    }

    /// Displacement of each probe [m], on all ranks. Ghost entries of @p
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
