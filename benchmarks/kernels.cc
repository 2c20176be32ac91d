// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// What is done per cell, on data that stay in the first-level cache.

#include <corotet/material/polar_decomposition.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <memory>
#include <vector>

#include "measure.h"
#include "svd_rotation.h"

namespace corotet::benchmarks
{
  namespace
  {
    constexpr unsigned int n_cells = 256;

    using Gradients = std::vector<dealii::Tensor<2, 3>>;

    /// Rotations by any angle times stretches of some ten percent.
    Gradients
    deformation_gradients()
    {
      Gradients result(n_cells);
      for (unsigned int n = 0; n < n_cells; ++n)
        {
          const double         angle = 0.1 * n;
          dealii::Tensor<2, 3> R, S;
          R[0][0] = R[1][1] = std::cos(angle);
          R[1][0]           = std::sin(angle);
          R[0][1]           = -R[1][0];
          R[2][2]           = 1;
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = a; b < 3; ++b)
              S[a][b] = S[b][a] = (a == b) + 0.1 * std::sin(n + 3. * a + b);
          result[n] = R * S;
        }
      return result;
    }

    void
    add_polar_decomposition()
    {
      add_short("kernels/polar_decomposition", [] {
        const auto F = std::make_shared<Gradients>(deformation_gradients());
        const auto R = std::make_shared<Gradients>(n_cells);
        return Measured{[F, R] {
                          for (unsigned int n = 0; n < n_cells; ++n)
                            (*R)[n] = polar_decomposition((*F)[n]).rotation;
                          benchmark::ClobberMemory();
                        },
                        {{"cells", n_cells}}};
      });
    }

    void
    add_jacobi_svd()
    {
      using Matrix = Eigen::Matrix3d;
      add_short("kernels/jacobi_svd", [] {
        const auto F = std::make_shared<std::vector<Matrix>>();
        const auto R = std::make_shared<std::vector<Matrix>>(n_cells);
        for (const auto &f : deformation_gradients())
          F->push_back(Matrix{{f[0][0], f[0][1], f[0][2]},
                              {f[1][0], f[1][1], f[1][2]},
                              {f[2][0], f[2][1], f[2][2]}});
        return Measured{[F, R] {
                          for (unsigned int n = 0; n < n_cells; ++n)
                            (*R)[n] = svd_rotation((*F)[n]);
                          benchmark::ClobberMemory();
                        },
                        {{"cells", n_cells}}};
      });
    }
  } // namespace
} // namespace corotet::benchmarks

int
main(int argc, char **argv)
{
  using namespace corotet::benchmarks;
  const Session session(argv);
  add_polar_decomposition();
  add_jacobi_svd();
  return run(argc, argv);
}
