// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/point_geometry.h>
#include <corotet/material/polar_decomposition.h>
#include <corotet/operators/gather.h>
#include <corotet/operators/rotated_frame.h>
#include <corotet/operators/vertex_dilatation.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace corotet
{
  using dealii::Tensor;

  namespace
  {
    constexpr unsigned int n_vertices = 4;

    using CellValues = Simd<double>[n_vertices][3];

    // Computes H = grad u R^T.
    COROTET_ALWAYS_INLINE void
    rotated_gradient(const Simd<double> (&g)[9],
                     const CellValues &u,
                     Tensor2Lanes     &H)
    {
      static_for<9>([&](auto ab) {
        constexpr int a = ab / 3, b = ab % 3;
        H[a][b] = u[1][a] * g[b] + u[2][a] * g[3 + b] + u[3][a] * g[6 + b];
      });
    }
  } // namespace

  VertexDilatation::VertexDilatation(
    const Discretization                            &discretization,
    const std::map<unsigned int, IsotropicMaterial> &of_regions)
    : discretization(discretization)
    , cell_loop(discretization)
  {
    std::map<unsigned int, unsigned int> index;
    for (const auto &[region, material] : of_regions)
      index[region] = index_of(material, materials);
    material_of_cell.reserve(discretization.n_local_cells());
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      material_of_cell.push_back(index.at(discretization.region(c)));
    copies                    = std::make_unique<MaterialNodes>(discretization,
                                             materials.size(),
                                             [this](const unsigned int c) {
                                               return material_of_cell[c];
                                             });
    const NodeNumbers numbers = copies->numbers();
    exchange = GhostExchange(discretization.communicator(), numbers);
    values.resize(numbers.n_local());
    moduli.resize(numbers.n_local());
    sums.resize(4 * std::size_t(discretization.n_local_nodes()));
    const CellBatches &batches = discretization.batches();
    chunk_sums.resize(4 * std::size_t(batches.max_chunk_nodes()));

    copies_of_cells.resize(std::size_t(n_vertices) * batch_size *
                           batches.n_batches());
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      {
        const auto [batch, lane] = batches.place(c);
        const auto own           = copies->cell_nodes(c);
        for (unsigned int i = 0; i < n_vertices; ++i)
          {
            copies_of_cells[(n_vertices * batch + i) * batch_size + lane] =
              own[i];
            moduli[own[i]] += discretization.geometry(c).volume / n_vertices;
          }
      }
    for (unsigned int a = 0; a < copies->n_owned(); ++a)
      moduli[a] =
        materials[copies->material(copies->copy(a).group)].lambda / moduli[a];
    exchange.update(moduli.data());
  }

  template <typename Read, typename AfterChunk>
  void
  VertexDilatation::read_cells(const Vector     &source,
                               const Read       &read,
                               const AfterChunk &after_chunk) const
  {
    const CellBatches &batches = discretization.batches();
    for (const auto *const chunks :
         {&batches.chunks(), &batches.chunks_of_ghosts()})
      cell_loop.read(*chunks,
                     source,
                     [&](const CellBatches::Chunk &chunk,
                         const double             *chunk_values) {
                       for (unsigned int batch = chunk.first; batch < chunk.end;
                            ++batch)
                         read(batch, chunk_values);
                       after_chunk(chunk);
                     });
  }

  template <typename Read>
  void
  VertexDilatation::read_cells(const Vector &source, const Read &read) const
  {
    read_cells(source, read, [](const CellBatches::Chunk &) {});
  }

  template <bool of_displacement>
  void
  VertexDilatation::sum_dilatations(const Vector      &source,
                                    const ElasticData &data)
  {
    Assert(source.has_ghost_elements() ||
             source.get_partitioner()->n_ghost_indices() == 0,
           dealii::ExcMessage("Ghost entries are not up to date."));
    std::fill(values.begin(), values.end(), 0.);
    const unsigned int *copy = copies_of_cells.data();
    read_cells(
      source, [&](const unsigned int batch, const double *chunk_values) {
        CellValues   u;
        Simd<double> g[9];
        Tensor2Lanes H;
        gather_differences<n_vertices>(data.batches, batch, chunk_values, u);
        load_rotated(data, batch, g);
        rotated_gradient(g, u, H);
        Simd<double> dilatation = H[0][0] + H[1][1] + H[2][2];
        if (of_displacement && data.has_rotations())
          {
            Tensor2Lanes R;
            rotations_of(data, batch, R);
            dilatation += R[0][0] + R[1][1] + R[2][2] - 3.;
          }
        // The volume is zero in lanes without a cell.
        dilatation *= lanes(data.constants[batch].volume) * (1. / n_vertices);
        for (unsigned int i = 0; i < n_vertices; ++i, copy += batch_size)
          for (unsigned int lane = 0; lane < batch_size; ++lane)
            values[copy[lane]] += dilatation[lane];
      });
  }

  void
  VertexDilatation::make_pressures()
  {
    for (unsigned int a = 0; a < copies->n_owned(); ++a)
      values[a] *= moduli[a];
    exchange.update(values.data());
  }

  Simd<double>
  VertexDilatation::mean_pressure(const unsigned int batch) const
  {
    const unsigned int *copy =
      &copies_of_cells[std::size_t(n_vertices) * batch_size * batch];
    Simd<double> sum{};
    for (unsigned int i = 0; i < n_vertices; ++i, copy += batch_size)
      for (unsigned int lane = 0; lane < batch_size; ++lane)
        sum[lane] += values[copy[lane]];
    return sum * (1. / n_vertices);
  }

  void
  VertexDilatation::add_rotation_part(const ElasticData &data,
                                      const unsigned int batch,
                                      const double      *source,
                                      double            *target) const
  {
    CellValues   v, f;
    Simd<double> g[9], T[6], a[3], w[3];
    Tensor2Lanes H;
    gather_differences<n_vertices>(data.batches, batch, source, v);
    load_rotated(data, batch, g);
    rotated_gradient(g, v, H);
    axial_vector(H, a);
    const double *const stored =
      &linearization[std::size_t(6) * batch_size * batch];
    static_for<6>([&](auto s) { T[s] = lanes(stored + s * batch_size); });
    symmetric_times(T, a, w);
    static_for<3>([&](auto k) {
      const Simd<double> *const gradient = g + 3 * k;
      static_for<3>([&](auto a) {
        constexpr int b = (a + 1) % 3, c = (a + 2) % 3;
        f[k + 1][a] = w[b] * gradient[c] - w[c] * gradient[b];
      });
    });
    static_for<3>([&](auto a) { f[0][a] = -(f[1][a] + f[2][a] + f[3][a]); });
    scatter_add<n_vertices>(data.batches, batch, f, target);
  }

  template <bool with_rotation_part>
  void
  VertexDilatation::add_stress(Vector            &f,
                               const Vector      &source,
                               const double       factor,
                               const ElasticData &data)
  {
    const auto add = [&](const unsigned int batch, const double *chunk_values) {
      CellValues   in_cell;
      Simd<double> g[9];
      load_rotated(data, batch, g);
      const Simd<double> pressure =
        factor * lanes(data.constants[batch].volume) * mean_pressure(batch);
      static_for<3>([&](auto a) {
        in_cell[0][a] = Simd<double>{};
        static_for<3>([&](auto k) {
          in_cell[k + 1][a] = pressure * g[3 * k + a];
          in_cell[0][a] -= in_cell[k + 1][a];
        });
      });
      scatter_add<n_vertices>(data.batches, batch, in_cell, chunk_sums.data());
      if constexpr (with_rotation_part)
        add_rotation_part(data, batch, chunk_values, chunk_sums.data());
    };
    read_cells(source, add, [&](const CellBatches::Chunk &chunk) {
      double *sum = chunk_sums.data();
      for (unsigned int n = chunk.first_node; n < chunk.n_final; ++n, sum += 4)
        move_sum(sum, &sums[4 * std::size_t(n)]);
      for (const PartialSum &open : data.batches.open_nodes(chunk))
        {
          move_sum(sum, &sums[4 * std::size_t(open.node)]);
          sum += 4;
        }
    });
    take_sums(sums.data(),
              0,
              discretization.n_owned_nodes(),
              [&](const unsigned int i, const auto y) {
                using V = decltype(y + y);
                store_to(load_as<V>(f.begin() + i) + y, f.begin() + i);
              });
    std::fill(sums.begin() + std::size_t(4) * discretization.n_owned_nodes(),
              sums.end(),
              0.);
  }

  void
  VertexDilatation::add_force(Vector            &f,
                              const Vector      &u,
                              const ElasticData &data)
  {
    sum_dilatations<true>(u, data);
    make_pressures();
    add_stress<false>(f, u, 1., data);
  }

  double
  VertexDilatation::local_energy(const Vector &u, const ElasticData &data)
  {
    sum_dilatations<true>(u, data);
    double energy = 0;
    for (unsigned int a = 0; a < copies->n_owned(); ++a)
      energy += moduli[a] / 2 * values[a] * values[a];
    return energy;
  }

  void
  VertexDilatation::add_product(Vector            &f,
                                const Vector      &v,
                                const double       factor,
                                const ElasticData &data)
  {
    sum_dilatations<false>(v, data);
    make_pressures();
    add_stress<false>(f, v, factor, data);
  }

  void
  VertexDilatation::linearize(const Vector &u, const ElasticData &data)
  {
    sum_dilatations<true>(u, data);
    make_pressures();
    linearization.resize_fast(std::size_t(6) * batch_size *
                              data.batches.n_batches());
    double *stored = linearization.data();
    read_cells(u, [&](const unsigned int batch, const double *chunk_values) {
      CellValues   in_cell;
      Simd<double> g[9], S[6], T[6];
      Tensor2Lanes R, B;
      gather_differences<n_vertices>(data.batches,
                                     batch,
                                     chunk_values,
                                     in_cell);
      load_rotated(data, batch, g);
      rotations_of(data, batch, R);
      rotated_gradient(g, in_cell, B);
      add_transposed(R, B);
      symmetric_part(B, S);
      inverse_spin_tensor(S, T);
      const Simd<double> volume = lanes(data.constants[batch].volume);
      const Simd<double> factor = volume * mean_pressure(batch);
      static_for<6>([&](auto s) {
        // Lanes without a cell have no rotation, so their value is set to zero.
        const Simd<double> value = volume > 0. ? T[s] * factor : broadcast(0.);
        store_aligned(value, stored + s * batch_size);
      });
      stored += std::size_t(6) * batch_size;
    });
  }

  void
  VertexDilatation::add_tangent(Vector            &f,
                                const Vector      &v,
                                const double       factor,
                                const ElasticData &data)
  {
    sum_dilatations<false>(v, data);
    make_pressures();
    add_stress<true>(f, v, factor, data);
  }

  std::vector<double>
  VertexDilatation::pressure_corrections(const Vector &u,
                                         const bool    has_rotations) const
  {
    const auto &centre = ReferenceElement::of(discretization.element()).centre;
    const unsigned int  n_cells = discretization.n_local_cells();
    std::vector<double> result(n_cells), pressures(values.size());
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const Tensor<2, 3> H =
          displacement_gradient(discretization, u, c, centre, 0);
        double dilatation = trace(H);
        if (has_rotations)
          {
            const Tensor<2, 3> R =
              polar_decomposition(
                H + Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()))
                .rotation;
            dilatation = scalar_product(R, H) + trace(R) - 3;
          }
        result[c] = -materials[material_of_cell[c]].lambda * dilatation;
        for (const unsigned int copy : copies->cell_nodes(c))
          pressures[copy] +=
            discretization.geometry(c).volume / n_vertices * dilatation;
      }
    for (unsigned int a = 0; a < copies->n_owned(); ++a)
      pressures[a] *= moduli[a];
    exchange.update(pressures.data());
    for (unsigned int c = 0; c < n_cells; ++c)
      for (const unsigned int copy : copies->cell_nodes(c))
        result[c] += pressures[copy] / n_vertices;
    return result;
  }
} // namespace corotet
