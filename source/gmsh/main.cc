// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// corotet-gmsh: lets gmsh read or mesh one file, in a process that cannot do
// harm, and writes a GmshModel to the standard output. The library starts it
// and waits for it (mesh/gmsh_process.cc).

#include <fcntl.h>
#include <gmsh.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <string_view>

#include "model.h"
#include "sandbox.h"

namespace
{
  // Writes all bytes, or ends the process.
  void
  write_all(const int file, std::string_view bytes)
  {
    while (!bytes.empty())
      {
        const ssize_t n = write(file, bytes.data(), bytes.size());
        if (n <= 0)
          std::_Exit(3);
        bytes.remove_prefix(n);
      }
  }
} // namespace

int
main(const int argc, char **argv)
{
  using namespace corotet;
  if (argc != 11)
    {
      std::fputs("corotet-gmsh is started by corotet, which reads meshes "
                 "through it.\n",
                 stderr);
      return 1;
    }
  GmshRequest request;
  request.path                   = argv[1];
  request.element_size           = std::atof(argv[2]);
  request.degree                 = std::atoi(argv[3]);
  request.n_refinements          = std::atoi(argv[4]);
  request.max_n_cells            = std::atof(argv[5]);
  const std::string   folder     = argv[6];
  const std::uint64_t max_memory = std::strtoull(argv[7], nullptr, 10);
  request.format                 = argv[8];
  request.is_geometry            = argv[9][0] == '1';
  request.feature_angle          = std::atof(argv[10]);

  // The output of gmsh itself goes to /dev/null, so that it cannot get into the
  // result.
  const int result = dup(STDOUT_FILENO);
  const int null   = open("/dev/null", O_WRONLY);
  dup2(null, STDOUT_FILENO);

  GmshModel model;
  try
    {
      // gmsh must neither read the user's configuration nor handle Ctrl-C.
      gmsh::initialize(0, nullptr, false, false);
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh_program::confine({request.path, folder, "/usr/share/opencascade"},
                            max_memory);
      model = gmsh_program::make_model(request);
    }
  catch (const std::bad_alloc &)
    {
      model.error = "it needs more memory than it may have";
    }
  catch (const std::exception &error)
    {
      model.error = error.what();
    }
  if (!model.error.empty())
    {
      const std::string error = model.error;
      model                   = {};
      model.error             = error;
    }
  BytesWriter writer(
    [&](const std::string_view bytes) { write_all(result, bytes); });
  transfer(writer, model);
  // Skips destructors, which could fail on a broken model; nothing is left to
  // save.
  std::_Exit(0);
}
