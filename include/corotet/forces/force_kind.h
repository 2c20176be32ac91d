// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_force_kind_h
#define corotet_forces_force_kind_h

#include <corotet/base/log.h>
#include <corotet/base/selectable.h>
#include <corotet/base/table_functions.h>
#include <corotet/discretization/boundary_conditions.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/operators/force_terms.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace corotet
{
  class Elasticity;
  class Mass;

  /**
   * The data that force terms are made of, and may keep. All that it refers to
   * must outlive the terms.
   */
  struct ForceContext
  {
    const Discretization     &discretization;
    const ReferenceElement   &reference;
    const Mass               &mass;
    Elasticity               &elasticity;
    const BoundaryConditions &conditions;
    /// The tables that expressions may use.
    const TableFunctions &tables;
    Log                  &log;
    /// Start time of the run [s].
    double start_time = 0;

    /// f = M a for owned entries. Ghost entries of @p a are up to date.
    /// Collective.
    void
    apply_mass(Vector &f, const Vector &a) const;
  };

  /// An item of a list "name: value, ..." of boundaries.
  struct ValueOnBoundaries
  {
    /// The name as in the list.
    std::string name;
    std::string value;
    /// The ids of the boundaries that @p name stands for.
    std::vector<unsigned int> boundaries;
  };

  /// The items of @p list, the value of the entry @p entry; @p what is "a
  /// traction" or the like, for messages. Throws InputError, also if a boundary
  /// is in two items.
  std::vector<ValueOnBoundaries>
  values_on_boundaries(const ForceContext &context,
                       const std::string  &list,
                       const std::string  &entry,
                       const std::string  &what);

  /// The name of a term on a boundary in messages: "ENTRY on boundary 'NAME'".
  std::string
  on_boundary(const ForceContext &context,
              const std::string  &entry,
              const unsigned int  boundary);

  /**
   * A kind of force: its parameters, and how to make terms of them.
   */
  class ForceKind
  {
  public:
    /// An entry of the parameter file that gives a force.
    struct GivenEntry
    {
      /// The path of the entry, "Section/Name".
      std::string entry;
      std::string value;
      /// The value that stands for no force.
      std::string none;
      /// Whether the force belongs to the stiffness at rest, which modes take
      /// into account.
      bool in_modes = false;
      /// Whether the force acts on the mass, so that statics needs densities.
      bool on_mass = false;
    };

    virtual ~ForceKind() = default;

    /// Declares its entries in their sections.
    virtual void
    declare_parameters(dealii::ParameterHandler & /*prm*/)
    {}

    /// The entries that give a force. Throws InputError.
    virtual std::vector<GivenEntry>
    given() const
    {
      return {};
    }

    /// The names of the obstacles of its terms. Throws InputError.
    virtual std::vector<std::string>
    obstacles() const
    {
      return {};
    }

    /// Adds the terms that the parameters ask for; none if there is no force.
    /// Throws InputError. Collective.
    virtual void
    add_to(ForceTerms &terms, const ForceContext &context) const = 0;
  };

  /**
   * The parameters of all registered kinds. Must not be moved after
   * declare_parameters().
   */
  class ForceParameters
  {
  public:
    ForceParameters();

    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// The entries of all kinds that give a force. Throws InputError.
    std::vector<ForceKind::GivenEntry>
    given() const;

    /// The names of the obstacles of all kinds. Throws InputError.
    std::vector<std::string>
    obstacles() const;

    /// The terms of all kinds. Throws InputError. Collective.
    ForceTerms
    make(const ForceContext &context) const;

    /// The terms of the kinds that give a force to modes. Throws InputError.
    /// Collective.
    ForceTerms
    make_for_modes(const ForceContext &context) const;

  private:
    /// The library's own kinds, and then those that programs have added.
    std::vector<std::unique_ptr<ForceKind>> kinds;
    std::size_t                             n_of_library = 0;
  };

  /// All kinds of forces, with those that programs have added.
  std::vector<Candidate<ForceKind>>
  force_kinds();
} // namespace corotet

#endif
