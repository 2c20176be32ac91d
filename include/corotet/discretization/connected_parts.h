// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_connected_parts_h
#define corotet_discretization_connected_parts_h

#include <corotet/discretization/discretization.h>

#include <set>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The parts of a body whose cells are connected through faces: what moves
   * without strain moves as one rigid body in each of them, as two cells have
   * three points of a face in common. Parts may have nodes in common: at a
   * vertex or an edge, about which they turn as on a hinge.
   *
   * All ranks know all parts, and number them alike; not so other numbers of
   * ranks.
   */
  struct ConnectedParts
  {
    /// An owned node that two parts have in common.
    struct Joint
    {
      unsigned int node;
      unsigned int part;
      unsigned int other;
    };

    /// Collective.
    explicit ConnectedParts(const Discretization &discretization);

    unsigned int n_parts = 0;
    /// Of each owned node one of its parts.
    std::vector<unsigned int> part_of_node;
    /// Of each owned cell.
    std::vector<unsigned int> part_of_cell;
    /// For each further part of an owned node.
    std::vector<Joint> joints;
    /// Mean of the nodes' positions of each part [m].
    std::vector<dealii::Point<3>> centres;
    /// Largest distance of a node from there [m].
    std::vector<double> radii;
    /// Regions of each part's cells.
    std::vector<std::set<unsigned int>> regions;

  private:
    /// Numbers the parts; the part of each cell of the LocalMesh.
    std::vector<unsigned int>
    number_parts(const Discretization &discretization);
    void
    find_joints(const Discretization            &discretization,
                const std::vector<unsigned int> &part_of_cell);
    void
    measure(const Discretization &discretization);
  };

  /// Those of all ranks, the same on each. Collective.
  std::set<std::pair<unsigned int, unsigned int>>
  of_all_ranks(const std::set<std::pair<unsigned int, unsigned int>> &pairs,
               const MPI_Comm                                         comm);
} // namespace corotet

#endif
