// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/discretization/curved_batches.h>
#include <corotet/operators/mass.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

namespace corotet
{
  std::vector<double>
  lumped_shares(const ReferenceElement &reference, const MassType type)
  {
    std::vector<double> shares(reference.n_nodes);
    double              sum = 0;
    for (unsigned int i = 0; i < reference.n_nodes; ++i)
      {
        if (type == MassType::diagonal_scaling)
          shares[i] = reference.mass[i][i];
        else
          // The share is the mean of N_i.
          for (unsigned int j = 0; j < reference.n_nodes; ++j)
            shares[i] += reference.mass[i][j];
        sum += shares[i];
      }
    for (double &share : shares)
      {
        share /= sum;
        // Exact row sums are 1/4; -1/20, 1/5; 1/40, 0, 9/40; with bubbles
        // 17/840 and more: no positive one is close to the limit.
        if (share < 1e-6)
          throw InputError(
            "Discretization/Mass",
            fmt::format("row-sum lumping with degree {} gives some nodes the "
                        "share {:.3g} of a cell's mass, and a mass must be "
                        "positive; found 'row sum', allowed: {}'diagonal "
                        "scaling' or 'consistent' (or degree 1)",
                        reference.degree,
                        std::abs(share) < 1e-6 ? 0. : share,
                        reference.degree == 2 ? "'nodal quadrature', " : ""));
      }
    return shares;
  }

  namespace
  {
    // The shares of a curved cell: the consistent diagonal and row sums by the
    // rule of curved cells, or quadrature at the nodes.
    std::vector<double>
    curved_shares(const Discretization                &discretization,
                  const unsigned int                   cell,
                  const ReferenceElement::PointValues &nodes,
                  const std::vector<double>           &straight,
                  const MassType                       type)
    {
      const CurvedBatches &curved = *discretization.batches().curved();
      const auto          &values = curved.shapes().values;
      const auto [batch, lane]    = discretization.batches().place(cell);
      const auto         *numbers = curved.numbers<double>(batch);
      const unsigned int  n       = straight.size();
      std::vector<double> shares(n);
      double              sum = 0;
      for (unsigned int i = 0; i < n; ++i)
        {
          if (type == MassType::nodal_quadrature)
            shares[i] = straight[i] *
                        determinant(discretization.jacobian(cell, nodes, i));
          else
            for (unsigned int q = 0; q < curved.n_points(); ++q)
              shares[i] +=
                numbers[(CurvedBatches::n_numbers * q + 9) * batch_size +
                        lane] *
                values[q][i] * (type == MassType::row_sum ? 1. : values[q][i]);
          sum += shares[i];
        }
      if (type != MassType::consistent)
        for (double &share : shares)
          share /= sum;
      return shares;
    }
  } // namespace

  Mass::Mass(const Discretization                 &discretization,
             const ReferenceElement               &reference,
             const std::map<unsigned int, double> &densities,
             const MassType                        type)
    : discretization(discretization)
    , type(type)
    , cell_loop(discretization)
    , masses(discretization.batches().n_batches())
  {
    if (is_lumped())
      shares = lumped_shares(reference, type);
    else
      for (unsigned int i = 0; i < reference.n_nodes; ++i)
        shares.push_back(reference.mass[i][i]);

    double owned_mass = 0;
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      {
        const CellGeometry &geometry = discretization.geometry(c);
        const auto [batch, lane]     = discretization.batches().place(c);
        const double cell_mass =
          densities.at(geometry.region) * geometry.volume;
        masses[batch].mass[lane] = cell_mass;
        if (c < discretization.n_owned_cells())
          owned_mass += cell_mass;
      }
    total_mass =
      dealii::Utilities::MPI::sum(owned_mass, discretization.communicator());
    if (is_lumped())
      compute_diagonal();
  }

  void
  Mass::compute_diagonal() const
  {
    const ReferenceElement::PointValues at_nodes = ReferenceElement::tabulate(
      discretization.element(),
      discretization.finite_element().base_element(0).get_unit_support_points(),
      std::vector<double>(shares.size(), 1.));
    discretization.initialize_vector(mass_diagonal);
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        const auto   nodes = discretization.cell_nodes(c);
        const double mass  = cell_mass(c);
        const auto   add   = [&](const std::vector<double> &shares_of_cell) {
          for (unsigned int i = 0; i < nodes.size(); ++i)
            for (unsigned int a = 0; a < 3; ++a)
              mass_diagonal.local_element(3 * nodes[i] + a) +=
                shares_of_cell[i] * mass;
        };
        if (discretization.is_curved(c))
          add(curved_shares(discretization, c, at_nodes, shares, type));
        else
          add(shares);
      }
    mass_diagonal.compress(dealii::VectorOperation::add);
    mass_diagonal.update_ghost_values();
  }

  void
  Mass::apply(Vector &f, const Vector &a) const
  {
    if (is_lumped())
      {
        for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
          f.local_element(i) =
            mass_diagonal.local_element(i) * a.local_element(i);
        return;
      }
    const FormData<double>  data{discretization.batches(),
                                nullptr,
                                masses.data(),
                                mass_scale(discretization.element())};
    const FormSweep<double> sweep =
      form_sweep<double>(discretization.element(), Terms::mass);
    cell_loop.run(
      a,
      [&](const auto &chunk, const double *source, double *sums) {
        sweep(data, chunk.first, chunk.end, source, sums);
      },
      [&](const unsigned int i, const auto y) { store_to(y, f.begin() + i); });
  }
} // namespace corotet
