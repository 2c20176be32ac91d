// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_prescribed_motion_h
#define corotet_discretization_prescribed_motion_h

#include <corotet/base/vector.h>
#include <corotet/discretization/boundary_conditions.h>
#include <corotet/discretization/discretization.h>
#include <corotet/discretization/reference_element.h>

#include <array>
#include <set>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The unknowns whose displacement is prescribed, and their motion in time.
   *
   * Velocity and acceleration are the time derivatives of the expression, exact
   * where they exist; see Expression::time_derivatives(). (Derivatives by the
   * integrator's own formulas would oscillate from step to step.) At an instant
   * where they are not finite, the expression is also evaluated up to three
   * tenths of a time scale later, or earlier.
   *
   * @p discretization and @p conditions must outlive this object.
   */
  class PrescribedMotion
  {
  public:
    /// @p time_scale [s] is the time step, or one that would be accurate; with
    /// 0 velocities and accelerations are zero, as in statics. Throws
    /// InputError. Collective.
    PrescribedMotion(const Discretization     &discretization,
                     const ReferenceElement   &reference,
                     const BoundaryConditions &conditions,
                     const double              time_scale);

    /**
     * Sets the prescribed owned entries of the displacement, and those of the
     * velocity and the acceleration, to their values at @p time multiplied by
     * @p load_factor. Throws InputError if two places disagree at a node that
     * they share, or a value or derivative is not finite. Collective.
     */
    void
    apply(const double time,
          const double load_factor,
          Vector      &displacement,
          Vector      &velocity,
          Vector      &acceleration) const;

    /// Whether each local unknown, ghosts included, is prescribed (0 or 1).
    const std::vector<unsigned char> &
    is_prescribed() const
    {
      return flags;
    }

    /// Whether no prescribed displacement depends on time.
    bool
    is_at_rest() const;

    /// Sets the prescribed owned entries of @p vector to zero.
    void
    set_zero(Vector &vector) const;

    /// The prescribed owned unknowns, as local numbers.
    const std::vector<unsigned int> &
    unknowns() const
    {
      return prescribed;
    }

    /// Whether each local node, ghosts included, belongs to all @p places (0 or
    /// 1). Throws InputError, blamed on @p entry, if no node does. Collective.
    std::vector<unsigned char>
    common_nodes(const ReferenceElement &reference,
                 const std::set<Place>  &places,
                 const std::string      &entry) const;

  private:
    /// An unknown and the condition that prescribes it.
    struct Entry
    {
      unsigned int unknown;
      unsigned int condition;
    };

    const Expression &
    expression(const Entry &entry) const
    {
      return *conditions.displacements[entry.condition]
                .components[entry.unknown % 3];
    }

    /// Adds 1 or more to the first component of those nodes of a place that are
    /// on faces, edges or vertices of owned cells there.
    void
    mark(Vector                 &marks,
         const ReferenceElement &reference,
         const Place            &place) const;

    double
    value(const Entry &entry, const double time) const;

    /// The displacement, velocity and acceleration. Throws InputError.
    std::array<double, 3>
    motion(const Entry &entry, const double time) const;

    void
    check_agreement(const double time) const;

    const Discretization      &discretization;
    const BoundaryConditions  &conditions;
    double                     time_scale;
    double                     length_scale;
    std::vector<unsigned char> flags;
    std::vector<unsigned int>  prescribed;
    std::vector<Entry>         entries;
    /// Further conditions on unknowns that entries already has, with the index
    /// of that entry.
    std::vector<std::pair<Entry, unsigned int>> shared;
  };
} // namespace corotet

#endif
