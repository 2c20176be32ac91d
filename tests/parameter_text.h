// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_parameter_text_h
#define corotet_tests_parameter_text_h

#include <corotet/discretization/element.h>

#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <string_view>

/*
 * Sections of parameter files as text. Texts are joined by +: a section may
 * occur several times, and if an entry does, the last one counts.
 */
namespace corotet::tests
{
  /**
   * An entry of a section, or any text with entries and sections. Numbers have
   * enough digits to be read back exactly.
   */
  struct Entry
  {
    template <typename Value>
    Entry(const std::string_view name, const Value &value)
      : text(fmt::format("set {} = {}\n", name, value))
    {}

    Entry(const std::string &entries)
      : text(entries + "\n")
    {}

    std::string text;
  };

  using Entries = std::initializer_list<Entry>;

  /// A section, such as section("Mesh", {{"Scale", 2}, section("box",
  /// {{"Cells", "1, 2, 3"}})}).
  inline std::string
  section(const std::string &name, const Entries entries)
  {
    std::string text = "subsection " + name + "\n";
    for (const Entry &entry : entries)
      text += entry.text;
    return text + "end\n";
  }

  inline std::string
  box_mesh(const std::string &size, const std::string &cells)
  {
    return section("Mesh",
                   {section("box", {{"Size", size}, {"Cells", cells}})});
  }

  /// The entries for an element. Bubbles get quadrature at the nodes as mass;
  /// without @p mass other elements have the program's default.
  inline std::string
  element_text(const Element element, const std::string &mass = "")
  {
    std::string text =
      section("Discretization", {{"Degree", element.degree()}});
    if (element.has_bubbles())
      text += section("Discretization", {{"Mass", "nodal quadrature"}});
    if (!mass.empty())
      text += section("Discretization", {{"Mass", mass}});
    return text;
  }

  /// The entries of a material; arguments left out are the program's defaults.
  inline std::string
  material_text(const double youngs_modulus,
                const double poissons_ratio = 0.3,
                const double density        = 1000)
  {
    return section("Material",
                   {{"Young's modulus", youngs_modulus},
                    {"Poisson's ratio", poissons_ratio},
                    {"Density", density}});
  }

  inline std::string
  material_type(const std::string &type)
  {
    return section("Material", {{"Type", type}});
  }

  /// The entry for the placement of rotations in a corotational law.
  inline std::string
  rotation_at(const std::string &place)
  {
    return section("Material", {{"Rotation", place}});
  }

  inline std::string
  fixed(const std::string &boundaries)
  {
    return section("Boundary conditions", {{"Fixed", boundaries}});
  }

  inline std::string
  displacements(const std::string &on_boundaries)
  {
    return section("Boundary conditions", {{"Displacement", on_boundaries}});
  }

  inline std::string
  tractions(const std::string &on_boundaries)
  {
    return section("Boundary conditions", {{"Traction", on_boundaries}});
  }

  inline std::string
  pressures(const std::string &on_boundaries)
  {
    return section("Boundary conditions", {{"Pressure", on_boundaries}});
  }

  /// A box that can only be stretched along x, and is held at x-min.
  inline std::string
  sliding_along_x()
  {
    return displacements("x-min: 0; free; free, y-min: free; 0; free, "
                         "y-max: free; 0; free, z-min: free; free; 0, "
                         "z-max: free; free; 0");
  }

  /// The same value for each side of a box.
  inline std::string
  on_all_sides(const std::string &value)
  {
    return fmt::format(
      "x-min: {0}, x-max: {0}, y-min: {0}, y-max: {0}, z-min: {0}, z-max: {0}",
      value);
  }

  inline std::string
  supports(const std::string &elastic,
           const std::string &normal   = "",
           const std::string &dashpots = "")
  {
    return section("Supports",
                   {{"Elastic", elastic},
                    {"Elastic normal", normal},
                    {"Dashpots", dashpots}});
  }

  inline std::string
  gravity(const std::string &acceleration)
  {
    return section("Loads", {{"Gravity", acceleration}});
  }

  inline std::string
  initial_conditions(const std::string &displacement,
                     const std::string &velocity)
  {
    return section("Initial conditions",
                   {{"Displacement", displacement}, {"Velocity", velocity}});
  }

  inline std::string
  newton_tolerances(const double tolerance)
  {
    return section("Newton",
                   {{"Residual tolerance", tolerance},
                    {"Increment tolerance", tolerance}});
  }

  inline std::string
  linear_solver(const std::string &type, const double tolerance = 1e-8)
  {
    return section("Linear solver", {{"Type", type}, {"Tolerance", tolerance}});
  }

  inline std::string
  statics(const unsigned int load_steps   = 1,
          const unsigned int max_halvings = 8)
  {
    return section("Time integration",
                   {{"Type", "static"},
                    {"Maximum halvings", max_halvings},
                    section("static", {{"Load steps", load_steps}})});
  }

  inline std::string
  time_integration(const std::string &type,
                   const double       end,
                   const double       step,
                   const Entries      more = {})
  {
    return section("Time integration",
                   {{"Type", type}, {"End time", end}, {"Time step", step}}) +
           section("Time integration", more);
  }
} // namespace corotet::tests

#endif
