// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_body_h
#define corotet_simulation_body_h

#include <corotet/base/log.h>
#include <corotet/base/table_functions.h>
#include <corotet/discretization/boundary_conditions.h>
#include <corotet/discretization/discretization.h>
#include <corotet/discretization/prescribed_motion.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/forces/force_kind.h>
#include <corotet/mesh/mesh.h>
#include <corotet/operators/elasticity.h>
#include <corotet/operators/mass.h>
#include <corotet/operators/stress_field.h>
#include <corotet/simulation/manufactured_problem.h>
#include <corotet/simulation/observer.h>
#include <corotet/simulation/simulation_parameters.h>

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace corotet
{
  /**
   * An elastic body as parameters describe it: its mesh and elements, what it
   * is made of, its mass and stiffness, and how its boundaries are held. What
   * simulations, modal analyses, benchmarks and tests work on.
   *
   * The constructor makes and checks all of it. Nothing changes after that but
   * the elasticity, which has the rotations of the displacement that it has
   * seen last. Members are collective.
   */
  class Body
  {
  public:
    enum class Purpose
    {
      /// A body in motion: with the law, and with the data of an exact solution
      /// if the parameters want them.
      motion,
      /// A body near its state at rest: linear elasticity.
      small_vibrations
    };

    /// @p folder is that of the parameter file; relative file names begin
    /// there. @p parameters must outlive this object. Throws InputError.
    Body(const SimulationParameters &parameters,
         const std::string          &folder,
         const MPI_Comm              comm,
         Log                        &log,
         const Purpose               purpose = Purpose::motion);

    /// Makes a body from a mesh on rank 0 instead of that of the parameters,
    /// without tables.
    Body(const SimulationParameters &parameters,
         SerialMesh                  serial_mesh,
         const MPI_Comm              comm,
         Log                        &log);

    /// The data that force terms are made from.
    ForceContext
    force_context(Log &log, const double start_time);

    /// Root mean square of a vector field, weighted by mass.
    double
    root_mean_square(const Vector &field) const;

    /// An object for the stress of displacements by the body's law.
    StressField
    stress_field() const
    {
      return {discretization,
              reference,
              materials,
              law,
              elasticity.vertex_dilatation()};
    }

    /// Describes the body in the log at the start.
    void
    describe(Log &log) const;

    /// The entries of a summary that belong to the body.
    void
    fill_in(RunSummary &summary) const;

    const TableFunctions      tables;
    const Mesh                mesh;
    const Discretization      discretization;
    const ReferenceElement   &reference;
    const ManufacturedProblem problem;
    /// The material of each region's id.
    const std::map<unsigned int, IsotropicMaterial> materials;
    const std::shared_ptr<const MaterialLaw>        law;
    const BoundaryConditions                        conditions;
    const Mass                                      mass;
    Elasticity                                      elasticity;
    const PrescribedMotion                          motion;

    /// Whether it is known to have one of the ConnectedParts only, so that
    /// nobody need look for them.
    bool is_one_piece = false;

  private:
    Body(const SimulationParameters  &parameters,
         const TableFunctions        &tables,
         const std::function<Mesh()> &make_mesh,
         const Purpose                purpose);

    /// The sum of the nodal masses [kg]; with a consistent mass it is not the
    /// mass of the body. Zero before it is needed.
    mutable double sum_of_nodal_masses = 0;
  };
} // namespace corotet

#endif
