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
   * Reads a .csv file with a line of names and lines of numbers, which may be
   * nan; texts in quotation marks count as nan, too. Throws MachineError if the
   * file has another form.
   */
  ResultTable
  read_result_table(const std::string &path);

  /**
   * The result of a check.
   */
  struct CheckResult
  {
    std::string name;
    double      computed  = 0;
    double      reference = 0;
    /// The computed value minus the reference. In percent of the reference if
    /// the tolerance is.
    double error = 0;
    /// The text of the tolerance, "0.1 %" or "1e-09"; "below" or "above" if the
    /// reference is a bound.
    std::string tolerance;
    bool        relative = false;
    bool        passed   = false;
  };

  /**
   * A comparison of a computed number with its expected value:
   *
   *   NAME: STATISTIC FORMULA [where CONDITION] = REFERENCE +- TOLERANCE
   *
   * The statistic (first, last, min, max, mean; range: max - min) is that of
   * the formula's values in those rows of a table where the condition holds.
   * Formula and condition use the names of the columns, reference and tolerance
   * are constants, all in the syntax of Expression. A tolerance that ends in %
   * is relative to the reference. In place of `= REFERENCE +- TOLERANCE` there
   * may be a bound, `< REFERENCE` or `> REFERENCE`. A value that is not a
   * number fails every check, and so does a check without rows.
   */
  class Check
  {
  public:
    /// Throws an InputError that blames Verification/Checks if @p text is not a
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

    /// Checks @p table, which must have the columns that the check was made
    /// for; throws std::logic_error if it has more or fewer.
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
    /// The condition on rows; null if all rows count.
    std::unique_ptr<RowFormula> condition;
    /// The relation =, < or >.
    char   relation  = '=';
    double reference = 0;
    /// The tolerance as written by the user; empty for a bound.
    std::string tolerance_text;
    double      tolerance = 0;
    bool        relative  = false;
  };
} // namespace corotet

#endif
