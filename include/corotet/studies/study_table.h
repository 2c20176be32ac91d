// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_study_table_h
#define corotet_studies_study_table_h

#include <corotet/studies/study_run.h>

#include <string>
#include <vector>

namespace corotet
{
  /**
   * The results of a study in rows, with orders of convergence from pairs of
   * runs that differ in the refinement, or the time step, only: log(e_1 / e_2)
   * / log(h_1 / h_2), with mean time steps in place of h.
   */
  class StudyTable
  {
  public:
    /// @p quantities have the values that quantities are compared with.
    StudyTable(const std::vector<StudyResult>               &results,
               const std::vector<StudyParameters::Quantity> &quantities);

    /// The whole table, with the names of the columns.
    std::string
    csv() const;

    /// The most important columns, as text.
    std::vector<std::string>
    lines() const;

    /// The most important columns for LaTeX (a tabular for package booktabs).
    std::string
    latex() const;

    /// A line of text for each error that does not converge with finer cells:
    /// from the second finest to the finest mesh of a series it shrinks by less
    /// than the power 1/2 of the cell size.
    std::vector<std::string>
    not_converging() const;

  private:
    struct Error
    {
      std::string name;
      /// The reference value in each row.
      std::vector<double> references;
      /// The error of each result; not a number if it is not known.
      std::vector<double> values;
      std::vector<double> orders;
      std::vector<double> orders_in_time;
    };

    void
    add_error(const std::string         &name,
              const std::vector<double> &references,
              const std::vector<double> &values);

    /// The titles and rows of the most important columns.
    std::vector<std::vector<std::string>>
    cells() const;

    std::vector<StudyResult>               results;
    std::vector<StudyParameters::Quantity> quantities;
    std::vector<Error>                     errors;
    bool                                   has_orders_in_time = false;
  };
} // namespace corotet

#endif
