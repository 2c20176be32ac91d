// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_laws_material_parameters_h
#define corotet_laws_material_parameters_h

#include <corotet/laws/law_kind.h>
#include <corotet/material/dilatation.h>
#include <corotet/mesh/mesh.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The parameters of section Material. A value is one number for the whole
   * body or a list "region: number, region: number" that names every region.
   */
  struct MaterialParameters
  {
    MaterialParameters();

    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// The law for elements of that degree. At degree 1 all points of a cell
    /// have the same rotation, and the fastest implementation is taken.
    std::shared_ptr<const MaterialLaw>
    law(const unsigned int degree) const;

    /**
     * The material of each region, by the region's id. Throws InputError if a
     * region is unknown or left out, or a value is not allowed.
     */
    std::map<unsigned int, IsotropicMaterial>
    materials(const MeshNames &regions) const;

    /// The dilatation that elements of that degree resist. Throws InputError if
    /// the elements or the law have no choice and it is not Dilatation::cells.
    Dilatation
    dilatation_of(const unsigned int degree) const;

    Selectable<LawKind> type;
    Rotation            rotation       = Rotation::cell_centre;
    Dilatation          dilatation     = Dilatation::cells;
    std::string         youngs_modulus = "1e6";
    std::string         poissons_ratio = "0.3";
    std::string         density        = "1000";
  };
} // namespace corotet

#endif
