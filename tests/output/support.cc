// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "support.h"

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

#include "../source_path.h"

namespace test_output
{
  using corotet::SerialMesh;
  using dealii::Point;
  using dealii::Tensor;
  namespace mpi = dealii::Utilities::MPI;

  ScratchFolder::ScratchFolder()
  {
    if (on_rank_0())
      {
        path = (std::filesystem::temp_directory_path() / "corotet-XXXXXX");
        AssertThrow(mkdtemp(path.data()) != nullptr,
                    dealii::ExcMessage("no temporary folder"));
      }
    path = mpi::broadcast(MPI_COMM_WORLD, path, 0);
  }

  ScratchFolder::~ScratchFolder()
  {
    wait_for_all();
    if (on_rank_0())
      std::filesystem::remove_all(path);
  }

  void
  wait_for_all()
  {
    MPI_Barrier(MPI_COMM_WORLD);
  }

  unsigned int
  rank()
  {
    return mpi::this_mpi_process(MPI_COMM_WORLD);
  }

  bool
  on_rank_0()
  {
    return rank() == 0;
  }

  unsigned int
  n_ranks()
  {
    return mpi::n_mpi_processes(MPI_COMM_WORLD);
  }

  std::string
  content_of(const std::string &file)
  {
    std::ifstream     stream(file);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
  }

  FileSizeLimit::FileSizeLimit(const rlim_t bytes)
  {
    handler = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old);
    const rlimit limit{bytes, old.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }

  FileSizeLimit::~FileSizeLimit()
  {
    setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, handler);
  }

  SerialMesh
  distorted_box()
  {
    constexpr unsigned int nx = 4, ny = 2, nz = 2;
    const auto vertex = [](unsigned int i, unsigned int j, unsigned int k) {
      return i + (nx + 1) * (j + (ny + 1) * k);
    };
    SerialMesh mesh;
    for (unsigned int k = 0; k <= nz; ++k)
      for (unsigned int j = 0; j <= ny; ++j)
        for (unsigned int i = 0; i <= nx; ++i)
          {
            Point<3> x(i / double(nx), 0.5 * j / ny, 0.25 * k / nz);
            if (i % nx != 0 && j % ny != 0 && k % nz != 0)
              x += Point<3>(0.03 * std::sin(7. * i), 0.04, -0.02);
            mesh.vertices.push_back(x);
          }
    // The six paths along the edges of a cube from one corner to the opposite
    // one.
    const std::array<std::array<unsigned int, 3>, 6> paths{{{{0, 1, 2}},
                                                            {{1, 2, 0}},
                                                            {{2, 0, 1}},
                                                            {{0, 2, 1}},
                                                            {{2, 1, 0}},
                                                            {{1, 0, 2}}}};
    for (unsigned int k = 0; k < nz; ++k)
      for (unsigned int j = 0; j < ny; ++j)
        for (unsigned int i = 0; i < nx; ++i)
          for (unsigned int p = 0; p < 6; ++p)
            {
              std::array<unsigned int, 3> at{{i, j, k}};
              SerialMesh::Cell            cell;
              cell.vertices[0] = vertex(i, j, k);
              for (unsigned int s = 0; s < 3; ++s)
                {
                  ++at[paths[p][s]];
                  cell.vertices[s + 1] = vertex(at[0], at[1], at[2]);
                }
              // Odd permutations give mirror images, so two vertices are
              // swapped.
              if (p >= 3)
                std::swap(cell.vertices[1], cell.vertices[2]);
              cell.region = 2 * i < nx ? 7 : 8;
              mesh.cells.push_back(cell);
            }
    mesh.regions.names = {{7, "left"}, {8, "right"}};
    return mesh;
  }

  Tensor<1, 3>
  displacement_field(const Point<3> &x, const double t)
  {
    Tensor<1, 3> u;
    u[0] = t * std::sin(3 * x[0] + x[1]);
    u[1] = t * std::cos(2 * x[1] - x[2]);
    u[2] = t * x[0] * x[1] + t * t * x[2];
    return u;
  }

  ModelBody::ModelBody(const corotet::Element element)
    : log(MPI_COMM_WORLD, true)
    , mesh(distorted_box(), 0, 1, MPI_COMM_WORLD, log)
    , discretization(mesh, element)
  {
    discretization.initialize_vector(displacement);
    discretization.initialize_vector(velocity);
    // All local entries, including ghosts, are set here.
    displacement.set_ghost_state(true);
    velocity.set_ghost_state(true);
  }

  corotet::StepRecord
  ModelBody::record(const unsigned int step, const double time)
  {
    corotet::StepRecord record;
    record.step              = step;
    record.time              = time;
    record.dt                = 0.1;
    record.newton_iterations = 2;
    record.linear_iterations = 31;
    record.kinetic_energy    = 1. / 3. + time;
    record.elastic_energy    = 1e-300 / 7;
    record.external_work     = -2e20 / 3;
    record.momentum[1]       = std::numbers::sqrt2;
    record.reaction[2]       = -std::numbers::sqrt3;
    record.volume            = 0.125;
    record.wall_time         = 0.5 * step;
    return record;
  }

  void
  ModelBody::show(corotet::Observer &observer,
                  const unsigned int step,
                  const double       time,
                  const bool         last)
  {
    for (unsigned int n = 0; n < discretization.n_local_nodes(); ++n)
      {
        const Tensor<1, 3> u =
          displacement_field(discretization.node_position(n), time);
        for (unsigned int c = 0; c < 3; ++c)
          {
            displacement.local_element(3 * n + c) = u[c];
            velocity.local_element(3 * n + c)     = 2 * u[c];
          }
      }
    const auto cell_results = [&] {
      corotet::CellResults results;
      for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
        {
          Point<3> centre;
          for (unsigned int v = 0; v < 4; ++v)
            centre += 0.25 * discretization.node_position(
                               discretization.cell_nodes(c)[v]);
          results.rotation_angle.push_back(time + centre[0]);
          results.det_F.push_back(time + centre[1]);
          results.von_mises.push_back(time + centre[2]);
        }
      return results;
    };
    const corotet::StepRecord numbers = record(step, time);
    const corotet::Snapshot   state{discretization,
                                  numbers,
                                  displacement,
                                  velocity,
                                  cell_results,
                                  last,
                                    {},
                                    {}};
    if (step == 0)
      observer.start(state);
    else
      observer.step(state);
  }

  int
  run_python(const std::string &command)
  {
    int status = 0;
    if (on_rank_0())
      status = std::system(
        ("python3 " + corotet::tests::source_path("tests/output/") + command)
          .c_str());
    return mpi::broadcast(MPI_COMM_WORLD, status, 0);
  }
} // namespace test_output
