// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/laws/corotational.h>
#include <corotet/laws/neo_hookean.h>
#include <corotet/laws/saint_venant_kirchhoff.h>

#include "case_data.h"
#include "svd_rotation.h"

namespace corotet::benchmarks
{
  namespace
  {
    using Matrix = Eigen::Matrix3d;

    /// The deformation gradients at the centres of all cells.
    std::vector<Matrix>
    deformation_gradients(const Problem &problem, const Vector &u)
    {
      const auto         &discretization = problem.discretization;
      const auto         &gradients      = problem.reference.centre.gradients;
      std::vector<Matrix> F(discretization.n_local_cells());
      for (unsigned int c = 0; c < F.size(); ++c)
        {
          const auto           nodes = discretization.cell_nodes(c);
          dealii::Tensor<2, 3> by_xi;
          for (unsigned int i = 0; i < nodes.size(); ++i)
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int k = 0; k < 3; ++k)
                by_xi[a][k] +=
                  u.local_element(3 * nodes[i] + a) * gradients(0, i, k);
          const auto grad_u =
            by_xi * discretization.geometry(c).inverse_jacobian;
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = 0; b < 3; ++b)
              F[c](a, b) = grad_u[a][b] + (a == b ? 1 : 0);
        }
      return F;
    }

    Measured
    make_svd_rotations(CaseData &data)
    {
      Problem     &problem = data.problem();
      const Vector u       = problem.deformed();
      const auto   F       = std::make_shared<std::vector<Matrix>>(
        deformation_gradients(problem, u));
      const auto R      = std::make_shared<std::vector<Matrix>>(F->size());
      const auto action = [F, R] {
        for (std::size_t c = 0; c < F->size(); ++c)
          (*R)[c] = svd_rotation((*F)[c]);
      };
      action();
      problem.elasticity.update_rotations(u);
      double difference = 0;
      for (std::size_t c = 0; c < F->size(); ++c)
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            difference =
              std::max(difference,
                       std::abs((*R)[c](a, b) -
                                problem.elasticity.rotation(c)[a][b]));
      problem.reset_rotations();
      return {action,
              {{"cells", static_cast<double>(F->size())},
               {"difference", difference}}};
    }

    Counters
    cells(CaseData &data)
    {
      return {
        {"cells",
         static_cast<double>(data.problem().discretization.n_local_cells())}};
    }

    /// While this object lives, rotations and operator may be those of the
    /// deformed beam; afterwards they are those of the state of solves again.
    struct DeformedBeam
    {
      explicit DeformedBeam(CaseData &data)
        : data(data)
        , u(data.problem().deformed())
        , f(data.problem().vector())
      {}

      DeformedBeam(const DeformedBeam &) = delete;
      DeformedBeam &
      operator=(const DeformedBeam &) = delete;

      ~DeformedBeam()
      {
        data.problem().reset_rotations();
        data.effective().update(1., 0.);
      }

      CaseData    &data;
      const Vector u;
      Vector       f;
    };

    /// The steps of a Newton iteration before its solve, with a preconditioner
    /// of an earlier iteration.
    Measured
    make_setup_after_rotation(CaseData &data)
    {
      const double dt   = first_period() / 100;
      const double c_M  = 4 / (dt * dt);
      const auto   beam = std::make_shared<DeformedBeam>(data);
      const std::shared_ptr<Preconditioner> P =
        make_preconditioner("p-multigrid");
      data.effective().update(1., c_M);
      P->build(data.effective(), data.problem().state_of_solves());
      return {[beam, P, c_M] {
                EffectiveOperator &A = beam->data.effective();
                beam->data.problem().elasticity.update_rotations_and_force(
                  beam->f, beam->u);
                A.update(1., c_M);
                P->update(A);
              },
              cells(data)};
    }

    /// The vectors of an explicit step.
    struct Explicit
    {
      explicit Explicit(const Problem &p)
        : u(p.deformed())
        , v(p.vector())
        , g(p.weight())
        , inverse_mass(p.vector())
      {
        u.zero_out_ghost_values();
        const Mass lumped(p.discretization,
                          p.reference,
                          {{0, density}, {1, density}},
                          MassType::diagonal_scaling);
        for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
          inverse_mass.local_element(i) =
            p.motion.is_prescribed()[i] ?
              0 :
              1 / lumped.diagonal().local_element(i);
      }

      Vector u, v, g, inverse_mass;
    };

    Measured
    make_explicit_step(CaseData &data)
    {
      // This time step is far below the limit of stability.
      constexpr double dt   = 1e-8;
      Problem         &p    = data.problem();
      const auto       beam = std::make_shared<DeformedBeam>(data);
      const auto       s    = std::make_shared<Explicit>(p);
      Vector           v(s->v);
      p.elasticity.update_rotations_and_force(v, beam->u);
      v.sadd(-1., s->g);
      v.scale(s->inverse_mass);
      v *= dt;
      p.elasticity.explicit_step(s->u, s->v, s->g, s->inverse_mass, dt);
      const double size = v.linfty_norm();
      v -= s->v;
      Counters counters      = cells(data);
      counters["unknowns"]   = p.n_unknowns();
      counters["difference"] = v.linfty_norm() / size;
      return {[beam, s, &p] {
                p.elasticity.explicit_step(
                  s->u, s->v, s->g, s->inverse_mass, dt);
              },
              counters};
    }

    /// The force, its linearization and the exact tangent of a law.
    void
    add_law(CaseData                                 &data,
            const std::string                        &name,
            const std::shared_ptr<const MaterialLaw> &law)
    {
      struct Deformed : DeformedBeam
      {
        Deformed(CaseData &data, const std::shared_ptr<const MaterialLaw> &law)
          : DeformedBeam(data)
          , elasticity(data.problem().elasticity_with(law))
        {
          elasticity->update_rotations_and_force(f, u);
          elasticity->linearize(u, Tangent::consistent);
        }

        std::unique_ptr<Elasticity> elasticity;
      };
      const auto make = [&data, law] {
        return std::make_shared<Deformed>(data, law);
      };
      add_short(data.name("force_" + name), [&data, make] {
        const auto beam = make();
        return Measured{[beam] {
                          beam->elasticity->update_rotations_and_force(beam->f,
                                                                       beam->u);
                        },
                        cells(data)};
      });
      add_short(data.name("linearization_" + name), [&data, make] {
        const auto beam = make();
        return Measured{[beam] {
                          beam->elasticity->linearize(beam->u,
                                                      Tangent::consistent);
                        },
                        cells(data)};
      });
      add_short(data.name("tangent_" + name), [&data, make] {
        const auto beam = make();
        return Measured{[beam] {
                          beam->elasticity->apply_linearization(
                            beam->f, beam->u, 1., 0., nullptr, nullptr);
                        },
                        cells(data)};
      });
    }
  } // namespace

  void
  add_updates(CaseData &data)
  {
    add_short(data.name("rotations_svd"),
              [&data] { return make_svd_rotations(data); });
    add_short(data.name("rotations"), [&data] {
      const auto beam = std::make_shared<DeformedBeam>(data);
      return Measured{
        [beam] { beam->data.problem().elasticity.update_rotations(beam->u); },
        cells(data)};
    });
    add_short(data.name("rotations_and_matrix"), [&data] {
      data.matrix();
      const auto beam = std::make_shared<DeformedBeam>(data);
      return Measured{[beam] {
                        beam->data.problem().elasticity.update_rotations(
                          beam->u);
                        beam->data.effective().update(1., 0.);
                        beam->data.effective().matrix();
                      },
                      cells(data)};
    });
    add_short(data.name("setup_after_rotation"),
              [&data] { return make_setup_after_rotation(data); });
    add_short(data.name("explicit_step"),
              [&data] { return make_explicit_step(data); });
    add_law(data, "cell_centre", corotational_law(Rotation::cell_centre));
    add_law(data,
            "variational",
            corotational_law(Rotation::cell_centre_variational));
    add_law(data,
            "quadrature_points",
            corotational_law(Rotation::quadrature_points));
    add_law(data, "saint_venant_kirchhoff", saint_venant_kirchhoff_law());
    // The same law, with a call for each point, as programs that add laws write
    // it.
    add_law(data,
            "saint_venant_kirchhoff_by_points",
            material_law(saint_venant_kirchhoff_law()));
    add_law(data, "neo_hookean", neo_hookean_law());
  }
} // namespace corotet::benchmarks
