// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/values_by_place.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace corotet
{
  namespace
  {
    // The sine of a number of any size, with an error of 4e-6.
    double
    rough_sine(const double x)
    {
      using std::numbers::pi;
      const double r = x - 2 * pi * std::nearbyint(x / (2 * pi));
      const double t = std::abs(r) > pi / 2 ? std::copysign(pi, r) - r : r;
      const double q = t * t;
      return t * (1 + q * (-1. / 6 +
                           q * (1. / 120 + q * (-1. / 5040 + q / 362880))));
    }
  } // namespace

  template <typename T>
  void
  fill_by_place(dealii::LinearAlgebra::distributed::Vector<T> &values,
                const Discretization                          &discretization)
  {
    const unsigned int    n = discretization.n_owned_nodes();
    std::array<double, 6> ends;
    ends.fill(std::numeric_limits<double>::lowest());
    for (unsigned int node = 0; node < n; ++node)
      for (unsigned int a = 0; a < 3; ++a)
        {
          const double x = discretization.node_position(node)[a];
          ends[a]        = std::max(ends[a], x);
          ends[3 + a]    = std::max(ends[3 + a], -x);
        }
    dealii::Utilities::MPI::max(dealii::ArrayView<const double>(ends.data(), 6),
                                discretization.communicator(),
                                dealii::ArrayView<double>(ends.data(), 6));
    const double size =
      std::max({ends[0] + ends[3], ends[1] + ends[4], ends[2] + ends[5]});
    constexpr double waves[3] = {12.9898, 78.233, 37.719};
    const double     sin_1 = std::sin(1.), cos_1 = std::cos(1.),
                 sin_2 = std::sin(2.), cos_2 = std::cos(2.);
    for (unsigned int node = 0; node < n; ++node)
      {
        double phase = 0;
        for (unsigned int a = 0; a < 3; ++a)
          phase += waves[a] / size *
                   (discretization.node_position(node)[a] + ends[3 + a]);
        const double sine = std::sin(phase), cosine = std::cos(phase);
        // sin(phase + a) for a = 0, 1, 2.
        const double shifted[3] = {sine,
                                   sine * cos_1 + cosine * sin_1,
                                   sine * cos_2 + cosine * sin_2};
        for (unsigned int a = 0; a < 3; ++a)
          values.local_element(3 * node + a) =
            rough_sine(43758.5453 * shifted[a]);
      }
  }

  template void
  fill_by_place(dealii::LinearAlgebra::distributed::Vector<float> &,
                const Discretization &);
  template void
  fill_by_place(dealii::LinearAlgebra::distributed::Vector<double> &,
                const Discretization &);
} // namespace corotet
