// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// One cycle is symmetric, leads conjugate gradients to the solution in a number
// of iterations that does not grow with the body, whatever its rotation, and
// needs the right rigid body motions for that.

#include <corotet/base/exceptions.h>
#include <corotet/solvers/smoothed_aggregation.h>

#include <gtest/gtest.h>

#include "spring_box.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  /// Iterations of conjugate gradients for K x = b until the residual is 1e-8
  /// |b|; 1000 if it does not get there.
  int
  iterations(const SpringBox &box, const SmoothedAggregation &preconditioner)
  {
    const Epetra_BlockMap &map = box.matrix->RowMap();
    Epetra_Vector          x(map), r(map), z(map), d(map), q(map);
    for (int i = 0; i < r.MyLength(); ++i)
      r[i] = i % 3 == 1;
    double b_norm, norm, rz = 0;
    r.Norm2(&b_norm);
    for (int i = 1; i < 1000; ++i)
      {
        preconditioner.vmult(z.Values(), r.Values());
        const double last = rz;
        double       dq;
        r.Dot(z, &rz);
        d.Update(1., z, i == 1 ? 0. : rz / last);
        box.matrix->Multiply(false, d, q);
        d.Dot(q, &dq);
        x.Update(rz / dq, d, 1.);
        r.Update(-rz / dq, q, 1.);
        r.Norm2(&norm);
        if (norm <= 1e-8 * b_norm)
          return i;
      }
    return 1000;
  }
} // namespace

TEST(SmoothedAggregation, IterationsDoNotGrow)
{
  for (const int n : {4, 8, 14})
    {
      const SpringBox     box({{4 * n, n, n}}, true, MPI_COMM_SELF);
      SmoothedAggregation preconditioner;
      preconditioner.build(*box.matrix, box.positions().data());
      EXPECT_LE(iterations(box, preconditioner), 25) << n;
      EXPECT_LT(8 * preconditioner.n_aggregates(), box.matrix->NumMyRows() / 3)
        << n;
    }
}

// Positions that are all the same have no rotations.
TEST(SmoothedAggregation, NeedsRotations)
{
  const SpringBox     box({{32, 6, 6}}, true, MPI_COMM_SELF);
  SmoothedAggregation preconditioner;
  preconditioner.build(*box.matrix, box.positions().data());
  const int                 right = iterations(box, preconditioner);
  const std::vector<double> nowhere(box.matrix->NumMyRows(), 1.);
  preconditioner.build(*box.matrix, nowhere.data());
  EXPECT_GT(iterations(box, preconditioner), 1.5 * right);
}

// u.Pv = v.Pu up to the round-off of single precision, in both precisions.
TEST(SmoothedAggregation, IsSymmetric)
{
  SpringBox           box({{9, 5, 4}}, true, MPI_COMM_SELF);
  SmoothedAggregation preconditioner(3);
  preconditioner.build(*box.matrix, box.positions().data());
  const int           n = box.matrix->NumMyRows();
  std::vector<double> u(n), v(n), Pu(n), Pv(n);
  std::vector<float>  single_v(n), single_Pv(n);
  for (int i = 0; i < n; ++i)
    {
      u[i]        = std::sin(i + 1.);
      v[i]        = std::cos(0.3 * i);
      single_v[i] = v[i];
    }
  preconditioner.vmult(Pu.data(), u.data());
  preconditioner.vmult(Pv.data(), v.data());
  preconditioner.vmult(single_Pv.data(), single_v.data());
  double uPv = 0, vPu = 0, u_single_Pv = 0, uPu = 0, vPv = 0;
  for (int i = 0; i < n; ++i)
    {
      uPv += u[i] * Pv[i];
      vPu += v[i] * Pu[i];
      u_single_Pv += u[i] * single_Pv[i];
      uPu += u[i] * Pu[i];
      vPv += v[i] * Pv[i];
    }
  EXPECT_GT(uPu, 0.);
  EXPECT_GT(vPv, 0.);
  const double size = std::sqrt(uPu * vPv);
  EXPECT_NEAR(uPv, vPu, 1e-4 * size);
  EXPECT_NEAR(u_single_Pv, uPv, 1e-4 * size);
}

// New values in the same pattern; then no motion is without resistance.
TEST(SmoothedAggregation, FollowsMatrixAndRefusesFreeBody)
{
  SpringBox           box({{8, 4, 4}}, false, MPI_COMM_SELF);
  SmoothedAggregation preconditioner;
  EXPECT_THROW(preconditioner.build(*box.matrix, box.positions().data()),
               ComputationError);
  box.add_mass(1.);
  preconditioner.build(*box.matrix, box.positions().data());
  EXPECT_LE(iterations(box, preconditioner), 20);
  box.add_mass(1e3);
  preconditioner.build(*box.matrix, box.positions().data());
  EXPECT_LE(iterations(box, preconditioner), 8);
}
