// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/disjoint_sets.h>
#include <corotet/discretization/rigid_motions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace corotet
{
  namespace
  {
    using Pair = std::pair<unsigned int, unsigned int>;

    // The largest number of parts in a cluster: more make a dense problem that
    // takes minutes.
    constexpr unsigned int max_cluster_size = 100;

    // Smaller entries of null vectors are round-off: null vectors are accurate
    // to the machine precision divided by the tolerance of the null space.
    constexpr double no_pivot = 1e-6;

    // Any number of linear equations in n unknowns, kept as the triangular
    // factor of their QR decomposition. It is computed by Givens rotations and
    // has the singular values of all equations, without squaring any value.
    class Equations
    {
    public:
      explicit Equations(const unsigned int n = 0)
        : n(n)
        , R(std::size_t(n) * n)
      {}

      // Adds an equation with n coefficients, which are overwritten.
      void
      add(std::vector<double> &row)
      {
        for (unsigned int i = 0; i < n; ++i)
          {
            if (row[i] == 0)
              continue;
            double      *pivot  = &R[std::size_t(n) * i];
            const double length = std::hypot(pivot[i], row[i]);
            const double c = pivot[i] / length, s = row[i] / length;
            for (unsigned int j = i; j < n; ++j)
              {
                const double old = pivot[j];
                pivot[j]         = c * old + s * row[j];
                row[j]           = c * row[j] - s * old;
              }
          }
      }

      unsigned int        n;
      std::vector<double> R;
      // The number of equations that were added.
      double count = 0;
    };

    // The equations of one part (a pair of equal numbers), or of two parts with
    // joints.
    using EquationsOfParts = std::map<Pair, Equations>;

    // The coefficients of u_a(x) by the six numbers of a part; with two parts,
    // those of the difference of their displacements at x by the twelve numbers
    // of both.
    std::vector<double>
    coefficients(const ConnectedParts   &parts,
                 const Pair             &pair,
                 const dealii::Point<3> &x,
                 const unsigned int      a)
    {
      const auto fill = [&](double *row, const unsigned int p, const double f) {
        const dealii::Tensor<1, 3> r = (x - parts.centres[p]) / parts.radii[p];
        row[a]                       = f;
        row[3 + (a + 1) % 3]         = f * r[(a + 2) % 3];
        row[3 + (a + 2) % 3]         = -f * r[(a + 1) % 3];
      };
      std::vector<double> row(12);
      fill(row.data(), pair.first, 1);
      if (pair.first != pair.second)
        fill(row.data() + 6, pair.second, -1);
      else
        row.resize(6);
      return row;
    }

    // The equations of all ranks, on each rank, added up in the same order.
    EquationsOfParts
    sum_over_ranks(const EquationsOfParts &own, const MPI_Comm comm)
    {
      std::vector<double> numbers;
      for (const auto &[pair, equations] : own)
        {
          numbers.insert(numbers.end(),
                         {double(pair.first),
                          double(pair.second),
                          equations.count});
          numbers.insert(numbers.end(), equations.R.begin(), equations.R.end());
        }
      EquationsOfParts all;
      for (const auto &of_rank :
           dealii::Utilities::MPI::all_gather(comm, numbers))
        for (auto next = of_rank.begin(); next != of_rank.end();)
          {
            const Pair         pair(next[0], next[1]);
            const unsigned int n   = pair.first == pair.second ? 6 : 12;
            Equations         &sum = all.try_emplace(pair, n).first->second;
            sum.count += next[2];
            next += 3;
            for (unsigned int i = 0; i < n; ++i, next += n)
              {
                std::vector<double> row(next, next + n);
                sum.add(row);
              }
          }
      return all;
    }

    EquationsOfParts
    equations_of_parts(const Discretization                    &discretization,
                       const PrescribedMotion                  &motion,
                       const std::vector<RigidMotions::Spring> &springs,
                       const ConnectedParts                    &parts)
    {
      EquationsOfParts own;
      const auto add_row = [&](const Pair &pair, std::vector<double> &row) {
        Equations &equations = own.try_emplace(pair, row.size()).first->second;
        equations.add(row);
        ++equations.count;
      };
      const auto add =
        [&](const Pair &pair, const unsigned int node, const unsigned int a) {
          std::vector<double> row =
            coefficients(parts, pair, discretization.node_position(node), a);
          add_row(pair, row);
        };
      for (const RigidMotions::Spring &spring : springs)
        {
          // d . (t + w x r) = d . t + (r x d) . w
          const unsigned int         part = parts.part_of_cell[spring.cell];
          const dealii::Tensor<1, 3> r =
            (spring.point - parts.centres[part]) / parts.radii[part];
          const dealii::Tensor<1, 3> moment =
            cross_product_3d(r, spring.direction);
          std::vector<double> row(6);
          for (unsigned int a = 0; a < 3; ++a)
            {
              row[a]     = spring.direction[a];
              row[3 + a] = moment[a];
            }
          add_row({part, part}, row);
        }
      for (const unsigned int dof : motion.unknowns())
        {
          const unsigned int part = parts.part_of_node[dof / 3];
          add({part, part}, dof / 3, dof % 3);
        }
      for (const auto &joint : parts.joints)
        for (unsigned int a = 0; a < 3; ++a)
          add(std::minmax({joint.part, joint.other}), joint.node, a);
      return sum_over_ranks(own, discretization.communicator());
    }

    // An orthonormal basis of the null space of @p rows with n unknowns, as
    // rows.
    std::vector<std::vector<double>>
    null_space(std::vector<std::vector<double>> &rows,
               const unsigned int                n,
               const double                      tolerance)
    {
      Equations all(n);
      for (std::vector<double> &row : rows)
        all.add(row);
      dealii::LAPACKFullMatrix<double> A(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = i; j < n; ++j)
          A(i, j) = all.R[n * i + j];
      A.compute_svd();
      std::vector<std::vector<double>> basis;
      for (unsigned int k = 0; k < n; ++k)
        if (A.singular_value(k) <= tolerance)
          {
            basis.emplace_back(n);
            for (unsigned int j = 0; j < n; ++j)
              basis.back()[j] = A.get_svd_vt()(k, j);
          }
      return basis;
    }

    std::vector<unsigned int>
    in_order(const unsigned int n)
    {
      std::vector<unsigned int> result(n);
      std::iota(result.begin(), result.end(), 0u);
      return result;
    }
  } // namespace

  void
  reduce_rows(std::vector<std::vector<double>> &rows,
              const std::vector<unsigned int>  &columns,
              const double                      tolerance)
  {
    unsigned int n_done = 0;
    for (const unsigned int column : columns)
      {
        const auto largest =
          std::max_element(rows.begin() + n_done,
                           rows.end(),
                           [&](const auto &a, const auto &b) {
                             return std::abs(a[column]) < std::abs(b[column]);
                           });
        if (largest == rows.end() || std::abs((*largest)[column]) < tolerance)
          continue;
        std::swap(*largest, rows[n_done]);
        std::vector<double> &pivot  = rows[n_done++];
        const double         factor = 1 / pivot[column];
        for (double &entry : pivot)
          entry *= factor;
        for (std::vector<double> &row : rows)
          if (&row != &pivot)
            {
              const double part = row[column];
              for (unsigned int j = 0; j < row.size(); ++j)
                row[j] -= part * pivot[j];
            }
      }
    rows.resize(n_done);
  }

  RigidMotions::RigidMotions(const Discretization      &discretization,
                             const PrescribedMotion    &motion,
                             const std::vector<Spring> &springs,
                             const double               tolerance)
    : discretization(discretization)
    , motion(motion)
    , parts(discretization)
    , numbers_of_parts(parts.n_parts)
  {
    const EquationsOfParts all =
      equations_of_parts(discretization, motion, springs, parts);
    DisjointSets sets(parts.n_parts);
    for (const auto &[pair, equations] : all)
      sets.unite(pair.first, pair.second);
    const auto [numbers, n_clusters] = sets.numbers();
    std::vector<Cluster>      clusters(n_clusters);
    std::vector<unsigned int> place(parts.n_parts);
    for (unsigned int part = 0; part < parts.n_parts; ++part)
      {
        place[part] = clusters[numbers[part]].size();
        clusters[numbers[part]].push_back(part);
      }
    // Equations in the unknowns of each cluster, scaled to root mean squares.
    std::vector<std::vector<std::vector<double>>> rows(n_clusters);
    for (const auto &[pair, equations] : all)
      {
        const unsigned int c = numbers[pair.first], n = equations.n;
        if (clusters[c].size() > max_cluster_size)
          continue;
        const double factor = 1 / std::sqrt(equations.count);
        for (unsigned int i = 0; i < n; ++i)
          {
            rows[c].emplace_back(6 * clusters[c].size());
            for (unsigned int j = 0; j < n; ++j)
              rows[c]
                .back()[6 * place[j < 6 ? pair.first : pair.second] + j % 6] =
                factor * equations.R[n * i + j];
          }
      }
    for (unsigned int c = 0; c < n_clusters; ++c)
      if (clusters[c].size() <= max_cluster_size)
        solve(clusters[c], rows[c], tolerance);
      else
        complete = false;
  }

  void
  RigidMotions::solve(const Cluster                    &cluster,
                      std::vector<std::vector<double>> &equations,
                      const double                      tolerance)
  {
    const unsigned int n     = 6 * cluster.size();
    auto               basis = null_space(equations, n, tolerance);
    reduce_rows(basis, in_order(n), no_pivot);
    // Entries that should be zero but have round-off would make forces in the
    // stiffest springs, so they are set to zero.
    constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
    for (std::vector<double> &numbers : basis)
      {
        for (double &number : numbers)
          if (std::abs(number) < round_off)
            number = 0;
        motions.emplace_back();
        for (unsigned int p = 0; p < cluster.size(); ++p)
          {
            Numbers of_part;
            std::copy_n(&numbers[std::size_t(6) * p], 6, of_part.begin());
            motions.back().emplace_back(cluster[p], of_part);
            numbers_of_parts[cluster[p]].emplace_back(of_part.begin(),
                                                      of_part.end());
          }
      }
  }

  void
  RigidMotions::evaluate(Vector &u, const unsigned int k) const
  {
    std::vector<Numbers> numbers(parts.n_parts);
    for (const auto &[part, of_part] : motions[k])
      numbers[part] = of_part;
    for (unsigned int n = 0; n < parts.part_of_node.size(); ++n)
      {
        const unsigned int         part = parts.part_of_node[n];
        const Numbers             &m    = numbers[part];
        const dealii::Tensor<1, 3> r =
          (discretization.node_position(n) - parts.centres[part]) /
          parts.radii[part];
        for (unsigned int a = 0; a < 3; ++a)
          {
            const unsigned int b = (a + 1) % 3, c = (a + 2) % 3;
            u.local_element(3 * n + a) =
              m[a] + m[3 + b] * r[c] - m[3 + c] * r[b];
          }
      }
    motion.set_zero(u);
  }

  std::vector<RigidMotions::Numbers>
  RigidMotions::motions_of(const unsigned int part) const
  {
    std::vector<std::vector<double>> rows = numbers_of_parts[part];
    // Rotations are eliminated first, so that the remaining rows are pure
    // translations.
    reduce_rows(rows, {3, 4, 5, 0, 1, 2}, no_pivot);
    std::vector<Numbers> result(rows.size());
    for (unsigned int k = 0; k < rows.size(); ++k)
      std::copy_n(rows[k].begin(), 6, result[k].begin());
    return result;
  }
} // namespace corotet
