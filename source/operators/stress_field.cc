// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/material/stress_measures.h>
#include <corotet/operators/stress_field.h>
#include <corotet/operators/vertex_dilatation.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace corotet
{
  using dealii::SymmetricTensor;

  double
  StressError::relative() const
  {
    // Norms that are not numbers have no ratio.
    return energy_norm == 0 ?
             0. :
             energy_norm / std::hypot(stress_norm, energy_norm);
  }

  StressField::StressField(
    const Discretization                            &discretization,
    const ReferenceElement                          &reference,
    const std::map<unsigned int, IsotropicMaterial> &materials,
    const std::shared_ptr<const MaterialLaw>        &law,
    const VertexDilatation                          *dilatation)
    : discretization(discretization)
    , reference(reference)
    , point_stress(discretization, reference, materials, law)
    , dilatation(dilatation)
    , has_rotations(!law->is_linear())
  {}

  void
  StressField::set_displacement(const Vector &u)
  {
    displacement = &u;
    if (dilatation != nullptr)
      pressure_corrections = dilatation->pressure_corrections(u, has_rotations);
    has_points = has_recovery = has_selected_recovery = has_error = false;
  }

  void
  StressField::evaluate(const unsigned int                   cell,
                        const ReferenceElement::PointValues &rule,
                        SymmetricTensor<2, 3>               *stresses) const
  {
    point_stress.evaluate(*displacement, cell, rule, stresses);
    if (dilatation != nullptr)
      for (unsigned int q = 0; q < rule.weights.size(); ++q)
        stresses[q] +=
          pressure_corrections[cell] * dealii::unit_symmetric_tensor<3>();
  }

  const std::vector<SymmetricTensor<2, 3>> &
  StressField::at_points()
  {
    if (has_points)
      return points;
    Assert(displacement != nullptr, dealii::ExcNotInitialized());
    const auto       &rule     = reference.stiffness_rule;
    const std::size_t n_points = rule.weights.size();
    points.resize(discretization.n_local_cells() * n_points);
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      evaluate(c, rule, &points[c * n_points]);
    has_points = true;
    return points;
  }

  void
  StressField::set_up(std::unique_ptr<const StressPatches> &patches,
                      Vector                               &vector,
                      const StressPatches::AtSurface        at_surface,
                      const std::vector<unsigned int>      *cells)
  {
    if (patches)
      return;
    if (!nodes)
      nodes = std::make_unique<const MaterialNodes>(
        discretization, point_stress.n_materials(), [&](const unsigned int c) {
          return point_stress.material_index(c);
        });
    patches = std::make_unique<const StressPatches>(
      discretization, reference, *nodes, at_surface, cells);
    nodes->initialize_vector(vector);
  }

  void
  StressField::recover()
  {
    if (has_recovery)
      return;
    set_up(patches, recovered_stress, StressPatches::AtSurface::two_layers);
    at_points();
    patches->recover(points, recovered_stress);
    has_recovery = true;
  }

  void
  StressField::recover(const std::vector<unsigned int> &cells)
  {
    if (has_recovery)
      return;
    const bool is_other = !selected_patches || cells != selected_cells;
    if (dealii::Utilities::MPI::max(is_other ? 1 : 0,
                                    discretization.communicator()) == 1)
      {
        selected_cells        = cells;
        has_selected_recovery = false;
        selected_patches.reset();
        set_up(selected_patches,
               recovered_stress,
               StressPatches::AtSurface::two_layers,
               &selected_cells);
      }
    if (has_selected_recovery)
      return;
    if (!has_points)
      {
        const auto       &rule     = reference.stiffness_rule;
        const std::size_t n_points = rule.weights.size();
        points.resize(discretization.n_local_cells() * n_points);
        for (const unsigned int c : selected_patches->cells_read())
          evaluate(c, rule, &points[c * n_points]);
      }
    selected_patches->recover(points, recovered_stress);
    has_selected_recovery = true;
  }

  SymmetricTensor<2, 3>
  StressField::raw(const unsigned int                   cell,
                   const ReferenceElement::PointValues &point) const
  {
    Assert(displacement != nullptr, dealii::ExcNotInitialized());
    AssertDimension(point.weights.size(), 1);
    SymmetricTensor<2, 3> result;
    evaluate(cell, point, &result);
    return result;
  }

  SymmetricTensor<2, 3>
  StressField::recovered(const unsigned int            cell,
                         const std::span<const double> shape_values) const
  {
    Assert(has_recovery || has_selected_recovery, dealii::ExcNotInitialized());
    return value(recovered_stress, cell, shape_values);
  }

  SymmetricTensor<2, 3>
  StressField::value(const Vector                 &vector,
                     const unsigned int            cell,
                     const std::span<const double> shape_values) const
  {
    const auto            cell_nodes = nodes->cell_nodes(cell);
    SymmetricTensor<2, 3> result;
    for (unsigned int i = 0; i < cell_nodes.size(); ++i)
      for (unsigned int k = 0; k < 6; ++k)
        result.access_raw_entry(k) +=
          shape_values[i] * vector.local_element(6 * cell_nodes[i] + k);
    return result;
  }

  StressField::NodalValues
  StressField::at_nodes()
  {
    recover();
    NodalValues               result;
    std::vector<unsigned int> n_copies(discretization.n_owned_nodes());
    result.stress.resize(n_copies.size());
    result.strain.resize(n_copies.size());
    for (unsigned int n = 0; n < nodes->n_owned(); ++n)
      {
        const auto [node, group] = nodes->copy(n);
        SymmetricTensor<2, 3> sigma;
        for (unsigned int k = 0; k < 6; ++k)
          sigma.access_raw_entry(k) = recovered_stress.local_element(6 * n + k);
        ++n_copies[node];
        result.stress[node] += sigma;
        result.strain[node] +=
          strain_of_stress(point_stress.material(nodes->material(group)),
                           sigma);
      }
    for (unsigned int node = 0; node < n_copies.size(); ++node)
      if (n_copies[node] > 1)
        {
          result.stress[node] /= n_copies[node];
          result.strain[node] /= n_copies[node];
        }
    return result;
  }

  const StressError &
  StressField::error()
  {
    if (has_error)
      return stress_error;
    set_up(patches_of_estimate,
           stress_of_estimate,
           StressPatches::AtSurface::one_sided);
    at_points();
    patches_of_estimate->recover(points, stress_of_estimate);
    // The rule is exact for the square of the recovered stress, of degree 2p.
    const auto                        &rule = reference.load_rule;
    std::vector<SymmetricTensor<2, 3>> stresses(rule.weights.size());
    double                             sums[2] = {0, 0};
    stress_error.of_cells.assign(discretization.n_owned_cells(), 0.);
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        const IsotropicMaterial &material =
          point_stress.material(point_stress.material_index(c));
        evaluate(c, rule, stresses.data());
        double error_square = 0;
        for (unsigned int q = 0; q < stresses.size(); ++q)
          {
            const double volume =
              point_geometry(discretization, rule, c, q).volume;
            const SymmetricTensor<2, 3> difference =
              value(stress_of_estimate,
                    c,
                    {&rule.values(q, 0), reference.n_nodes}) -
              stresses[q];
            error_square +=
              volume * (difference * strain_of_stress(material, difference));
            sums[1] +=
              volume * (stresses[q] * strain_of_stress(material, stresses[q]));
          }
        stress_error.of_cells[c] = std::sqrt(error_square);
        sums[0] += error_square;
      }
    using dealii::Utilities::MPI::sum;
    stress_error.energy_norm =
      std::sqrt(sum(sums[0], discretization.communicator()));
    stress_error.stress_norm =
      std::sqrt(sum(sums[1], discretization.communicator()));
    has_error = true;
    return stress_error;
  }
} // namespace corotet
