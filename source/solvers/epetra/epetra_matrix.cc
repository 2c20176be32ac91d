// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/epetra/epetra_matrix.h>

#include <deal.II/base/exceptions.h>

#include <Epetra_CrsGraph.h>
#include <Epetra_Vector.h>

#include <numeric>
#include <vector>

namespace corotet
{
  namespace
  {
    void
    check(const int status)
    {
      AssertThrow(status >= 0,
                  dealii::ExcMessage("Epetra failed with status " +
                                     std::to_string(status) + "."));
    }

    /// Local numbers of the columns of node @p node.
    void
    unknowns_of(std::vector<int> &columns, const NodeGraph &graph, int node)
    {
      columns.clear();
      for (int k = graph.starts[node]; k < graph.starts[node + 1]; ++k)
        for (int a = 0; a < 3; ++a)
          columns.push_back(3 * graph.columns[k] + a);
    }

    /// The graph's columns are numbered as those of the pattern, and so have
    /// the same order.
    Epetra_CrsGraph
    graph_of(const BlockPattern &pattern, const Epetra_Map &owned)
    {
      const NodeGraph &blocks = pattern.graph();
      std::vector<int> unknowns, columns, lengths;
      for (int node = 0; node < pattern.exchange().n_items(); ++node)
        for (int a = 0; a < 3; ++a)
          unknowns.push_back(3 * pattern.nodes().global_node(node) + a);
      for (int node = 0; node < pattern.n_owned(); ++node)
        lengths.insert(lengths.end(),
                       3,
                       3 * (blocks.starts[node + 1] - blocks.starts[node]));
      const Epetra_Map all(
        -1, unknowns.size(), unknowns.data(), 0, owned.Comm());
      Epetra_CrsGraph graph(Copy, owned, all, lengths.data(), true);
      for (int node = 0; node < pattern.n_owned(); ++node)
        {
          unknowns_of(columns, blocks, node);
          for (int a = 0; a < 3; ++a)
            check(graph.InsertMyIndices(3 * node + a,
                                        columns.size(),
                                        columns.data()));
        }
      check(graph.FillComplete(owned, owned));
      check(graph.OptimizeStorage());
      return graph;
    }
  } // namespace

  EpetraMatrix::EpetraMatrix(const BlockMatrix &A)
    : pattern(A.pattern())
    , values(A.values_begin())
    , comm(pattern->communicator())
    , owned(3 * pattern->nodes().n_global(), 3 * pattern->n_owned(), 0, comm)
    , matrix(
        std::make_unique<Epetra_CrsMatrix>(View, graph_of(*pattern, owned)))
  {
    std::vector<int> columns;
    for (int node = 0; node < pattern->n_owned(); ++node)
      {
        unknowns_of(columns, pattern->graph(), node);
        // Epetra requires pointers to values that it may change, but nothing
        // here changes them.
        for (int a = 0; a < 3; ++a)
          check(matrix->InsertMyValues(3 * node + a,
                                       columns.size(),
                                       const_cast<double *>(A.row(node, a)),
                                       columns.data()));
      }
    check(matrix->FillComplete(owned, owned));
    check(matrix->OptimizeStorage());
  }

  void
  EpetraMatrix::vmult(Vector &dst, const Vector &src) const
  {
    Epetra_Vector       y(View, owned, dst.begin());
    const Epetra_Vector x(View, owned, const_cast<double *>(src.begin()));
    check(matrix->Multiply(false, x, y));
  }
} // namespace corotet
