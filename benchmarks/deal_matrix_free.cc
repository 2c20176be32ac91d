// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// y = K x by deal.II's own matrix-free operators, which corotet's kernels are
// meant to outperform. Elements whose degree is known at run time only, as for
// FEEvaluation on tetrahedra, are evaluated by functions of deal.II's library,
// compiled for any machine; with their templates they are compiled here, for
// the machine that corotet's kernels are compiled for.

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/matrix_free/evaluation_template_factory.templates.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#include "application.h"

namespace corotet::benchmarks
{
  namespace
  {
    /// The largest difference to the factored kernel, relative to the largest
    /// entry: a bound of the round-off of sums of some hundred terms.
    constexpr double largest_deal_difference = 1e-12;

    /// A rule that is exact for products of two gradients, of degree 2(p-1): 1,
    /// 4 and 14 points, as in corotet's quadrature. dealii::MatrixFree refuses
    /// other rules than its own.
    dealii::Quadrature<3>
    stiffness_quadrature(const unsigned int degree)
    {
      if (degree < 3)
        return dealii::QGaussSimplex<3>(degree);
      return dealii::QWitherdenVincentSimplex<3>(3);
    }

    /**
     * K of linear elasticity by dealii::MatrixFree on straight cells, with the
     * numbering of the discretization. Rows and columns of prescribed unknowns
     * are those of the unit matrix. @p problem must outlive this object.
     */
    class DealMatrixFree
    {
    public:
      using Cells  = dealii::MatrixFree<3, double>;
      using Number = dealii::VectorizedArray<double>;

      explicit DealMatrixFree(const Problem &problem)
      {
        const Discretization        &disc = problem.discretization;
        const dealii::Quadrature<3>  rule = stiffness_quadrature(disc.degree());
        const dealii::DoFHandler<3> &dofs = disc.dof_handler();
        const dealii::Utilities::MPI::Partitioner &unknowns =
          *disc.partitioner();

        dealii::AffineConstraints<double> constraints(
          unknowns.locally_owned_range(),
          dealii::DoFTools::extract_locally_relevant_dofs(dofs));
        for (unsigned int i = 0; i < problem.motion.is_prescribed().size(); ++i)
          if (problem.motion.is_prescribed()[i])
            constraints.constrain_dof_to_zero(unknowns.local_to_global(i));
        constraints.close();

        Cells::AdditionalData data;
        data.tasks_parallel_scheme = Cells::AdditionalData::none;
        data.mapping_update_flags =
          dealii::update_gradients | dealii::update_JxW_values;
        cells.reinit(disc.mapping(), dofs, constraints, rule, data);

        materials.resize(cells.n_cell_batches());
        for (unsigned int batch = 0; batch < materials.size(); ++batch)
          {
            // Curved cells would have a Jacobian for each point, and take
            // longer.
            AssertThrow(
              cells.get_mapping_info().get_cell_type(batch) <=
                dealii::internal::MatrixFreeFunctions::GeometryType::affine,
              dealii::ExcMessage("deal.II takes a straight cell for curved"));
            for (unsigned int lane = 0;
                 lane < cells.n_active_entries_per_cell_batch(batch);
                 ++lane)
              {
                const IsotropicMaterial &material = problem.materials.at(
                  cells.get_cell_iterator(batch, lane)->material_id());
                materials[batch].lambda[lane]   = material.lambda;
                materials[batch].twice_mu[lane] = 2 * material.mu;
              }
          }
      }

      /// Gives @p vector the ghosts that this operator needs; owned entries
      /// remain.
      void
      adapt(Vector &vector) const
      {
        const Vector original(vector);
        cells.initialize_dof_vector(vector);
        vector.copy_locally_owned_data_from(original);
      }

      /// y = K x.
      void
      vmult(Vector &y, const Vector &x) const
      {
        cells.cell_loop(&DealMatrixFree::apply_to_cells, this, y, x, true);
        for (const unsigned int i : cells.get_constrained_dofs())
          y.local_element(i) = x.local_element(i);
      }

    private:
      struct Material
      {
        Number lambda   = 0.;
        Number twice_mu = 0.;
      };

      void
      apply_to_cells(const Cells &,
                     Vector                                      &y,
                     const Vector                                &x,
                     const std::pair<unsigned int, unsigned int> &range) const
      {
        constexpr auto gradients = dealii::EvaluationFlags::gradients;
        dealii::FEEvaluation<3, -1, 0, 3, double> u(cells);
        for (unsigned int batch = range.first; batch < range.second; ++batch)
          {
            u.reinit(batch);
            u.gather_evaluate(x, gradients);
            const Material material = materials[batch];
            for (const unsigned int q : u.quadrature_point_indices())
              {
                const auto   strain     = u.get_symmetric_gradient(q);
                auto         stress     = material.twice_mu * strain;
                const Number volumetric = material.lambda * trace(strain);
                for (unsigned int a = 0; a < 3; ++a)
                  stress[a][a] += volumetric;
                u.submit_symmetric_gradient(stress, q);
              }
            u.integrate_scatter(gradients, y);
          }
      }

      Cells                           cells;
      dealii::AlignedVector<Material> materials;
    };

    /// Operations per cell: at each point the gradient by reference coordinates
    /// and its transpose (each two for 9 n_nodes products), the changes of
    /// coordinates (45 each), and 25 for strain, stress and weights.
    double
    deal_flops(const ReferenceElement &reference)
    {
      return reference.stiffness_rule.weights.size() *
             (36. * reference.n_nodes + 2 * 45 + 25);
    }
  } // namespace

  void
  add_deal_matrix_free(CaseData &data)
  {
    // This operator has no rotations.
    if (data.which().bend != 0)
      return;
    const auto make = [&data](Application &a) {
      const Problem &p = data.problem();
      const auto     K = std::make_shared<DealMatrixFree>(p);
      data.effective().vmult(a.expected, a.x);
      K->adapt(a.x);
      K->adapt(a.y);
      // Moved besides the vectors are inverse Jacobians with determinants, two
      // moduli, and numbers of unknowns instead of nodes.
      Counters counters =
        matrix_free_counters(p,
                             deal_flops(p.reference),
                             96 + 8. * p.discretization.n_nodes_per_cell());
      counters["width"]     = DealMatrixFree::Number::size();
      counters["own_width"] = batch_size;
      return Measured{[K, &a] { K->vmult(a.y, a.x); }, counters};
    };
    add_application(data, "deal_matrix_free", make, largest_deal_difference);
  }
} // namespace corotet::benchmarks
