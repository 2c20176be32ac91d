// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_expression_h
#define corotet_base_expression_h

#include <corotet/base/table_functions.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <memory>
#include <string>

namespace corotet
{
  /**
   * A formula in x, y, z [m] and t [s] with one or more components, as a user
   * writes it: muParser's syntax, components separated by semicolons, the
   * constant pi, functions of time (see define_functions()) and tables.
   * Example: "0; 0; -9.81 * ramp(t, 0, 1)".
   *
   * Values may be infinite or not a number; whoever evaluates decides about
   * that. Copies share the compiled formula; one must not be evaluated by
   * several threads at once.
   */
  class Expression
  {
  public:
    /// Throws an InputError that blames @p entry if @p text has not @p
    /// n_components components or is no formula. @p tables are functions of
    /// one argument that formulas may use.
    Expression(const std::string    &text,
               const unsigned int    n_components,
               const std::string    &entry,
               const TableFunctions &tables = {});

    double
    value(const dealii::Point<3> &p,
          const double            t,
          const unsigned int      component = 0) const;

    /// The value of an expression of three components.
    dealii::Tensor<1, 3>
    vector_value(const dealii::Point<3> &p, const double t) const;

    /// The first and second derivative in time; at a jump or kink, those from
    /// later times. They are exact up to round-off. Where they are not finite
    /// (as of sqrt(t) at t = 0), they are one-sided differences of values up to
    /// 3 @p width [s] away.
    std::array<double, 2>
    time_derivatives(const dealii::Point<3> &p,
                     const double            t,
                     const double            width,
                     const unsigned int      component = 0) const;

    unsigned int
    n_components() const;

    bool
    depends_on_space() const
    {
      return space_dependent;
    }

    bool
    depends_on_time() const
    {
      return time_dependent;
    }

    /// Whether all components are constants of value zero.
    bool
    is_zero() const
    {
      return zero;
    }

  private:
    struct Formulas;

    std::shared_ptr<Formulas> formulas;

    bool space_dependent = false;
    bool time_dependent  = false;
    bool zero            = false;
  };

  /// Whether @p text is an Expression with so many components, all of which are
  /// constants of value zero; false if it is no expression, or one with tables.
  bool
  is_zero_expression(const std::string &text, const unsigned int n_components);
} // namespace corotet

#endif
