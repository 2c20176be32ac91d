// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_written_digits_h
#define corotet_mesh_written_digits_h

#include <deal.II/base/point.h>

#include <vector>

namespace corotet
{
  /**
   * How many digits a file has of coordinates: with six or nine of them, as
   * many programs write, nodes in the middle of straight edges are off by what
   * rounding leaves. Told by the numbers themselves: the shortest decimal
   * number that is the same double has no more digits than the file. Numbers
   * of single precision, as files of bytes may have, have seven.
   */
  class WrittenDigits
  {
  public:
    explicit WrittenDigits(const std::vector<dealii::Point<3>> &nodes);

    /// One of the last digit of coordinates up to @p size: what a node on a
    /// line between others that are rounded, too, is off by at most in each
    /// direction. 0 if the numbers are too long or too short to tell.
    double
    last_digit(const double size) const;

    /// Significant digits; 0 if there are too many or too few to tell.
    int
    n_significant() const
    {
      return significant;
    }

  private:
    int significant = 0;
    /// Behind the decimal point.
    int  decimals            = 0;
    bool is_single_precision = false;
  };
} // namespace corotet

#endif
