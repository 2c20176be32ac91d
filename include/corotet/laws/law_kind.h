// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_laws_law_kind_h
#define corotet_laws_law_kind_h

#include <corotet/base/selectable.h>
#include <corotet/laws/rotation.h>
#include <corotet/material/material_law.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * A kind of law that Material/Type names: its parameters, and the law that is
   * made of them.
   */
  class LawKind
  {
  public:
    virtual ~LawKind() = default;

    /// Declares its entries: the caller has entered the section of the law's
    /// name in section Material.
    virtual void
    declare_parameters(dealii::ParameterHandler & /*prm*/)
    {}

    /// Whether Material/Rotation makes a difference to the law.
    virtual bool
    has_rotations() const
    {
      return false;
    }

    /// Makes the law. @p rotation is the value of Material/Rotation.
    virtual std::shared_ptr<const MaterialLaw>
    make(const Rotation rotation) const = 0;
  };

  /// All kinds of laws, with those that programs have added.
  std::vector<Candidate<LawKind>>
  law_kinds();

  /// Makes a MaterialLaw of a program's law, which is written at a point.
  /// law_candidate() registers it.
  std::shared_ptr<const MaterialLaw>
  material_law(const std::shared_ptr<const PointLaw> &law);

  /// A kind whose law is made by a function without arguments.
  inline Candidate<LawKind>
  law_candidate(const std::string                                         &name,
                const std::function<std::shared_ptr<const MaterialLaw>()> &law)
  {
    class Kind : public LawKind
    {
    public:
      explicit Kind(
        const std::function<std::shared_ptr<const MaterialLaw>()> &law)
        : law(law)
      {}

      std::shared_ptr<const MaterialLaw>
      make(const Rotation) const override
      {
        return law();
      }

    private:
      const std::function<std::shared_ptr<const MaterialLaw>()> law;
    };
    return candidate<LawKind, Kind>(name, law);
  }
} // namespace corotet

#endif
