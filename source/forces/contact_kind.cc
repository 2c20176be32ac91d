// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Section Contact of the parameter file.

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>
#include <corotet/forces/contact.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace corotet
{
  namespace
  {
    const std::string obstacles_entry  = "Contact/Obstacles",
                      boundaries_entry = "Contact/Boundaries",
                      motions_entry    = "Contact/Motions",
                      stiffness_entry  = "Contact/Stiffness",
                      friction_entry   = "Contact/Friction",
                      slip_entry       = "Contact/Slip velocity";

    using Pairs = std::vector<std::pair<std::string, std::string>>;

    Pairs
    list_of_obstacles(const std::string &text)
    {
      const Pairs result =
        named_values(text,
                     obstacles_entry,
                     "a list of NAME: SHAPE, separated by commas");
      for (auto item = result.begin(); item != result.end(); ++item)
        {
          check_column_name(obstacles_entry, item->first, "an obstacle");
          if (std::any_of(result.begin(), item, [&](const auto &other) {
                return other.first == item->first;
              }))
            throw InputError(obstacles_entry,
                             fmt::format("two obstacles are called '{}'; each "
                                         "name must be used once",
                                         shortened(item->first)));
        }
      return result;
    }

    // The values of a list "name: value, ..." by the names of obstacles, each
    // of which it may have once.
    std::map<std::string, std::string>
    values_of_obstacles(const std::string &text,
                        const std::string &entry,
                        const Pairs       &obstacles)
    {
      std::map<std::string, std::string> values;
      for (const auto &[name, value] : named_values(
             text, entry, "a list of OBSTACLE: VALUE, separated by commas"))
        {
          std::vector<std::string> known;
          for (const auto &[obstacle, shape] : obstacles)
            known.push_back(obstacle);
          if (std::find(known.begin(), known.end(), name) == known.end())
            throw InputError(entry,
                             fmt::format("there is no obstacle '{}'; allowed: "
                                         "{}",
                                         shortened(name),
                                         known.empty() ?
                                           "none, as Contact/Obstacles is "
                                           "empty" :
                                           shortened(join(known))));
          if (!values.emplace(name, value).second)
            throw InputError(entry,
                             fmt::format("obstacle '{}' has two values; each "
                                         "may have one",
                                         name));
        }
      return values;
    }

    // The numbers of such a list; zero is allowed with @p with_zero.
    std::map<std::string, double>
    numbers_of_obstacles(const std::string &text,
                         const std::string &entry,
                         const Pairs       &obstacles,
                         const bool         with_zero)
    {
      std::map<std::string, double> numbers;
      for (const auto &[name, value] :
           values_of_obstacles(text, entry, obstacles))
        {
          const auto number = parse_number(value);
          if (!number || !std::isfinite(*number) || *number < 0 ||
              (*number == 0 && !with_zero))
            throw InputError(entry,
                             fmt::format("found '{}' for obstacle '{}'; "
                                         "allowed: a number {}",
                                         shortened(value),
                                         name,
                                         with_zero ? "that is not negative" :
                                                     "above zero"));
          numbers[name] = *number;
        }
      return numbers;
    }
  } // namespace

  void
  ContactKind::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Contact");
    prm.add_parameter(
      "Obstacles",
      obstacle_list,
      "Rigid shapes that the surface of the body touches [m]: 'name: plane x y "
      "z nx ny nz', all behind a plane whose normal points to the body, 'name: "
      "box x y z x y z', 'name: sphere x y z radius', 'name: cylinder x y z x "
      "y z radius', or with 'not' before the shape all that is outside of it (a cylinder has ends); "
      "separated by commas. Their pressure is Stiffness times the depth of the "
      "surface inside of them. Its energy counts as elastic energy, the work "
      "of obstacles that move as external work. In statics, obstacles are no "
      "supports.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Boundaries",
      boundaries,
      "Boundaries that touch obstacles, separated by commas. Empty: all of the "
      "surface. To be given if there are planes of symmetry, which are no "
      "surface of the whole body.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Motions",
      motions,
      "Displacements of obstacles [m]: 'name: x; y; z, ...', expressions in t. "
      "The shapes are those without displacement.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Stiffness",
      stiffnesses,
      "Pressure of obstacles over the depth of the surface inside of them, per "
      "area at rest [N/m^3]: 'name: k, ...'. Without a value: 10 times Young's "
      "modulus over the size of the face, less for bodies thinner than that.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Friction",
      frictions,
      "Coefficients of friction between obstacles and the body [-]: 'name: mu, "
      "...'. The energy that friction takes counts as dissipated energy. No "
      "effect in statics and modes.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Slip velocity",
      slip_velocity,
      "Velocity w [m/s] at which friction becomes what Coulomb's law says: a "
      "point that slides at v has mu v / sqrt(v^2 + w^2) times its pressure. "
      "Above zero where there is friction: bodies that should stick creep at a "
      "fraction of it.",
      dealii::Patterns::Double(0));
    prm.leave_subsection();
  }

  std::vector<ForceKind::GivenEntry>
  ContactKind::given() const
  {
    std::vector<GivenEntry> result;
    for (const auto &[entry, value] :
         {std::pair{obstacles_entry, obstacle_list},
          std::pair{boundaries_entry, boundaries},
          std::pair{motions_entry, motions},
          std::pair{stiffness_entry, stiffnesses},
          std::pair{friction_entry, frictions}})
      if (!dealii::Utilities::trim(value).empty())
        result.push_back({entry, value, ""});
    return result;
  }

  std::vector<std::string>
  ContactKind::obstacles() const
  {
    std::vector<std::string> names;
    for (const auto &[name, shape] : list_of_obstacles(obstacle_list))
      names.push_back(name);
    return names;
  }

  void
  ContactKind::add_to(ForceTerms &terms, const ForceContext &context) const
  {
    const Pairs list = list_of_obstacles(obstacle_list);
    const auto  stiffness =
      numbers_of_obstacles(stiffnesses, stiffness_entry, list, false);
    const auto friction =
      numbers_of_obstacles(frictions, friction_entry, list, true);
    const auto motion = values_of_obstacles(motions, motions_entry, list);
    std::set<unsigned int> touching;
    const PlaceNames      &names = context.discretization.mesh().places();
    for (const auto &[name, value] : names_and_values(boundaries))
      {
        if (value)
          throw InputError(boundaries_entry,
                           fmt::format("found '{}: {}'; allowed: names of "
                                       "boundaries, separated by commas",
                                       shortened(name),
                                       shortened(*value)));
        for (const unsigned int id :
             names.boundary_ids(name, boundaries_entry, "contact"))
          touching.insert(id);
      }
    if (list.empty())
      return;
    const auto value_of = [](const auto &values, const std::string &name) {
      const auto found = values.find(name);
      return found == values.end() ? 0. : found->second;
    };
    const auto surface =
      std::make_shared<const ContactSurface>(context, touching);
    const auto [low, top] = surface->range_of_stiffness();
    for (const auto &[name, shape] : list)
      {
        auto obstacle =
          std::make_shared<Obstacle>(name, shape, obstacles_entry);
        if (const auto found = motion.find(name); found != motion.end())
          obstacle->set_motion(found->second, motions_entry, context.tables);
        const double k  = value_of(stiffness, name);
        const double mu = value_of(friction, name);
        if (mu > 0 && slip_velocity == 0)
          throw InputError(slip_entry,
                           fmt::format("found 0, but obstacle '{}' has "
                                       "friction; allowed: a velocity above "
                                       "zero, well below those of sliding",
                                       name));
        const auto nearby = std::make_shared<NearbyFaces>(*surface, *obstacle);
        auto       contact =
          std::make_unique<NormalContact>(surface, obstacle, nearby, k);
        describe(*contact, context, low, top);
        terms.add(std::move(contact));
        if (mu > 0)
          terms.add(std::make_unique<Friction>(
                      surface, obstacle, nearby, k, mu, slip_velocity),
                    friction_entry + " of obstacle '" + name + "'");
      }
  }

  void
  ContactKind::describe(const NormalContact &contact,
                        const ForceContext  &context,
                        const double         low,
                        const double         top)
  {
    const double k = contact.given_stiffness();
    // The shown digits of the smallest and the largest one, or one for both.
    const std::string least     = fmt::format("{:.3g}", k > 0 ? k : low),
                      most      = fmt::format("{:.3g}", k > 0 ? k : top);
    const std::string stiffness = least == most ? least : least + " to " + most;
    context.log.line(fmt::format("contact: obstacle '{}', stiffness {} N/m^3",
                                 contact.obstacle(),
                                 stiffness));
  }
} // namespace corotet
