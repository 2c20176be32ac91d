// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/ghosted_copy.h>
#include <corotet/solvers/anasazi_adapter.h>
#include <corotet/solvers/eigenvalue_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <AnasaziBasicEigenproblem.hpp>
#include <AnasaziBlockKrylovSchurSolMgr.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  namespace
  {
    // Vectors of a block, as symmetric bodies have pairs of modes.
    constexpr unsigned int block_size = 2;

    // Number of basis vectors beyond those sought. With fewer the search takes
    // more solves.
    constexpr unsigned int n_extra_vectors = 50;

    // Pairs sought beyond those wanted: a search is slow if the first pair that
    // is left out is close to the last one that it must find.
    constexpr unsigned int n_extra_pairs = 6;
  } // namespace

  class EigenvalueSolver::ShiftedInverse : public BlockOperator
  {
  public:
    ShiftedInverse(EigenvalueSolver &solver)
      : solver(solver)
    {}

    void
    apply(const MultiVector &X, MultiVector &Y) const override
    {
      for (unsigned int j = 0; j < X.size(); ++j)
        {
          Y[j] = X[j];
          solver.apply_inverse(Y[j]);
          solver.set_zero(Y[j]);
        }
    }

  private:
    EigenvalueSolver &solver;
  };

  class EigenvalueSolver::FreeMass : public BlockOperator
  {
  public:
    FreeMass(const EigenvalueSolver &solver)
      : solver(solver)
    {}

    void
    apply(const MultiVector &X, MultiVector &Y) const override
    {
      for (unsigned int j = 0; j < X.size(); ++j)
        {
          copy_with_ghosts(solver.ghosted, X[j]);
          solver.A.mass().apply(Y[j], solver.ghosted);
          solver.set_zero(Y[j]);
        }
    }

  private:
    const EigenvalueSolver &solver;
  };

  EigenvalueSolver::EigenvalueSolver(
    EffectiveOperator                       &A,
    LinearSolver                            &linear_solver,
    const double                             tolerance,
    std::vector<Vector>                      null_space,
    const std::function<void(unsigned int)> &progress)
    : A(A)
    , linear_solver(linear_solver)
    , tolerance(tolerance)
    , progress(progress)
    , generator(1 + dealii::Utilities::MPI::this_mpi_process(
                      A.discretization().communicator()))
  {
    A.discretization().initialize_vector(ghosted);
    A.discretization().initialize_vector(right_side);
    for (unsigned int i = 0; i < ghosted.locally_owned_size(); ++i)
      if (!A.is_prescribed()[i])
        free.push_back(i);
    n_free =
      dealii::Utilities::MPI::sum(static_cast<dealii::types::global_dof_index>(
                                    free.size()),
                                  A.discretization().communicator());
    this->null_space = orthonormal(std::move(null_space));
  }

  EigenvalueSolver::Basis
  EigenvalueSolver::orthonormal(std::vector<Vector> vectors)
  {
    // The Gram-Schmidt process is applied twice: the first pass leaves
    // round-off of vectors that were far from orthogonal.
    Basis  result;
    Vector Mx(right_side);
    for (Vector &x : vectors)
      {
        for (unsigned int round = 0; round < 2; ++round)
          {
            result.remove_from(x);
            copy_with_ghosts(ghosted, x);
            A.mass().apply(Mx, ghosted);
            set_zero(Mx);
            const double factor = 1 / std::sqrt(x * Mx);
            x *= factor;
            Mx *= factor;
          }
        result.vectors.push_back(std::move(x));
        result.M_vectors.push_back(Mx);
      }
    return result;
  }

  void
  EigenvalueSolver::Basis::remove_from(Vector &x) const
  {
    for (unsigned int k = 0; k < vectors.size(); ++k)
      x.add(-(x * M_vectors[k]), vectors[k]);
  }

  double
  EigenvalueSolver::lowest_eigenvalue(const double        shift,
                                      std::vector<Vector> motions,
                                      const bool          of_strain)
  {
    A.update(1., shift);
    const Basis basis = orthonormal(std::move(motions));
    Vector      x(right_side), f(x), g(x);
    std::uniform_real_distribution<double> random(-1, 1);
    x = 0;
    for (const unsigned int i : free)
      x.local_element(i) = random(generator);
    for (unsigned int step = 0; step < 3; ++step)
      {
        apply_inverse(x);
        basis.remove_from(x);
      }
    apply(f, g, x);
    if (of_strain)
      A.elasticity().apply_tangent(f, ghosted);
    return (x * f) / (x * g);
  }

  void
  EigenvalueSolver::set_zero(Vector &x) const
  {
    for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
      if (A.is_prescribed()[i])
        x.local_element(i) = 0;
  }

  void
  EigenvalueSolver::apply(Vector &f, Vector &g, const Vector &x) const
  {
    copy_with_ghosts(ghosted, x);
    A.elasticity().apply_tangent(f, ghosted);
    A.add_surface(f, ghosted);
    A.mass().apply(g, ghosted);
    set_zero(f);
    set_zero(g);
  }

  void
  EigenvalueSolver::apply_inverse(Vector &x)
  {
    copy_with_ghosts(ghosted, x);
    A.mass().apply(right_side, ghosted);
    set_zero(right_side);
    n_iterations += linear_solver.solve(A,
                                        x,
                                        right_side,
                                        A.discretization().node_positions());
    progress(++n_solves);
  }

  Eigenpairs
  EigenvalueSolver::search(const unsigned int n,
                           const double       shift,
                           const double       tolerance,
                           const Eigenpairs  &others)
  {
    using Teuchos::RCP;
    using Teuchos::rcp;
    const auto space = std::make_shared<VectorSpace>(right_side, free);
    const auto start = rcp(new MultiVector(space, block_size));
    std::uniform_real_distribution<double> random(-1, 1);
    for (unsigned int j = 0; j < block_size; ++j)
      for (const unsigned int i : free)
        (*start)[j].local_element(i) = random(generator);

    Anasazi::BasicEigenproblem<double, MultiVector, BlockOperator> problem;
    problem.setOperator(rcp(new ShiftedInverse(*this)));
    problem.setM(rcp(new FreeMass(*this)));
    problem.setInitVec(start);
    // Solves of finite accuracy are not quite symmetric, so equal eigenvalues
    // come as conjugate pairs, with which the symmetric variant fails at a
    // restart. A Rayleigh-Ritz step corrects that.
    problem.setHermitian(false);
    problem.setNEV(n);
    std::vector<const Vector *> known;
    for (const Vector &x : null_space.vectors)
      known.push_back(&x);
    for (const Vector &x : others.vectors)
      known.push_back(&x);
    if (!known.empty())
      {
        const auto columns = rcp(new MultiVector(space, known.size()));
        for (unsigned int j = 0; j < known.size(); ++j)
          {
            (*columns)[j] = *known[j];
            set_zero((*columns)[j]);
          }
        problem.setAuxVecs(columns);
      }
    problem.setProblem();

    // The basis must not fill the space, as there would be no next vector.
    const unsigned int n_basis = std::min<dealii::types::global_dof_index>(
      n + std::max(n, n_extra_vectors), (n_free - known.size()) / 2);
    Teuchos::ParameterList list;
    list.set("Which", "LM");
    list.set("Block Size", static_cast<int>(block_size));
    list.set("Num Blocks", static_cast<int>(n_basis / block_size));
    list.set("Step Size", 1);
    list.set("Maximum Restarts", 100);
    list.set("Orthogonalization", "DGKS");
    list.set("Convergence Tolerance", tolerance);
    list.set("Verbosity", 0);
    Anasazi::BlockKrylovSchurSolMgr<double, MultiVector, BlockOperator> manager(
      rcp(&problem, false), list);
    if (manager.solve() != Anasazi::Converged)
      throw ComputationError(
        fmt::format("the eigenvalue solver found {} of {} modes in {} linear "
                    "solves",
                    problem.getSolution().numVecs,
                    n,
                    n_solves));

    const auto &solution = problem.getSolution();
    Eigenpairs  pairs;
    for (int j = 0; j < solution.numVecs; ++j)
      {
        pairs.values.push_back(1 / solution.Evals[j].realpart - shift);
        pairs.vectors.push_back((*solution.Evecs)[j]);
      }
    return pairs;
  }

  void
  EigenvalueSolver::rayleigh_ritz(Eigenpairs &pairs) const
  {
    const unsigned int  n = pairs.vectors.size();
    std::vector<Vector> Kx(pairs.vectors), Mx(pairs.vectors);
    for (unsigned int j = 0; j < n; ++j)
      apply(Kx[j], Mx[j], pairs.vectors[j]);
    dealii::LAPACKFullMatrix<double> K(n, n), M(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          K(i, j) = pairs.vectors[i] * Kx[j];
          M(i, j) = pairs.vectors[i] * Mx[j];
        }
    std::vector<dealii::Vector<double>> ritz(n);
    try
      {
        K.compute_generalized_eigenvalues_symmetric(M, ritz);
      }
    catch (const dealii::ExceptionBase &)
      {
        throw ComputationError(
          "the modes are lost in round-off: those that were found are not "
          "linearly independent");
      }

    std::vector<Vector> &x = Kx;
    for (unsigned int j = 0; j < n; ++j)
      {
        x[j] = 0;
        for (unsigned int i = 0; i < n; ++i)
          x[j].add(ritz[j][i], pairs.vectors[i]);
        pairs.values[j] = K.eigenvalue(j).real();
      }
    pairs.vectors.swap(x);
  }

  void
  EigenvalueSolver::refine(Eigenpairs &pairs, const unsigned int n)
  {
    // The step damps errors of the vectors from other modes, most of all from
    // those of high frequency, which residuals of K amplify. Modes of one
    // frequency mix, so all of them are included.
    constexpr double same  = 1e-6;
    unsigned int     n_all = n;
    while (n_all < pairs.vectors.size() &&
           pairs.values[n_all] <= (1 + same) * std::abs(pairs.values[n - 1]))
      ++n_all;
    for (unsigned int j = 0; j < n_all; ++j)
      {
        apply_inverse(pairs.vectors[j]);
        null_space.remove_from(pairs.vectors[j]);
      }
    rayleigh_ritz(pairs);
  }

  Eigenpairs
  EigenvalueSolver::solve(const unsigned int n_wanted, const double shift)
  {
    Eigenpairs         result;
    const unsigned int n_null =
      std::min<std::size_t>(n_wanted, null_space.vectors.size());
    result.vectors.assign(null_space.vectors.begin(),
                          null_space.vectors.begin() + n_null);
    result.values.assign(n_null, 0.);
    if (n_null == n_wanted)
      return result;

    A.update(1., shift);
    const unsigned int n = n_wanted - n_null;
    const unsigned int n_sought =
      n + std::min(n_extra_pairs, max_eigenvalues() - n_wanted);
    Eigenpairs pairs = search(n_sought, shift, tolerance, {});
    refine(pairs, n);
    // Values far below the shift look alike to the search: the errors of their
    // vectors are small relative to the shift, but not to these values. Another
    // step makes the errors of a mode with value lambda smaller by the factor 1
    // + lambda / shift.
    const unsigned int n_below_shift =
      std::count_if(pairs.values.begin(),
                    pairs.values.begin() + n,
                    [&](const double value) { return value < shift; });
    if (n_below_shift > 0)
      refine(pairs, n_below_shift);
    // A value that a search finds exceeds the true one at most by the square of
    // its tolerance.
    unsigned int n_missing = 0;
    double       next      = 0;
    while ((next = search(1, shift, 1e-3, pairs).values[0]) + shift <
           (1 - 1e-6) * (pairs.values[n - 1] + shift))
      {
        if (++n_missing > n)
          throw ComputationError(
            fmt::format("the eigenvalue solver finds more and more modes below "
                        "the lowest {}; the linear solver may not be accurate "
                        "enough",
                        n_wanted));
        Eigenpairs missing = search(1, shift, tolerance, pairs);
        pairs.vectors.push_back(missing.vectors[0]);
        pairs.values.push_back(missing.values[0]);
        refine(pairs, pairs.vectors.size());
      }
    pairs.values.push_back(next);
    result.values.insert(result.values.end(),
                         pairs.values.begin(),
                         pairs.values.end());
    for (unsigned int j = 0; j < n; ++j)
      result.vectors.push_back(std::move(pairs.vectors[j]));
    return result;
  }
} // namespace corotet
