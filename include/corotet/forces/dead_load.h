// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_dead_load_h
#define corotet_forces_dead_load_h

#include <corotet/base/expression.h>
#include <corotet/discretization/discretization.h>
#include <corotet/forces/force_kind.h>

#include <deal.II/base/point.h>

#include <functional>
#include <optional>
#include <vector>

namespace corotet
{
  /**
   * A load that depends on the place at rest and on time, not on the motion:
   * f_i = int N_i b or int N_i t [seed, 2.61]. If it is the same everywhere, it
   * is integrated once.
   */
  class DeadLoad : public ForceTerm
  {
  public:
    /// The load at a point at rest, with the outward normal there if it is on
    /// the surface, at a time.
    using Value =
      std::function<dealii::Tensor<1, 3>(const dealii::Point<3> &,
                                         const dealii::Tensor<1, 3> &,
                                         const double)>;

    bool
    depends_on_time() const override
    {
      return varies_in_time;
    }

    void
    add_force(Vector &f, const Motion &motion) const override;

  protected:
    /// The load at one time.
    using Field =
      std::function<dealii::Tensor<1, 3>(const dealii::Point<3> &,
                                         const dealii::Tensor<1, 3> &)>;

    DeadLoad(const Discretization &discretization, const Expression &value);
    DeadLoad(const Discretization &discretization,
             const Value          &value,
             const bool            depends_on_time);

    /// f += the force of @p field, in any local entries. Collective.
    virtual void
    integrate(Vector &f, const Field &field) const = 0;

    const Discretization &discretization;

  private:
    struct NodalForce
    {
      /// The local number of an owned node.
      unsigned int         node;
      dealii::Tensor<1, 3> force;
    };

    /// Integrates a unit load in each direction. Collective.
    std::vector<NodalForce>
    forces_of_unit_load() const;

    Value value;
    bool  varies_in_space;
    bool  varies_in_time;
    /// The forces of a unit load in each direction, at the nodes where it has
    /// any; set by the first add_force() if the load is the same everywhere.
    mutable std::optional<std::vector<NodalForce>> unit_forces;
  };

  /**
   * A load on the whole body, given by an entry of section Loads: three
   * expressions in x, y, z, t.
   */
  class VectorFieldKind : public ForceKind
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    std::vector<GivenEntry>
    given() const override;

    void
    add_to(ForceTerms &terms, const ForceContext &context) const override;

  protected:
    /// @p entry is its name, @p quantity describes the load with its unit.
    VectorFieldKind(const std::string &entry, const std::string &quantity);

    virtual std::unique_ptr<ForceTerm>
    make(const Expression &value, const ForceContext &context) const = 0;

  private:
    const std::string entry, quantity;
    std::string       text = "0; 0; 0";
  };
} // namespace corotet

#endif
