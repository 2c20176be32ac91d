// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_stress_patches_h
#define corotet_operators_stress_patches_h

#include <corotet/discretization/reference_element.h>
#include <corotet/operators/material_nodes.h>

#include <array>
#include <vector>

namespace corotet
{
  /**
   * Superconvergent patch recovery of stress (Zienkiewicz, Zhu 1992,
   * @cite zienkiewicz1992).
   *
   * The patch of a vertex is the cells of one material around it. A polynomial
   * of degree p is fitted to the stress at the points of the stiffness rule
   * there, by least squares. A node gets the values of the polynomials of the
   * vertices of its edge, face or cell, weighted by its barycentric
   * coordinates.
   *
   * For p = 1 and 2, one-sided patches of vertices on the surface or on an
   * interface would cost half an order: where nodes have other patches of the
   * same material, these count alone, those of the node's own vertices first,
   * then those of all inner vertices whose cells it belongs to. Cubic
   * polynomials, taken that far beyond the points that they were fitted to, are
   * worse than one-sided ones on all but very fine meshes: for p = 3 all
   * patches count. Where a fit of degree p is badly determined, one of degree
   * p - 1 takes its place, which counts last.
   *
   * Stress that is a polynomial of degree p - 1 is recovered exactly.
   *
   * @p discretization and @p nodes must outlive this object.
   */
  class StressPatches
  {
  public:
    /// Collective.
    StressPatches(const Discretization   &discretization,
                  const ReferenceElement &reference,
                  const MaterialNodes    &nodes);

    /**
     * @p recovered (of @p nodes, six numbers each as SymmetricTensor has them;
     * ghost entries up to date afterwards) from the stress at the points of
     * the stiffness rule in all local cells, cell by cell. Collective.
     */
    void
    recover(const std::vector<dealii::SymmetricTensor<2, 3>> &at_points,
            Vector                                           &recovered) const;

  private:
    /// A node that the polynomial of a patch contributes to, and how much.
    struct Target
    {
      unsigned int node;
      double       weight;
    };

    struct Patch
    {
      /// Of the discretization.
      unsigned int vertex;
      /// Whether it counts before others.
      bool is_preferred;
      /// Of the polynomial, in the variables scale (x - centre), in which the
      /// patch is round.
      unsigned int         degree;
      dealii::Point<3>     centre;
      dealii::Tensor<2, 3> scale;
      /// Of the matrix of the normal equations.
      std::vector<double>       inverse;
      std::vector<unsigned int> cells;
      std::vector<Target>       targets;
    };

    void
    find_patches(const ReferenceElement &reference);
    void
    set_up_fit(Patch &patch) const;
    /// All nodes of a patch, with the vertex's barycentric coordinate as
    /// weight; @p barycentric are those of the nodes of an element.
    std::vector<Target>
    nodes_of(const Patch                              &patch,
             const std::vector<std::array<double, 4>> &barycentric) const;
    void
    find_targets();

    const Discretization &discretization;
    const MaterialNodes  &nodes;
    unsigned int          n_points;
    /// Of the stiffness rule in all local cells, cell by cell.
    std::vector<dealii::Point<3>> points;
    std::vector<Patch>            patches;
  };
} // namespace corotet

#endif
