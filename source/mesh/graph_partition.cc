// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/exchange.h>
#include <corotet/base/mpi.h>
#include <corotet/mesh/cell_order.h>
#include <corotet/mesh/graph_partition.h>
#include <corotet/mesh/mesh_part.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#ifdef COROTET_WITH_PT_SCOTCH
#  include <cstdio>
// The header uses FILE without declaring it.
#  include <ptscotch.h>
#endif

namespace corotet
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

#ifdef COROTET_WITH_PT_SCOTCH
    // The largest excess of a rank's work over the mean [-].
    constexpr double inequality = 0.01;



    // Throws if a function of PT-Scotch on this rank failed: success is zero.
    void
    require(const int status, const char *function)
    {
      if (status != 0)
        throw ComputationError(
          fmt::format("PT-Scotch could not share out the cells: {} failed",
                      function));
    }



    // An object of PT-Scotch that is released at the end of the scope.
    template <typename Type, void (*exit)(Type *)>
    class Scoped
    {
    public:
      // @p init initialises the object, or throws.
      template <typename Init>
      explicit Scoped(const Init &init)
      {
        init(&object);
      }

      Scoped(const Scoped &) = delete;
      Scoped &
      operator=(const Scoped &) = delete;

      ~Scoped()
      {
        exit(&object);
      }

      Type *
      get()
      {
        return &object;
      }

    private:
      Type object{};
    };

    using Context  = Scoped<SCOTCH_Context, SCOTCH_contextExit>;
    using Graph    = Scoped<SCOTCH_Dgraph, SCOTCH_dgraphExit>;
    using Strategy = Scoped<SCOTCH_Strat, SCOTCH_stratExit>;



    // The new rank of each owned cell, in the order of the cells.
    std::vector<SCOTCH_Num>
    ranks_of_cells(const LocalMesh &mesh)
    {
      const double many = std::numeric_limits<SCOTCH_Num>::max();
      if (4. * mesh.n_global_cells > many)
        throw InputError("Mesh/Partitioner",
                         fmt::format("found 'PT-Scotch' for {} cells; this "
                                     "PT-Scotch counts no more than {:.0f}",
                                     mesh.n_global_cells,
                                     many / 4));
      std::vector<SCOTCH_Num> first_edges{0}, works, edges;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        {
          if (!mesh.is_owned(c))
            continue;
          works.push_back(work_of(mesh.cells[c]));
          for (const unsigned int neighbor : mesh.neighbors[c])
            if (neighbor != LocalMesh::no_cell)
              edges.push_back(mesh.numbers[neighbor]);
          first_edges.push_back(edges.size());
        }

      const SCOTCH_Num        n_ranks = MPI::n_mpi_processes(mesh.communicator);
      std::optional<Context>  context;
      std::optional<Strategy> strategy;
      on_all_ranks(mesh.communicator, [&] {
        context.emplace([](SCOTCH_Context *object) {
          require(SCOTCH_contextInit(object), "SCOTCH_contextInit");
        });
        // One thread, and the same random numbers at each call.
        require(SCOTCH_contextThreadSpawn(context->get(), 1, nullptr),
                "SCOTCH_contextThreadSpawn");
        require(SCOTCH_contextRandomClone(context->get()),
                "SCOTCH_contextRandomClone");
        SCOTCH_contextRandomReset(context->get());
        require(SCOTCH_contextOptionSetNum(context->get(),
                                           SCOTCH_OPTIONNUMDETERMINISTIC,
                                           1),
                "SCOTCH_contextOptionSetNum");
        strategy.emplace([](SCOTCH_Strat *object) {
          require(SCOTCH_stratInit(object), "SCOTCH_stratInit");
        });
        require(SCOTCH_stratDgraphMapBuild(strategy->get(),
                                           SCOTCH_STRATQUALITY,
                                           n_ranks,
                                           n_ranks,
                                           inequality),
                "SCOTCH_stratDgraphMapBuild");
      });
      // Checks collective functions.
      const auto require_on_all = [&](const int status, const char *function) {
        on_all_ranks(mesh.communicator, [&] { require(status, function); });
      };
      const auto init = [&](SCOTCH_Dgraph *object) {
        require_on_all(SCOTCH_dgraphInit(object, mesh.communicator),
                       "SCOTCH_dgraphInit");
      };
      Graph cells(init), graph(init);
      require_on_all(SCOTCH_dgraphBuild(cells.get(),
                                        0,
                                        works.size(),
                                        works.size(),
                                        first_edges.data(),
                                        nullptr,
                                        works.data(),
                                        nullptr,
                                        edges.size(),
                                        edges.size(),
                                        edges.data(),
                                        nullptr,
                                        nullptr),
                     "SCOTCH_dgraphBuild");
      require_on_all(SCOTCH_contextBindDgraph(context->get(),
                                              cells.get(),
                                              graph.get()),
                     "SCOTCH_contextBindDgraph");
      std::vector<SCOTCH_Num> ranks(works.size());
      require_on_all(
        SCOTCH_dgraphPart(graph.get(), n_ranks, strategy->get(), ranks.data()),
        "SCOTCH_dgraphPart");
      return ranks;
    }
#else
    std::vector<int>
    ranks_of_cells(const LocalMesh &)
    {
      throw ComputationError("this corotet was built without PT-Scotch");
    }
#endif
  } // namespace



  const Enumeration<Partitioner> &
  partitioners()
  {
    static const Enumeration<Partitioner> values{
      {"Hilbert curve", Partitioner::hilbert_curve},
#ifdef COROTET_WITH_PT_SCOTCH
      {"PT-Scotch", Partitioner::pt_scotch}
#endif
    };
    return values;
  }



  std::uint64_t
  n_faces_between_ranks(const LocalMesh &mesh)
  {
    std::uint64_t n = 0;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.is_owned(c))
        for (const unsigned int neighbor : mesh.neighbors[c])
          if (neighbor != LocalMesh::no_cell && !mesh.is_owned(neighbor))
            ++n;
    return MPI::sum(n, mesh.communicator) / 2;
  }



  MeshPart
  partition_graph(const LocalMesh &mesh)
  {
    const auto                             ranks = ranks_of_cells(mesh);
    std::vector<std::vector<unsigned int>> cells(
      MPI::n_mpi_processes(mesh.communicator));
    for (unsigned int c = 0, i = 0; c < mesh.cells.size(); ++c)
      if (mesh.is_owned(c))
        cells[ranks[i++]].push_back(c);
    std::vector<std::uint64_t> n_cells;
    for (const auto &of_rank : cells)
      n_cells.push_back(of_rank.size());
    MPI::sum(n_cells, mesh.communicator, n_cells);
    if (*std::min_element(n_cells.begin(), n_cells.end()) == 0)
      return owned_part(mesh);

    PartCutter cutter(mesh);
    Messages   messages;
    for (unsigned int rank = 0; rank < cells.size(); ++rank)
      if (!cells[rank].empty())
        messages[rank] = packed(cutter.cut(cells[rank]));
    std::vector<MeshPart>                              parts;
    std::vector<std::pair<unsigned int, unsigned int>> order;
    for (const auto &[rank, message] :
         exchange_messages(std::move(messages), mesh.communicator))
      {
        std::size_t position = 0;
        parts.push_back(unpacked(message, position));
        for (unsigned int c = 0; c < parts.back().cells.size(); ++c)
          order.emplace_back(parts.size() - 1, c);
      }
    MeshPart result        = merged(parts, order);
    result.geometry_degree = mesh.geometry_degree;
    return result;
  }
} // namespace corotet
