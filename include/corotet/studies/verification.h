// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_verification_h
#define corotet_studies_verification_h

#include <corotet/base/log.h>
#include <corotet/studies/check.h>

#include <deal.II/base/parameter_handler.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace corotet
{
  /**
   * Section Verification: checks of a run's results against given numbers.
   */
  class Verification
  {
  public:
    /// Declares the entries in the section that @p prm is in.
    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// Reads the checks, for results with these @p columns. Throws InputError.
    void
    initialize(const std::vector<std::string> &columns);

    /**
     * Checks the table @p file in @p directory, shows the results and writes
     * them to verification.csv there. Does nothing if there are no checks. @p
     * name is the name of the run. Throws ComputationError if a check fails,
     * and MachineError. Collective.
     */
    void
    compare(const std::string &name,
            const std::string &directory,
            const std::string &file,
            const MPI_Comm     comm,
            Log               &log) const;

  private:
    std::string        checks_text;
    std::string        source;
    std::string        tolerance_reason;
    std::vector<Check> checks;
  };
} // namespace corotet

#endif
