// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_selectable_h
#define corotet_base_selectable_h

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * One candidate of a run-time choice: the name that a parameter file selects
   * it by, and how to make it.
   */
  template <typename Base>
  struct Candidate
  {
    std::string                            name;
    std::function<std::unique_ptr<Base>()> make;
  };

  /**
   * The candidate called @p name of class @p Derived: one line in a layer's
   * list registers it.
   */
  template <typename Base, typename Derived>
  Candidate<Base>
  candidate(const std::string &name)
  {
    return {name, [] { return std::make_unique<Derived>(); }};
  }

  /**
   * A named run-time choice among classes derived from @p Base: the entry
   * `Type`, and a subsection with the parameters of each candidate.
   *
   * @p Base has a member `void declare_parameters(dealii::ParameterHandler &)`.
   * All candidates live as long as this object, which must not be moved after
   * declare_parameters(): the handler writes into it while it reads a file.
   */
  template <typename Base>
  class Selectable
  {
  public:
    Selectable(const std::vector<Candidate<Base>> &candidates,
               const std::string                  &default_name)
      : selected_name(default_name)
    {
      for (const Candidate<Base> &c : candidates)
        objects.emplace_back(c.name, c.make());
    }

    Selectable(const Selectable &) = delete;
    Selectable &
    operator=(const Selectable &) = delete;

    void
    declare_parameters(dealii::ParameterHandler &prm,
                       const std::string        &documentation)
    {
      std::string names;
      for (const auto &[name, object] : objects)
        names += (names.empty() ? "" : "|") + name;
      prm.add_parameter("Type",
                        selected_name,
                        documentation,
                        dealii::Patterns::Selection(names));
      for (auto &[name, object] : objects)
        {
          prm.enter_subsection(name);
          object->declare_parameters(prm);
          prm.leave_subsection();
        }
    }

    const std::string &
    name() const
    {
      return selected_name;
    }

    Base &
    selected() const
    {
      for (const auto &[name, object] : objects)
        if (name == selected_name)
          return *object;
      AssertThrow(false,
                  dealii::ExcMessage("No candidate is called " +
                                     selected_name));
      return *objects.front().second;
    }

  private:
    std::string                                                selected_name;
    std::vector<std::pair<std::string, std::unique_ptr<Base>>> objects;
  };
} // namespace corotet

#endif
