// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_vertex_dilatation_h
#define corotet_operators_vertex_dilatation_h

#include <corotet/base/vector.h>
#include <corotet/discretization/discretization.h>
#include <corotet/material/isotropic.h>
#include <corotet/operators/block_matrix.h>
#include <corotet/operators/cell_loop.h>
#include <corotet/operators/material_nodes.h>
#include <corotet/operators/sweep.h>

#include <deal.II/base/aligned_vector.h>

#include <map>
#include <memory>
#include <vector>

namespace corotet
{
  /**
   * Mean dilatation at the vertices, for elements of degree 1: the part of an
   * isotropic law with Lame's lambda, where the dilatation is the mean of the
   * cells around a vertex (average nodal pressures: Bonet, Burton 1998,
   * @cite bonet1998),
   *
   *   W = sum_a V_a lambda / 2 theta_a^2,
   *   V_a theta_a = sum_c V_c / 4 theta_c,  V_a = sum_c V_c / 4,
   *
   * theta_c = tr(R^T F) - 3 with the rotation R of the cell, and div u without
   * rotations. There are five or six times as many cells as vertices, and so
   * hardly any motions in which no cell changes its volume: where lambda is
   * large, elements with the dilatation of cells lock. With that of the
   * vertices they keep their orders of convergence.
   *
   * In a cell this part is the stress p R with the mean p of lambda theta_a at
   * its vertices. A vertex where materials meet has a dilatation for each of
   * them: regions with equal elastic constants are one material.
   *
   * So the force on a node depends on two layers of cells around it. Sweeps
   * include ghost cells and only have to exchange the pressures. The matrix is
   * a sum over the vertices of V_a lambda b_a b_a^T, where b_a u = theta_a;
   * rows b_a of ghosts come from their owners.
   *
   * Vectors are those of the discretization. Vectors that are read must have
   * ghost entries up to date; sums are added to owned entries. The ElasticData
   * are those of the elasticity with its present rotations, also of ghost
   * cells. @p discretization must outlive this object. Members but those marked
   * are collective.
   */
  class VertexDilatation
  {
  public:
    /// @p of_regions has the materials by region, the same on all ranks.
    VertexDilatation(
      const Discretization                            &discretization,
      const std::map<unsigned int, IsotropicMaterial> &of_regions);

    /// f += the force [N] of the displacement @p u.
    void
    add_force(Vector &f, const Vector &u, const ElasticData &data);

    /// The contribution of this rank to the energy of the displacement @p u
    /// [J]. Not collective.
    double
    local_energy(const Vector &u, const ElasticData &data);

    /// f += factor K v, the derivative of the force with frozen rotations.
    void
    add_product(Vector            &f,
                const Vector      &v,
                const double       factor,
                const ElasticData &data);

    /// Prepares the part p dR of the tangent, with the derivative dR of the
    /// rotations, at the displacement @p u.
    void
    linearize(const Vector &u, const ElasticData &data);

    /// f += (factor K + that part) v.
    void
    add_tangent(Vector            &f,
                const Vector      &v,
                const double       factor,
                const ElasticData &data);

    /// @p target += that part of a batch alone, four numbers for each node of
    /// the cells of @p data. Not collective.
    void
    add_rotation_part(const ElasticData &data,
                      const unsigned int batch,
                      const double      *source,
                      double            *target) const;

    /// The correction of the stress of each local cell, a multiple of the
    /// identity: p - lambda theta_c [Pa]. Rotations are those of @p u itself.
    std::vector<double>
    pressure_corrections(const Vector &u, const bool has_rotations) const;

    /// diagonal += factor times the diagonal of K.
    void
    add_diagonal(Vector            &diagonal,
                 const double       factor,
                 const ElasticData &data);

    /// The pattern of matrices with K: blocks of nodes that have a neighbour in
    /// common. Throws ComputationError if there are too many for one rank.
    const std::shared_ptr<const BlockPattern> &
    block_pattern();

    /// A += factor K, without off-diagonal entries of prescribed unknowns,
    /// which @p is_prescribed marks among the local ones. A has the
    /// block_pattern().
    void
    add_to_matrix(BlockMatrix                      &A,
                  const std::vector<unsigned char> &is_prescribed,
                  const double                      factor,
                  const ElasticData                &data);

  private:
    /// Sets values[a] = V_a theta_a of owned copies.
    template <bool of_displacement>
    void
    sum_dilatations(const Vector &source, const ElasticData &data);
    /// Turns the values into pressures, with those of ghosts.
    void
    make_pressures();
    /// Adds p R times @p factor, and the stored part if wanted.
    template <bool with_rotation_part>
    void
    add_stress(Vector            &f,
               const Vector      &source,
               const double       factor,
               const ElasticData &data);
    /// Calls read(batch, values) for all local batches, with the values of
    /// @p source in the chunk, and after_chunk(chunk).
    template <typename Read, typename AfterChunk>
    void
    read_cells(const Vector     &source,
               const Read       &read,
               const AfterChunk &after_chunk) const;
    template <typename Read>
    void
    read_cells(const Vector &source, const Read &read) const;
    /// Mean pressure of the four vertices of each cell of a batch.
    Simd<double>
    mean_pressure(const unsigned int batch) const;
    void
    make_rows();
    void
    update_rows(const ElasticData &data);
    /// Calls @p function(copy, k, i) for entries k of the rows whose columns
    /// are owned nodes i.
    template <typename Function>
    void
    for_owned_columns(const Function &function) const;

    const Discretization          &discretization;
    std::vector<IsotropicMaterial> materials;
    std::vector<unsigned int>      material_of_cell;
    std::unique_ptr<MaterialNodes> copies;
    GhostExchange                  exchange;
    /// The copy of each cell's vertices, [batch][vertex][lane].
    std::vector<unsigned int> copies_of_cells;
    /// lambda / V_a of each copy.
    std::vector<double> moduli;
    /// V_a theta_a or the pressure of each copy; see make_pressures().
    std::vector<double> values;
    CellLoop<double>    cell_loop;
    /// Sums of local nodes, four numbers each; zero between sweeps.
    dealii::AlignedVector<double> sums;
    /// Sums of the present chunk of cells.
    dealii::AlignedVector<double> chunk_sums;
    /// p V G^{-1} for all local batches, [6][lane] each.
    dealii::AlignedVector<double> linearization;

    /// V_a b_a of owned copies, then of ghosts: three numbers for each column,
    /// which is the global number of a node.
    NodeGraph                           rows;
    GhostExchange                       exchange_of_rows;
    std::vector<double>                 entries;
    bool                                are_rows_made     = false;
    bool                                are_entries_known = false;
    std::shared_ptr<const BlockPattern> pattern;
    /// The copies whose rows have an entry for each owned node.
    NodeGraph copies_of_nodes;
  };
} // namespace corotet

#endif
