// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// One cycle is symmetric, leads conjugate gradients to the solution in a number
// of iterations that hardly grows with the body or with the number of ranks,
// and needs the right rigid body motions for that.

#include <corotet/base/exceptions.h>
#include <corotet/solvers/smoothed_aggregation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

// Aggregates end where a rank does; if they lost their rigid motions there,
// more iterations would be added.
TEST(SmoothedAggregation, IterationsHardlyGrow)
{
  for (const int n : {4, 8, 14})
    {
      const auto iterations_of = [&](const MPI_Comm comm) {
        const SpringBox     box({{4 * n, n, n}}, true, comm);
        SmoothedAggregation preconditioner;
        preconditioner.build(*box.matrix, box.positions().data());
        EXPECT_LT(8 * preconditioner.n_aggregates(),
                  box.matrix->NumGlobalRows() / 3)
          << n;
        return iterations(box, preconditioner);
      };
      const int alone = iterations_of(MPI_COMM_SELF);
      EXPECT_LE(alone, 25) << n;
      const int n_interfaces = Epetra_MpiComm(MPI_COMM_WORLD).NumProc() - 1;
      EXPECT_LE(iterations_of(MPI_COMM_WORLD), alone + 2 * n_interfaces) << n;
    }
}

// The first of several ranks owns none of three nodes in a row.
TEST(SmoothedAggregation, AllowsRankWithoutNodes)
{
  SpringBox box({{2, 0, 0}}, false);
  box.add_mass(1.);
  const Epetra_Comm &comm = box.matrix->Comm();
  if (comm.NumProc() > 1 && comm.MyPID() == 0)
    {
      EXPECT_EQ(box.matrix->NumMyRows(), 0);
    }
  SmoothedAggregation preconditioner;
  preconditioner.build(*box.matrix, box.positions().data());
  EXPECT_LE(iterations(box, preconditioner), 9);
}

// Positions that are all the same have no rotations.
TEST(SmoothedAggregation, NeedsRotations)
{
  const SpringBox     box({{32, 6, 6}}, true);
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
  SpringBox           box({{9, 5, 4}}, true);
  SmoothedAggregation preconditioner(3);
  preconditioner.build(*box.matrix, box.positions().data());
  const Epetra_Map  &map = box.matrix->RowMap();
  const int          n   = map.NumMyElements();
  Epetra_Vector      u(map), v(map), Pu(map), Pv(map), widened(map);
  std::vector<float> single_v(n), single_Pv(n);
  for (int i = 0; i < n; ++i)
    {
      u[i]        = std::sin(map.GID(i) + 1.);
      v[i]        = std::cos(0.3 * map.GID(i));
      single_v[i] = v[i];
    }
  preconditioner.vmult(Pu.Values(), u.Values());
  preconditioner.vmult(Pv.Values(), v.Values());
  preconditioner.vmult(single_Pv.data(), single_v.data());
  std::copy(single_Pv.begin(), single_Pv.end(), widened.Values());
  double uPv, vPu, u_single_Pv, uPu, vPv;
  u.Dot(Pv, &uPv);
  v.Dot(Pu, &vPu);
  u.Dot(widened, &u_single_Pv);
  u.Dot(Pu, &uPu);
  v.Dot(Pv, &vPv);
  EXPECT_GT(uPu, 0.);
  EXPECT_GT(vPv, 0.);
  const double size = std::sqrt(uPu * vPv);
  EXPECT_NEAR(uPv, vPu, 1e-4 * size);
  EXPECT_NEAR(u_single_Pv, uPv, 1e-4 * size);
}

// New values in the same pattern; then no motion is without resistance.
TEST(SmoothedAggregation, FollowsMatrixAndRefusesFreeBody)
{
  SpringBox           box({{8, 4, 4}}, false);
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
