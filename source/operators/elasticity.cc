// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/material/corotational.h>
#include <corotet/material/polar_decomposition.h>
#include <corotet/operators/elasticity.h>
#include <corotet/operators/vertex_dilatation.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <cmath>

namespace corotet
{
  using dealii::Tensor;

  Elasticity::Elasticity(
    const Discretization                            &discretization,
    const ReferenceElement                          &reference,
    const std::map<unsigned int, IsotropicMaterial> &materials,
    const std::shared_ptr<const MaterialLaw>        &law,
    const Dilatation                                 whose_dilatation)
    : discretization(discretization)
    , reference(reference)
    , material_law(law)
    , sweeps(law->sweeps(discretization.element()))
    , materials(materials)
    , cell_loop(discretization)
    , constants(discretization.batches().n_batches())
    , at_rest(law->is_linear() ? 0 : constants.size())
    , cell_coefficients(constants.size())
  {
    AssertThrow(whose_dilatation == Dilatation::cells ||
                  (discretization.degree() == 1 &&
                   allows_vertex_dilatation(*law)),
                dealii::ExcMessage(
                  "The dilatation of vertices is for elements of degree 1 with "
                  "linear or corotational laws."));
    if (whose_dilatation == Dilatation::vertices)
      dilatation =
        std::make_unique<VertexDilatation>(discretization, materials);
    set_up_cells();
  }

  Elasticity::~Elasticity() = default;

