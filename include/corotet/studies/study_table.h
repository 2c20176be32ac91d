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
   * The results of a study in rows, with the orders of convergence that two
   * runs show which differ in nothing but the refinement, or the time step:
   * log(e_1 / e_2) / log(h_1 / h_2), with mean time steps in place of h.
   */
  class StudyTable
  {
  public:
    /// Values that quantities are compared with stand in @p quantities.
    StudyTable(const std::vector<StudyResult>               &results,
               const std::vector<StudyParameters::Quantity> &quantities);

    /// All that is known, with the names of the columns.
    std::string
    csv() const;

    /// What matters most, in columns.
    std::vector<std::string>
    lines() const;

    /// The same for LaTeX (a tabular for package booktabs).
    std::string
    latex() const;

    /// A line of text for each error that does not shrink with finer cells: by
    /// less than the power 1/2 of their size, from the finest but one to the
    /// finest of a series.
    std::vector<std::string>
    not_converging() const;

  private:
    struct Error
    {
      std::string name;
      /// Of what it is an error, in each row.
      std::vector<double> references;
      /// Of each result; not a number if it is not known.
      std::vector<double> values;
      std::vector<double> orders;
      std::vector<double> orders_in_time;
    };

    void
    add_error(const std::string         &name,
              const std::vector<double> &references,
              const std::vector<double> &values);

    /// Titles and rows of what matters most.
    std::vector<std::vector<std::string>>
    cells() const;

    std::vector<StudyResult>               results;
    std::vector<StudyParameters::Quantity> quantities;
    std::vector<Error>                     errors;
    bool                                   has_orders_in_time = false;
  };
} // namespace corotet

#endif
