// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_cell_nodes_h
#define corotet_discretization_cell_nodes_h

#include <cstddef>
#include <cstdint>

namespace corotet
{
  /**
   * A node that several chunks of cells have, and where their contributions to
   * it are added up (CellBatches).
   */
  struct PartialSum
  {
    unsigned int node;
    unsigned int slot;
  };

  /**
   * Local numbers of the nodes of a cell, in the order of the element: a list,
   * or numbers in a chunk of cells, as CellBatches have them.
   */
  class CellNodes
  {
  public:
    CellNodes(const unsigned int *list, const unsigned int n)
      : list(list)
      , n(n)
    {}

    /// Node i has the number k = numbers[stride i] in a chunk: it is first_node
    /// + k if k < @p n_final, open[k - n_final] otherwise.
    CellNodes(const std::uint16_t *numbers,
              const unsigned int   stride,
              const unsigned int   n,
              const unsigned int   first_node,
              const unsigned int   n_final,
              const PartialSum    *open)
      : numbers(numbers)
      , stride(stride)
      , first_node(first_node)
      , n_final(n_final)
      , open(open)
      , n(n)
    {}

    unsigned int
    size() const
    {
      return n;
    }

    unsigned int
    operator[](const unsigned int i) const
    {
      if (list != nullptr)
        return list[i];
      const unsigned int k = numbers[static_cast<std::size_t>(i) * stride];
      return k < n_final ? first_node + k : open[k - n_final].node;
    }

    /// Goes through the nodes.
    struct Iterator
    {
      unsigned int
      operator*() const
      {
        return (*nodes)[i];
      }

      Iterator &
      operator++()
      {
        ++i;
        return *this;
      }

      bool
      operator==(const Iterator &other) const
      {
        return i == other.i;
      }

      const CellNodes *nodes;
      unsigned int     i;
    };

    Iterator
    begin() const
    {
      return {this, 0};
    }

    Iterator
    end() const
    {
      return {this, n};
    }

  private:
    const unsigned int  *list       = nullptr;
    const std::uint16_t *numbers    = nullptr;
    unsigned int         stride     = 0;
    unsigned int         first_node = 0;
    unsigned int         n_final    = 0;
    const PartialSum    *open       = nullptr;
    unsigned int         n;
  };
} // namespace corotet

#endif
