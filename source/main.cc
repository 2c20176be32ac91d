// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/studies/program.h>

int
main(int argc, char **argv)
{
  return corotet::run_program(argc, argv);
}
