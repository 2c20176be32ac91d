// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/ghosted_copy.h>
#include <corotet/operators/elasticity.h>
#include <corotet/operators/gather.h>
#include <corotet/operators/vertex_dilatation.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace corotet
{
  unsigned int
  Elasticity::linearize(const Vector &u, const Tangent tangent)
  {
    if (is_by_cell(tangent))
      return 0;
    const TangentSweeps &work = sweeps.tangent(tangent);
    linearized_tangent        = tangent;
    linearization.resize_fast(
      work.size.of_batches(reference, discretization.batches()));
    if (work.needs_displacement)
      {
        const std::size_t n = std::size_t(3) * discretization.n_local_nodes();
        linearized_displacement.resize_fast(n);
        std::copy_n(u.begin(), n, linearized_displacement.begin());
        chunk_displacement.resize_fast(
          std::size_t(4) * discretization.batches().max_chunk_nodes());
      }
    ElasticData data       = elastic_data();
    data.new_linearization = linearization.data();
    read_cells(work.linearize, discretization.batches().chunks(), data, u);
    if (dilatation && tangent == Tangent::consistent)
      dilatation->linearize(u, data);
    return dealii::Utilities::MPI::sum(data.n_clamped,
                                       discretization.communicator());
  }

  void
  Elasticity::apply_linearization(Vector                   &f,
                                  const Vector             &v,
                                  const double              frozen_factor,
                                  const double              c_M,
                                  const CellMasses<double> *masses,
                                  const Vector             *lumped_mass) const
  {
    Assert(!linearization.empty(), dealii::ExcNotInitialized());
    ElasticData data   = elastic_data();
    data.linearization = linearization.data();
    data.frozen_factor = frozen_factor;
    data.masses        = masses;
    data.mass_factor   = c_M;
    const auto &[size, linearize, sweep, needs_displacement] =
      sweeps.tangent(linearized_tangent);
    std::optional<GhostsInUse> ghosts;
    if (dilatation)
      ghosts.emplace(v);
    cell_loop.run(
      v,
      [&](const auto &chunk, const double *source, double *sums) {
        if (needs_displacement)
          {
            load_chunk(discretization.batches(),
                       chunk,
                       linearized_displacement.data(),
                       chunk_displacement.data());
            data.linearized_displacement = chunk_displacement.data();
          }
        sweep(data, chunk.first, chunk.end, source, sums);
      },
      [&](const unsigned int i, const auto y) {
        using V  = decltype(y + y);
        V result = y;
        if (lumped_mass != nullptr)
          result += c_M * load_as<V>(lumped_mass->begin() + i) *
                    load_as<V>(v.begin() + i);
        store_to(result, f.begin() + i);
      });
    if (dilatation && linearized_tangent == Tangent::consistent)
      dilatation->add_tangent(f, v, frozen_factor, data);
    else if (dilatation)
      dilatation->add_product(f, v, frozen_factor, data);
  }

  void
  Elasticity::cell_matrices(const Vector             &u,
                            const double              frozen_factor,
                            const double              c_M,
                            const CellMasses<double> *masses,
                            const TakeCellMatrices   &take)
  {
    Assert(!linearization.empty(), dealii::ExcNotInitialized());
    const CellBatches   &batches = discretization.batches();
    const TangentSweeps &work    = sweeps.tangent(linearized_tangent);
    ElasticData          ghosts  = elastic_data();
    ghosts.new_linearization     = linearization.data();
    read_cells(work.linearize, batches.chunks_of_ghosts(), ghosts, u);

    // Unit vectors are set in all cells of a batch at once, as if these had no
    // common nodes.
    const CellBatches apart = batches.apart();
    const auto        own   = elastic_data();
    ElasticData       data{apart,
                     own.reference,
                     own.constants,
                     own.coefficients,
                     own.at_rest,
                     own.law};
    data.linearization                 = linearization.data();
    data.frozen_factor                 = frozen_factor;
    data.masses                        = masses;
    data.mass_factor                   = c_M;
    const unsigned int            n    = discretization.n_nodes_per_cell();
    const std::size_t             size = std::size_t(4) * batch_size * n;
    dealii::AlignedVector<double> source(size);
    dealii::AlignedVector<double> displacement(source.size());
    data.linearized_displacement = displacement.data();
    dealii::AlignedVector<double> columns(std::size_t(3) * n * size);
    for (unsigned int batch = 0; batch < batches.n_batches(); ++batch)
      {
        columns.fill(0.);
        const auto [first, n_cells] = batches.cells(batch);
        for (unsigned int lane = 0; lane < n_cells; ++lane)
          {
            const CellNodes nodes = discretization.cell_nodes(first + lane);
            for (unsigned int i = 0; i < n; ++i)
              std::copy_n(u.begin() + std::size_t(3) * nodes[i],
                          3,
                          &displacement[std::size_t(4) * (lane * n + i)]);
          }
        for (unsigned int column = 0; column < 3 * n; ++column)
          {
            for (unsigned int lane = 0; lane < batch_size; ++lane)
              source[(lane * n + column / 3) * 4 + column % 3] = 1;
            work.apply(
              data, batch, batch + 1, source.data(), &columns[column * size]);
            if (dilatation && linearized_tangent == Tangent::consistent)
              dilatation->add_rotation_part(data,
                                            batch,
                                            source.data(),
                                            &columns[column * size]);
            for (unsigned int lane = 0; lane < batch_size; ++lane)
              source[(lane * n + column / 3) * 4 + column % 3] = 0;
          }
        take(batch, columns.data());
      }
  }
} // namespace corotet
