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
   * The exact solution that the parameters give, if they do, and the data that
   * are made of it.
   */
  class ManufacturedProblem
  {
  public:
    /// Throws InputError if the parameters give a solution that cannot be
    /// differentiated, or data that are to be made. @p is_used: if false, there
    /// is none, whatever they give.
    ManufacturedProblem(const SimulationParameters &parameters,
                        const bool                  is_used);

    /// Null if there is none.
    const ExactSolution *
    solution() const
    {
      return exact.get();
    }

    /// Whether data are made of the exact solution.
    bool
    makes_data() const
    {
      return manufacture;
    }

    /// Those of the parameters, or those that are made. Throws InputError if a
    /// boundary is unknown.
    BoundaryConditionParameters
    boundary_conditions(const MeshNames &boundaries) const;

    /// As texts of three components.
    std::string
    initial_displacement() const;
    std::string
    initial_velocity() const;

    /// Adds what is made to @p terms, which must not outlive this object and
    /// the other arguments. @p materials: of a body with exact solution they
    /// must be equal, or an InputError is thrown.
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
