// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_local_nodes_h
#define corotet_discretization_local_nodes_h

#include <corotet/discretization/element.h>
#include <corotet/mesh/local_mesh.h>

namespace corotet
{
  /**
   * The nodes of an element in the cells of a mesh that a rank has: which nodes
   * cells share, and who owns them. Numbers are valid on this rank only; the
   * nodes at vertices come first, then those on edges, on faces and inside of
   * cells.
   */
  struct LocalNodes
  {
    LocalNodes(const LocalMesh &mesh, const Element element);

    unsigned int
    node(const unsigned int cell, const unsigned int i) const
    {
      return of_cells[std::size_t(cell) * n_per_cell + i];
    }

    unsigned int n_per_cell;
    /// The nodes of each cell, in the order of the element.
    std::vector<unsigned int> of_cells;
    /// The lowest rank with a cell that has the node. Correct for nodes of
    /// owned cells, since all cells around them are known.
    std::vector<dealii::types::subdomain_id> owners;
  };
} // namespace corotet

#endif
