// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>
#include <corotet/laws/material_parameters.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <functional>
#include <stdexcept>

namespace corotet
{
  namespace
  {
    double
    number_of(const std::string &text, const std::string &entry)
    {
      if (const auto value = parse_number(dealii::Utilities::trim(text)))
        return *value;
      throw InputError(entry,
                       fmt::format("'{}' is not a number; allowed: a number, "
                                   "or 'region: number, ...'",
                                   shortened(text)));
    }

    // The values of one entry by region id.
    std::map<unsigned int, double>
    values_by_region(const std::string &text,
                     const MeshNames   &regions,
                     const std::string &entry)
    {
      std::map<unsigned int, double> values;
      if (text.find(':') == std::string::npos)
        {
          const double value = number_of(text, entry);
          for (const auto &[id, name] : regions.all())
            values[id] = value;
          return values;
        }
      for (const auto &[region, number] : named_values(
             text, entry, "a number for all regions, or 'region: number, ...'"))
        {
          const double value = number_of(number, entry);
          for (const unsigned int id : regions.ids(region, entry))
            if (!values.emplace(id, value).second)
              throw InputError(entry,
                               fmt::format("region '{}' has two values; "
                                           "allowed is one, by names that "
                                           "share no cells",
                                           regions.name(id)));
        }
      for (const auto &[id, name] : regions.all())
        if (!values.contains(id))
          throw InputError(entry,
                           fmt::format("region '{}' has no value; needed is "
                                       "one for each region",
                                       regions.name(id)));
      return values;
    }

    void
    check(const std::map<unsigned int, double> &values,
          const MeshNames                      &regions,
          const std::string                    &entry,
          const std::function<bool(double)>    &is_allowed,
          const std::string                    &allowed)
    {
      for (const auto &[id, value] : values)
        if (!is_allowed(value))
          throw InputError(entry,
                           fmt::format("found {} for region '{}'; allowed: {}",
                                       value,
                                       regions.name(id),
                                       allowed));
    }
  } // namespace

  MaterialParameters::MaterialParameters()
    : type(law_kinds(), "corotational")
  {}

  void
  MaterialParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    type.declare_parameters(
      prm,
      "Law of elasticity: 'linear' is small-strain elasticity, right for small "
      "rotations only; 'corotational' takes the rotation of each cell out of "
      "the deformation gradient first, for small strains at any rotation; "
      "'Saint Venant-Kirchhoff', linear in Green's strain, for moderate "
      "strains without strong compression, in which it softens; 'neo-Hookean', "
      "mu / 2 (tr C - 3) - mu ln J + lambda / 2 (ln J)^2, for large strains: "
      "no cell can be inside out at the points where forces are computed. All "
      "are the same at small strains.");
    add_enumeration(prm,
                    "Rotation",
                    rotation,
                    rotations,
                    "Where 'corotational' elasticity takes the rotation out: "
                    "'cell centre', one rotation per cell, which is fastest "
                    "and recovers best from crushed states; 'quadrature "
                    "points', one at each of them, for thin parts that bend or "
                    "twist far and for long motions: it conserves energy and "
                    "angular momentum and keeps the full order at large "
                    "rotations; 'cell centre, variational', one per cell, with "
                    "forces that are the exact gradient of the energy. For "
                    "degree 1 all are the same. For degrees 2 and 3 with one "
                    "rotation per cell, the log says at the end how far "
                    "rotations differ inside of cells, and warns above 0.005 "
                    "rad.");
    add_enumeration(prm,
                    "Dilatation",
                    dilatation,
                    dilatations,
                    "Change of volume that elements of degree 1 resist: "
                    "'cells', that of each cell; 'vertices', the mean over the "
                    "cells around each vertex, so that nearly incompressible "
                    "bodies do not lock (Poisson's ratio above 0.4, say; with "
                    "'linear' and 'corotational' laws). Elements of degree 2 "
                    "and 3 allow 'cells' only.");
    const std::string by_region =
      " One number for the whole body, or 'region: number, ...' with every "
      "region.";
    prm.add_parameter("Young's modulus",
                      youngs_modulus,
                      "Young's modulus [Pa], positive." + by_region);
    prm.add_parameter("Poisson's ratio",
                      poissons_ratio,
                      "Poisson's ratio [-], in (-1, 0.499999]." + by_region);
    prm.add_parameter("Density",
                      density,
                      "Mass per volume [kg/m^3], positive." + by_region);
  }

  std::shared_ptr<const MaterialLaw>
  MaterialParameters::law(const unsigned int degree) const
  {
    std::shared_ptr<const MaterialLaw> law =
      type.selected().make(degree == 1 ? Rotation::cell_centre : rotation);
    if (!law)
      throw std::logic_error("the candidate '" + type.name() +
                             "' of Material/Type makes no law");
    return law;
  }

  std::map<unsigned int, IsotropicMaterial>
  MaterialParameters::materials(const MeshNames &regions) const
  {
    const std::string E_entry   = "Material/Young's modulus";
    const std::string nu_entry  = "Material/Poisson's ratio";
    const std::string rho_entry = "Material/Density";
    const auto        E   = values_by_region(youngs_modulus, regions, E_entry);
    const auto        nu  = values_by_region(poissons_ratio, regions, nu_entry);
    const auto        rho = values_by_region(density, regions, rho_entry);

    const auto positive = [](const double v) { return v > 0; };
    check(E, regions, E_entry, positive, "a positive number of Pa");
    check(
      nu,
      regions,
      nu_entry,
      // Pressures are lambda / mu times displacements, which have eight digits
      // with the default tolerances: at this bound two digits of a pressure are
      // left.
      [](const double v) { return v > -1 && v <= 0.499999; },
      "-1 < nu <= 0.499999 (at 0.5 the material is incompressible; 0.499 is in "
      "general close enough)");
    check(rho, regions, rho_entry, positive, "a positive number of kg/m^3");

    std::map<unsigned int, IsotropicMaterial> result;
    for (const auto &[id, name] : regions.all())
      result[id] = isotropic_material(E.at(id), nu.at(id), rho.at(id));
    return result;
  }
} // namespace corotet
