// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_loads_h
#define corotet_operators_loads_h

#include <corotet/base/expression.h>
#include <corotet/base/log.h>
#include <corotet/base/vector.h>
#include <corotet/discretization/boundary_conditions.h>
#include <corotet/discretization/discretization.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/material/exact_solution.h>
#include <corotet/operators/mass.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The parameters of section Loads, as text.
   */
  struct LoadParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    std::string gravity    = "0; 0; 0";
    std::string body_force = "0; 0; 0";
    std::string point_forces;
  };

  /**
   * The external force f_ext(t, u) [N]: gravity, body force, tractions,
   * pressures and point forces, f_i = int N_i b + int_Gamma N_i t [seed, 2.61].
   *
   * Gravity is an acceleration field, interpolated at the nodes, times the mass
   * matrix: a free body falls without deforming whatever the mass matrix. What
   * does not depend on time, or not on space, is integrated once.
   *
   * The other arguments must outlive this object. Members are collective.
   */
  class Loads
  {
  public:
    /// @p follow: whether pressures act on the deformed surface. @p tables are
    /// for the expressions.
    Loads(const Discretization     &discretization,
          const ReferenceElement   &reference,
          const Mass               &mass,
          const BoundaryConditions &conditions,
          const LoadParameters     &parameters,
          const bool                follow,
          Log                      &log,
          const TableFunctions     &tables = {});

    /**
     * Adds the body force of @p solution and its tractions on @p boundaries.
     * @p with_inertia: of a dynamic problem. @p solution must outlive this
     * object.
     */
    void
    add_manufactured(const ExactSolution             &solution,
                     const IsotropicMaterial         &material,
                     const bool                       is_linear,
                     const bool                       with_inertia,
                     const std::vector<unsigned int> &boundaries);

    /// f = f_ext at @p time and displacement @p u (ghosts up to date).
    void
    force(Vector &f, const double time, const Vector &u) const;

    /// Whether the force depends neither on time nor on the displacement.
    bool
    is_constant() const;

    /// Whether there are pressures on the deformed surface: loads that depend
    /// on the displacement.
    bool
    has_follower_pressure() const;

    /// What round-off may make of the force of such pressures at the
    /// displacement @p u, relative to its size [-].
    double
    relative_round_off(const Vector &u) const;

    /// Prepares the derivative of the force by the displacement, at @p time and
    /// displacement @p u (ghosts up to date). Not collective.
    void
    linearize(const double time, const Vector &u);

    /// f += factor d f_ext / du v, with v's ghosts up to date. f must not have
    /// ghost entries in use.
    void
    add_linearized(Vector &f, const Vector &v, const double factor) const;

  private:
    /// A load that does not depend on the displacement.
    struct DeadLoad
    {
      enum class Kind
      {
        gravity,
        body_force,
        traction
      };

      /// At a point, on the surface with the outward normal there, at a time.
      using Value =
        std::function<dealii::Tensor<1, 3>(const dealii::Point<3> &,
                                           const dealii::Tensor<1, 3> &,
                                           const double)>;

      DeadLoad(const Kind         kind,
               const Expression  &expression,
               const unsigned int boundary = 0);
      DeadLoad(const Kind         kind,
               const Value       &value,
               const bool         depends_on_time,
               const unsigned int boundary = 0);

      Kind         kind;
      Value        value;
      bool         is_zero;
      bool         depends_on_space;
      bool         depends_on_time;
      unsigned int boundary;
      /// The force of a unit load in each direction if the load is constant in
      /// space.
      Vector integral = {};
    };

    /// A point of a surface under pressure.
    struct PressurePoint
    {
      const BoundaryFace *face;
      /// In the face's rule.
      unsigned int index;
      /// Pressure times weight [N/m^2].
      double pressure;
      /// Derivatives of the position by the face's parameters [m].
      std::array<dealii::Tensor<1, 3>, 2> tangents;
    };

    struct PointForce
    {
      Expression       value;
      dealii::Point<3> position;
      /// Local number; used only where the node is owned.
      unsigned int node;
      bool         is_owned;
    };

    void
    add_dead_load(DeadLoad load);
    /// Finds the smallest height of faces under pressure.
    void
    measure_faces();
    PointForce
    locate(const std::string    &text,
           const TableFunctions &tables,
           Log                  &log) const;

    /// f = the load, with its value taken from @p value(x, n).
    template <typename Value>
    void
    integrate(Vector &f, const DeadLoad &load, const Value &value) const;
    template <typename Value>
    void
    integrate_body_force(Vector &f, const Value &value) const;
    template <typename Value>
    void
    integrate_traction(Vector            &f,
                       const unsigned int boundary,
                       const Value       &value) const;
    void
    add_pressure(Vector                                &f,
                 const BoundaryConditions::SurfaceLoad &load,
                 const double                           time,
                 const Vector                          &u) const;

    const Discretization     &discretization;
    const ReferenceElement   &reference;
    const Mass               &mass;
    const BoundaryConditions &conditions;
    bool                      follow;
    std::vector<DeadLoad>     dead_loads;
    std::vector<PointForce>   point_forces;
    /// Of the faces under pressure, the inverse of the smallest height [1/m].
    double inverse_height = 0;
    /// Sum of the loads that do not depend on time.
    Vector constant_force;
    /// Of the last linearize().
    std::vector<PressurePoint> pressure_points;
    mutable Vector             scratch;
  };
} // namespace corotet

#endif
