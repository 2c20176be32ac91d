// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/force_round_off.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>

namespace corotet
{
  using dealii::Tensor;

  namespace
  {
    // Error of corotational strain, in machine precisions: F, R and their
    // product are each rounded.
    constexpr double corotational_noise = 4;
    // Error of displacements, in machine precisions: from their own rounding,
    // and from the sums of which the gradient consists.
    constexpr double displacement_noise = 1;
    constexpr double precision = std::numeric_limits<double>::epsilon();
  } // namespace

  ForceRoundOff::ForceRoundOff(const Discretization &discretization,
                               const Elasticity     &elasticity)
    : by_displacement(discretization.n_owned_nodes())
  {
    const ReferenceElement &reference = elasticity.reference_element();
    // Two sums for each node are its first two components here.
    Vector sums;
    discretization.initialize_vector(sums);
    std::vector<double> slopes(reference.n_nodes);
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        const CellGeometry &geometry = discretization.geometry(c);
        const Tensor<2, 3>  G =
          geometry.inverse_jacobian * transpose(geometry.inverse_jacobian);
        double square = 0;
        for (unsigned int i = 0; i < reference.n_nodes; ++i)
          {
            // The root mean square of |grad N_i| over the cell.
            double sum = 0;
            for (unsigned int k = 0; k < 3; ++k)
              for (unsigned int l = 0; l < 3; ++l)
                sum += G[k][l] * reference.gradient_products(i, i, 3 * k + l);
            slopes[i] = std::sqrt(sum);
            square += sum;
          }
        const IsotropicMaterial &material = elasticity.material(c);
        const double             stress = 3 * material.lambda + 2 * material.mu;
        const auto               nodes  = discretization.cell_nodes(c);
        for (unsigned int i = 0; i < reference.n_nodes; ++i)
          {
            const double force = stress * geometry.volume * slopes[i];
            sums.local_element(3 * nodes[i]) += force * force;
            sums.local_element(3 * nodes[i] + 1) += force * force * square;
          }
      }
    sums.compress(dealii::VectorOperation::add);
    double of_unit_strains = 0;
    for (unsigned int n = 0; n < by_displacement.size(); ++n)
      {
        of_unit_strains += sums.local_element(3 * n);
        by_displacement[n] = sums.local_element(3 * n + 1);
      }
    if (!elasticity.law().is_linear())
      by_rotations =
        corotational_noise * precision *
        std::sqrt(dealii::Utilities::MPI::sum(of_unit_strains,
                                              sums.get_mpi_communicator()));
  }

  double
  ForceRoundOff::of_displacement(const Vector &u) const
  {
    double sum = 0;
    for (unsigned int n = 0; n < by_displacement.size(); ++n)
      sum += square_at_node(u, n) * by_displacement[n];
    return displacement_noise * precision *
           std::sqrt(
             dealii::Utilities::MPI::sum(sum, u.get_mpi_communicator()));
  }

  std::vector<double>
  ForceRoundOff::squares_of_stiffness(const Vector *springs) const
  {
    // Rows of the springs' matrix are some three times their diagonal.
    constexpr double    of_row = 3;
    std::vector<double> squares(by_displacement);
    if (springs != nullptr)
      for (unsigned int n = 0; n < squares.size(); ++n)
        {
          double of_springs = 0;
          for (unsigned int a = 0; a < 3; ++a)
            of_springs =
              std::max(of_springs, of_row * springs->local_element(3 * n + a));
          squares[n] += of_springs * of_springs;
        }
    return squares;
  }
} // namespace corotet
