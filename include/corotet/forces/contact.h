// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_contact_h
#define corotet_forces_contact_h

#include <corotet/forces/contact_surface.h>
#include <corotet/forces/nearby_faces.h>
#include <corotet/forces/obstacle.h>
#include <corotet/operators/surface_matrix.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * Forces of an obstacle on the points of the surface that are inside of it.
   */
  class Contact : public ForceTerm
  {
  public:
    bool
    depends_on_time() const override
    {
      return the_obstacle->is_moving();
    }

    bool
    depends_on_displacement() const override
    {
      return true;
    }

    std::string
    obstacle() const override
    {
      return the_obstacle->name();
    }

    std::shared_ptr<const Obstacle>
    obstacle_shape() const override
    {
      return the_obstacle;
    }

    /// The stiffness per area that was given [N/m^3]; 0 for the default.
    double
    given_stiffness() const
    {
      return stiffness;
    }

    bool
    has_surface_matrix() const override
    {
      return true;
    }

    bool
    surface_matrix_depends_on_motion() const override
    {
      return true;
    }

  protected:
    /// @p stiffness is that per area at rest [N/m^3]; 0 stands for the default.
    Contact(const std::shared_ptr<const ContactSurface> &surface,
            const std::shared_ptr<const Obstacle>       &obstacle,
            const std::shared_ptr<NearbyFaces>          &nearby,
            const double                                 stiffness)
      : surface(surface)
      , the_obstacle(obstacle)
      , stiffness(stiffness)
      , nearby(nearby)
    {}

    /// A point of the surface that is inside of the obstacle.
    struct TouchingPoint
    {
      /// Numbers of the face and of the point in its rule.
      std::size_t  face;
      unsigned int point;
      /// Stiffness times area [N/m].
      double        stiffness;
      Obstacle::Gap gap;
    };

    /// Calls @p function(TouchingPoint) for the points of own faces, or of all
    /// faces.
    template <typename Function>
    void
    for_each_point(const Motion   &motion,
                   const bool      with_ghosts,
                   const Function &function) const;

    /// The stiffness of a face per area [N/m^3].
    double
    stiffness_of(const ContactSurface::Face &face) const
    {
      return stiffness > 0 ? stiffness : face.stiffness;
    }

    /// Adds @p force at a point to @p f.
    void
    add_at(Vector                     &f,
           const TouchingPoint        &point,
           const dealii::Tensor<1, 3> &force) const;

    /// The value of a vector at a point.
    dealii::Tensor<1, 3>
    value_at(const Vector &v, const TouchingPoint &point) const;

    /// Adds @p tensor(TouchingPoint) to the points' tensors in @p S.
    template <typename Function>
    void
    add_tensors(SurfaceMatrix  &S,
                const Motion   &motion,
                const Function &tensor) const;

    const std::shared_ptr<const ContactSurface> surface;
    const std::shared_ptr<const Obstacle>       the_obstacle;
    const double                                stiffness;

  private:
    /// Those of this obstacle, for all of its forces.
    const std::shared_ptr<NearbyFaces> nearby;
  };

  /**
   * Section Contact, entry Obstacles: the pressure of an obstacle, f = k d n
   * per area at rest at a depth d below its surface with the normal n, with the
   * energy k d^2 / 2. Its derivative leaves out that of n, which is smaller by
   * d over the radius of curvature.
   */
  class NormalContact : public Contact
  {
  public:
    NormalContact(const std::shared_ptr<const ContactSurface> &surface,
                  const std::shared_ptr<const Obstacle>       &obstacle,
                  const std::shared_ptr<NearbyFaces>          &nearby,
                  const double                                 stiffness)
      : Contact(surface, obstacle, nearby, stiffness)
    {}

    Role
    role() const override
    {
      return Role::elastic;
    }

    double
    energy(const Motion &motion) const override;

    void
    add_force(Vector &f, const Motion &motion) const override;

    void
    add_surface_matrix(SurfaceMatrix &S,
                       const Motion  &motion,
                       const double   c_u,
                       const double   c_v) const override;

    void
    add_largest_surface_matrix(SurfaceMatrix &S) const override;

    /// That of positions.
    double
    round_off(const Motion        &motion,
              const double         size,
              const ForceRoundOff &noise) const override;

    double
    depth(const Motion &motion) const override;
  };

  /**
   * Section Contact, entry Friction: f = - mu p v / sqrt(v^2 + w^2) per area at
   * rest, with the pressure p of NormalContact, the velocity v at which a point
   * slides on the obstacle, and the entry Slip velocity w.
   */
  class Friction : public Contact
  {
  public:
    Friction(const std::shared_ptr<const ContactSurface> &surface,
             const std::shared_ptr<const Obstacle>       &obstacle,
             const std::shared_ptr<NearbyFaces>          &nearby,
             const double                                 stiffness,
             const double                                 coefficient,
             const double                                 slip_velocity)
      : Contact(surface, obstacle, nearby, stiffness)
      , coefficient(coefficient)
      , slip_velocity(slip_velocity)
    {}

    Role
    role() const override
    {
      return Role::damping;
    }

    bool
    depends_on_velocity() const override
    {
      return true;
    }

    void
    add_force(Vector &f, const Motion &motion) const override;

    /// The force over the velocity, which is stiffer than the derivative.
    void
    add_surface_matrix(SurfaceMatrix &S,
                       const Motion  &motion,
                       const double   c_u,
                       const double   c_v) const override;

    /// What the derivative has besides: that by the pressure, which is not
    /// symmetric, and the softness along the velocity.
    bool
    has_linearization() const override
    {
      return true;
    }

    void
    linearize(const Motion &motion) override;

    void
    add_linearized(Vector       &f,
                   const Vector &w,
                   const double  velocity_factor) const override;

    bool
    is_symmetric() const override
    {
      return false;
    }

    bool
    has_potential() const override
    {
      return false;
    }

  private:
    /// How a point slides.
    struct Sliding
    {
      /// The velocity along the surface, and the square root of its square and
      /// that of the slip velocity [m/s].
      dealii::Tensor<1, 3> velocity;
      double               speed;
      /// mu times the pressure times the area [N].
      double limit;
    };

    Sliding
    sliding(const TouchingPoint        &point,
            const Motion               &motion,
            const dealii::Tensor<1, 3> &velocity_of_obstacle) const;

    /// The direction z of friction that a point has in the linearization: v / s
    /// with s = sqrt(v^2 + w^2) in the first one of a solve, then what the last
    /// linearization of s z = v gives for the present velocity, but no longer
    /// than one. A point that a full increment turns round would else be turned
    /// back and forth [chan1999].
    dealii::Tensor<1, 3>
    direction_at(const TouchingPoint &point, const Sliding &now);

    /// A point at the last linearize().
    struct LinearizedPoint
    {
      TouchingPoint point;
      /// The derivative of the force by the depth [N/m].
      dealii::Tensor<1, 3> of_pressure;
      /// The force over the velocity less the derivative by it [N s/m].
      SurfaceMatrix::Tensor less_damping;
    };

    /// The last linearization of a point.
    struct Direction
    {
      unsigned int         solve = 0;
      dealii::Tensor<1, 3> velocity;
      double               speed = 1;
      dealii::Tensor<1, 3> z;
    };

    const double                 coefficient;
    const double                 slip_velocity;
    std::vector<LinearizedPoint> points;
    /// [face][point]; empty before the first linearization.
    std::vector<Direction> directions;
    /// Linearizations at one time belong to one solve.
    double       linearized_time = std::numeric_limits<double>::quiet_NaN();
    unsigned int n_solves        = 0;
  };

  /**
   * The kind contact, section Contact: pressure and friction of each obstacle.
   */
  class ContactKind : public ForceKind
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    std::vector<GivenEntry>
    given() const override;

    std::vector<std::string>
    obstacles() const override;

    void
    add_to(ForceTerms &terms, const ForceContext &context) const override;

  private:
    /// Describes an obstacle in the log; stiffnesses of faces are from @p low
    /// to @p top. Collective.
    static void
    describe(const NormalContact &contact,
             const ForceContext  &context,
             const double         low,
             const double         top);

    std::string obstacle_list;
    std::string boundaries;
    std::string motions;
    std::string stiffnesses;
    std::string frictions;
    double      slip_velocity = 0;
  };
} // namespace corotet

#endif
