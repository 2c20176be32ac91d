// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/file_names.h>
#include <corotet/base/formula_functions.h>
#include <corotet/base/mpi.h>
#include <corotet/base/table_file.h>
#include <corotet/base/table_functions.h>
#include <corotet/base/text.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace corotet
{
  namespace
  {
    using Interpolation = TableFunction::Interpolation;

    void
    check_name(const std::string    &name,
               const TableFunctions &functions,
               const std::string    &entry)
    {
      const bool is_word =
        !name.empty() &&
        std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
        std::all_of(name.begin(), name.end(), [](const unsigned char c) {
          return std::isalnum(c) != 0 || c == '_';
        });
      if (!is_word)
        throw InputError(entry,
                         fmt::format("the name of a table is no name of a "
                                     "function: found '{}'; allowed are "
                                     "letters, digits and _, no digit first",
                                     shortened(name)));
      if (is_formula_name(name))
        throw InputError(entry,
                         fmt::format("the name of a table is taken: found "
                                     "'{}', which formulas have already; "
                                     "allowed is any other",
                                     name));
      if (functions.contains(name))
        throw InputError(entry,
                         fmt::format("found two tables called '{}'; allowed "
                                     "is one",
                                     name));
    }

    // Reads a table file. Called on rank 0.
    TableRows
    read(const std::string &path, const std::string &entry)
    {
      if (!std::filesystem::is_regular_file(path))
        throw InputError(entry,
                         "there is no table file: found '" + shortened(path) +
                           "'");
      return read_table_file(path);
    }

    void
    add_functions(TableFunctions     &functions,
                  const std::string  &text,
                  const Interpolation interpolation,
                  const std::string  &entry,
                  const std::string  &folder,
                  const MPI_Comm      comm)
    {
      for (const std::string &item :
           dealii::Utilities::split_string_list(text, ','))
        {
          const std::vector<std::string> name_and_file =
            dealii::Utilities::split_string_list(item, ':');
          // The entry's pattern ensures that there are two parts.
          AssertDimension(name_and_file.size(), 2);
          const std::string &name = name_and_file[0];
          check_name(name, functions, entry);

          const std::string path = file_in(folder, name_and_file[1]);
          TableRows         rows;
          on_root(comm, [&] { rows = read(path, entry); });
          rows.arguments =
            dealii::Utilities::MPI::broadcast(comm, rows.arguments);
          rows.values = dealii::Utilities::MPI::broadcast(comm, rows.values);
          functions[name] =
            std::make_shared<const TableFunction>(rows.arguments,
                                                  rows.values,
                                                  interpolation);
        }
    }
  } // namespace

  void
  TableParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    const Map names_and_files{Anything(), FileName()};
    prm.add_parameter(
      "Linear",
      linear,
      "Functions of one argument, used as name(t) in all expressions, from "
      "files relative to the folder of this file: 'name: file.csv, ...'. A "
      "file has two columns, argument and value, separated by commas, "
      "semicolons or blanks; arguments increase; a header and comments after # "
      "are skipped. Values are interpolated linearly between the rows, and "
      "constant before the first and after the last.",
      names_and_files);
    prm.add_parameter(
      "Cubic",
      cubic,
      "Functions like those of Linear, but interpolated by cubic polynomials: "
      "slopes are continuous, as moving supports need, and values do not "
      "overshoot, as monotone data stay monotone.",
      names_and_files);
  }

  TableFunctions
  read_table_functions(const TableParameters &parameters,
                       const std::string     &folder,
                       const MPI_Comm         comm)
  {
    TableFunctions functions;
    add_functions(functions,
                  parameters.linear,
                  Interpolation::linear,
                  "Tables/Linear",
                  folder,
                  comm);
    add_functions(functions,
                  parameters.cubic,
                  Interpolation::cubic,
                  "Tables/Cubic",
                  folder,
                  comm);
    return functions;
  }
} // namespace corotet
