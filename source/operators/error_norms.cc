// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/point_geometry.h>
#include <corotet/operators/error_norms.h>
#include <corotet/operators/vertex_dilatation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Adds the squares of the norms. @p pressure is added to the pressure of
    // the gradient.
    void
    add(FieldNorms              &sums,
        const IsotropicMaterial &material,
        const Tensor<1, 3>      &value,
        const Tensor<2, 3>      &gradient,
        const double             weight,
        const double             pressure = 0)
    {
      sums.L2 += weight * value.norm_square();
      sums.H1 += weight * gradient.norm_square();
      sums.energy +=
        weight * 2 * energy_density(material, symmetrize(gradient));
      // The energy has lambda (theta + change)^2 in place of lambda theta^2.
      if (pressure != 0)
        sums.energy += weight * pressure *
                       (2 * trace(gradient) + pressure / material.lambda);
    }

    FieldNorms
    total(const FieldNorms &sums, const MPI_Comm comm)
    {
      const auto norm = [&](const double square) {
        return std::sqrt(dealii::Utilities::MPI::sum(square, comm));
      };
      return {norm(sums.L2), norm(sums.H1), norm(sums.energy)};
    }
  } // namespace

  ErrorNorms
  error_norms(
    const Discretization                                     &discretization,
    const std::map<unsigned int, IsotropicMaterial>          &materials,
    const Vector                                             &u,
    const std::function<PointDisplacement(const Point<3> &)> &reference,
    const VertexDilatation                                   *dilatation)
  {
    const std::vector<double> pressures =
      dilatation != nullptr ? dilatation->pressure_corrections(u, false) :
                              std::vector<double>();
    const dealii::QWitherdenVincentSimplex<3> quadrature(5);
    const auto rule = ReferenceElement::tabulate(discretization.element(),
                                                 quadrature.get_points(),
                                                 quadrature.get_weights());
    ErrorNorms sums;
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        const auto               nodes = discretization.cell_nodes(c);
        const IsotropicMaterial &material =
          materials.at(discretization.region(c));
        for (unsigned int q = 0; q < rule.weights.size(); ++q)
          {
            Tensor<1, 3> value;
            Tensor<2, 3> gradient;
            for (unsigned int i = 0; i < nodes.size(); ++i)
              for (unsigned int a = 0; a < 3; ++a)
                {
                  const double u_ia = u.local_element(3 * nodes[i] + a);
                  value[a] += u_ia * rule.values[q][i];
                  for (unsigned int k = 0; k < 3; ++k)
                    gradient[a][k] += u_ia * rule.gradients[q][i][k];
                }
            const PointGeometry geometry =
              point_geometry(discretization, rule, c, q);
            gradient = gradient * geometry.inverse_jacobian;
            const PointDisplacement exact =
              reference(point_position(discretization, rule, c, q));
            add(sums.error,
                material,
                value - exact.value,
                gradient - exact.gradient,
                geometry.volume,
                dilatation != nullptr ? pressures[c] : 0.);
            add(sums.reference,
                material,
                exact.value,
                exact.gradient,
                geometry.volume);
          }
      }
    const MPI_Comm comm = discretization.communicator();
    return {total(sums.error, comm), total(sums.reference, comm)};
  }
} // namespace corotet
