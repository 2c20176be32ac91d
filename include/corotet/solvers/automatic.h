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
   * p-multigrid or a sparse factorisation, whichever is the faster way for the
   * body at hand.
   *
   * What a factorisation costs follows from that of degree 1, which the
   * multigrid has: it is said in iterations of the multigrid. Where cells are
   * so flat or stretched that these will not be enough, the body is factorised
   * at once; elsewhere when solves have spent as many in vain, if need be in
   * the middle of one. So a solve takes at most about twice as long as by the
   * better way. Where rotations or time steps make factors outdated so often
   * that solves cost more than they did, the multigrid comes back; factors are
   * tried again when it has cost four times as much as that try, and each time
   * twice as long after, as bodies that move far become others. A solve with
   * older factors gets new ones when it has cost as much as these.
   *
   * Exact tangents get factors only where many cells are flat or stretched, or
   * a material is nearly incompressible. Others are slow where they are
   * indefinite alone, far from the solution: they get factors of the frozen
   * matrix, and where cells are well-shaped not in the middle of a solve, which
   * may fail with them as well.
   *
   * Everything is counted and nothing is measured: runs repeat to the last
   * digit.
   */
  class AutomaticPreconditioner : public Preconditioner
  {
  public:
    /// @p parameters are those of the multigrid, which others declare.
    explicit AutomaticPreconditioner(
      const std::shared_ptr<PMultigridParameters> &parameters =
        std::make_shared<PMultigridParameters>())
      : multigrid(parameters)
    {}

    /// A copy has the parameters, and nothing that has been built.
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
    /// What a sparse factorisation takes, in iterations of the multigrid.
    struct Costs
    {
      /// The first one, with its ordering; one more; a solve with the factors.
      double first, again, solve;
    };

    void
    find_costs(const EffectiveOperator &A);
    /// Makes factors; where that cannot be done, the multigrid is there for
    /// good.
    void
    factorize(const EffectiveOperator &A,
              const TangentOperator   *J,
              const Vector            &displacement);
    /// Iterations that a solve of @p n has more than one with factors takes.
    double
    too_many(const unsigned int n) const;
    /// The multigrid is used; factors are gone.
    void
    leave_factors();

    PMultigrid multigrid;
    /// Null until it is first wanted.
    std::unique_ptr<CholeskyDirect> direct;

    /// Whether exact tangents have factors of their own, once it is known.
    std::optional<bool> has_factors_of_tangents;
    bool                is_direct  = false;
    bool                is_settled = false;
    bool                has_costs  = false;
    /// Solves with the multigrid, their iterations, and those in vain.
    unsigned int n_multigrid = 0;
    double       iterations  = 0;
    double       in_vain     = 0;
    /// How many in vain until factors are tried again; 0 before the first time.
    double wait = 0;
    /// Solves with factors since these are in use, and what they have cost.
    unsigned int n_direct    = 0;
    double       direct_cost = 0;
    Costs        costs{std::numeric_limits<double>::infinity(), 0, 0};
    std::string  news;
  };
} // namespace corotet

#endif
