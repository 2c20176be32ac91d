// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/effective_operator.h>
#include <corotet/operators/force_round_off.h>

namespace corotet
{
  std::vector<unsigned int>
  marked_unknowns(const std::vector<unsigned char> &marks)
  {
    std::vector<unsigned int> result;
    for (unsigned int i = 0; i < marks.size(); ++i)
      if (marks[i])
        result.push_back(i);
    return result;
  }

  EffectiveOperator::EffectiveOperator(
    const Discretization             &discretization,
    const Elasticity                 &elasticity,
    const Mass                       &mass,
    const std::vector<unsigned char> &is_prescribed,
    const SurfaceMatrix              *surface)
    : CellwiseOperator<double>(discretization, marked_unknowns(is_prescribed))
    , disc(discretization)
    , elastic(elasticity)
    , mass_matrix(mass)
    , prescribed(is_prescribed)
    , noise(std::make_unique<ForceRoundOff>(discretization, elasticity))
    , surface_matrix(surface)
  {
    if (surface == nullptr)
      return;
    surface_operator = std::make_unique<SurfaceOperator<double>>(disc);
    set_surface(surface_operator.get());
  }

  EffectiveOperator::~EffectiveOperator() = default;

  double
  EffectiveOperator::round_off(const Vector &v) const
  {
    return c_K * noise->of_product(v) +
           (surface_operator ? surface_operator->round_off(v) : 0.);
  }

  void
  EffectiveOperator::update(const double c_K, const double c_M)
  {
    this->c_K = c_K;
    this->c_M = c_M;
    set_terms(c_K,
              elastic.coefficients().data(),
              c_M,
              mass_matrix.cell_masses().data(),
              mass_matrix.is_lumped() ? &mass_matrix.diagonal() : nullptr);
    if (surface_matrix != nullptr)
      {
        surface_operator->set(*surface_matrix);
        size_of_surface = surface_matrix->size() / c_K;
      }
    compute_diagonal();
    is_assembled = false;
    ++n_updates;
  }

  AssembledMatrix &
  EffectiveOperator::matrix_for_others() const
  {
    if (!assembled)
      assembled = std::make_unique<AssembledMatrix>(disc, prescribed);
    is_assembled = false;
    return *assembled;
  }

  const BlockMatrix &
  EffectiveOperator::matrix() const
  {
    if (!assembled || !is_assembled)
      matrix_for_others().update(c_K,
                                 elastic.coefficients(),
                                 c_M,
                                 mass_matrix.cell_masses(),
                                 mass_matrix.is_lumped() ?
                                   &mass_matrix.diagonal() :
                                   nullptr,
                                 surface_operator.get());
    is_assembled = true;
    return assembled->matrix();
  }
} // namespace corotet
