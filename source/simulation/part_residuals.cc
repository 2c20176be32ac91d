// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/vector.h>
#include <corotet/operators/force_round_off.h>
#include <corotet/simulation/part_residuals.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  PartResiduals::PartResiduals(const Discretization &discretization)
    : comm(discretization.communicator())
    , parts(discretization)
  {
    start();
  }

  std::unique_ptr<PartResiduals>
  PartResiduals::of_several(const Discretization &discretization)
  {
    std::unique_ptr<PartResiduals> result(new PartResiduals(discretization));
    if (result->parts.n_parts == 1)
      result.reset();
    return result;
  }

  void
  PartResiduals::take(const std::vector<const Vector *> &terms)
  {
    // Where a part has no forces in equilibrium, its residual is compared with
    // those that it has had before.
    constexpr double    least_share = 1e-8;
    std::vector<double> squares(terms.size() * parts.n_parts);
    for (unsigned int k = 0; k < terms.size(); ++k)
      if (terms[k] != nullptr)
        for (unsigned int n = 0; n < parts.part_of_node.size(); ++n)
          squares[k * parts.n_parts + parts.part_of_node[n]] +=
            square_at_node(*terms[k], n);
    dealii::Utilities::MPI::sum(squares, comm, squares);
    forces.assign(parts.n_parts, 0.);
    for (std::size_t i = 0; i < squares.size(); ++i)
      {
        double &force = forces[i % parts.n_parts];
        force         = std::max(force, std::sqrt(squares[i]));
      }
    for (unsigned int p = 0; p < parts.n_parts; ++p)
      {
        scales[p] = std::max(scales[p], least_share * forces[p]);
        forces[p] = std::max(forces[p], scales[p]);
      }
  }

  PartResiduals::Worst
  PartResiduals::worst(const Vector              &r,
                       const Vector              &u,
                       const std::vector<double> &squares_of_stiffness) const
  {
    std::vector<double> displacements(parts.n_parts);
    for (unsigned int n = 0; n < parts.part_of_node.size(); ++n)
      {
        double &largest = displacements[parts.part_of_node[n]];
        largest         = std::max(largest, square_at_node(u, n));
      }
    dealii::Utilities::MPI::max(displacements, comm, displacements);
    std::vector<double> squares(parts.n_parts);
    for (unsigned int n = 0; n < parts.part_of_node.size(); ++n)
      {
        const unsigned int p     = parts.part_of_node[n];
        const double       cause = ForceRoundOff::error_of_displacements(
          std::sqrt(displacements[p]) + 2 * parts.radii[p]);
        const double square = square_at_node(r, n);
        if (square > cause * cause * squares_of_stiffness[n])
          squares[p] += square;
      }
    dealii::Utilities::MPI::sum(squares, comm, squares);
    Worst worst;
    for (unsigned int p = 0; p < parts.n_parts; ++p)
      if (const double residual = std::sqrt(squares[p]);
          residual > worst.ratio * forces[p])
        worst = {residual / forces[p], p};
    return worst;
  }
} // namespace corotet
