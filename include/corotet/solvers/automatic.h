// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_automatic_h
#define corotet_solvers_automatic_h

#include <corotet/solvers/direct.h>
#include <corotet/solvers/p_multigrid.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace corotet
{
  /**
   * Preconditions with p-multigrid or a sparse factorisation, whichever is
   * faster for the body at hand.
   *
   * The cost of a factorisation is expressed in iterations of the multigrid,
   * and follows from that of degree 1, which the multigrid has. Where cells are
   * so flat or stretched that more iterations than these are expected, the body
   * is factorised at once; elsewhere when solves have wasted as many
   * iterations, if need be in the middle of a solve. So a solve takes at most
   * about twice as long as with the better choice. Where rotations or time
   * steps make factors outdated so often that solves cost more than with the
   * multigrid, it comes back; factors are tried again when it has cost four
   * times as much as that trial, and after each further trial the wait doubles,
   * as bodies that move far change. A solve with older factors gets new ones
   * when it has cost as much as these.
   *
   * Exact tangents are factorised only where many cells are flat or stretched,
   * or a material is nearly incompressible. Solves with other exact tangents
   * are slow only where these are indefinite, far from the solution: then the
   * frozen matrix is factorised, and with well-shaped cells not in the middle
   * of a solve, which may fail with its factors as well.
   *
   * Decisions depend on counts and not on measured times: runs repeat to the
   * last digit.
   */
  class AutomaticPreconditioner : public Preconditioner
  {
  public:
    /// @p parameters are those of the multigrid; another preconditioner
    /// declares them.
    explicit AutomaticPreconditioner(
      const std::shared_ptr<PMultigridParameters> &parameters =
        std::make_shared<PMultigridParameters>())
      : multigrid(parameters)
    {}

    /// A copy has the parameters, but nothing that has been built.
    AutomaticPreconditioner(const AutomaticPreconditioner &other)
      : Preconditioner()
      , multigrid(other.multigrid)
    {}

    AutomaticPreconditioner &
    operator=(const AutomaticPreconditioner &) = delete;
    ~AutomaticPreconditioner() override        = default;

    void
    build(const EffectiveOperator &A, const Vector &displacement) override;

    void
    build_for(const EffectiveOperator &A,
              const TangentOperator   *J,
              const Vector            &displacement) override;

    void
    update(const EffectiveOperator &A) override;

    void
    vmult(Vector &dst, const Vector &src) const override;

    void
    vmult_with_norm(Vector       &dst,
                    const Vector &src,
                    const double  src_norm) const override;

    unsigned int
    acceptable_iterations(const unsigned int first) const override;

    double
    build_cost() const override
    {
      return is_direct ? direct->build_cost() : multigrid.build_cost();
    }

    double
    cost() const override
    {
      return is_direct ? costs.solve : 1.;
    }

    unsigned int
    patience(const bool is_new, const bool is_tangent) const override;

    bool
    change(const EffectiveOperator &A,
           const TangentOperator   *J,
           const Vector            &displacement,
           const unsigned int       n_iterations,
           const double             n_expected) override;

    bool
    is_worth_another(const unsigned int n_iterations) const override
    {
      return is_direct && direct->is_worth_another(n_iterations);
    }

    bool
    take_note(const unsigned int n_iterations, const bool was_built) override;

    std::string
    take_news() override;

    void
    transfer(Archive &archive) override;

  private:
    /// Costs of a sparse factorisation, in iterations of the multigrid.
    struct Costs
    {
      /// Costs of the first factorisation, with its ordering; of each further
      /// one; and of an iteration with the factors.
      double first, again, solve;
    };

    void
    find_costs(const EffectiveOperator &A);
    /// Computes factors; if that fails, the multigrid stays in use for good.
    void
    factorize(const EffectiveOperator &A,
              const TangentOperator   *J,
              const Vector            &displacement);
    /// The number of iterations that a solve with @p n iterations has wasted
    /// compared with one with factors.
    double
    too_many(const unsigned int n) const;
    /// Returns to the multigrid and drops the factors.
    void
    leave_factors();

    PMultigrid multigrid;
    /// The factorisation; null until it is first needed.
    std::unique_ptr<CholeskyDirect> direct;

    /// Whether exact tangents have factors of their own, once that is known.
    std::optional<bool> has_factors_of_tangents;
    bool                is_direct  = false;
    bool                is_settled = false;
    bool                has_costs  = false;
    /// Solves with the multigrid, their iterations, and the wasted ones of
    /// these.
    unsigned int n_multigrid = 0;
    double       iterations  = 0;
    double       in_vain     = 0;
    /// Wasted iterations after which factors are tried again; 0 before the
    /// first trial.
    double wait = 0;
    /// Solves with factors since these have been in use, and their cost.
    unsigned int n_direct    = 0;
    double       direct_cost = 0;
    Costs        costs{std::numeric_limits<double>::infinity(), 0, 0};
    std::string  news;
  };
} // namespace corotet

#endif
