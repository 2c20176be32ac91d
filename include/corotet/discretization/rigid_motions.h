// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_rigid_motions_h
#define corotet_discretization_rigid_motions_h

#include <corotet/discretization/connected_parts.h>
#include <corotet/discretization/prescribed_motion.h>

#include <array>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The small motions without strain that supports leave to the body: the null
   * space of the stiffness of linear elasticity.
   *
   * Each of the ConnectedParts moves by u(x) = t + w x (x - c) / r, with its
   * centre c and radius r. The six numbers t, w of all parts are in the null
   * space of the equations "prescribed unknowns are zero", "parts agree at
   * their joints" and "displacements that springs resist are zero". A motion of
   * size one counts as free if it violates them by less than the square root of
   * the machine precision (root mean square over the nodes concerned): then the
   * energy that resists it is round-off.
   *
   * The arguments of the constructor must outlive this object.
   */
  class RigidMotions
  {
  public:
    /// A point of the body where an elastic support resists displacements in a
    /// direction.
    struct Spring
    {
      /// The owned cell that has the point.
      unsigned int         cell;
      dealii::Point<3>     point;
      dealii::Tensor<1, 3> direction;
    };

    /// The tolerance of motions that nothing resists.
    static constexpr double free_tolerance = 1.5e-8;
    /// That of motions that supports hardly resist.
    static constexpr double weak_tolerance = 0.02;

    /// Motions that violate the equations by less than @p tolerance.
    /// Collective.
    RigidMotions(const Discretization      &discretization,
                 const PrescribedMotion    &motion,
                 const std::vector<Spring> &springs   = {},
                 const double               tolerance = free_tolerance);

    /// The number of ConnectedParts.
    unsigned int
    n_parts() const
    {
      return parts.n_parts;
    }

    /// The number of linearly independent motions.
    unsigned int
    size() const
    {
      return motions.size();
    }

    /// Whether all motions were found. They are not looked for among more than
    /// 100 parts that are connected by joints.
    bool
    is_complete() const
    {
      return complete;
    }

    /// Sets the owned entries of @p u to motion number @p k, 0 to size() - 1,
    /// of size one [m]; prescribed entries are exactly zero. The motions of a
    /// part that is free are translations along x, y, z and rotations about
    /// these axes.
    void
    evaluate(Vector &u, const unsigned int k) const;

    /// A description of what can move, and how; empty if there are no motions.
    /// The same on any number of ranks.
    std::string
    description() const;

    /// The six numbers t [m], w [m] of a part.
    using Numbers = std::array<double, 6>;

  private:
    /// The numbers of parts that joints connect, in ascending order.
    using Cluster = std::vector<unsigned int>;

    /// Finds the motions of a cluster from its equations, one per row, which
    /// are overwritten.
    void
    solve(const Cluster                    &cluster,
          std::vector<std::vector<double>> &equations,
          const double                      tolerance);
    /// The linearly independent motions of one part.
    std::vector<Numbers>
    motions_of(const unsigned int part) const;
    std::string
    name(const unsigned int part) const;

    const Discretization   &discretization;
    const PrescribedMotion &motion;
    const ConnectedParts    parts;
    bool                    complete = true;
    /// The parts that move in each motion, with their six numbers.
    std::vector<std::vector<std::pair<unsigned int, Numbers>>> motions;
    /// The six numbers of each part in all motions.
    std::vector<std::vector<std::vector<double>>> numbers_of_parts;
  };

  /**
   * A text that lists the bodies, by their places and regions, if there are
   * several that have no node in common: each is one of @p parts, or some that
   * have joints. Empty otherwise. The same on any number of ranks. Collective.
   */
  std::string
  unconnected_parts(const Discretization &discretization,
                    const ConnectedParts &parts);

  /**
   * The motions in words: "move along x and rotate about the axis through (0,
   * 0, 0) along z". @p motions are linearly independent motions of a part with
   * this @p centre and @p radius, as RigidMotions has them.
   */
  std::string
  describe(const std::vector<RigidMotions::Numbers> &motions,
           const dealii::Point<3>                   &centre,
           const double                              radius);

  /**
   * The reduced row echelon form of linearly independent rows, with columns
   * taken in the order @p columns: the same for all bases of their span.
   * Entries below @p tolerance are not used as pivots.
   */
  void
  reduce_rows(std::vector<std::vector<double>> &rows,
              const std::vector<unsigned int>  &columns,
              const double                      tolerance);
} // namespace corotet

#endif
