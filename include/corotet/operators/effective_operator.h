// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_effective_operator_h
#define corotet_operators_effective_operator_h

#include <corotet/operators/assembled_matrix.h>
#include <corotet/operators/cellwise_operator.h>
#include <corotet/operators/elasticity.h>
#include <corotet/operators/mass.h>

#include <functional>
#include <memory>
#include <vector>

namespace corotet
{
  class ForceRoundOff;

  /**
   * The linear operator of implicit steps, A = c_K K + c_M M + S: a
   * CellwiseOperator with the coefficients of a body and the dilatation of its
   * vertices, if it has that, with the rotations of the elasticity at the last
   * update(), and a matrix S of the surface, if there is one. A is symmetric,
   * and positive definite if c_M > 0 or if enough is prescribed or supported by
   * S.
   *
   * A is assembled only if its matrix is asked for. The arguments of the
   * constructor must outlive this object.
   */
  class EffectiveOperator : private CellwiseOperator<double>
  {
  public:
    using CellwiseOperator<double>::diagonal;
    using CellwiseOperator<double>::prescribed_unknowns;

    /// @p is_prescribed has an entry for each local unknown, with ghosts.
    /// @p surface is S; null if there is none. Collective.
    EffectiveOperator(const Discretization             &discretization,
                      const Elasticity                 &elasticity,
                      const Mass                       &mass,
                      const std::vector<unsigned char> &is_prescribed,
                      const SurfaceMatrix              *surface = nullptr);

    ~EffectiveOperator();

    /// Takes over the coefficients, c_K > 0, the rotations, and the values of
    /// the surface's matrix. Collective.
    void
    update(const double c_K, const double c_M);

    /// dst = A src. Collective.
    void
    vmult(Vector &dst, const Vector &src) const;

    /// The matrix of A at the last update(); its values are computed by the
    /// first call after that. Collective.
    const BlockMatrix &
    matrix() const;

    /// The same for a caller who removes the values: the next call of matrix()
    /// computes them again. Collective.
    BlockMatrix &
    matrix_to_take() const;

    /// Gives back the memory of the matrix' values until the next call of
    /// matrix() or other_matrix().
    void
    release_matrix() const
    {
      if (assembled)
        assembled->release_values();
      is_assembled = false;
    }

    /**
     * The matrix of cells that @p update writes, plus @p stiffness_factor times
     * the stiffness of the vertices' dilatation. It uses the memory of matrix()
     * and is valid until that is called again. Collective.
     */
    const BlockMatrix &
    other_matrix(const std::function<void(AssembledMatrix &)> &update,
                 const double stiffness_factor) const;

    /// f += S v for owned entries. v has ghost values.
    void
    add_surface(Vector &f, const Vector &v) const
    {
      if (surface_operator)
        surface_operator->add(f, v);
    }

    /// The matrix S; null if there is none.
    const SurfaceMatrix *
    surface() const
    {
      return surface_matrix;
    }

    /// The values of S since the last update(); null if there is none.
    const SurfaceOperator<double> *
    surface_numbers() const
    {
      return surface_operator.get();
    }

    /// SurfaceMatrix::size() of S over c_K at the last update [N/m].
    double
    surface_size() const
    {
      return size_of_surface;
    }

    const Discretization &
    discretization() const
    {
      return disc;
    }

    const Elasticity &
    elasticity() const
    {
      return elastic;
    }

    const Mass &
    mass() const
    {
      return mass_matrix;
    }

    const ForceRoundOff &
    force_round_off() const
    {
      return *noise;
    }

    /// The node positions for which K does not resist rigid motions: displaced
    /// ones, or those at rest if the law is linear [m]. Owned entries.
    Vector
    positions(const Vector &displacement) const;

    /// The round-off that A v may have, or J v with another tangent than that
    /// of A, as a Euclidean norm [N]; that of M v is far smaller. Collective.
    double
    round_off(const Vector &v) const;

    /// See ForceRoundOff::squares_of_stiffness(). Collective.
    std::vector<double>
    squares_of_node_stiffness() const;

    /// The norm of those forces @p r at single nodes that are larger than what
    /// errors of displacements of @p cause [m] make in cells and springs [N].
    /// Collective.
    double
    unexplained(const Vector &r, const double cause) const;

    const std::vector<unsigned char> &
    is_prescribed() const
    {
      return prescribed;
    }

    /// c_K of the last update.
    double
    stiffness_factor() const
    {
      return c_K;
    }

    double
    mass_factor() const
    {
      return c_M;
    }

    /// Number of updates so far.
    unsigned int
    version() const
    {
      return n_updates;
    }

    /// c_M / c_K of the last update [1/s^2]: 0 in statics.
    double
    mass_ratio() const
    {
      return c_M / c_K;
    }

  private:
    const Discretization             &disc;
    const Elasticity                 &elastic;
    const Mass                       &mass_matrix;
    const std::vector<unsigned char> &prescribed;
    double                            c_K       = 1;
    double                            c_M       = 0;
    unsigned int                      n_updates = 0;

    std::unique_ptr<const ForceRoundOff>     noise;
    mutable std::unique_ptr<AssembledMatrix> assembled;
    mutable bool                             is_assembled = false;
    /// The vector that is multiplied, without prescribed entries; empty without
    /// a dilatation of the vertices.
    mutable Vector source;

    const SurfaceMatrix                     *surface_matrix  = nullptr;
    double                                   size_of_surface = 0;
    std::unique_ptr<SurfaceOperator<double>> surface_operator;
  };

  /// Numbers of the unknowns that are marked.
  std::vector<unsigned int>
  marked_unknowns(const std::vector<unsigned char> &marks);
} // namespace corotet

#endif
