// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_refinement_h
#define corotet_mesh_refinement_h

#include <corotet/mesh/mesh_part.h>

namespace corotet
{
  /**
   * Cuts every cell of all ranks into eight, @p n_refinements times, as deal.II
   * does: the octahedron in the middle is cut along its shortest diagonal, or
   * the first one of those that are equally short but for round-off. The
   * children of cell c have the numbers 8 c to 8 c + 7. Children of curved
   * cells are curved like their parents, and new vertices lie on the curves;
   * parts of faces and edges inherit their names. Collective.
   */
  void
  refine_uniformly(MeshPart          &part,
                   const unsigned int n_refinements,
                   const MPI_Comm     comm);
} // namespace corotet

#endif
