// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/memory.h>
#include <corotet/solvers/vertex_level.h>

#include <deal.II/base/array_view.h>

#include <algorithm>
#include <array>
#include <utility>

namespace corotet
{
  namespace
  {
    // Number of faces of the surface per cell of a body that is at most three
    // layers of cells thick; one layer has 0.8.
    constexpr double thin = 0.25;

    // Rotations halve the iterations, or better, and make each of them cost up
    // to twice as much: they pay on thin bodies, where factors are small, and
    // on others if the mean ratio of their cells' proportions is at least this
    // one.
    constexpr double least_ratio = 15;

    // Operations to factorise a cube with n unknowns of degree 1, divided by
    // n^2.
    constexpr double operations_of_cube = 12;
    // Thin bodies with more than this many times the unknowns that a cube may
    // have are not factorised.
    constexpr double most_unknowns = 8;

    // Number of nodes of a rank that take more memory than pages of libraries
    // do.
    constexpr unsigned int many_nodes = 50000;

    // The growth of a factor with six unknowns in place of three at each point
    // of the same graph.
    constexpr double operations_of_motions = 8;
    constexpr double entries_of_motions    = 4;

    bool
    is_thin(const Discretization &discretization)
    {
      std::array<double, 2> sums{
        {static_cast<double>(discretization.boundary_faces().size()),
         static_cast<double>(discretization.n_owned_cells())}};
      dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums.data(),
                                                                  2),
                                  discretization.communicator(),
                                  dealii::ArrayView<double>(sums.data(), 2));
      return sums[0] > thin * sums[1];
    }
  } // namespace

  Coarsening
  VertexLevel::coarsening_for(const CellProportions &cells) const
  {
    Coarsening result;
    if (!cells.are_poor() && !is_thin_body)
      {
        // Larger aggregates take a third more iterations of half the work and
        // memory. They are for elements of degree 1 only, as iterations of
        // others cost more. The dilatation of vertices couples more nodes,
        // which makes aggregates that large anyway.
        if (quadratic == nullptr && !couples_further)
          result.n_joined = 3;
        return result;
      }
    // Bodies that bend, like those of flat cells and thin ones, need a large
    // last level: with more levels iterations double, or worse.
    result.most_aggregates = 4000;
    if (cells.are_poor())
      result.least_similarity = 0.3;
    return result;
  }

  bool
  VertexLevel::wants_rotations(const CellProportions &cells) const
  {
    // The further solvers do not support rotations.
    for (const auto &candidate : parameters.further)
      if (candidate.name == parameters.coarse_type)
        return false;
    if (parameters.vertex_rotations != "automatic")
      return parameters.vertex_rotations == "true";
    return cells.are_poor() &&
           (is_thin_body ||
            (3 * vertices.n_global_nodes() <= parameters.direct_limit &&
             cells.mean_ratio > least_ratio));
  }

  VertexLevel::VertexLevel(const PMultigridParameters       &parameters,
                           const EffectiveOperator          &A,
                           const CellProportions            &proportions,
                           const Nodes                      *quadratic,
                           const CoarserNodes               *coarser,
                           const std::vector<unsigned char> &is_prescribed,
                           std::vector<unsigned int>         finest_nodes)
    : parameters(parameters)
    , quadratic(quadratic)
    , coarser(coarser)
    , vertices(coarser != nullptr ? static_cast<const Nodes &>(*coarser) :
                                    A.discretization())
    , finest_nodes(std::move(finest_nodes))
  {
    is_thin_body    = is_thin(A.discretization());
    couples_further = A.elasticity().vertex_dilatation() != nullptr;
    aggregation.set_coarsening(coarsening_for(proportions));
    if (quadratic == nullptr)
      return;
    const std::vector<unsigned char> marks = coarser->marks(is_prescribed);
    prescribed                             = marked_unknowns(marks);
    vertices.initialize_vector(float_x);
    vertices.initialize_vector(float_b);
    if (wants_rotations(proportions))
      motions =
        std::make_unique<VertexMotions>(*quadratic, *coarser, is_prescribed);
    else
      assembled = std::make_unique<AssembledMatrix>(vertices,
                                                    marks,
                                                    block_pattern(vertices));
    unknowns.resize(6 * std::size_t(motions ? vertices.n_owned_nodes() : 0));
  }

  const BlockMatrix &
  VertexLevel::matrix(const EffectiveOperator &A) const
  {
    if (motions)
      return motions->matrix();
    return assembled ? assembled->matrix() : A.matrix();
  }

  void
  VertexLevel::assemble(const EffectiveOperator &A,
                        const double             scale,
                        const Vector            &displacement)
  {
    if (quadratic == nullptr)
      return;
    std::unique_ptr<SurfaceOperator<double>> surface;
    if (A.surface() != nullptr)
      {
        surface = std::make_unique<SurfaceOperator<double>>(
          motions ? *quadratic : vertices);
        surface->set(*A.surface(), 1 / scale);
      }
    const auto  &cells  = A.elasticity().coefficients();
    const auto  &masses = A.mass().cell_masses();
    const double c_K    = A.stiffness_factor() / scale,
                 c_M    = A.mass_factor() / scale;
    if (!motions)
      {
        assembled->update(c_K, cells, c_M, masses, nullptr, surface.get());
        return;
      }
    Vector positions = A.positions(displacement);
    positions.update_ghost_values();
    motions->update(
      A.discretization(), positions, c_K, cells, c_M, masses, surface.get());
  }

  bool
  VertexLevel::factors_pay(const BlockMatrix &A)
  {
    const double n     = 3. * vertices.n_global_nodes(),
                 limit = parameters.direct_limit;
    if (n <= limit)
      return true;
    // Aggregation is slow on these bodies, and their factors are small.
    if (!motions || !is_thin_body || n > most_unknowns * limit)
      return false;
    direct.analyze(A);
    return direct.n_operations() <=
           operations_of_motions * operations_of_cube * limit * limit;
  }

  void
  VertexLevel::build(const EffectiveOperator &A,
                     const double             scale,
                     const Vector            &displacement)
  {
    // Memory use is largest here. Library pages that only the set-up of large
    // bodies has read are released.
    if (solver.empty() && A.discretization().n_owned_nodes() > many_nodes)
      release_library_pages();
    assemble(A, scale, displacement);
    const BlockMatrix &level_matrix = matrix(A);
    solver                          = parameters.coarse_type;
    if (solver == "automatic")
      solver = factors_pay(level_matrix) ? "direct" : "aggregation";
    if (solver == "direct")
      {
        direct.factorize(level_matrix);
        if (assembled)
          assembled->release_values();
        else if (!motions)
          A.release_matrix();
        return;
      }
    if (solver == "aggregation" && motions)
      {
        aggregation.build(motions->aggregates());
        return;
      }
    Vector places = A.positions(displacement);
    if (quadratic != nullptr)
      {
        Vector finest;
        finest.swap(places);
        vertices.initialize_vector(places);
        for (unsigned int n = 0; n < vertices.n_owned_nodes(); ++n)
          for (unsigned int a = 0; a < 3; ++a)
            places.local_element(3 * n + a) =
              finest.local_element(3 * finest_nodes[n] + a);
      }
    if (solver == "aggregation")
      {
        aggregation.build(assembled ? std::move(assembled->matrix()) :
                                      std::move(A.matrix_to_take()),
                          places.begin());
        return;
      }
    for (Vector *vector : {&x, &b})
      vertices.initialize_vector(*vector);
    for (const auto &candidate : parameters.further)
      if (candidate.name == solver && !other)
        other = candidate.make();
    other->build(level_matrix, places);
  }

  VertexLevel::Factorization
  VertexLevel::factorization(const EffectiveOperator &A) const
  {
    SparseCholesky analyzed;
    if (!has_factors())
      analyzed.analyze(matrix(A));
    const SparseCholesky &factor = has_factors() ? direct : analyzed;
    return {3. * vertices.n_global_nodes(),
            factor.n_operations() / (motions ? operations_of_motions : 1),
            factor.n_entries() / (motions ? entries_of_motions : 1)};
  }

  template <typename Number>
  void
  VertexLevel::solve(Number *to, const Number *from, const double size) const
  {
    if (solver == "direct")
      direct.vmult(to, from);
    else
      aggregation.vmult(to, from, size);
  }

  void
  VertexLevel::vmult(Vector &to, const Vector &from, const double norm) const
  {
    if (other)
      other->vmult(to, from);
    else
      solve(to.begin(), from.begin(), norm);
  }

  void
  VertexLevel::correct(FloatVector &fine, const FloatVector &residual) const
  {
    if (motions)
      {
        motions->restrict_to(unknowns.data(), residual);
        solve(unknowns.data(), unknowns.data(), 1);
        motions->prolongate_add(fine, unknowns.data());
        return;
      }
    coarser->restrict_to(float_b, residual);
    for (const unsigned int i : prescribed)
      if (i < float_b.locally_owned_size())
        float_b.local_element(i) = 0;
    if (other)
      {
        std::copy_n(float_b.begin(), b.locally_owned_size(), b.begin());
        other->vmult(x, b);
        std::copy_n(x.begin(), x.locally_owned_size(), float_x.begin());
      }
    else
      solve(float_x.begin(), float_b.begin(), 1);
    float_x.update_ghost_values();
    coarser->prolongate_add(fine, float_x);
    float_x.zero_out_ghost_values();
  }
} // namespace corotet
