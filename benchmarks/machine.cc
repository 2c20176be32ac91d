// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Upper limits of this machine for the roofline: STREAM's triad (McCalpin 1995)
// in main memory and in the second-level cache, and multiply-adds. With several
// ranks all measure at the same time.

#include <corotet/base/simd.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <memory>

#include "measure.h"

namespace corotet::benchmarks
{
  namespace
  {
    double
    n_ranks()
    {
      return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    }

    double
    cache_size(const int level)
    {
      double size = level == 2 ? 1e6 : 3.2e7;
      for (const auto &cache : benchmark::CPUInfo::Get().caches)
        if (cache.level == level)
          size = cache.size;
      return size;
    }

    struct Triad
    {
      /// Allocates three arrays with @p bytes together.
      explicit Triad(const double bytes)
        : a(static_cast<std::size_t>(bytes / 24), 1.)
        , b(a)
        , c(a)
      {}

      __attribute__((noinline)) void
      pass()
      {
        double *__restrict__ target   = a.data();
        const double *__restrict__ b0 = b.data();
        const double *__restrict__ c0 = c.data();
        for (std::size_t i = 0; i < a.size(); ++i)
          target[i] = b0[i] + 0.5 * c0[i];
      }

      dealii::AlignedVector<double> a, b, c;
    };

    // Bytes are those that STREAM counts: two reads and one write per element.
    void
    add_triad(const std::string &name, const double bytes)
    {
      add_short(name, [bytes] {
        const auto triad = std::make_shared<Triad>(bytes);
        return Measured{[triad] { triad->pass(); },
                        {{"bytes", 24. * triad->a.size() * n_ranks()}}};
      });
    }

    // Runs enough independent chains of multiply-adds to cover their latency.
    template <typename T>
    __attribute__((noinline)) void
    multiply_add(const int steps)
    {
      constexpr int chains = 16;
      // volatile hides these values from the compiler.
      const volatile T factor = 0.999, summand = 1e-3;
      const Simd<T>    m = broadcast<T>(factor), s = broadcast<T>(summand);
      Simd<T>          x[chains];
      for (int i = 0; i < chains; ++i)
        x[i] = broadcast(T(i));
      for (int k = 0; k < steps; ++k)
        static_for<chains>([&](const auto i) {
          constexpr int n = decltype(i)::value;
          x[n]            = x[n] * m + s;
        });
      for (Simd<T> &chain : x)
        benchmark::DoNotOptimize(chain);
    }

    template <typename T>
    void
    add_multiply_add(const std::string &name)
    {
      add_short(name, [] {
        constexpr int steps = 100000;
        return Measured{[] { multiply_add<T>(steps); },
                        {{"flops", 2. * 16 * steps * n_lanes<T> * n_ranks()},
                         {"simd_bits", 8. * sizeof(Simd<T>)}}};
      });
    }
  } // namespace
} // namespace corotet::benchmarks

int
main(int argc, char **argv)
{
  using namespace corotet::benchmarks;
  const Session session(argv);
  // The arrays are far larger than the last cache, if others keep enough
  // memory.
  add_triad("machine/triad_memory",
            std::clamp(2 * cache_size(3), 4e8, 2.4e9) / n_ranks());
  add_triad("machine/triad_cache", cache_size(2) / 2);
  add_multiply_add<double>("machine/multiply_add_double");
  add_multiply_add<float>("machine/multiply_add_float");
  return run(argc, argv);
}
