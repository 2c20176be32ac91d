// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_manufactured_problem_h
#define corotet_simulation_manufactured_problem_h

#include <corotet/operators/force_terms.h>
#include <corotet/simulation/simulation_parameters.h>

#include <memory>
#include <set>
#include <string>

namespace corotet
{
  /**
   * The exact solution that the parameters give, if they do, and the data made
   * from it.
   */
  class ManufacturedProblem
  {
  public:
    /// Throws InputError if the parameters give a solution that cannot be
    /// differentiated, or give data that are to be made from it. If not @p
    /// is_used there is no solution, whatever the parameters give.
    ManufacturedProblem(const SimulationParameters &parameters,
                        const bool                  is_used);

    /// Null if there is none.
    const ExactSolution *
    solution() const
    {
      return exact.get();
    }

    /// Whether data are made from the exact solution.
    bool
    makes_data() const
    {
      return manufacture;
    }

    /// The conditions of the parameters, or those made from the solution.
    /// Throws InputError if a boundary is unknown.
    BoundaryConditionParameters
    boundary_conditions(const MeshNames &boundaries) const;

    /// The initial values as texts of three components.
    std::string
    initial_displacement() const;
    std::string
    initial_velocity() const;

    /// Adds the forces made from the solution to @p terms, which must not
    /// outlive this object and the other arguments. Throws InputError if the @p
    /// materials of a body with an exact solution are not equal.
    void
    add_to(ForceTerms                                      &terms,
           const Discretization                            &discretization,
           const ReferenceElement                          &reference,
           const std::map<unsigned int, IsotropicMaterial> &materials,
           const std::shared_ptr<const MaterialLaw>        &law) const;

  private:
    void
    refuse_given_data() const;
    /// Boundaries where the displacement is prescribed.
    std::set<unsigned int>
    displacement_boundaries(const MeshNames &boundaries) const;

    const SimulationParameters          &parameters;
    std::unique_ptr<const ExactSolution> exact;
    bool                                 manufacture = false;
  };
} // namespace corotet

#endif
