// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_simulation_supported_box_h
#define corotet_tests_simulation_supported_box_h

#include <string>

#include "complete_run.h"

namespace corotet::tests
{
  /// A box with Young's modulus E, nu = 0 and rho = 1, with tight tolerances.
  inline std::string
  supported_box(const std::string &size,
                const std::string &cells,
                const double       youngs_modulus,
                const std::string &type = "linear")
  {
    return box_mesh(size, cells) + material_type(type) +
           material_text(youngs_modulus, 0, 1) + newton_tolerances(1e-12) +
           section("Linear solver", {{"Tolerance", 1e-13}});
  }

  inline const StepRecord &
  last_record(const CompleteRun &run)
  {
    return run.recorder().records.back();
  }

  /// The mean displacement of all nodes, which move alike in these tests.
  inline double
  mean_displacement(const CompleteRun &run, const unsigned int component)
  {
    const Vector &u   = run.recorder().displacement;
    double        sum = 0;
    for (unsigned int i = component; i < u.locally_owned_size(); i += 3)
      sum += u.local_element(i);
    return dealii::Utilities::MPI::sum(sum, u.get_mpi_communicator()) /
           (u.size() / 3.);
  }
} // namespace corotet::tests

#endif
