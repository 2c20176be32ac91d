// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_stress_field_h
#define corotet_operators_stress_field_h

#include <corotet/operators/point_stress.h>
#include <corotet/operators/stress_patches.h>

#include <memory>
#include <span>
#include <vector>

namespace corotet
{
  class VertexDilatation;

  /**
   * Error of the stress, estimated by its distance from a recovered stress
   * sigma* (Zienkiewicz, Zhu 1987, @cite zienkiewicz1987), which comes from
   * one-sided patches at the surface. Norms are those of energy, |sigma|_E^2 =
   * integral of sigma : C^{-1} : sigma over the body at rest: twice its elastic
   * energy. Unit: square root of J.
   */
  struct StressError
  {
    /// |sigma* - sigma|_E of each owned cell.
    std::vector<double> of_cells;
    /// |sigma* - sigma|_E of the body.
    double energy_norm = 0;
    /// |sigma|_E of the body.
    double stress_norm = 0;

    /// energy_norm over the estimated norm of the exact stress, the root of
    /// |sigma|_E^2 + energy_norm^2. By Galerkin's orthogonality this holds
    /// where only loads are prescribed; elsewhere it is an estimate, too. Zero
    /// without stress.
    double
    relative() const;
  };

  /**
   * The stress of a state: at quadrature points, recovered, and the estimate of
   * its error. Each is computed when it is first asked for. Stress is that of
   * PointStress [Pa].
   *
   * @p discretization and @p reference must outlive this object. Members are
   * collective.
   */
  class StressField
  {
  public:
    /// @p materials are given by region id. @p dilatation is that of the
    /// vertices, which must outlive this object; null if the law has that of
    /// cells.
    StressField(const Discretization                            &discretization,
                const ReferenceElement                          &reference,
                const std::map<unsigned int, IsotropicMaterial> &materials,
                const std::shared_ptr<const MaterialLaw>        &law,
                const VertexDilatation                          *dilatation);

    /// From now on all results belong to the displacement @p u, which must not
    /// change until the next call; its ghost entries must be up to date.
    void
    set_displacement(const Vector &u);

    const PointStress &
    law() const
    {
      return point_stress;
    }

    const ReferenceElement &
    reference_element() const
    {
      return reference;
    }

    /// The stress at the points of the stiffness rule in all local cells (owned
    /// ones come first), cell by cell.
    const std::vector<dealii::SymmetricTensor<2, 3>> &
    at_points();

    /// The stress of the displacement at the only point of a rule in a local
    /// cell. Not collective.
    dealii::SymmetricTensor<2, 3>
    raw(const unsigned int                   cell,
        const ReferenceElement::PointValues &point) const;

    /// The recovered stress at a point of a local cell, given by values of the
    /// shape functions: sum_i N_i sigma*_i. To be called after recover() for
    /// that cell. Not collective.
    dealii::SymmetricTensor<2, 3>
    recovered(const unsigned int            cell,
              const std::span<const double> shape_values) const;

    /// Recovers the stress, unless it has been recovered.
    void
    recover();

    /// Recovers the stress in some local @p cells, unless it has been recovered
    /// there; the cost grows with their number. Repeated calls with the same
    /// cells cost least.
    void
    recover(const std::vector<unsigned int> &cells);

    /// Recovered stress, and the strain that belongs to it [-], at the owned
    /// nodes. Where materials meet, they are the means of those of all
    /// materials.
    struct NodalValues
    {
      std::vector<dealii::SymmetricTensor<2, 3>> stress;
      std::vector<dealii::SymmetricTensor<2, 3>> strain;
    };

    NodalValues
    at_nodes();

    const StressError &
    error();

  private:
    /// The stress at the points of a rule in a local cell.
    void
    evaluate(const unsigned int                   cell,
             const ReferenceElement::PointValues &rule,
             dealii::SymmetricTensor<2, 3>       *stresses) const;
    void
    set_up(std::unique_ptr<const StressPatches> &patches,
           Vector                               &vector,
           const StressPatches::AtSurface        at_surface,
           const std::vector<unsigned int>      *cells = nullptr);
    /// The value in a cell of a function at @p nodes.
    dealii::SymmetricTensor<2, 3>
    value(const Vector                 &vector,
          const unsigned int            cell,
          const std::span<const double> shape_values) const;

    const Discretization   &discretization;
    const ReferenceElement &reference;
    const PointStress       point_stress;
    const VertexDilatation *dilatation;
    const bool              has_rotations;
    /// VertexDilatation::pressure_corrections(), if there is a dilatation.
    std::vector<double> pressure_corrections;

    /// These are made when they are first needed.
    std::unique_ptr<const MaterialNodes> nodes;
    std::unique_ptr<const StressPatches> patches, patches_of_estimate;
    /// Cells of the last recovery that was not for all cells, and their
    /// patches.
    std::vector<unsigned int>            selected_cells;
    std::unique_ptr<const StressPatches> selected_patches;

    const Vector *displacement = nullptr;
    bool          has_points   = false;
    bool          has_recovery = false;
    /// Whether there is a recovered stress in the selected cells.
    bool has_selected_recovery = false;
    bool has_error             = false;

    std::vector<dealii::SymmetricTensor<2, 3>> points;
    Vector      recovered_stress, stress_of_estimate;
    StressError stress_error;
  };
} // namespace corotet

#endif
