// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// What the log says about a modal analysis.

#include <corotet/simulation/modal_analysis.h>

#include <fmt/format.h>

#include <cmath>

namespace corotet
{
  void
  ModalAnalysis::note_what_is_ignored() const
  {
    const BoundaryConditions &conditions = the_body.conditions;
    bool                      something =
      !conditions.tractions.empty() || !conditions.pressures.empty();
    for (const ForceKind::GivenEntry &given : parameters.forces.given())
      something = something || !given.in_modes;
    for (const auto &condition : conditions.displacements)
      for (const auto &component : condition.components)
        something = something || (component && !component->is_zero());
    if (something)
      log.line(
        "Modes are those of the body at rest, undamped: loads are left out, and "
        "prescribed displacements count as zero");
  }

  void
  ModalAnalysis::log_table() const
  {
    log.line(fmt::format("Modes: {} linear solves with {} iterations, shift "
                         "{:.3g} 1/s^2",
                         solver.n_linear_solves(),
                         solver.n_linear_iterations(),
                         shift));
    log.line(fmt::format("  {:>4} {:>14} {:>9}   {}",
                         "mode",
                         "frequency [Hz]",
                         "residual",
                         "effective mass in x, y, z [%]"));
    for (unsigned int i = 0; i < computed.size(); ++i)
      log.line(
        fmt::format("  {:>4} {:>14.7g} {:>9.2g}   {:>6.2f} {:>6.2f} {:>6.2f}",
                    i + 1,
                    computed[i].frequency,
                    computed[i].residual,
                    100 * computed[i].effective_mass[0] / the_body.mass.total(),
                    100 * computed[i].effective_mass[1] / the_body.mass.total(),
                    100 * computed[i].effective_mass[2] /
                      the_body.mass.total()));
  }

  void
  ModalAnalysis::note_cut_group(const std::vector<double> &eigenvalues) const
  {
    // Meshes are less symmetric than bodies: one frequency of the body may
    // become several of the mesh, which differ by its discretization error.
    constexpr double    equal   = 5e-3;
    const unsigned int  n_rigid = rigid_motions.size(), n = computed.size();
    std::vector<double> frequencies;
    for (unsigned int i = 0; i < eigenvalues.size(); ++i)
      frequencies.push_back(i < n ? computed[i].angular_frequency :
                                    std::sqrt(eigenvalues[i]));
    if (n < n_rigid)
      {
        log.line(fmt::format("Mode {} is a rigid body mode, of which {} of {} "
                             "are given; Modes/Number = {} gives all",
                             n,
                             n,
                             n_rigid,
                             n_rigid));
        return;
      }
    if (n == n_rigid)
      return;
    const auto is_like_the_last = [&](const unsigned int i) {
      return frequencies[i] <= (1 + equal) * frequencies[i - 1];
    };
    unsigned int first = n - 1, end = n;
    while (first > n_rigid && is_like_the_last(first))
      --first;
    while (end < frequencies.size() && is_like_the_last(end))
      ++end;
    if (end == n)
      return;
    const bool is_open = end == frequencies.size();
    log.line(fmt::format("Mode {} belongs to a group of {}{} modes with equal "
                         "frequencies (each within {} % of the next), of which "
                         "{} {} given; Modes/Number = {} gives {}",
                         n,
                         is_open ? "at least " : "",
                         end - first,
                         100 * equal,
                         n - first,
                         n - first == 1 ? "is" : "are",
                         end,
                         is_open ? "these" : "all"));
  }
} // namespace corotet
