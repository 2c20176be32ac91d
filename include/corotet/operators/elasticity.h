// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_elasticity_h
#define corotet_operators_elasticity_h

#include <corotet/base/joint_reduction.h>
#include <corotet/base/vector.h>
#include <corotet/discretization/discretization.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/material/dilatation.h>
#include <corotet/material/material_law.h>
#include <corotet/operators/cell_loop.h>
#include <corotet/operators/elastic_sweeps.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace corotet
{
  class VertexDilatation;

  /**
   * Elastic energy and shape of a deformed body.
   */
  struct ElasticState
  {
    /// Elastic energy [J].
    double energy = 0;
    /// Smallest det F at the points of the stiffness rule and the centres [-].
    double min_det_F = 1;
    /// Cells where det F is negative at one of these points.
    unsigned int inverted_cells = 0;
    /// Cells that the last rotation update found collapsed to a plane, a line
    /// or a point, where the law has rotations.
    unsigned int degenerate_cells = 0;
    /// Cells whose rotation the fast algorithm left to the robust one.
    unsigned int robust_rotations = 0;

    /// Makes the state of the body from those of the ranks.
    void
    reduce(JointReduction &reduction);
  };

  /**
   * Cell data of one state: a value at the centre of each locally owned cell.
   */
  struct CellResults
  {
    /// Angle of the cell's rotation [rad], in [0, pi].
    std::vector<double> rotation_angle;
    /// det F [-].
    std::vector<double> det_F;
    /// Von Mises stress [Pa].
    std::vector<double> von_mises;
  };

  /**
   * Internal force f(u) of a law of elasticity, f_i = sum_q w_q P(F_q) grad N_i
   * [seed, 2.73 to 2.76], and its tangents.
   *
   * Unless the law is linear, cells have rotations R, those of their centres.
   * Corotational laws use them, and so do preconditioners for all laws: their K
   * is the tangent of linear elasticity with these rotations, R K0 R^T.
   * Rotations change only in update_rotations(), update_rotations_and_force()
   * and explicit_step(). Tangents that need more are prepared by linearize().
   * Vectors are those of the discretization; input vectors need ghost entries
   * up to date unless told otherwise, results are complete on owned entries.
   * @p discretization and @p reference must outlive this object. All members
   * but those marked are collective.
   */
  class Elasticity
  {
  public:
    /// @p materials are given by region id. @p dilatation may be that of
    /// vertices for linear and corotational laws and elements of degree 1.
    Elasticity(const Discretization                            &discretization,
               const ReferenceElement                          &reference,
               const std::map<unsigned int, IsotropicMaterial> &materials,
               const std::shared_ptr<const MaterialLaw>        &law,
               const Dilatation dilatation = Dilatation::cells);

    ~Elasticity();

    /// Computes the rotation of every local cell from the displacement @p u.
    /// Does nothing for linear elasticity.
    void
    update_rotations(const Vector &u);

    /// f = internal force of the displacement @p u by linear elasticity with
    /// the present rotations of the cells, whatever the law.
    void
    internal_force(Vector &f, const Vector &u) const;

    /// Computes new rotations of the cells and the internal force of @p u, in
    /// one sweep over the cells.
    void
    update_rotations_and_force(Vector &f, const Vector &u);

    /**
     * A step of explicit dynamics with lumped mass in one sweep over the cells:
     * v += dt M^{-1} (g - f(u)), then u += dt v, with new rotations. Entries of
     * @p inverse_mass are 1 / M_ii, or zero where v is prescribed; @p external
     * is g. @p u must not have ghost entries in use. Rotations of ghost cells
     * are not updated: they serve assembled matrices only.
     */
    void
    explicit_step(Vector       &u,
                  Vector       &v,
                  const Vector &external,
                  const Vector &inverse_mass,
                  const double  dt);

    /// f = K v, with K = R K0 R^T at the present rotations.
    void
    apply_tangent(Vector &f, const Vector &v) const;

    /// The same by quadrature, as for laws whose stress varies in a cell: for
    /// comparisons.
    void
    apply_tangent_by_quadrature(Vector &f, const Vector &v) const;

    /**
     * Prepares the tangent at @p u, to which the cells' rotations must belong.
     * Returns the number of cells, over all ranks, where the derivative of a
     * rotation was clamped.
     */
    unsigned int
    linearize(const Vector &u, const Tangent tangent);

    /**
     * f = (K_T + (frozen_factor - 1) K_frozen + c_M M) v with the tangent of
     * the last linearize(). M is the consistent mass of @p masses, or has the
     * diagonal @p lumped_mass; null if it is not used. Ghost entries of @p v
     * are brought up to date where they are not in use.
     */
    void
    apply_linearization(Vector                   &f,
                        const Vector             &v,
                        const double              frozen_factor,
                        const double              c_M,
                        const CellMasses<double> *masses,
                        const Vector             *lumped_mass) const;

    /// Gets the matrices of the cells of a batch, by columns: entry [3 j +
    /// b][lane][i][a] belongs to row 3 i + a and column 3 j + b. There is a
    /// fourth a without meaning.
    using TakeCellMatrices =
      std::function<void(const unsigned int batch, const double *columns)>;

    /**
     * Hands over the matrices that apply_linearization() applies, without
     * @p lumped_mass: those of all local cells, ghost cells included. @p u is
     * the displacement of the last linearize(). Not collective.
     */
    void
    cell_matrices(const Vector             &u,
                  const double              frozen_factor,
                  const double              c_M,
                  const CellMasses<double> *masses,
                  const TakeCellMatrices   &take);

    /// f = K v with that tangent. It must be the last one prepared if it is not
    /// by cell.
    void
    apply_stiffness(Vector &f, const Vector &v, const Tangent tangent) const
    {
      if (is_by_cell(tangent))
        apply_tangent(f, v);
      else
        {
          Assert(tangent == linearized_tangent, dealii::ExcInternalError());
          apply_linearization(f, v, 1., 0., nullptr, nullptr);
        }
    }

    /// The part of the law that belongs to the vertices' dilatation; null if
    /// there is none. It uses the present rotations. explicit_step() and
    /// coefficients() do not include it.
    VertexDilatation *
    vertex_dilatation() const
    {
      return dilatation.get();
    }

    /// The data of the cells for the vertices' dilatation.
    ElasticData
    elastic_data() const;

    ElasticState
    state(const Vector &u) const;

    /// The state of this rank's cells. Not collective.
    ElasticState
    local_state(const Vector &u) const;

    CellResults
    cell_results(const Vector &u) const;

    const IsotropicMaterial &
    material(const unsigned int cell) const
    {
      return materials.at(discretization.region(cell));
    }

    /// The largest Poisson's ratio of all materials [-].
    double
    largest_poissons_ratio() const
    {
      double ratio = -1;
      for (const auto &[region, material] : materials)
        ratio = std::max(ratio, poissons_ratio(material));
      return ratio;
    }

    dealii::Tensor<2, 3>
    rotation(const unsigned int cell) const;

    /// The cells' data for the factored kernel, with the present rotations;
    /// operators share them.
    const dealii::AlignedVector<CellCoefficients<double>> &
    coefficients() const
    {
      return cell_coefficients;
    }

    const ReferenceElement &
    reference_element() const
    {
      return reference;
    }

    const MaterialLaw &
    law() const
    {
      return *material_law;
    }

    /// Whether that tangent is the one of the cells' frozen rotations, which
    /// apply_tangent() and the effective operator apply without linearize().
    bool
    is_by_cell(const Tangent tangent) const
    {
      return sweeps.tangent(tangent).apply == nullptr;
    }

    /// Whether that tangent is symmetric. For the consistent one this means
    /// that the force is the gradient of the energy.
    bool
    is_symmetric(const Tangent tangent) const
    {
      return tangent == Tangent::frozen_rotation ||
             material_law->has_energy(discretization.degree());
    }

  private:
    void
    set_up_cells();
    /// elastic_data() for sweeps that change the rotations.
    ElasticData
    rotating_data();
    /// grad u at the centre of a cell.
    dealii::Tensor<2, 3>
    centre_gradient(const unsigned int cell, const Vector &u) const;
    /// Lets @p sweep read the displacement @p u in chunks of cells.
    void
    read_cells(const ElasticSweep                     sweep,
               const std::vector<CellBatches::Chunk> &chunks,
               ElasticData                           &data,
               const Vector                          &u) const;
    /// f = scale times the sums that @p sweep makes from @p u and @p data.
    template <typename Data>
    void
    cell_sweep(Vector       &f,
               const Vector &u,
               void (*sweep)(Data &,
                             const unsigned int,
                             const unsigned int,
                             const double *,
                             double *),
               Data        &data,
               const double scale) const;

    const Discretization              &discretization;
    const ReferenceElement            &reference;
    std::shared_ptr<const MaterialLaw> material_law;
    ElasticSweeps                      sweeps;
    /// Materials by region.
    std::map<unsigned int, IsotropicMaterial> materials;
    CellLoop<double>                          cell_loop;

    // Data of the cells in the discretization's batches. Gradients among the
    // coefficients are rotated: that is how rotations are stored. Without
    // rotations they are those at rest, and at_rest is empty.
    dealii::AlignedVector<CellConstants>            constants;
    dealii::AlignedVector<CellGeometryAtRest>       at_rest;
    dealii::AlignedVector<CellCoefficients<double>> cell_coefficients;

    /// Numbers of the last linearize(); see TangentSweeps.
    dealii::AlignedVector<double> linearization;
    /// The displacement of the linearization, with ghosts, if the sweeps need
    /// it.
    dealii::AlignedVector<double> linearized_displacement;
    /// The part of it for the present chunk of cells.
    mutable dealii::AlignedVector<double> chunk_displacement;
    Tangent linearized_tangent = Tangent::frozen_rotation;

    RotationCounts counts;

    std::unique_ptr<VertexDilatation> dilatation;
  };
} // namespace corotet

#endif
