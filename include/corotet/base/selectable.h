// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_selectable_h
#define corotet_base_selectable_h

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <list>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * One candidate of a run-time choice: the name that a parameter file selects
   * it by, and how to make it, with its default parameters or with those of
   * another object of the same class.
   */
  template <typename Base>
  struct Candidate
  {
    std::string                                        name;
    std::function<std::unique_ptr<Base>()>             make;
    std::function<std::unique_ptr<Base>(const Base &)> copy;
  };

  /**
   * The candidate called @p name of class @p Derived, made with @p arguments:
   * one line in a layer's list registers it. A copy of a @p Derived must have
   * its parameters, but need not have any other state.
   */
  template <typename Base, typename Derived, typename... Arguments>
  Candidate<Base>
  candidate(const std::string &name, const Arguments &...arguments)
  {
    return {name,
            [arguments...] { return std::make_unique<Derived>(arguments...); },
            [](const Base &other) {
              return std::make_unique<Derived>(
                static_cast<const Derived &>(other));
            }};
  }

  /**
   * The candidates that programs have added to the list of @p Base by
   * AddedCandidate.
   */
  template <typename Base>
  std::list<Candidate<Base>> &
  added_candidates()
  {
    static std::list<Candidate<Base>> candidates;
    return candidates;
  }

  /// Throws std::logic_error if both candidates have the same name.
  template <typename Base>
  void
  refuse_same_name(const Candidate<Base> &a, const Candidate<Base> &b)
  {
    if (a.name == b.name)
      throw std::logic_error("two candidates are called '" + a.name + "'");
  }

  /**
   * Adds a candidate to a layer's list, without a change of the library, during
   * the lifetime of this object: choices that are declared in that time offer
   * it, by its name and with its parameters. Use it as a global variable, or at
   * the start of main(), of a program that uses the library:
   *
   *   const AddedCandidate<TimeIntegrator> added(
   *     candidate<TimeIntegrator, MyIntegrator>("my integrator"));
   *
   * All ranks must add the same candidates. The name must not be that of
   * another candidate, must not be empty, contain '|' or '/', or begin or end
   * with a blank. Throws std::logic_error otherwise; a conflict with the name
   * of one of the library's own candidates is found when a choice is declared.
   */
  template <typename Base>
  class AddedCandidate
  {
  public:
    explicit AddedCandidate(const Candidate<Base> &added)
    {
      std::list<Candidate<Base>> &all = added_candidates<Base>();
      if (added.name.empty() ||
          added.name != dealii::Utilities::trim(added.name) ||
          added.name.find_first_of("|/") != std::string::npos)
        throw std::logic_error("a candidate cannot be called '" + added.name +
                               "'");
      for (const Candidate<Base> &other : all)
        refuse_same_name(other, added);
      place = all.insert(all.end(), added);
    }

    AddedCandidate(const AddedCandidate &) = delete;
    AddedCandidate &
    operator=(const AddedCandidate &) = delete;

    ~AddedCandidate()
    {
      added_candidates<Base>().erase(place);
    }

  private:
    typename std::list<Candidate<Base>>::iterator place;
  };

  /**
   * A layer's own candidates and those that programs have added. Throws
   * std::logic_error if two have the same name.
   */
  template <typename Base>
  std::vector<Candidate<Base>>
  with_added(std::vector<Candidate<Base>> candidates)
  {
    for (const Candidate<Base> &added : added_candidates<Base>())
      {
        for (const Candidate<Base> &other : candidates)
          refuse_same_name(other, added);
        candidates.push_back(added);
      }
    return candidates;
  }

  /**
   * A named run-time choice among classes derived from @p Base: the entry
   * `Type`, and a subsection with the parameters of each candidate.
   *
   * @p Base has a member `void declare_parameters(dealii::ParameterHandler &)`.
   * This object holds one object of each candidate, which only keeps its
   * parameters; make() makes the objects that are used, as many as wanted. It
   * must not be moved after declare_parameters(): the handler writes into it
   * while it reads a file.
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
        objects.push_back({c.name, c.make(), c.copy});
    }

    Selectable(const Selectable &) = delete;
    Selectable &
    operator=(const Selectable &) = delete;
    ~Selectable()                 = default;

    void
    declare_parameters(dealii::ParameterHandler &prm,
                       const std::string        &documentation)
    {
      std::string names;
      for (const auto &[name, object, copy] : objects)
        names += (names.empty() ? "" : "|") + name;
      prm.add_parameter("Type",
                        selected_name,
                        documentation,
                        dealii::Patterns::Selection(names));
      for (const auto &[name, object, copy] : objects)
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

    /// The names of the candidates that have a property with their present
    /// parameters: "a, b, c".
    std::string
    names_of(const std::function<bool(const Base &)> &property) const
    {
      std::string names;
      for (const auto &[name, object, copy] : objects)
        if (property(*object))
          names += (names.empty() ? "" : ", ") + name;
      return names;
    }

    /// The selected candidate, to be asked for its properties.
    const Base &
    selected() const
    {
      return *selected_entry().object;
    }

    /// A new object of the selected candidate, with its parameters.
    std::unique_ptr<Base>
    make() const
    {
      const Entry &entry = selected_entry();
      return entry.copy(*entry.object);
    }

  private:
    struct Entry
    {
      std::string                                        name;
      std::unique_ptr<Base>                              object;
      std::function<std::unique_ptr<Base>(const Base &)> copy;
    };

    const Entry &
    selected_entry() const
    {
      for (const Entry &entry : objects)
        if (entry.name == selected_name)
          return entry;
      AssertThrow(false,
                  dealii::ExcMessage("No candidate is called " +
                                     selected_name));
      return objects.front();
    }

    std::string        selected_name;
    std::vector<Entry> objects;
  };
} // namespace corotet

#endif
