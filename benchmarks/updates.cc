// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "case_data.h"
#include "svd_rotation.h"

namespace corotet::benchmarks
{
  namespace
  {
    using Matrix = Eigen::Matrix3d;

    /// F at the centre of every cell.
    std::vector<Matrix>
    deformation_gradients(const Problem &problem, const Vector &u)
    {
      const auto         &discretization = problem.discretization;
      const auto         &gradients      = problem.reference.centre.gradients;
      std::vector<Matrix> F(discretization.n_local_cells());
      for (unsigned int c = 0; c < F.size(); ++c)
        {
          const auto           nodes = discretization.cell_nodes(c);
          dealii::Tensor<2, 3> by_xi;
          for (unsigned int i = 0; i < nodes.size(); ++i)
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int k = 0; k < 3; ++k)
                by_xi[a][k] +=
                  u.local_element(3 * nodes[i] + a) * gradients[0][i][k];
          const auto grad_u =
            by_xi * discretization.geometry(c).inverse_jacobian;
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = 0; b < 3; ++b)
              F[c](a, b) = grad_u[a][b] + (a == b);
        }
      return F;
    }

    Measured
    make_svd_rotations(CaseData &data)
    {
      Problem     &problem = data.problem();
      const Vector u       = problem.bent(bent_beam_angle);
      const auto   F       = std::make_shared<std::vector<Matrix>>(
        deformation_gradients(problem, u));
      const auto R      = std::make_shared<std::vector<Matrix>>(F->size());
      const auto action = [F, R] {
        for (std::size_t c = 0; c < F->size(); ++c)
          (*R)[c] = svd_rotation((*F)[c]);
      };
      action();
      problem.elasticity.update_rotations(u);
      double difference = 0;
      for (std::size_t c = 0; c < F->size(); ++c)
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            difference =
              std::max(difference,
                       std::abs((*R)[c](a, b) -
                                problem.elasticity.rotation(c)[a][b]));
      problem.elasticity.update_rotations(problem.vector());
      return {action,
              {{"cells", static_cast<double>(F->size())},
               {"difference", difference}}};
    }

    Counters
    cells(CaseData &data)
    {
      return {
        {"cells",
         static_cast<double>(data.problem().discretization.n_local_cells())}};
    }

    /// While it lives the rotations and the matrix may be those of the bent
    /// beam; afterwards they are those of the beam at rest.
    struct BentBeam
    {
      explicit BentBeam(CaseData &data)
        : data(data)
        , u(data.problem().bent(bent_beam_angle))
      {
        data.assembled();
      }

      ~BentBeam()
      {
        data.problem().elasticity.update_rotations(data.problem().vector());
        data.assembled().update(1., 0.);
      }

      CaseData    &data;
      const Vector u;
    };
  } // namespace

  void
  add_updates(CaseData &data)
  {
    add_short(data.name("rotations_svd"),
              [&data] { return make_svd_rotations(data); });
    add_short(data.name("rotations"), [&data] {
      const auto beam = std::make_shared<BentBeam>(data);
      return Measured{
        [beam] { beam->data.problem().elasticity.update_rotations(beam->u); },
        cells(data)};
    });
    add_short(data.name("rotations_and_matrix"), [&data] {
      const auto beam = std::make_shared<BentBeam>(data);
      return Measured{[beam] {
                        beam->data.problem().elasticity.update_rotations(
                          beam->u);
                        beam->data.assembled().update(1., 0.);
                      },
                      cells(data)};
    });
  }
} // namespace corotet::benchmarks
