// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/studies/program.h>

#include <gtest/gtest.h>

using namespace corotet;

// The program starts MPI, which these tests have started before.
TEST(Program, WhereMpiHasBeenStarted)
{
  char  name[]       = "corotet";
  char *arguments[2] = {name, nullptr};
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_program(1, arguments), 3);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "corotet: error: internal: run_program(argc, argv) starts MPI, "
            "which has been started before; with run_program(MPI_COMM_WORLD, "
            "...) the caller starts it\n");
}
