// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_coarser_nodes_h
#define corotet_discretization_coarser_nodes_h

#include <corotet/discretization/nodes.h>

#include <array>
#include <vector>

namespace corotet
{
  /**
   * The nodes of the next coarser element on the same cells (degree p - 1, or
   * no bubbles), and the natural embedding P of the coarser functions in the
   * finer ones.
   *
   * Each coarser node has a key, a finer node on the same vertex or edge: the
   * coarser node has the same owner and the same place in the order.
   *
   * @p finer must outlive this object.
   */
  class CoarserNodes : public Nodes
  {
  public:
    /// A finer node and the coarser nodes that its value is interpolated from.
    template <int n>
    struct Parents
    {
      unsigned int                fine;
      std::array<unsigned int, n> coarse;
    };

    /// Collective.
    explicit CoarserNodes(const Nodes &finer);

    /// The local number of the finer node that is the key of a local node. At
    /// vertices, and everywhere if the finer element has bubbles, it is the
    /// node at the same place.
    unsigned int
    key(const unsigned int local_node) const
    {
      return keys[local_node];
    }

    /// The marks of this object's local unknowns, copied from the finer nodes
    /// at the same places. Not collective.
    std::vector<unsigned char>
    marks(const std::vector<unsigned char> &finer_marks) const;

    /// fine += P coarse. Ghost entries of @p coarse must be up to date. Not
    /// collective.
    template <typename Number>
    void
    prolongate_add(
      dealii::LinearAlgebra::distributed::Vector<Number>       &fine,
      const dealii::LinearAlgebra::distributed::Vector<Number> &coarse) const;

    /// coarse = P^T fine. Collective.
    template <typename Number>
    void
    restrict_to(
      dealii::LinearAlgebra::distributed::Vector<Number>       &coarse,
      const dealii::LinearAlgebra::distributed::Vector<Number> &fine) const;

    /// The owned finer nodes of degree 2 in the middle of edges, and the
    /// vertices at their ends. For degree 1 only.
    const std::vector<Parents<2>> &
    middles() const
    {
      return on_middles;
    }

  private:
    void
    number_nodes();
    void
    find_parents();
    /// Calls function(fine node, coarse nodes, their weights) for all owned
    /// finer nodes.
    template <typename Number, typename Function>
    void
    for_each_fine_node(const Function &function) const;

    const Nodes              &finer;
    std::vector<unsigned int> keys;

    /// Owned finer nodes by their places: at a coarser node, on edges of cubic
    /// cells (near and far vertex, middle), in the middle of edges, on faces
    /// (vertices, middles of edges), in cells (the same).
    std::vector<Parents<1>>  on_nodes;
    std::vector<Parents<3>>  on_thirds;
    std::vector<Parents<2>>  on_middles;
    std::vector<Parents<6>>  on_faces;
    std::vector<Parents<10>> in_cells;
  };
} // namespace corotet

#endif