  void
  Elasticity::set_up_cells()
  {
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      {
        const auto [batch, lane]     = discretization.batches().place(c);
        const CellGeometry &geometry = discretization.geometry(c);
        CellConstants      &cells    = constants[batch];
        cells.volume[lane]           = geometry.volume;
        cells.scale[lane] = std::sqrt(material(c).mu * geometry.volume);
        cell_coefficients[batch].lame_ratio[lane] =
          dilatation ? 0. : material(c).lambda / material(c).mu;
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int a = 0; a < 3; ++a)
            {
              if (!at_rest.empty())
                at_rest[batch].inverse_jacobian[3 * k + a][lane] =
                  geometry.inverse_jacobian[k][a];
              cell_coefficients[batch].gradients[3 * k + a][lane] =
                cells.scale[lane] * geometry.inverse_jacobian[k][a];
            }
      }
  }

  ElasticData
  Elasticity::elastic_data() const
  {
    return {discretization.batches(),
            reference,
            constants.data(),
            cell_coefficients.data(),
            material_law->is_linear() ? nullptr : at_rest.data(),
            sweeps.law};
  }

  ElasticData
  Elasticity::rotating_data()
  {
    ElasticData data      = elastic_data();
    data.new_coefficients = cell_coefficients.data();
    return data;
  }

  Tensor<2, 3>
  Elasticity::rotation(const unsigned int cell) const
  {
    if (material_law->is_linear())
      return Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
    const auto [batch, lane] = discretization.batches().place(cell);
    // The rows are R grad xi_k.
    Tensor<2, 3> rotated;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int a = 0; a < 3; ++a)
        rotated[k][a] = cell_coefficients[batch].gradients[3 * k + a][lane] /
                        constants[batch].scale[lane];
    return transpose(rotated) *
           transpose(invert(discretization.geometry(cell).inverse_jacobian));
  }

  void
  Elasticity::update_rotations(const Vector &u)
  {
    if (material_law->is_linear())
      return;
    const CellBatches &batches = discretization.batches();
    const ElasticSweep rotate  = rotation_sweep(discretization.element());
    ElasticData        data    = rotating_data();
    read_cells(rotate, batches.chunks(), data, u);
    // Counts of other laws belong to rotations at their points, and come with
    // the force.
    if (material_law->has_cell_rotation())
      counts = data.counts;
    read_cells(rotate, batches.chunks_of_ghosts(), data, u);
  }

  void
  Elasticity::read_cells(const ElasticSweep                     sweep,
                         const std::vector<CellBatches::Chunk> &chunks,
                         ElasticData                           &data,
                         const Vector                          &u) const
  {
    cell_loop.read(chunks, u, [&](const auto &chunk, const double *source) {
      sweep(data, chunk.first, chunk.end, source, nullptr);
    });
  }

  template <typename Data>
  void
  Elasticity::cell_sweep(Vector       &f,
                         const Vector &u,
                         void (*sweep)(Data &,
                                       const unsigned int,
                                       const unsigned int,
                                       const double *,
                                       double *),
                         Data        &data,
                         const double scale) const
  {
    cell_loop.run(
      u,
      [&](const auto &chunk, const double *source, double *sums) {
        sweep(data, chunk.first, chunk.end, source, sums);
      },
      [&](const unsigned int i, const auto y) {
        store_to(y * scale, f.begin() + i);
      });
  }

  void
  Elasticity::internal_force(Vector &f, const Vector &u) const
  {
    const Element element = discretization.element();
    ElasticData   data    = elastic_data();
    cell_sweep(f, u, force_sweep(element), data, stiffness_scale(element));
    if (dilatation)
      dilatation->add_force(f, u, data);
  }

  void
  Elasticity::update_rotations_and_force(Vector &f, const Vector &u)
  {
    ElasticData data = rotating_data();
    cell_sweep(f, u, sweeps.force, data, sweeps.force_scale);
    counts = data.counts;
    if (!material_law->is_linear())
      {
        // Where rotations are not unique, they depend on round-off: those of
        // owned and of ghost cells must come from the same function.
        const CellBatches &batches = discretization.batches();
        const ElasticSweep rotate  = rotation_sweep(discretization.element());
        if (!sweeps.force_rotates)
          read_cells(rotate, batches.chunks(), data, u);
        read_cells(rotate, batches.chunks_of_ghosts(), data, u);
      }
    if (dilatation)
      dilatation->add_force(f, u, data);
  }

  void
  Elasticity::explicit_step(Vector       &u,
                            Vector       &v,
                            const Vector &external,
                            const Vector &inverse_mass,
                            const double  dt)
  {
    Assert(!dilatation, dealii::ExcNotImplemented());
    ElasticData data = rotating_data();
    cell_loop.run(
      u,
      [&](const auto &chunk, const double *source, double *sums) {
        sweeps.force(data, chunk.first, chunk.end, source, sums);
      },
      // No cell of this rank needs these nodes again in this sweep.
      [&](const unsigned int i, const auto y) {
        using V = decltype(y + y);
        const V velocity =
          load_as<V>(v.begin() + i) +
          dt * load_as<V>(inverse_mass.begin() + i) *
            (load_as<V>(external.begin() + i) - sweeps.force_scale * y);
        store_to(velocity, v.begin() + i);
        store_to(load_as<V>(u.begin() + i) + dt * velocity, u.begin() + i);
      });
    counts = data.counts;
  }

  void
  Elasticity::apply_tangent(Vector &f, const Vector &v) const
  {
    const Element          element = discretization.element();
    const FormData<double> data{discretization.batches(),
                                cell_coefficients.data(),
                                nullptr,
                                0};
    cell_sweep(f,
               v,
               form_sweep<double>(element, Terms::stiffness),
               data,
               stiffness_scale(element));
    if (dilatation)
      dilatation->add_product(f, v, 1., elastic_data());
  }

  void
  Elasticity::apply_tangent_by_quadrature(Vector &f, const Vector &v) const
  {
    ElasticData data = elastic_data();
    cell_sweep(
      f, v, tangent_by_quadrature_sweep(discretization.element()), data, 1.);
    if (dilatation)
      dilatation->add_product(f, v, 1., data);
  }

  void
  ElasticState::reduce(JointReduction &reduction)
  {
    reduction.sum(energy);
    reduction.min(min_det_F);
    for (unsigned int *count :
         {&inverted_cells, &degenerate_cells, &robust_rotations})
      reduction.sum(*count);
  }

  ElasticState
  Elasticity::local_state(const Vector &u) const
  {
    ElasticData data = elastic_data();
    read_cells(sweeps.state, discretization.batches().chunks(), data, u);
    const PointResults &local = data.results;
    return {local.energy +
              (dilatation ? dilatation->local_energy(u, data) : 0.),
            local.min_det_F,
            local.inverted_cells,
            counts.degenerate,
            counts.robust};
  }

  ElasticState
  Elasticity::state(const Vector &u) const
  {
    ElasticState   result = local_state(u);
    JointReduction reduction;
    result.reduce(reduction);
    reduction.run(discretization.communicator());
    return result;
  }

  CellResults
  Elasticity::cell_results(const Vector &u) const
  {
    const unsigned int n = discretization.n_owned_cells();
    CellResults        result{std::vector<double>(n),
                       std::vector<double>(n),
                       std::vector<double>(n)};
    for (unsigned int c = 0; c < n; ++c)
      {
        const Tensor<2, 3> grad_u = centre_gradient(c, u);
        const Tensor<2, 3> F =
          grad_u + Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
        const Tensor<2, 3> R = rotation(c);
        // With linear elasticity the angle shows the rotation that it neglects.
        result.rotation_angle[c] = rotation_angle(
          material_law->is_linear() ? polar_decomposition(F).rotation : R);
        result.det_F[c] = determinant(F);
        dealii::SymmetricTensor<2, 3> sigma;
        material_law->spatial_stresses(material(c),
                                       grad_u,
                                       {&grad_u, 1},
                                       &sigma);
        result.von_mises[c] = von_mises(sigma);
      }
    return result;
  }

  Tensor<2, 3>
  Elasticity::centre_gradient(const unsigned int cell, const Vector &u) const
  {
    const auto   nodes = discretization.cell_nodes(cell);
    Tensor<2, 3> by_xi;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int k = 0; k < 3; ++k)
          by_xi[a][k] += (u.local_element(3 * nodes[i] + a) -
                          u.local_element(3 * nodes[0] + a)) *
                         reference.centre.gradients(0, i, k);
    return by_xi * discretization.geometry(cell).inverse_jacobian;
  }
} // namespace corotet
