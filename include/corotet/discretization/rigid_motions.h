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
   * centre c and radius r; the six numbers t, w of all parts are in the null
   * space of the equations "prescribed unknowns are zero", "parts agree at
   * their joints" and "what springs resist is zero". Motions of size one that
   * move these by less than the square root of the machine precision (root mean
   * square over the nodes concerned) count as free: the energy that resists
   * them is round-off.
   *
   * The arguments of the constructor must outlive this object.
   */
  class RigidMotions
  {
  public:
    /// A point of the body where something elastic resists displacements in a
    /// direction.
    struct Spring
    {
      /// The owned cell that has the point.
      unsigned int         cell;
      dealii::Point<3>     point;
      dealii::Tensor<1, 3> direction;
    };

    /// Collective.
    RigidMotions(const Discretization      &discretization,
                 const PrescribedMotion    &motion,
                 const std::vector<Spring> &springs = {});

    /// How many there are, linearly independent.
    unsigned int
    size() const
    {
      return motions.size();
    }

    /// Whether all were found. They are not looked for among more than 100
    /// parts that hang together by joints.
    bool
    is_complete() const
    {
      return complete;
    }

    /// Sets the owned entries of @p u to motion number @p k, 0 to size() - 1,
    /// of size one [m]: exactly zero where prescribed. Those of a part that is
    /// free are translations along x, y, z and rotations about these axes.
    void
    evaluate(Vector &u, const unsigned int k) const;

    /// What can move, and how, in words; empty if there are no motions. The
    /// same on any number of ranks.
    std::string
    description() const;

    /// The six numbers t [m], w [m] of a part.
    using Numbers = std::array<double, 6>;

  private:
    /// Parts that joints connect, and their numbers in ascending order.
    using Cluster = std::vector<unsigned int>;

    /// Finds the motions of a cluster from its equations, a row for each, which
    /// are overwritten.
    void
    solve(const Cluster &cluster, std::vector<std::vector<double>> &equations);
    /// What one part can do, as independent motions.
    std::vector<Numbers>
    motions_of(const unsigned int part) const;
    std::string
    name(const unsigned int part) const;

    const Discretization   &discretization;
    const PrescribedMotion &motion;
    const ConnectedParts    parts;
    bool                    complete = true;
    /// Of each motion the parts that move, with their numbers.
    std::vector<std::vector<std::pair<unsigned int, Numbers>>> motions;
    /// Of each part its numbers in all of them.
    std::vector<std::vector<std::vector<double>>> numbers_of_parts;
  };

  /**
   * In words, if the body consists of several that have no node in common:
   * which, by their places and regions. Empty otherwise. The same on any number
   * of ranks. Collective.
   */
  std::string
  unconnected_parts(const Discretization &discretization);

  /**
   * In words: "move along x and rotate about the axis through (0, 0, 0) along
   * z". @p motions are linearly independent, those of a part with this @p
   * centre and @p radius, as RigidMotions has them.
   */
  std::string
  describe(const std::vector<RigidMotions::Numbers> &motions,
           const dealii::Point<3>                   &centre,
           const double                              radius);

  /**
   * The reduced row echelon form of linearly independent rows, with columns
   * taken in the order @p columns: the same for all bases of their span.
   * Entries below @p tolerance are no pivots.
   */
  void
  reduce_rows(std::vector<std::vector<double>> &rows,
              const std::vector<unsigned int>  &columns,
              const double                      tolerance);
} // namespace corotet

#endif
