// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/tangent_operator.h>

namespace corotet
{
  TangentOperator::TangentOperator(const EffectiveOperator &A,
                                   Elasticity              &elasticity,
                                   ForceTerms              &forces)
    : A(A)
    , elasticity(elasticity)
    , forces(forces)
  {
    A.discretization().initialize_vector(source);
  }

  unsigned int
  TangentOperator::update(const Motion &motion,
                          const Tangent tangent,
                          const double  load_factor,
                          const double  velocity_factor)
  {
    this->load_factor     = load_factor;
    this->velocity_factor = velocity_factor;
    forces.linearize(motion, tangent);
    return update_elasticity(motion.u, tangent);
  }

  unsigned int
  TangentOperator::update_elasticity(const Vector &u, const Tangent tangent)
  {
    this->tangent = tangent;
    displacement  = &u;
    return elasticity.is_by_cell(tangent) ? 0 :
                                            elasticity.linearize(u, tangent);
  }

  const BlockMatrix &
  TangentOperator::matrix(const double n_frozen) const
  {
    Assert(has_matrix(), dealii::ExcInternalError());
    const Mass         &mass = A.mass();
    const double        c_M  = A.mass_factor();
    const Vector *const lumped =
      c_M != 0 && mass.is_lumped() ? &mass.diagonal() : nullptr;
    const double frozen_factor = A.stiffness_factor() + n_frozen;
    return A.other_matrix(
      [&](AssembledMatrix &matrix) {
        matrix.update(
          [&](const Elasticity::TakeCellMatrices &take) {
            elasticity.cell_matrices(*displacement,
                                     frozen_factor,
                                     c_M,
                                     c_M == 0 || mass.is_lumped() ?
                                       nullptr :
                                       mass.cell_masses().data(),
                                     take);
          },
          c_M,
          lumped,
          A.surface_numbers());
      },
      frozen_factor);
  }

  void
  TangentOperator::vmult(Vector &dst, const Vector &src) const
  {
    const unsigned int n_owned     = src.locally_owned_size();
    const bool         with_forces = forces.has_linearization(tangent);
    const bool         with_surface =
      A.surface() != nullptr && !elasticity.is_by_cell(tangent);
    source.copy_locally_owned_data_from(src);
    for (const unsigned int i : A.prescribed_unknowns())
      if (i < n_owned)
        source.local_element(i) = 0;
    if (with_forces || with_surface)
      source.update_ghost_values();
    const Mass &mass = A.mass();
    if (elasticity.is_by_cell(tangent))
      A.vmult(dst, src);
    else
      elasticity.apply_linearization(dst,
                                     source,
                                     A.stiffness_factor(),
                                     A.mass_factor(),
                                     A.mass_factor() == 0 || mass.is_lumped() ?
                                       nullptr :
                                       mass.cell_masses().data(),
                                     A.mass_factor() != 0 && mass.is_lumped() ?
                                       &mass.diagonal() :
                                       nullptr);
    if (with_surface)
      A.add_surface(dst, source);
    if (with_forces)
      forces.subtract_linearized(
        dst, source, load_factor, velocity_factor, tangent);
    if (with_forces || with_surface)
      source.zero_out_ghost_values();
    for (const unsigned int i : A.prescribed_unknowns())
      if (i < n_owned)
        dst.local_element(i) =
          A.diagonal().local_element(i) * src.local_element(i);
  }
} // namespace corotet
