// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_check_h
#define corotet_studies_check_h

#include <memory>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * A table of numbers that a run has written: history.csv, modes.csv or
   * study.csv.
   */
  struct ResultTable
  {
    std::vector<std::string>         columns;
    std::vector<std::vector<double>> rows;
  };

  /**
   * Reads a .csv file with a line of names and lines of numbers, nan among
   * them; texts in quotation marks count as that, too. Throws MachineError if
   * it is none.
   */
  ResultTable
  read_result_table(const std::string &path);

  /**
   * What a check found.
   */
  struct CheckResult
  {
    std::string name;
    double      computed  = 0;
    double      reference = 0;
    /// Computed less reference. In percent of the reference if the tolerance
    /// is.
    double error = 0;
    /// "0.1 %", "1e-09"; "below" or "above" if the reference is a bound.
    std::string tolerance;
    bool        relative = false;
    bool        passed   = false;
  };

  /**
   * A number that a run has computed and what it is to be:
   *
   *   NAME: STATISTIC FORMULA [where CONDITION] = REFERENCE +- TOLERANCE
   *
   * The statistic (first, last, min, max, mean; range: max - min) is that of
   * the formula's values in those rows of a table where the condition holds.
   * Formula and condition are in the names of the columns, reference and
   * tolerance are constants, all in the syntax of Expression. A tolerance
   * that ends in % is relative to the reference. In place of `= REFERENCE +-
   * TOLERANCE` there may be a bound, `< REFERENCE` or `> REFERENCE`. What is
   * not a number passes nothing, nor does a check without any row.
   */
  class Check
  {
  public:
    /// Throws an InputError that blames Verification/Checks if @p text is no
    /// check of a table with these @p columns.
    Check(const std::string &text, const std::vector<std::string> &columns);
    ~Check();
    Check(Check &&) noexcept;
    Check(const Check &) = delete;
    Check &
    operator=(const Check &) = delete;
    Check &
    operator=(Check &&) = delete;

    const std::string &
    name() const
    {
      return label;
    }

    /// @p table has the columns that the check was made for.
    CheckResult
    evaluate(const ResultTable &table) const;

  private:
    class RowFormula;

    void
    parse_quantity(const std::string              &quantity,
                   const std::vector<std::string> &columns);
    void
    parse_expectation(const std::string &expectation);
    double
    statistic_of(const std::vector<double> &values) const;

    std::string                 label;
    std::string                 statistic;
    std::unique_ptr<RowFormula> formula;
    /// None: all rows.
    std::unique_ptr<RowFormula> condition;
    /// =, < or >.
    char   relation  = '=';
    double reference = 0;
    /// As written; empty for a bound.
    std::string tolerance_text;
    double      tolerance = 0;
    bool        relative  = false;
  };
} // namespace corotet

#endif
