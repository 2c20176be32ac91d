// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/material/corotational.h>
#include <corotet/material/polar_decomposition.h>
#include <corotet/operators/cell_kernel.h>
#include <corotet/operators/elasticity.h>

#include <deal.II/base/mpi.h>

#include <limits>

namespace corotet
{
  using dealii::Tensor;

  namespace
  {
    Tensor<2, 3>
    deformation_gradient(Tensor<2, 3> grad_u)
    {
      for (unsigned int a = 0; a < 3; ++a)
        grad_u[a][a] += 1;
      return grad_u;
    }
  } // namespace

  Elasticity::Elasticity(
    const Discretization                            &discretization,
    const ReferenceElement                          &reference,
    const std::map<unsigned int, IsotropicMaterial> &materials,
    const bool                                       corotational)
    : discretization(discretization)
    , reference(reference)
    , corotational(corotational)
    , rotations(discretization.n_local_cells(),
                Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()))
  {
    std::map<unsigned int, unsigned int> index;
    for (const auto &[region, material] : materials)
      {
        index[region] = cell_materials.size();
        cell_materials.push_back(material);
      }
    material_of_cell.resize(discretization.n_local_cells());
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      material_of_cell[c] = index.at(discretization.geometry(c).region);
    if (corotational)
      estimate_round_off();
  }

  void
  Elasticity::estimate_round_off()
  {
    // |f_i| for a strain of a few machine precisions at every point.
    const double strain = 4 * std::numeric_limits<double>::epsilon();
    Vector       noise;
    discretization.initialize_vector(noise);
    const auto &rule = reference.stiffness_rule;
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        const CellGeometry &geometry = discretization.geometry(c);
        const auto          nodes    = discretization.cell_nodes(c);
        const double        stress =
          strain * (3 * material(c).lambda + 2 * material(c).mu);
        for (unsigned int i = 0; i < reference.n_nodes; ++i)
          for (unsigned int q = 0; q < rule.weights.size(); ++q)
            {
              Tensor<1, 3> by_xi;
              for (unsigned int k = 0; k < 3; ++k)
                by_xi[k] = rule.gradients[q][i][k];
              noise.local_element(3 * nodes[i]) +=
                stress * rule.weights[q] * geometry.volume *
                (by_xi * geometry.inverse_jacobian).norm();
            }
      }
    noise.compress(dealii::VectorOperation::add);
    round_off_norm = noise.l2_norm();
  }

  void
  Elasticity::update_rotations(const Vector &u)
  {
    if (!corotational)
      return;
    degenerate_cells = 0;
    with_degree(discretization.degree(), [&](const auto p) {
      using Kernel = CellKernel<decltype(p)::value>;
      typename Kernel::NodalValues cell_u;
      for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
        {
          Kernel::gather_differences(u.begin(),
                                     discretization.cell_nodes(c),
                                     cell_u);
          const PolarDecomposition polar =
            polar_decomposition(deformation_gradient(Kernel::gradient(
              reference.centre, 0, discretization.geometry(c), cell_u)));
          rotations[c] = polar.rotation;
          if (polar.state == PolarState::degenerate &&
              c < discretization.n_owned_cells())
            ++degenerate_cells;
        }
    });
  }

  template <typename StressOfCell>
  void
  Elasticity::cell_loop(Vector             &f,
                        const Vector       &u,
                        const StressOfCell &stress) const
  {
    f = 0;
    with_degree(discretization.degree(), [&](const auto p) {
      using Kernel = CellKernel<decltype(p)::value>;
      typename Kernel::NodalValues cell_u;
      for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
        {
          const auto nodes = discretization.cell_nodes(c);
          Kernel::gather_differences(u.begin(), nodes, cell_u);
          typename Kernel::NodalValues cell_f = {};
          Kernel::integrate(reference,
                            discretization.geometry(c),
                            cell_u,
                            cell_f,
                            [&](const Tensor<2, 3> &gradient) {
                              return stress(c, gradient);
                            });
          Kernel::scatter_add(cell_f, nodes, f.begin());
        }
    });
    f.compress(dealii::VectorOperation::add);
  }

  void
  Elasticity::internal_force(Vector &f, const Vector &u) const
  {
    cell_loop(f, u, [&](const unsigned int c, const Tensor<2, 3> &grad_u) {
      return corotational_stress(material(c), grad_u, rotations[c]);
    });
  }

  void
  Elasticity::apply_tangent(Vector &f, const Vector &v) const
  {
    cell_loop(f, v, [&](const unsigned int c, const Tensor<2, 3> &grad_v) {
      return corotational_tangent(material(c), grad_v, rotations[c]);
    });
  }

  ElasticState
  Elasticity::state(const Vector &u) const
  {
    ElasticState result;
    result.min_det_F = std::numeric_limits<double>::infinity();
    with_degree(discretization.degree(), [&](const auto p) {
      using Kernel = CellKernel<decltype(p)::value>;
      typename Kernel::NodalValues cell_u;
      for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
        {
          const CellGeometry &geometry = discretization.geometry(c);
          Kernel::gather_differences(u.begin(),
                                     discretization.cell_nodes(c),
                                     cell_u);
          const auto &rule    = reference.stiffness_rule;
          double      density = 0;
          double      det_F   = determinant(deformation_gradient(
            Kernel::gradient(reference.centre, 0, geometry, cell_u)));
          for (unsigned int q = 0; q < Kernel::n_points; ++q)
            {
              const Tensor<2, 3> grad_u =
                Kernel::gradient(rule, q, geometry, cell_u);
              density +=
                rule.weights[q] *
                energy_density(material(c),
                               corotational_strain(grad_u, rotations[c]));
              det_F =
                std::min(det_F, determinant(deformation_gradient(grad_u)));
            }
          result.energy += density * geometry.volume;
          result.min_det_F = std::min(result.min_det_F, det_F);
          result.inverted_cells += (det_F < 0);
        }
    });
    const MPI_Comm comm = discretization.communicator();
    result.energy       = dealii::Utilities::MPI::sum(result.energy, comm);
    result.min_det_F    = dealii::Utilities::MPI::min(result.min_det_F, comm);
    result.inverted_cells =
      dealii::Utilities::MPI::sum(result.inverted_cells, comm);
    result.degenerate_cells =
      dealii::Utilities::MPI::sum(degenerate_cells, comm);
    return result;
  }

  CellResults
  Elasticity::cell_results(const Vector &u) const
  {
    const unsigned int n = discretization.n_owned_cells();
    CellResults        result{std::vector<double>(n),
                       std::vector<double>(n),
                       std::vector<double>(n)};
    with_degree(discretization.degree(), [&](const auto p) {
      using Kernel = CellKernel<decltype(p)::value>;
      typename Kernel::NodalValues cell_u;
      for (unsigned int c = 0; c < n; ++c)
        {
          Kernel::gather_differences(u.begin(),
                                     discretization.cell_nodes(c),
                                     cell_u);
          const Tensor<2, 3> grad_u = Kernel::gradient(
            reference.centre, 0, discretization.geometry(c), cell_u);
          const Tensor<2, 3> F = deformation_gradient(grad_u);
          // Also linear elasticity shows how far its cells rotate: that is
          // what it neglects.
          result.rotation_angle[c] = rotation_angle(
            corotational ? rotations[c] : polar_decomposition(F).rotation);
          result.det_F[c]     = determinant(F);
          result.von_mises[c] = von_mises(
            stress(material(c), corotational_strain(grad_u, rotations[c])));
        }
    });
    return result;
  }
} // namespace corotet
