// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/laws/law_kind.h>
#include <corotet/operators/law_sweeps.h>

namespace corotet
{
  namespace
  {
    using dealii::Tensor;

    // Calls action(lane, material) for the lanes that have a cell: a law may
    // divide by the parameters, which are zero in others.
    template <typename Action>
    void
    for_each_cell(const LameLanes &lame, const Action &action)
    {
      for (int lane = 0; lane < n_lanes<double>; ++lane)
        if (lame.mu[lane] > 0)
          action(lane, IsotropicMaterial{lame.lambda[lane], lame.mu[lane], 0.});
    }

    // Calls a PointLaw lane by lane.
    struct LawByLane
    {
      // The numbers stored are H.
      static constexpr int n_stored = 9;

      void
      stress(const LameLanes    &lame,
             const Tensor2Lanes &H,
             Tensor2Lanes       &P) const
      {
        set_zero(P);
        for_each_cell(lame, [&](const int lane, const auto &material) {
          to_lane(law->stress(material, internal::of_lane(H, lane)), lane, P);
        });
      }

      Simd<double>
      energy_density(const LameLanes &lame, const Tensor2Lanes &H) const
      {
        Simd<double> energy{};
        for_each_cell(lame, [&](const int lane, const auto &material) {
          energy[lane] =
            law->energy_density(material, internal::of_lane(H, lane));
        });
        return energy;
      }

      unsigned int
      linearize(const LameLanes &,
                const Tensor2Lanes    &H,
                NumberLanes<n_stored> &stored) const
      {
        static_for<9>([&](auto i) { stored[i] = H[i / 3][i % 3]; });
        return 0;
      }

      void
      derivative(const LameLanes             &lame,
                 const NumberLanes<n_stored> &stored,
                 const Tensor2Lanes          &dF,
                 Tensor2Lanes                &dP) const
      {
        set_zero(dP);
        for_each_cell(lame, [&](const int lane, const auto &material) {
          Tensor<2, 3> H;
          static_for<9>([&](auto i) { H[i / 3][i % 3] = stored[i][lane]; });
          to_lane(law->stress_derivative(material,
                                         H,
                                         internal::of_lane(dF, lane)),
                  lane,
                  dP);
        });
      }

      const PointLaw *law = nullptr;

    private:
      static void
      set_zero(Tensor2Lanes &values)
      {
        static_for<9>([&](auto i) { values[i / 3][i % 3] = Simd<double>{}; });
      }

      static void
      to_lane(const Tensor<2, 3> &value, const int lane, Tensor2Lanes &result)
      {
        static_for<9>(
          [&](auto i) { result[i / 3][i % 3][lane] = value[i / 3][i % 3]; });
      }
    };

    class PointMaterialLaw : public MaterialLawOf<LawByLane>
    {
    public:
      explicit PointMaterialLaw(const std::shared_ptr<const PointLaw> &law)
        : MaterialLawOf<LawByLane>({law.get()})
        , owner(law)
      {}

    private:
      const std::shared_ptr<const PointLaw> owner;
    };
  } // namespace

  std::shared_ptr<const MaterialLaw>
  material_law(const std::shared_ptr<const PointLaw> &law)
  {
    return std::make_shared<PointMaterialLaw>(law);
  }
} // namespace corotet
