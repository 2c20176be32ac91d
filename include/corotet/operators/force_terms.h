// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_force_terms_h
#define corotet_operators_force_terms_h

#include <corotet/discretization/discretization.h>
#include <corotet/operators/force_term.h>

#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace corotet
{
  class PrescribedMotion;
  enum class Tangent;
  class SurfaceMatrix;

  /**
   * The sum of force terms. Loads that depend on neither time nor motion are
   * evaluated once. Members are collective.
   */
  class ForceTerms
  {
  public:
    /// @p discretization must outlive this object.
    explicit ForceTerms(const Discretization &discretization);

    /// @p name is the entry and place that messages call it by, if any does:
    /// "Boundary conditions/Traction on boundary 'x-max'".
    void
    add(std::unique_ptr<ForceTerm> term, const std::string &name = "");

    /// Terms that are added from now on are those of programs that use the
    /// library: derivative_errors() looks at them.
    void
    terms_of_programs_follow()
    {
      first_of_programs = terms.size();
    }

    /// Removes damping terms, for statics and modes, but keeps their names.
    void
    leave_out_damping();

    /// f = load_factor times the loads, plus the forces of supports and of the
    /// elastic terms that depend on time.
    void
    external_force(Vector       &f,
                   const Motion &motion,
                   const double  load_factor) const;

    /// Whether the external force depends on neither time nor motion.
    bool
    is_constant() const;

    /// Whether the external force depends on the motion.
    bool
    follows_motion() const;

    /// f = minus the forces of the elastic terms that do not depend on time.
    void
    elastic_force(Vector &f, const Motion &motion) const;

    /// Whether elastic_force() has any terms.
    bool
    has_elastic() const;

    /// Energy of all elastic terms [J].
    double
    energy(const Motion &motion) const;

    /// Energy of the elastic terms that depend on time [J].
    double
    changing_energy(const Motion &motion) const;

    /// f = minus the forces of damping.
    void
    damping_force(Vector &f, const Motion &motion) const;

    bool
    has_damping() const;

    /// Whether any term depends on the velocity.
    bool
    depends_on_velocity() const;

    /// Whether damping may change velocities far within a step: whether any
    /// term depends on them that is not proportional to the mass.
    bool
    has_stiff_damping() const;

    /// Whether any term depends on the velocity in another way than by the
    /// body's matrices or a matrix of the surface.
    bool
    has_other_velocity_forces() const;

    /// Whether damping may do work on the body: other velocity forces, and
    /// friction of obstacles that move.
    bool
    may_drive() const;

    /// The parts of the terms' - df/dv that consist of the body's matrices.
    MatrixShares
    damping_shares() const;

    /// Whether surface_matrix() has any terms.
    bool
    has_surface_matrix() const;

    /// Whether surface_matrix() has terms that depend on the displacement and
    /// are supports.
    bool
    has_springs() const;

    /// Whether surface_matrix() has terms that depend on the velocity.
    bool
    has_surface_damping() const;

    bool
    surface_matrix_depends_on_time() const;

    bool
    surface_matrix_depends_on_motion() const;

    /// @p S = - (@p c_u df/du + @p c_v df/dv) of the terms that have such a
    /// matrix. Throws ComputationError.
    void
    surface_matrix(SurfaceMatrix &S,
                   const Motion  &motion,
                   const double   c_u,
                   const double   c_v) const;

    /// The springs of all supports at a time, as a matrix of the surface; null
    /// if there are none.
    std::unique_ptr<SurfaceMatrix>
    springs(const ReferenceElement &reference, const double time) const;

    /// The springs of all terms at a time, no less stiff than at any motion;
    /// null if there are none.
    std::unique_ptr<SurfaceMatrix>
    stiffest_springs(const ReferenceElement &reference,
                     const double            time) const;

    /// The names of all obstacles, without repetition.
    std::vector<std::string>
    obstacles() const;

    /// The obstacles, without repetition.
    std::vector<std::shared_ptr<const Obstacle>>
    obstacle_shapes() const;

    /// The boundaries on which the ground acts by force terms: springs and
    /// dashpots.
    std::set<unsigned int>
    ground_boundaries() const;

    /// What the ground does on each of them. Collective.
    std::vector<GroundForce>
    ground_forces(const Motion &motion) const;

    /// The name of each obstacle, and its force on the body [N].
    std::vector<std::pair<std::string, dealii::Tensor<1, 3>>>
    contact_forces(const Motion &motion) const;

    /// The energy of the pressure of obstacles [J].
    double
    contact_energy(const Motion &motion) const;

    /// The name of each obstacle, and the greatest depth of the body inside of
    /// it [m]; less than zero where it is outside.
    std::vector<std::pair<std::string, double>>
    contact_depths(const Motion &motion) const;

    /// Whether obstacles have damping.
    bool
    has_friction() const;

    /// Whether no other term has damping.
    bool
    has_only_friction() const;

    /// f = minus the damping forces of obstacles.
    void
    friction_force(Vector &f, const Motion &motion) const;

    /// Names of the terms whose forces act on no unknowns but those that
    /// supports prescribe, in all of these motions, which should move every
    /// node. Motions after the second one are for loads that depend on time.
    /// Terms without a name are left out.
    std::vector<std::string>
    names_without_effect(const std::vector<Motion> &motions,
                         const PrescribedMotion    &supports) const;

    /// Names of the terms that resist motion, if they have names; also of those
    /// left out.
    std::vector<std::string>
    names_of_damping() const;

    /// Names of the loads that depend on time, if they have names.
    std::vector<std::string>
    names_of_loads_in_time() const;

    /// Whether all terms are linear.
    bool
    is_linear() const;

    /// Whether there are derivatives that belong to that tangent, besides those
    /// in matrices.
    bool
    has_linearization(const Tangent tangent) const;

    /// Prepares add_linearized() for that tangent. Not collective.
    void
    linearize(const Motion &motion, const Tangent tangent);

    /// f -= (df/du + velocity_factor df/dv) w, with loads times @p load_factor,
    /// as linearize() has prepared it. Ghost entries of w must be up to date,
    /// those of f must not be in use.
    void
    subtract_linearized(Vector       &f,
                        const Vector &w,
                        const double  load_factor,
                        const double  velocity_factor,
                        const Tangent tangent) const;

    /// How far the derivatives that terms of programs give differ from those by
    /// finite differences, relative to the larger one [-], with the terms'
    /// names: (df/du + @p velocity_factor df/dv) w at @p motion. Ghost entries
    /// of w are up to date.
    std::vector<std::pair<std::string, double>>
    derivative_errors(const Motion &motion,
                      const Vector &w,
                      const double  velocity_factor);

    /// Whether the derivatives that belong to that tangent are symmetric.
    bool
    is_symmetric(const Tangent tangent) const;

    bool
    has_potential() const;

    /// The round-off that the sum may have [N]; the arguments are those of
    /// ForceTerm::round_off().
    double
    round_off(const Motion        &motion,
              const double         size,
              const ForceRoundOff &noise) const;

  private:
    /// A zero vector, used for one sum at a time.
    Vector &
    zero_vector() const;

    const Discretization                   &discretization;
    std::vector<std::unique_ptr<ForceTerm>> terms;
    /// The number of the first term of programs, if there is one.
    std::size_t first_of_programs = std::numeric_limits<std::size_t>::max();
    /// The name of each term, or an empty text.
    std::vector<std::string> names;
    /// Names of the damping terms that have been left out.
    std::vector<std::string> names_left_out;
    /// Sum of the loads that depend on neither time nor motion.
    Vector constant_load;
    /// See zero_vector(); empty before its first call.
    mutable Vector scratch;
  };
} // namespace corotet

#endif
