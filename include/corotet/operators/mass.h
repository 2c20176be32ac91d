// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_mass_h
#define corotet_operators_mass_h

#include <corotet/base/enumeration.h>
#include <corotet/base/vector.h>
#include <corotet/discretization/discretization.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/operators/cell_loop.h>
#include <corotet/operators/sweep.h>

#include <map>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The kinds of mass matrices.
   */
  enum class MassType
  {
    /// The integral of rho N_i N_j.
    consistent,
    /// Diagonal: the consistent diagonal, scaled to the cell's mass (Hinton,
    /// Rock, Zienkiewicz 1976). Positive for every degree.
    diagonal_scaling,
    /// Diagonal: the row sums. Positive for degree 1 only.
    row_sum,
    /// Diagonal: by quadrature at the nodes, with full order. For the quadratic
    /// element with bubbles only.
    nodal_quadrature
  };

  inline const Enumeration<MassType> mass_types{
    {"consistent", MassType::consistent},
    {"diagonal scaling", MassType::diagonal_scaling},
    {"row sum", MassType::row_sum},
    {"nodal quadrature", MassType::nodal_quadrature}};

  /**
   * Share of a cell's mass that each of its nodes gets when the mass is lumped.
   * Throws InputError, blamed on Discretization/Mass, if a share is not
   * positive.
   */
  std::vector<double>
  lumped_shares(const ReferenceElement &reference, const MassType type);

  /**
   * The mass matrix M, consistent or lumped. @p discretization must outlive
   * this object.
   */
  class Mass
  {
  public:
    /// @p densities [kg/m^3] are given by region id. Collective.
    Mass(const Discretization                 &discretization,
         const ReferenceElement               &reference,
         const std::map<unsigned int, double> &densities,
         const MassType                        type);

    /// f = M a. Ghost entries of @p a must be up to date. Collective.
    void
    apply(Vector &f, const Vector &a) const;

    bool
    is_lumped() const
    {
      return type != MassType::consistent;
    }

    /// The diagonal of M, ghost entries up to date. If M is consistent, the
    /// first call computes it: that is collective.
    const Vector &
    diagonal() const
    {
      if (mass_diagonal.size() == 0)
        compute_diagonal();
      return mass_diagonal;
    }

    /// Mass of local cell @p cell [kg].
    double
    cell_mass(const unsigned int cell) const
    {
      const auto [batch, lane] = discretization.batches().place(cell);
      return masses[batch].mass[lane];
    }

    /// Masses of all cells, in the form that kernels use.
    const dealii::AlignedVector<CellMasses<double>> &
    cell_masses() const
    {
      return masses;
    }

    /// Mass of the body [kg].
    double
    total() const
    {
      return total_mass;
    }

  private:
    void
    compute_diagonal() const;

    const Discretization &discretization;
    MassType              type;
    /// Shares of a straight cell's mass that its nodes have in the diagonal.
    std::vector<double>                       shares;
    CellLoop<double>                          cell_loop;
    dealii::AlignedVector<CellMasses<double>> masses;
    mutable Vector                            mass_diagonal;
    double                                    total_mass;
  };
} // namespace corotet

#endif
