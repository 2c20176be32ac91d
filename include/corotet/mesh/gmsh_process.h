// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_gmsh_process_h
#define corotet_mesh_gmsh_process_h

#include <corotet/mesh/gmsh_model.h>

namespace corotet
{
  /**
   * What gmsh makes of a file, in a process of its own that has limits on its
   * memory (of a mesh: ten times its file and 100 MB; of a geometry: that of
   * the machine) and on its time, reads no files outside of the file's folder,
   * writes none and starts no programs. Throws InputError if it fails there or
   * ends by a signal, or if refinements would make too many cells, and
   * MachineError if it cannot be started. Errors blame the
   * file @p origin, which is that of the request if it is empty.
   */
  GmshModel
  run_gmsh(const GmshRequest &request, const std::string &origin = "");

  /**
   * The model that such a process has handed back as @p bytes, which may be
   * anything: the file @p path may have damaged it. Throws InputError that
   * blames the file if they are no model, or one whose parts do not fit
   * together.
   */
  GmshModel
  model_of_bytes(const std::string_view bytes, const std::string &path);
} // namespace corotet

#endif
