// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_stress_patches_h
#define corotet_operators_stress_patches_h

#include <corotet/discretization/reference_element.h>
#include <corotet/operators/stress_samples.h>

#include <array>
#include <optional>
#include <vector>

namespace corotet
{
  /// A polynomial that is fitted to stress by weighted least squares.
  struct StressFit
  {
    /// Degree in the variables scale (x - centre), in which the cells are
    /// round.
    unsigned int         degree;
    dealii::Point<3>     centre;
    dealii::Tensor<2, 3> scale;
    /// Points at the distance r in these variables from the vertex have weights
    /// proportional to (1/2 + r)^-decay; decay is 0, 2 or 4.
    dealii::Point<3>          vertex;
    unsigned int              decay;
    std::vector<unsigned int> cells;
    /// Inverse of the matrix of the normal equations, row by row.
    std::vector<double> inverse;
    /// Sums over the samples of its monomials times those of the patch's first
    /// fit, row by row, if it is fitted to the remainder of that one.
    std::vector<double> products_with_first;

    /// Weight of a sample.
    double
    weight(const dealii::Point<3> &x) const
    {
      if (decay == 0)
        return 1;
      const double distance = 0.5 + (scale * (x - vertex)).norm();
      const double square   = distance * distance;
      return 1 / (decay == 2 ? square : square * square);
    }
  };

  /**
   * Superconvergent patch recovery of stress (Zienkiewicz, Zhu 1992,
   * @cite zienkiewicz1992), with wider patches at the surface.
   *
   * The patch of a vertex consists of the cells of one group of MaterialNodes
   * around it. A polynomial of degree p is fitted to the stress at the points
   * of the stiffness rule there, by least squares. A node gets the values of
   * the polynomials of the vertices of its edge, face or cell, weighted by its
   * barycentric coordinates.
   *
   * At the surface and at interfaces a patch is one-sided: it determines terms
   * of degree p badly, and their errors are largest at the vertex. There a
   * polynomial of degree p is fitted to two layers of cells around the vertex,
   * with larger weights for nearer ones; one of degree p - 1 is fitted to the
   * remainder in the patch itself and added. For p = 1 the polynomial is that
   * of the two layers, and vertices next to inner ones take the polynomials of
   * these.
   *
   * Where a fit of degree p is badly determined all the same, it is replaced by
   * one of degree p - 1, which is used last. Stress that is a polynomial of
   * degree p - 1 is recovered exactly.
   *
   * @p discretization and @p nodes must outlive this object.
   */
  class StressPatches
  {
  public:
    /**
     * How polynomials of vertices at the surface and at interfaces are made.
     * With two_layers as described above, which is more accurate there. With
     * one_sided they are fitted to the patch alone, and for p = 1 and 2 nodes
     * that belong to patches of inner vertices take the polynomials of these.
     * The error is estimated by the distance of the recovered stress from the
     * raw one: as two_layers are closer to that at the surface, one_sided
     * patches estimate errors better.
     */
    enum class AtSurface
    {
      two_layers,
      one_sided
    };

    /// Collective. @p cells are local ones in whose nodes the stress is wanted,
    /// different ones on each rank; null if it is wanted everywhere.
    StressPatches(const Discretization            &discretization,
                  const ReferenceElement          &reference,
                  const MaterialNodes             &nodes,
                  const AtSurface                  at_surface,
                  const std::vector<unsigned int> *cells = nullptr);

    /**
     * Computes @p recovered (at @p nodes, six numbers each in the order of
     * SymmetricTensor; ghost entries up to date afterwards) from the stress at
     * the points of the stiffness rule in all local cells, cell by cell.
     * Entries where it is not wanted do not change. Stress of cells of other
     * ranks is added to @p at_points. Collective.
     */
    void
    recover(std::vector<dealii::SymmetricTensor<2, 3>> &at_points,
            Vector                                     &recovered) const;

    /// Local cells whose stress recover() reads if it is wanted in some cells
    /// only, ascending.
    const std::vector<unsigned int> &
    cells_read() const
    {
      return read;
    }

  private:
    /// A node to which the polynomial of a patch contributes, and its weight.
    struct Target
    {
      unsigned int node;
      double       weight;
    };

    struct Patch
    {
      /// The discretization's number.
      unsigned int vertex;
      unsigned int group;
      /// Whether the polynomial is used before others.
      bool                      is_preferred;
      std::vector<unsigned int> cells;
      /// Each fit is for the remainder of those before; the polynomial is their
      /// sum.
      std::vector<StressFit> fits;
      std::vector<Target>    targets;
    };

    void
    find_patches(const ReferenceElement &reference, const AtSurface at_surface);
    /// Patches of inner vertices with their fits, and those of the other
    /// vertices without fits, which widen() adds.
    std::vector<Patch>
    first_patches(const Vector &surface) const;
    void
    widen(Patch &patch) const;
    /// Adds fits like widen(), but for one_sided patches.
    void
    fit_one_sided(Patch &patch) const;
    /// The polynomial of a degree for some cells around a vertex; none if the
    /// smallest eigenvalue of the normal equations over the largest one is
    /// below @p smallest_eigenvalue.
    std::optional<StressFit>
    fit(const unsigned int               vertex,
        const std::vector<unsigned int> &cells,
        const unsigned int               degree,
        const unsigned int               decay,
        const double                     smallest_eigenvalue) const;
    /// All nodes of a patch, with the vertex's barycentric coordinate as
    /// weight; @p barycentric has those of an element's nodes.
    std::vector<Target>
    nodes_of(const Patch                              &patch,
             const std::vector<std::array<double, 4>> &barycentric) const;
    void
    find_targets();
    /// Sets is_wanted, from the cells of each rank.
    void
    find_wanted(const std::vector<unsigned int> &cells);
    /// Whether the stress at @p node of MaterialNodes is wanted on any rank.
    bool
    wants(const unsigned int node) const
    {
      return is_wanted.empty() || is_wanted[node] != 0;
    }
    /// Whether the stress is wanted at any node of some cells.
    bool
    wants_any(const std::vector<unsigned int> &cells) const;
    void
    find_cells_read();

    const Discretization &discretization;
    const MaterialNodes  &nodes;
    StressSamples         samples;
    /// Whether the stress is wanted, by local node; empty if it is everywhere.
    std::vector<unsigned char> is_wanted;
    /// The patches that contribute where stress is wanted.
    std::vector<Patch>        patches;
    std::vector<unsigned int> read;
  };
} // namespace corotet

#endif
