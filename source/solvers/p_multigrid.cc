// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/values_by_place.h>
#include <corotet/solvers/p_multigrid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace corotet
{
  namespace
  {
    // target = factor source on owned entries.
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

    // target = factor diagonal - that of S, at the nodes of S: in double
    // precision, as stiff springs have no stiffness along the surface.
    void
    take_out_surface(Chebyshev::FloatVector       &target,
                     const Vector                 &diagonal,
                     const double                  factor,
                     const SurfaceOperator<float> &S)
    {
      constexpr double round_off = std::numeric_limits<double>::epsilon();
      for (unsigned int k = 0; k < S.owned_nodes().size(); ++k)
        for (unsigned int a = 0; a < 3; ++a)
          {
            const unsigned int i    = 3 * S.owned_nodes()[k] + a;
            const double       both = factor * diagonal.local_element(i);
            target.local_element(i) =
              std::max(both - S.diagonal_blocks()[k][a][a], round_off * both);
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
    for (FloatVector *vector : {&x, &b, &residual})
      nodes.initialize_vector(*vector);
  }

  void
  PMultigrid::make_levels(const EffectiveOperator &A)
  {
    levels.clear();
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
    const Level *last = levels.empty() ? nullptr : levels.back().get();
    std::vector<unsigned int> finest_nodes(nodes->n_owned_nodes());
    for (unsigned int n = 0; n < finest_nodes.size(); ++n)
      {
        // Follows a vertex down the levels, where it is its own key.
        finest_nodes[n] = n;
        for (unsigned int l = levels.size(); l-- > 0;)
          finest_nodes[n] = levels[l]->coarser.key(finest_nodes[n]);
      }
    the_proportions = cell_proportions(A.discretization());
    vertex_level    = std::make_unique<VertexLevel>(
      *parameters,
      A,
      the_proportions,
      last != nullptr ? &last->A.nodes() : nullptr,
      last != nullptr ? &last->coarser : nullptr,
      last != nullptr ? last->is_prescribed : is_prescribed,
      std::move(finest_nodes));
    if (begins_in_double)
      vertex_level->begin_in_double();
    if (levels.empty())
      return;
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
    // The units are powers of two, or of four where a root is taken: so no
    // number is rounded by them, whatever the rotations of this first state.
    const auto power = [&](const double largest, const int base_exponent) {
      const double of_all = dealii::Utilities::MPI::max(largest, comm);
      if (of_all == 0)
        return 1.;
      return std::ldexp(1., std::ilogb(of_all) / base_exponent * base_exponent);
    };
    stiffness_unit = power(stiffness, 2);
    mass_unit      = power(mass, 1);
    if (levels.empty())
      return;

    for (unsigned int batch = 0; batch < n_batches; ++batch)
      for (unsigned int lane = 0; lane < batch_size; ++lane)
        masses[batch / floats_per_batch]
          .mass[batch % floats_per_batch * batch_size + lane] =
          A.mass().cell_masses()[batch].mass[lane] / mass_unit;
    if (A.mass().is_lumped())
      {
        A.discretization().initialize_vector(levels[0]->lumped_mass);
        copy_scaled(levels[0]->lumped_mass, A.mass().diagonal(), 1 / mass_unit);
      }
  }

  void
  PMultigrid::transfer(Archive &archive)
  {
    bool is_in_double = vertex_level && vertex_level->is_in_double();
    archive.transfer("is_in_double", is_in_double);
    if (archive.is_reading())
      begins_in_double = is_in_double;
  }

  void
  PMultigrid::build(const EffectiveOperator &A, const Vector &displacement)
  {
    if (!vertex_level)
      {
        make_levels(A);
        choose_units(A);
      }
    update(A);
    estimate_eigenvalues(A.discretization());
    vertex_level->build(A, scale, displacement);
  }

  void
  PMultigrid::estimate_eigenvalues(const Discretization &discretization)
  {
    // Places of nodes of coarser levels are not known on all ranks alike, so
    // their start is restricted from the finer level.
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
    const double stiffness = A.stiffness_factor() * stiffness_unit;
    const double mass      = A.mass_factor() * mass_unit;
    // In very short steps the mass dominates and must not leave the range of
    // single precision.
    constexpr double largest = 1e20;
    scale                    = std::max(stiffness, mass / largest);
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
        level.A.set_terms(stiffness / scale,
                          coefficients.data(),
                          mass / scale,
                          masses.data(),
                          // Mass is lumped on the finest level only: the
                          // consistent mass is closer to what coarser levels
                          // must correct.
                          l == 0 && A.mass().is_lumped() ? &level.lumped_mass :
                                                           nullptr);
        if (l == 0)
          {
            copy_scaled(level.residual, A.diagonal(), 1 / scale);
            if (level.surface)
              take_out_surface(level.residual,
                               A.diagonal(),
                               1 / scale,
                               *level.surface);
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
  PMultigrid::vmult(Vector &dst, const Vector &src) const
  {
    vmult_with_norm(dst, src, src.l2_norm());
  }

  void
  PMultigrid::vmult_with_norm(Vector       &dst,
                              const Vector &src,
                              const double  src_norm) const
  {
    if (src_norm == 0)
      {
        dst = 0;
        return;
      }
    if (levels.empty())
      {
        vertex_level->vmult(dst, src, src_norm);
        return;
      }
    // Sources of any size are scaled to size one, for the range of single
    // precision.
    copy_scaled(levels[0]->b, src, 1 / src_norm);
    cycle(0);
    copy_scaled(dst, levels[0]->x, src_norm / scale);
  }

  void
  PMultigrid::cycle(const unsigned int l) const
  {
    Level &level = *levels[l];
    level.smoother.smooth_from_zero(level.x, level.b);
    level.A.residual(level.residual, level.b, level.x);

    if (l + 1 == levels.size())
      vertex_level->correct(level.x, level.residual);
    else
      {
        Level &next = *levels[l + 1];
        level.coarser.restrict_to(next.b, level.residual);
        cycle(l + 1);
        next.x.update_ghost_values();
        level.coarser.prolongate_add(level.x, next.x);
        next.x.zero_out_ghost_values();
      }

    level.smoother.smooth(level.x, level.b);
  }
} // namespace corotet
