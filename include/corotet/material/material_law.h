// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_material_law_h
#define corotet_material_material_law_h

#include <corotet/discretization/element.h>
#include <corotet/material/point_law.h>

#include <span>

namespace corotet
{
  struct ElasticSweeps;

  /**
   * A law of elasticity that is chosen at run time. Laws are written as a Law,
   * at a point, and become this by MaterialLawOf. All members but sweeps() are
   * for single points, of a body with the same gradient all over: for output
   * and for data.
   */
  class MaterialLaw : public PointLaw
  {
  public:
    /// Whether forces are linear in the displacement.
    virtual bool
    is_linear() const = 0;

    /// Whether all points of a cell have the rotation of its centre.
    virtual bool
    has_cell_rotation() const
    {
      return false;
    }

    /// Whether the force is the gradient of the energy, so that its derivative
    /// is symmetric, for elements of that degree.
    virtual bool
    has_energy(const unsigned int /*degree*/) const
    {
      return true;
    }

    /**
     * The stress that is shown [Pa] at points of a cell with gradients @p H,
     * written to @p sigma. @p centre is the gradient at the cell's centre. The
     * stress is Cauchy's; for corotational elasticity R sigma R^T, which
     * differs from it by terms of the order of the strain; for linear
     * elasticity sigma.
     */
    virtual void
    spatial_stresses(const IsotropicMaterial                    &material,
                     const dealii::Tensor<2, 3>                 &centre,
                     const std::span<const dealii::Tensor<2, 3>> H,
                     dealii::SymmetricTensor<2, 3> *sigma) const = 0;

    /// The loops over cells that compute forces, energies and tangents.
    virtual ElasticSweeps
    sweeps(const Element element) const = 0;
  };
} // namespace corotet

#endif
