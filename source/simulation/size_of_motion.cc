// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/connected_parts.h>
#include <corotet/simulation/size_of_motion.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  SizeOfMotion::SizeOfMotion(const Body &body, const SurfaceMatrix *springs)
    : body(body)
  {
    const Discretization &discretization = body.discretization;
    const MPI_Comm        comm           = discretization.communicator();
    const ConnectedParts  parts(discretization);
    const auto [bodies, n_bodies] = parts.bodies(comm);
    std::vector<unsigned int> is_held(n_bodies);
    for (const unsigned int i : body.motion.unknowns())
      is_held[bodies[parts.part_of_node[i / 3]]] = 1;
    if (springs != nullptr)
      for (const unsigned int face : springs->used_faces())
        is_held[bodies[parts.part_of_cell[springs->faces()[face].cell]]] = 1;
    dealii::Utilities::MPI::max(is_held, comm, is_held);

    const unsigned int n_free = std::count(is_held.begin(), is_held.end(), 0u);
    std::vector<unsigned int> number(n_bodies, n_free);
    unsigned int              next = 0;
    for (unsigned int b = 0; b < n_bodies; ++b)
      if (is_held[b] == 0)
        number[b] = next++;
    for (const unsigned int part : parts.part_of_node)
      free_part.push_back(number[bodies[part]]);
    // The mass of a node counts for each of its three unknowns.
    masses.resize(n_free);
    for (unsigned int n = 0; n < free_part.size(); ++n)
      if (free_part[n] < n_free)
        masses[free_part[n]] += body.mass.diagonal().local_element(3 * n);
    dealii::Utilities::MPI::sum(masses, comm, masses);
  }

  double
  SizeOfMotion::operator()(const Vector &u) const
  {
    // Displacements are known to the tolerances of solvers, relative to the
    // largest ones.
    constexpr double least_share = 1e-4;
    const double     size        = body.root_mean_square(u);
    if (masses.empty())
      return size;
    std::vector<double> means(3 * masses.size());
    for (unsigned int n = 0; n < free_part.size(); ++n)
      if (free_part[n] < masses.size())
        for (unsigned int a = 0; a < 3; ++a)
          means[3 * free_part[n] + a] +=
            body.mass.diagonal().local_element(3 * n + a) *
            u.local_element(3 * n + a);
    dealii::Utilities::MPI::sum(means, u.get_mpi_communicator(), means);
    Vector relative(u);
    for (unsigned int n = 0; n < free_part.size(); ++n)
      if (free_part[n] < masses.size())
        for (unsigned int a = 0; a < 3; ++a)
          relative.local_element(3 * n + a) -=
            means[3 * free_part[n] + a] / masses[free_part[n]];
    return std::max(body.root_mean_square(relative), least_share * size);
  }
} // namespace corotet
