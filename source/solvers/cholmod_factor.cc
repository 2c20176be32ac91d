// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/solvers/cholmod_factor.h>
#include <corotet/solvers/scaling.h>

#include <deal.II/base/exceptions.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace corotet
{
  namespace
  {
    /// Number of rows below which nested dissection takes longer than it saves,
    /// measured with one factorisation per ordering.
    constexpr int min_rows_for_dissection = 15000;

    /// A pivot counts as round-off if it is smaller than this many machine
    /// precisions, relative to the diagonal entry that it comes from.
    constexpr double pivot_noise = 64;
  } // namespace

  CholmodFactor::CholmodFactor(const int         n_rows,
                               const std::size_t n_entries,
                               const bool        single_precision)
    : n_rows(n_rows)
  {
    cholmod_start(&common);
    common.print        = 0;
    common.supernodal   = CHOLMOD_SUPERNODAL;
    common.nthreads_max = 1;
    // Supernodes are wider than CHOLMOD's default, as a node has three columns.
    common.nrelax[0] = 8;
    common.nrelax[1] = 32;
    common.nrelax[2] = 96;
    common.zrelax[1] = 0.2;
    if (n_entries <= std::numeric_limits<int>::max())
      lower = cholmod_allocate_sparse(n_rows,
                                      n_rows,
                                      n_entries,
                                      0, // not sorted
                                      1, // packed
                                      1, // symmetric, the upper part
                                      CHOLMOD_REAL + (single_precision ?
                                                        CHOLMOD_SINGLE :
                                                        CHOLMOD_DOUBLE),
                                      &common);
    else
      common.status = CHOLMOD_TOO_LARGE;
    try
      {
        check_status();
      }
    catch (...)
      {
        cholmod_finish(&common);
        throw;
      }
  }

  CholmodFactor::~CholmodFactor()
  {
    free_factor();
    cholmod_free_sparse(&lower, &common);
    cholmod_finish(&common);
  }

  void
  CholmodFactor::free_factor()
  {
    for (cholmod_dense **vector : {&rhs, &solution, &work_y, &work_e})
      cholmod_free_dense(vector, &common);
    cholmod_free_factor(&L, &common);
  }

  void
  CholmodFactor::check_status() const
  {
    if (common.status == CHOLMOD_OUT_OF_MEMORY)
      throw MachineError("memory is too short to factorise a matrix with " +
                         std::to_string(n_rows) + " unknowns");
    if (common.status == CHOLMOD_TOO_LARGE)
      throw ComputationError("the matrix with " + std::to_string(n_rows) +
                             " unknowns is too large to be factorised: its "
                             "factor has more than 2^31 entries");
    if (common.status < CHOLMOD_OK)
      throw ComputationError(
        fmt::format("the matrix with {} unknowns cannot be factorised: CHOLMOD "
                    "ends with status {}",
                    n_rows,
                    common.status));
  }

  /// The graph of points with @p size unknowns each: columns for each row of a
  /// point, in the order of the rows. Returns false if rows of a point differ.
  bool
  CholmodFactor::find_points(const int size, NodeGraph &points) const
  {
    if (n_rows % size != 0)
      return false;
    const int        n_points = n_rows / size;
    const int       *starts   = row_starts();
    const int       *column   = columns();
    std::vector<int> last_seen(n_points, -1);
    points = NodeGraph();
    for (int point = 0; point < n_points; ++point)
      {
        const int begin = points.columns.size();
        for (int row = size * point; row < size * (point + 1); ++row)
          {
            int n_seen = 0, last = -1;
            for (int k = starts[row]; k < starts[row + 1]; ++k)
              {
                const int other = column[k] / size;
                if (std::exchange(last_seen[other], point) != point)
                  {
                    if (row > size * point)
                      return false;
                    points.columns.push_back(other);
                  }
                n_seen += std::exchange(last, other) != other ? 1 : 0;
              }
            if (n_seen != static_cast<int>(points.columns.size()) - begin)
              return false;
          }
        points.starts.push_back(points.columns.size());
      }
    return true;
  }

  /// Orders the graph of points, which has at most a ninth of the matrix's
  /// entries.
  void
  CholmodFactor::order()
  {
    NodeGraph points;
    int       size = 6;
    while (!find_points(size, points))
      size /= 2;
    const int       n_points = points.n_rows();
    cholmod_sparse *graph    = cholmod_allocate_sparse(n_points,
                                                    n_points,
                                                    points.columns.size(),
                                                    0, // not sorted
                                                    1, // packed
                                                    1, // symmetric
                                                    CHOLMOD_PATTERN,
                                                    &common);
    check_status();
    std::copy(points.starts.begin(),
              points.starts.end(),
              static_cast<int *>(graph->p));
    std::copy(points.columns.begin(),
              points.columns.end(),
              static_cast<int *>(graph->i));
    std::vector<int> point_order(n_points);
    if (n_rows < min_rows_for_dissection)
      cholmod_amd(graph, nullptr, 0, point_order.data(), &common);
    else
      cholmod_metis(graph, nullptr, 0, 1, point_order.data(), &common);
    cholmod_free_sparse(&graph, &common);
    check_status();

    permutation.resize(n_rows);
    for (int row = 0; row < n_rows; ++row)
      permutation[row] = size * point_order[row / size] + row % size;
  }

  void
  CholmodFactor::analyze()
  {
    free_factor();
    if (permutation.empty())
      order();
    common.nmethods           = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    L = cholmod_analyze_p(lower, permutation.data(), nullptr, 0, &common);
    // Each of CHOLMOD's functions has a status of its own.
    check_status();
    operations = common.fl;
    rhs        = cholmod_zeros(n_rows, 1, type(), &common);
    check_status();
  }

  void
  CholmodFactor::convert_to_double()
  {
    cholmod_sparse_xtype(CHOLMOD_REAL + CHOLMOD_DOUBLE, lower, &common);
    check_status();
    analyze();
  }

  /// Whether each L_kk^2, the remainder of a diagonal entry of A after
  /// elimination, is more than round-off.
  template <typename Number>
  bool
  CholmodFactor::pivots_are_sound() const
  {
    const int   *first  = static_cast<const int *>(L->super);
    const int   *pi     = static_cast<const int *>(L->pi);
    const int   *px     = static_cast<const int *>(L->px);
    const int   *row    = static_cast<const int *>(L->Perm);
    const int   *ends   = static_cast<const int *>(lower->p) + 1;
    const int   *column = static_cast<const int *>(lower->i);
    const auto  *x      = static_cast<const Number *>(L->x);
    const auto  *a      = static_cast<const Number *>(lower->x);
    const Number noise  = pivot_noise * std::numeric_limits<Number>::epsilon();
    for (std::size_t s = 0; s < L->nsuper; ++s)
      {
        const std::size_t length = pi[s + 1] - pi[s];
        for (int k = first[s]; k < first[s + 1]; ++k)
          {
            const Number pivot = x[px[s] + (k - first[s]) * (length + 1)];
            // Columns are sorted, with the diagonal last or nearly so.
            int diagonal = ends[row[k]] - 1;
            while (diagonal > ends[row[k] - 1] && column[diagonal] != row[k])
              --diagonal;
            if (!(pivot * pivot > noise * a[diagonal]))
              return false;
          }
      }
    return true;
  }

  bool
  CholmodFactor::factorize()
  {
    cholmod_factorize(lower, L, &common);
    check_status();
    if (L->minor < L->n)
      return false;
    if (!(is_single() ? pivots_are_sound<float>() : pivots_are_sound<double>()))
      return false;
    if (solution == nullptr)
      solve_rhs();
    return true;
  }

  /// solution = A^-1 rhs.
  void
  CholmodFactor::solve_rhs()
  {
    cholmod_solve2(CHOLMOD_A,
                   L,
                   rhs,
                   nullptr,
                   &solution,
                   nullptr,
                   &work_y,
                   &work_e,
                   &common);
    check_status();
  }

  template <typename Number>
  void
  CholmodFactor::solve(Number *dst, const Number *src, const double factor)
  {
    if (!is_single())
      {
        std::copy_n(src, n_rows, static_cast<double *>(rhs->x));
        solve_rhs();
        const auto *x = static_cast<const double *>(solution->x);
        for (int i = 0; i < n_rows; ++i)
          dst[i] = factor * x[i];
        return;
      }
    // Right-hand sides of any size are scaled to size one, so that no product
    // leaves the range of float.
    double largest = 0;
    for (int i = 0; i < n_rows; ++i)
      largest = std::max(largest, std::abs(static_cast<double>(src[i])));
    const double unit = power_of_two(largest), inverse = 1 / unit;
    auto        *b = static_cast<float *>(rhs->x);
    for (int i = 0; i < n_rows; ++i)
      b[i] = inverse * src[i];
    solve_rhs();
    const auto  *x    = static_cast<const float *>(solution->x);
    const double back = factor * unit;
    for (int i = 0; i < n_rows; ++i)
      dst[i] = back * x[i];
  }

  template void
  CholmodFactor::solve(float *, const float *, const double);
  template void
  CholmodFactor::solve(double *, const double *, const double);
} // namespace corotet
