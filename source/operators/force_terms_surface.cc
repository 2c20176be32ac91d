// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Terms that act on the surface: matrices of springs and dashpots, and contact.

#include <corotet/base/joint_reduction.h>
#include <corotet/base/vector_at.h>
#include <corotet/operators/force_terms.h>
#include <corotet/operators/surface_matrix.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

#include "any_of.h"

namespace corotet
{
  namespace
  {
    bool
    is_spring(const ForceTerm &term)
    {
      return term.has_surface_matrix() &&
             term.role() == ForceTerm::Role::elastic;
    }

    bool
    is_friction(const ForceTerm &term)
    {
      return term.role() == ForceTerm::Role::damping &&
             !term.obstacle().empty();
    }
  } // namespace

  bool
  ForceTerms::has_surface_matrix() const
  {
    return any_of(terms, [](const ForceTerm &term) {
      return term.has_surface_matrix();
    });
  }

  bool
  ForceTerms::has_springs() const
  {
    return any_of(terms, [](const ForceTerm &term) {
      return is_spring(term) && !term.surface_matrix_depends_on_motion();
    });
  }

  bool
  ForceTerms::has_surface_damping() const
  {
    return any_of(terms, [](const ForceTerm &term) {
      return term.has_surface_matrix() && term.depends_on_velocity();
    });
  }

  bool
  ForceTerms::surface_matrix_depends_on_time() const
  {
    return any_of(terms, [](const ForceTerm &term) {
      return term.has_surface_matrix() && term.depends_on_time();
    });
  }

  bool
  ForceTerms::surface_matrix_depends_on_motion() const
  {
    return any_of(terms, [](const ForceTerm &term) {
      return term.surface_matrix_depends_on_motion();
    });
  }

  void
  ForceTerms::surface_matrix(SurfaceMatrix &S,
                             const Motion  &motion,
                             const double   c_u,
                             const double   c_v) const
  {
    S.clear();
    for (const auto &term : terms)
      if (term->has_surface_matrix())
        term->add_surface_matrix(S, motion, c_u, c_v);
  }

  std::unique_ptr<SurfaceMatrix>
  ForceTerms::springs(const ReferenceElement &reference,
                      const double            time) const
  {
    if (!has_springs())
      return nullptr;
    auto S = std::make_unique<SurfaceMatrix>(discretization, reference);
    // Supports do not read the motion: any vector will do.
    const Motion motion{time, constant_load, constant_load};
    for (const auto &term : terms)
      if (is_spring(*term) && !term->surface_matrix_depends_on_motion())
        term->add_surface_matrix(*S, motion, 1., 0.);
    return S;
  }

  std::unique_ptr<SurfaceMatrix>
  ForceTerms::stiffest_springs(const ReferenceElement &reference,
                               const double            time) const
  {
    std::unique_ptr<SurfaceMatrix> S;
    for (const auto &term : terms)
      if (is_spring(*term) && term->surface_matrix_depends_on_motion())
        {
          if (!S)
            S = std::make_unique<SurfaceMatrix>(discretization, reference);
          term->add_largest_surface_matrix(*S);
        }
    auto of_supports = springs(reference, time);
    if (!S)
      return of_supports;
    if (of_supports)
      S->add(*of_supports, 1.);
    return S;
  }

  std::vector<std::string>
  ForceTerms::obstacles() const
  {
    std::vector<std::string> result;
    for (const auto &term : terms)
      if (const std::string name = term->obstacle();
          !name.empty() &&
          std::find(result.begin(), result.end(), name) == result.end())
        result.push_back(name);
    return result;
  }

  std::vector<std::shared_ptr<const Obstacle>>
  ForceTerms::obstacle_shapes() const
  {
    std::vector<std::shared_ptr<const Obstacle>> result;
    for (const auto &term : terms)
      if (const auto shape = term->obstacle_shape();
          shape &&
          std::find(result.begin(), result.end(), shape) == result.end())
        result.push_back(shape);
    return result;
  }

  std::set<unsigned int>
  ForceTerms::ground_boundaries() const
  {
    std::set<unsigned int> result;
    for (const auto &term : terms)
      if (const auto boundary = term->ground_boundary())
        result.insert(*boundary);
    return result;
  }

  std::vector<GroundForce>
  ForceTerms::ground_forces(const Motion &motion) const
  {
    std::vector<GroundForce>     result;
    const std::set<unsigned int> boundaries = ground_boundaries();
    if (boundaries.empty())
      return result;
    for (const unsigned int boundary : boundaries)
      {
        Vector &f = zero_vector();
        for (const auto &term : terms)
          if (term->ground_boundary() == boundary)
            term->add_force(f, motion);
        f.compress(dealii::VectorOperation::add);
        GroundForce ground{boundary, {}, {}};
        for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
          {
            const dealii::Tensor<1, 3> force = vector_at(f, n);
            ground.force += force;
            ground.moment += cross_product_3d(discretization.node_position(n) +
                                                vector_at(motion.u, n),
                                              force);
          }
        result.push_back(ground);
      }
    JointReduction reduction;
    for (GroundForce &ground : result)
      {
        reduction.sum(ground.force);
        reduction.sum(ground.moment);
      }
    reduction.run(discretization.communicator());
    return result;
  }

  std::vector<std::pair<std::string, dealii::Tensor<1, 3>>>
  ForceTerms::contact_forces(const Motion &motion) const
  {
    std::vector<std::pair<std::string, dealii::Tensor<1, 3>>> result;
    for (const std::string &name : obstacles())
      {
        Vector &f = zero_vector();
        for (const auto &term : terms)
          if (term->obstacle() == name)
            term->add_force(f, motion);
        f.compress(dealii::VectorOperation::add);
        dealii::Tensor<1, 3> sum;
        for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
          sum[i % 3] += f.local_element(i);
        result.emplace_back(
          name, dealii::Utilities::MPI::sum(sum, f.get_mpi_communicator()));
      }
    return result;
  }

  double
  ForceTerms::contact_energy(const Motion &motion) const
  {
    double sum = 0;
    for (const auto &term : terms)
      if (!term->obstacle().empty() && term->role() == ForceTerm::Role::elastic)
        sum += term->energy(motion);
    return sum;
  }

  std::vector<std::pair<std::string, double>>
  ForceTerms::contact_depths(const Motion &motion) const
  {
    std::vector<std::pair<std::string, double>> result;
    for (const auto &term : terms)
      if (!term->obstacle().empty() && term->role() == ForceTerm::Role::elastic)
        result.emplace_back(term->obstacle(), term->depth(motion));
    return result;
  }

  bool
  ForceTerms::has_friction() const
  {
    return any_of(terms, is_friction);
  }

  bool
  ForceTerms::has_only_friction() const
  {
    return has_friction() && !any_of(terms, [](const ForceTerm &term) {
             return term.role() == ForceTerm::Role::damping &&
                    term.obstacle().empty();
           });
  }

  void
  ForceTerms::friction_force(Vector &f, const Motion &motion) const
  {
    f = 0;
    for (const auto &term : terms)
      if (is_friction(*term))
        term->add_force(f, motion);
    f.compress(dealii::VectorOperation::add);
    f *= -1.;
  }
} // namespace corotet
