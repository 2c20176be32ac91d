// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_gmsh_process_h
#define corotet_mesh_gmsh_process_h

#include <corotet/mesh/gmsh_model.h>

namespace corotet
{
  /**
   * Runs gmsh on a file, in a process of its own with limited memory (for a
   * mesh ten times its file and 100 MB, for a geometry the machine's) and time,
   * which reads no files outside of the file's folder, writes none and starts
   * no programs. Returns the model. Throws InputError if gmsh fails or is ended
   * by a signal, or if refinements would make too many cells, and MachineError
   * if it cannot be started. Errors blame the file @p origin, or if that is
   * empty the file of the request.
   */
  GmshModel
  run_gmsh(const GmshRequest &request, const std::string &origin = "");

  /**
   * The model that such a process has returned as @p bytes. The file @p path
   * may have damaged it, so any bytes are possible. Throws InputError that
   * blames the file if they are not a model, or one whose parts do not fit
   * together.
   */
  GmshModel
  model_of_bytes(const std::string_view bytes, const std::string &path);
} // namespace corotet

#endif
