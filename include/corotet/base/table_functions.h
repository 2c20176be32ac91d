// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_table_functions_h
#define corotet_base_table_functions_h

#include <corotet/base/table_function.h>

#include <deal.II/base/parameter_handler.h>

#include <mpi.h>

#include <map>
#include <memory>
#include <string>

namespace corotet
{
  /// Functions that formulas may use, by their names. Copies share the tables.
  using TableFunctions =
    std::map<std::string, std::shared_ptr<const TableFunction>>;

  /**
   * The parameters of section Tables, as text.
   */
  struct TableParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    std::string linear;
    std::string cubic;
  };

  /**
   * Reads all tables on rank 0 and gives them to all ranks. File names are
   * relative to @p folder. Throws InputError, on every rank, if a name is not
   * valid for a function or is taken, or if a file is missing or has no table.
   * Collective.
   */
  TableFunctions
  read_table_functions(const TableParameters &parameters,
                       const std::string     &folder,
                       const MPI_Comm         comm);
} // namespace corotet

#endif
