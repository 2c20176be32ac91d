// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_written_digits_h
#define corotet_mesh_written_digits_h

#include <deal.II/base/point.h>

#include <vector>

namespace corotet
{
  /**
   * The number of digits that a file has of coordinates. With six or nine
   * digits, as many programs write, nodes in the middle of straight edges are
   * off by the rounding error. The numbers themselves tell: the shortest
   * decimal number that gives the same double has no more digits than the file.
   * Numbers of single precision, as binary files may have, have seven.
   */
  class WrittenDigits
  {
  public:
    explicit WrittenDigits(const std::vector<dealii::Point<3>> &nodes);

    /// The unit of the last digit of coordinates up to @p size: the largest
    /// deviation, in each direction, of a node on a line between others, all of
    /// which are rounded. 0 if the numbers are too long or too short to tell.
    double
    last_digit(const double size) const;

    /// The number of significant digits; 0 if there are too many or too few to
    /// tell.
    int
    n_significant() const
    {
      return significant;
    }

  private:
    int significant = 0;
    /// The number of digits behind the decimal point.
    int  decimals            = 0;
    bool is_single_precision = false;
  };
} // namespace corotet

#endif
