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
   * The parts of a body whose cells are connected through faces. In a motion
   * without strain each part moves as one rigid body, since two neighbouring
   * cells have the three points of a face in common. Parts may have nodes in
   * common: at a vertex or an edge, about which they turn as on a hinge.
   *
   * All ranks know all parts, with the same numbers, which depend on the number
   * of ranks.
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
    /// One part of each owned node.
    std::vector<unsigned int> part_of_node;
    /// The part of each local cell.
    std::vector<unsigned int> part_of_cell;
    /// The further parts of owned nodes that belong to several.
    std::vector<Joint> joints;
    /// The mean of the nodes' positions of each part [m].
    std::vector<dealii::Point<3>> centres;
    /// The largest distance of a node from the centre of its part [m].
    std::vector<double> radii;
    /// The regions of each part's cells.
    std::vector<std::set<unsigned int>> regions;

    /// The number of the body that each part belongs to, and how many bodies
    /// there are: parts with common nodes are one. Collective.
    std::pair<std::vector<unsigned int>, unsigned int>
    bodies(const MPI_Comm comm) const;

    /// A small number for each part, the same on all ranks, such that parts
    /// with a node in common have different ones. Collective.
    std::vector<unsigned int>
    colours(const MPI_Comm comm) const;

  private:
    /// Numbers the parts; returns the part of each cell of the LocalMesh.
    std::vector<unsigned int>
    number_parts(const Discretization &discretization);
    void
    find_joints(const Discretization            &discretization,
                const std::vector<unsigned int> &part_of_cell);
    void
    measure(const Discretization &discretization);
  };

  /// The union of all ranks' @p pairs, on each rank. Collective.
  std::set<std::pair<unsigned int, unsigned int>>
  of_all_ranks(const std::set<std::pair<unsigned int, unsigned int>> &pairs,
               const MPI_Comm                                         comm);
} // namespace corotet

#endif
