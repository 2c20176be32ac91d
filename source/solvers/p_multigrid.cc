// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/cell_proportions.h>
#include <corotet/solvers/p_multigrid.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace corotet
{
  namespace
  {
    // target = factor source, for owned entries.
    template <typename To, typename From>
    void
    copy_scaled(To &target, const From &source, const double factor)
    {
      const unsigned int n    = source.locally_owned_size();
      auto *const        to   = target.begin();
      const auto *const  from = source.begin();
      for (unsigned int i = 0; i < n; ++i)
        to[i] = factor * from[i];
    }

    // Values in [-1, 1] without pattern, by the places of the nodes in the body
    // alone: the same on any number of ranks, and in any units. They are smooth
    // functions of the place, so that round-off of positions, which others than
    // vertices have, grows to 1e7 roundings of doubles: none of floats.
    void
    fill_by_place(dealii::LinearAlgebra::distributed::Vector<float> &values,
                  const Discretization &discretization)
    {
      const unsigned int    n = discretization.n_owned_nodes();
      std::array<double, 6> ends;
      ends.fill(std::numeric_limits<double>::lowest());
      for (unsigned int node = 0; node < n; ++node)
        for (unsigned int a = 0; a < 3; ++a)
          {
            const double x = discretization.node_position(node)[a];
            ends[a]        = std::max(ends[a], x);
            ends[3 + a]    = std::max(ends[3 + a], -x);
          }
      dealii::Utilities::MPI::max(dealii::ArrayView<const double>(ends.data(),
                                                                  6),
                                  discretization.communicator(),
                                  dealii::ArrayView<double>(ends.data(), 6));
      const double size =
        std::max({ends[0] + ends[3], ends[1] + ends[4], ends[2] + ends[5]});
      constexpr double waves[3] = {12.9898, 78.233, 37.719};
      for (unsigned int node = 0; node < n; ++node)
        {
          double phase = 0;
          for (unsigned int a = 0; a < 3; ++a)
            phase += waves[a] / size *
                     (discretization.node_position(node)[a] + ends[3 + a]);
          for (unsigned int a = 0; a < 3; ++a)
            values.local_element(3 * node + a) =
              std::sin(43758.5453 * std::sin(phase + a));
        }
    }
  } // namespace

  PMultigrid::Level::Level(const Nodes                      &nodes,
                           const std::vector<unsigned char> &is_prescribed,
                           const unsigned int                smoother_degree,
                           const double                      smoothing_range)
    : is_prescribed(is_prescribed)
    , A(nodes, marked_unknowns(is_prescribed))
    , smoother(A, smoother_degree, smoothing_range)
    , coarser(nodes)
  {
    for (FloatVector *vector : {&lumped_mass, &x, &b, &residual})
      nodes.initialize_vector(*vector);
  }

  void
  PMultigrid::make_levels(const EffectiveOperator &A)
  {
    levels.clear();
    coarse_matrix.reset();
    const Nodes               *nodes         = &A.discretization();
    std::vector<unsigned char> is_prescribed = A.is_prescribed();
    while (nodes->degree() > 1)
      {
        levels.push_back(std::make_unique<Level>(*nodes,
                                                 is_prescribed,
                                                 parameters->smoother_degree,
                                                 parameters->smoothing_range));
        const CoarserNodes &coarser = levels.back()->coarser;
        is_prescribed               = coarser.marks(is_prescribed);
        nodes                       = &coarser;
      }
    coarse_nodes      = nodes;
    coarse_prescribed = marked_unknowns(is_prescribed);
    if (!levels.empty())
      {
        coarse_matrix =
          std::make_unique<AssembledMatrix>(*nodes, is_prescribed);
        nodes->initialize_vector(coarse_float_x);
        nodes->initialize_vector(coarse_float_b);
      }
    nodes->initialize_vector(coarse_x);
    nodes->initialize_vector(coarse_b);
    const CellBatches &batches = A.discretization().batches();
    coefficients.resize(batches.n_owned_batches() / floats_per_batch);
    masses.resize(coefficients.size());
  }

  void
  PMultigrid::choose_units(const EffectiveOperator &A)
  {
    const unsigned int n_batches =
      A.discretization().batches().n_owned_batches();
    double stiffness = 0, mass = 0;
    for (unsigned int batch = 0; batch < n_batches; ++batch)
      for (unsigned int lane = 0; lane < batch_size; ++lane)
        {
          const auto &cell = A.elasticity().coefficients()[batch];
          double      sum  = 0;
          for (const auto &component : cell.gradients)
            sum += component[lane] * component[lane];
          stiffness = std::max(stiffness, sum);
          mass      = std::max(mass, A.mass().cell_masses()[batch].mass[lane]);
        }
    const MPI_Comm comm = A.discretization().communicator();
    // Powers of two, and of four where there is a root: then no number gets
    // another last digit by them, whatever the rotations of this first state.
    const auto power = [&](const double largest, const int base_exponent) {
      const double of_all = dealii::Utilities::MPI::max(largest, comm);
      if (of_all == 0)
        return 1.;
      return std::ldexp(1., std::ilogb(of_all) / base_exponent * base_exponent);
    };
    stiffness_unit = power(stiffness, 2);
    mass_unit      = power(mass, 1);

    for (unsigned int batch = 0; batch < n_batches; ++batch)
      for (unsigned int lane = 0; lane < batch_size; ++lane)
        masses[batch / floats_per_batch]
          .mass[batch % floats_per_batch * batch_size + lane] =
          A.mass().cell_masses()[batch].mass[lane] / mass_unit;
    if (!levels.empty() && A.mass().is_lumped())
      copy_scaled(levels[0]->lumped_mass, A.mass().diagonal(), 1 / mass_unit);
  }

  void
  PMultigrid::build(const EffectiveOperator &A, const Vector &positions)
  {
    if (coarse_nodes == nullptr)
      {
        make_levels(A);
        choose_units(A);
      }
    update(A);
    estimate_eigenvalues(A.discretization());
    build_coarse_solver(A, positions);
  }

  void
  PMultigrid::estimate_eigenvalues(const Discretization &discretization)
  {
    // Nodes of coarser levels have no places of their own on all ranks alike:
    // their start is what they see of the finer one.
    for (unsigned int l = 0; l < levels.size(); ++l)
      {
        FloatVector &start = levels[l]->b;
        if (l == 0)
          fill_by_place(start, discretization);
        else
          levels[l - 1]->coarser.restrict_to(start, levels[l - 1]->b);
        levels[l]->smoother.estimate_eigenvalues(start);
      }
  }

  PMultigrid::Factorization
  PMultigrid::factorization_of_degree_1(const EffectiveOperator &A) const
  {
    const double n = 3. * coarse_nodes->n_global_nodes();
    if (has_factors())
      return {n,
              direct.n_operations(),
              static_cast<double>(direct.n_entries())};
    SparseCholesky factor;
    factor.analyze(coarse_matrix ? coarse_matrix->matrix() : A.matrix());
    return {n, factor.n_operations(), static_cast<double>(factor.n_entries())};
  }

  std::vector<double>
  PMultigrid::largest_eigenvalues() const
  {
    std::vector<double> result;
    for (const auto &level : levels)
      result.push_back(level->smoother.largest_eigenvalue());
    return result;
  }

  void
  PMultigrid::update(const EffectiveOperator &A)
  {
    scale = A.stiffness_factor() * stiffness_unit;
    if (levels.empty())
      return;
    const auto  &cells  = A.elasticity().coefficients();
    const double factor = 1 / std::sqrt(stiffness_unit);
    for (unsigned int batch = 0; batch < coefficients.size() * floats_per_batch;
         ++batch)
      {
        CellCoefficients<float> &cell  = coefficients[batch / floats_per_batch];
        const unsigned int       first = batch % floats_per_batch * batch_size;
        for (unsigned int i = 0; i < 9; ++i)
          for (unsigned int lane = 0; lane < batch_size; ++lane)
            cell.gradients[i][first + lane] =
              factor * cells[batch].gradients[i][lane];
        for (unsigned int lane = 0; lane < batch_size; ++lane)
          cell.lame_ratio[first + lane] = cells[batch].lame_ratio[lane];
      }
    for (unsigned int l = 0; l < levels.size(); ++l)
      {
        Level &level = *levels[l];
        if (A.surface() != nullptr)
          {
            if (!level.surface)
              level.surface =
                std::make_unique<SurfaceOperator<float>>(level.A.nodes());
            level.surface->set(*A.surface(), 1 / scale);
          }
        level.A.set_surface(level.surface.get());
        level.A.set_terms(1,
                          coefficients.data(),
                          A.mass_factor() * mass_unit / scale,
                          masses.data(),
                          // Mass is lumped on the finest level only: that comes
                          // closer to what the coarser ones must correct.
                          l == 0 && A.mass().is_lumped() ? &level.lumped_mass :
                                                           nullptr);
        if (l == 0)
          {
            copy_scaled(level.residual, A.diagonal(), 1 / scale);
            level.smoother.update_diagonal(level.residual, level.surface.get());
          }
        else
          {
            level.A.compute_diagonal();
            level.smoother.update_diagonal(level.A.diagonal(),
                                           level.surface.get());
          }
      }
  }

  void
  PMultigrid::choose_aggregates(const Discretization &discretization)
  {
    if (has_chosen_aggregates)
      return;
    has_chosen_aggregates = true;
    // Aggregates end where a rank does. Partitions cut through lines of flat
    // cells, whose nodes are coupled strongly: aggregates of what is left of
    // these are worse than those of all neighbours. Stretched cells are cut in
    // few places only.
    constexpr double      few         = 0.1;
    const CellProportions proportions = cell_proportions(discretization);
    const bool            is_alone    = dealii::Utilities::MPI::n_mpi_processes(
                            discretization.communicator()) == 1;
    if (proportions.share_stretched > few ||
        (is_alone && proportions.share_flat > few))
      aggregation.set_least_similarity(0.3);
  }

  void
  PMultigrid::build_coarse_solver(const EffectiveOperator &A,
                                  const Vector            &positions)
  {
    if (coarse_matrix)
      {
        std::unique_ptr<SurfaceOperator<double>> surface;
        if (A.surface() != nullptr)
          {
            surface = std::make_unique<SurfaceOperator<double>>(*coarse_nodes);
            surface->set(*A.surface(), 1 / scale);
          }
        coarse_matrix->update(1 / stiffness_unit,
                              A.elasticity().coefficients(),
                              A.mass_factor() / scale,
                              A.mass().cell_masses(),
                              nullptr,
                              surface.get());
      }
    const auto &matrix = coarse_matrix ? coarse_matrix->matrix() : A.matrix();
    coarse_solver      = parameters->coarse_type;
    if (coarse_solver == "automatic")
      coarse_solver =
        3 * coarse_nodes->n_global_nodes() <= parameters->direct_limit ?
          "direct" :
          "aggregation";
    if (coarse_solver == "direct")
      {
        direct.factorize(matrix);
        return;
      }
    for (unsigned int n = 0; n < coarse_nodes->n_owned_nodes(); ++n)
      {
        // Down the levels: vertices are their own keys.
        unsigned int fine = n;
        for (unsigned int l = levels.size(); l-- > 0;)
          fine = levels[l]->coarser.key(fine);
        for (unsigned int a = 0; a < 3; ++a)
          coarse_x.local_element(3 * n + a) =
            positions.local_element(3 * fine + a);
      }
    if (coarse_solver == "aggregation")
      {
        choose_aggregates(A.discretization());
        aggregation.build(matrix, coarse_x.begin());
        return;
      }
    for (const auto &candidate : parameters->further)
      if (candidate.name == coarse_solver && !other)
        other = candidate.make();
    other->build(matrix, coarse_x);
  }

  template <typename VectorType>
  void
  PMultigrid::apply_coarse_solver(VectorType &x, const VectorType &b) const
  {
    if (coarse_solver == "direct")
      direct.vmult(x, b);
    else if (coarse_solver == "aggregation")
      aggregation.vmult(x.begin(), b.begin());
    else if constexpr (std::is_same_v<VectorType, Vector>)
      other->vmult(x, b);
  }

  void
  PMultigrid::vmult(Vector &dst, const Vector &src) const
  {
    if (levels.empty())
      {
        apply_coarse_solver(dst, src);
        return;
      }
    // Single precision has its limits: sources of any size become one of size
    // one.
    const double size = src.l2_norm();
    if (size == 0)
      {
        dst = 0;
        return;
      }
    copy_scaled(levels[0]->b, src, 1 / size);
    cycle(0);
    copy_scaled(dst, levels[0]->x, size / scale);
  }

  void
  PMultigrid::cycle(const unsigned int l) const
  {
    Level     &level   = *levels[l];
    const bool is_last = l + 1 == levels.size();
    level.smoother.smooth_from_zero(level.x, level.b);
    level.A.residual(level.residual, level.b, level.x);

    FloatVector &coarse_b = is_last ? coarse_float_b : levels[l + 1]->b;
    FloatVector &coarse_x = is_last ? coarse_float_x : levels[l + 1]->x;
    level.coarser.restrict_to(coarse_b, level.residual);
    if (is_last)
      solve_coarse(coarse_x, coarse_b);
    else
      cycle(l + 1);
    coarse_x.update_ghost_values();
    level.coarser.prolongate_add(level.x, coarse_x);
    coarse_x.zero_out_ghost_values();

    level.smoother.smooth(level.x, level.b);
  }

  void
  PMultigrid::solve_coarse(FloatVector &x, FloatVector &b) const
  {
    for (const unsigned int i : coarse_prescribed)
      if (i < b.locally_owned_size())
        b.local_element(i) = 0;
    if (!other)
      {
        apply_coarse_solver(x, b);
        return;
      }
    copy_scaled(coarse_b, b, 1.);
    apply_coarse_solver(coarse_x, coarse_b);
    copy_scaled(x, coarse_x, 1.);
  }
} // namespace corotet
