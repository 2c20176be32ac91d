// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_simulation_supported_box_h
#define corotet_tests_simulation_supported_box_h

#include <fmt/format.h>

#include <string>

#include "complete_run.h"

namespace corotet::tests
{
  /// A box of E, nu = 0, rho = 1 with tight tolerances.
  inline std::string
  supported_box(const std::string &size,
                const std::string &cells,
                const double       youngs_modulus,
                const std::string &type = "linear")
  {
    return fmt::format(R"(
      subsection Mesh
        subsection box
          set Size  = {}
          set Cells = {}
        end
      end
      subsection Material
        set Type            = {}
        set Young's modulus = {}
        set Poisson's ratio = 0
        set Density         = 1
      end
      subsection Newton
        set Residual tolerance  = 1e-12
        set Increment tolerance = 1e-12
      end
      subsection Linear solver
        set Tolerance = 1e-13
      end
    )",
                       size,
                       cells,
                       type,
                       youngs_modulus);
  }

  inline std::string
  supports(const std::string &elastic,
           const std::string &normal   = "",
           const std::string &dashpots = "")
  {
    return fmt::format("subsection Supports\n set Elastic = {}\n set Elastic "
                       "normal = {}\n set Dashpots = {}\nend\n",
                       elastic,
                       normal,
                       dashpots);
  }

  inline std::string
  loads(const std::string &gravity)
  {
    return "subsection Loads\n set Gravity = " + gravity + "\nend\n";
  }

  inline std::string
  time_integration(const std::string &type,
                   const double       end,
                   const double       step,
                   const std::string &more = "")
  {
    return fmt::format("subsection Time integration\n set Type = {}\n set End "
                       "time = {}\n set Time step = {}\n{}\nend\n",
                       type,
                       end,
                       step,
                       more);
  }

  inline const std::string statics =
    "subsection Time integration\n set Type = static\nend\n";

  inline const StepRecord &
  last_record(const CompleteRun &run)
  {
    return run.recorder().records.back();
  }

  /// Mean displacement over the nodes; all move alike in these tests.
  inline double
  mean_displacement(const CompleteRun &run, const unsigned int component)
  {
    const Vector &u   = run.recorder().displacement;
    double        sum = 0;
    for (unsigned int i = component; i < u.locally_owned_size(); i += 3)
      sum += u.local_element(i);
    return dealii::Utilities::MPI::sum(sum, u.get_mpi_communicator()) /
           (u.size() / 3);
  }
} // namespace corotet::tests

#endif
