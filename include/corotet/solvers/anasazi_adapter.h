// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_anasazi_adapter_h
#define corotet_solvers_anasazi_adapter_h

#include <corotet/solvers/multi_vector.h>

#include <AnasaziMultiVecTraits.hpp>
#include <AnasaziOperatorTraits.hpp>

#include <cmath>
#include <numeric>
#include <ostream>
#include <vector>

namespace corotet
{
  /**
   * A linear operator on the columns of a MultiVector, for Anasazi.
   */
  class BlockOperator
  {
  public:
    virtual ~BlockOperator() = default;

    /// Y = Op X. X and Y have no column in common. Collective.
    virtual void
    apply(const MultiVector &X, MultiVector &Y) const = 0;
  };
} // namespace corotet

namespace Anasazi
{
  /**
   * Makes MultiVector usable by Trilinos' Anasazi. The functions and their
   * arguments are defined by Anasazi (see AnasaziMultiVecTraits.hpp).
   */
  template <>
  class MultiVecTraits<double, corotet::MultiVector>
  {
    using MV      = corotet::MultiVector;
    using Matrix  = Teuchos::SerialDenseMatrix<int, double>;
    using Numbers = std::vector<int>;
    using Range   = Teuchos::Range1D;

    static Numbers
    numbers(const Range &range)
    {
      Numbers result(range.size());
      std::iota(result.begin(), result.end(), range.lbound());
      return result;
    }

  public:
    static Teuchos::RCP<MV>
    Clone(const MV &mv, const int n)
    {
      return Teuchos::rcp(new MV(mv.space(), n));
    }

    static Teuchos::RCP<MV>
    CloneCopy(const MV &mv)
    {
      return Teuchos::rcp(new MV(mv.copy()));
    }

    static Teuchos::RCP<MV>
    CloneCopy(const MV &mv, const Numbers &index)
    {
      return Teuchos::rcp(new MV(mv.view(index).copy()));
    }

    static Teuchos::RCP<MV>
    CloneCopy(const MV &mv, const Range &index)
    {
      return CloneCopy(mv, numbers(index));
    }

    static Teuchos::RCP<MV>
    CloneViewNonConst(MV &mv, const Numbers &index)
    {
      return Teuchos::rcp(new MV(mv.view(index)));
    }

    static Teuchos::RCP<MV>
    CloneViewNonConst(MV &mv, const Range &index)
    {
      return CloneViewNonConst(mv, numbers(index));
    }

    static Teuchos::RCP<const MV>
    CloneView(const MV &mv, const Numbers &index)
    {
      return Teuchos::rcp(new MV(mv.view(index)));
    }

    static Teuchos::RCP<const MV>
    CloneView(const MV &mv, const Range &index)
    {
      return CloneView(mv, numbers(index));
    }

    static std::ptrdiff_t
    GetGlobalLength(const MV &mv)
    {
      return mv.space()->dimension;
    }

    static int
    GetNumberVecs(const MV &mv)
    {
      return mv.size();
    }

    static void
    MvTimesMatAddMv(const double  alpha,
                    const MV     &A,
                    const Matrix &B,
                    const double  beta,
                    MV           &mv)
    {
      mv.add_product(alpha,
                     A,
                     {B.values(),
                      static_cast<unsigned int>(B.numRows()),
                      static_cast<unsigned int>(B.numCols()),
                      static_cast<unsigned int>(B.stride())},
                     beta);
    }

    static void
    MvAddMv(const double alpha,
            const MV    &A,
            const double beta,
            const MV    &B,
            MV          &mv)
    {
      mv.set_to_sum(alpha, A, beta, B);
    }

    static void
    MvScale(MV &mv, const double alpha)
    {
      for (unsigned int j = 0; j < mv.size(); ++j)
        mv[j] *= alpha;
    }

    static void
    MvScale(MV &mv, const std::vector<double> &alpha)
    {
      for (unsigned int j = 0; j < mv.size(); ++j)
        mv[j] *= alpha[j];
    }

    static void
    MvTransMv(const double alpha, const MV &A, const MV &B, Matrix &C)
    {
      MV::products({C.values(),
                    static_cast<unsigned int>(C.numRows()),
                    static_cast<unsigned int>(C.numCols()),
                    static_cast<unsigned int>(C.stride())},
                   alpha,
                   A,
                   B);
    }

    /// @p b may have more entries than there are columns.
    static void
    MvDot(const MV &mv, const MV &A, std::vector<double> &b)
    {
      const std::vector<double> dots = mv.dots(A);
      std::copy(dots.begin(), dots.end(), b.begin());
    }

    static void
    MvNorm(const MV &mv, std::vector<double> &norms)
    {
      MvDot(mv, mv, norms);
      for (unsigned int j = 0; j < mv.size(); ++j)
        norms[j] = std::sqrt(norms[j]);
    }

    static void
    SetBlock(const MV &A, const Numbers &index, MV &mv)
    {
      mv.view(index).assign(
        A.size() > index.size() ?
          A.view(numbers(Range(0, static_cast<int>(index.size()) - 1))) :
          A);
    }

    static void
    SetBlock(const MV &A, const Range &index, MV &mv)
    {
      SetBlock(A, numbers(index), mv);
    }

    static void
    Assign(const MV &A, MV &mv)
    {
      mv.assign(A);
    }

    static void
    MvRandom(MV &mv)
    {
      mv.set_random();
    }

    static void
    MvInit(MV &mv, const double alpha = 0)
    {
      mv.fill(alpha);
    }

    static void
    MvPrint(const MV &mv, std::ostream &out)
    {
      for (unsigned int j = 0; j < mv.size(); ++j)
        mv[j].print(out);
    }

#ifdef HAVE_ANASAZI_TSQR
    using tsqr_adaptor_type = details::StubTsqrAdapter<MV>;
#endif
  };

  template <>
  class OperatorTraits<double, corotet::MultiVector, corotet::BlockOperator>
  {
  public:
    static void
    Apply(const corotet::BlockOperator &op,
          const corotet::MultiVector   &x,
          corotet::MultiVector         &y)
    {
      op.apply(x, y);
    }
  };
} // namespace Anasazi

#endif
