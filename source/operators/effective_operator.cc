// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/effective_operator.h>
#include <corotet/operators/force_round_off.h>
#include <corotet/operators/vertex_dilatation.h>

namespace corotet
{
  std::vector<unsigned int>
  marked_unknowns(const std::vector<unsigned char> &marks)
  {
    std::vector<unsigned int> result;
    for (unsigned int i = 0; i < marks.size(); ++i)
      if (marks[i])
        result.push_back(i);
    return result;
  }

  EffectiveOperator::EffectiveOperator(
    const Discretization             &discretization,
    const Elasticity                 &elasticity,
    const Mass                       &mass,
    const std::vector<unsigned char> &is_prescribed,
    const SurfaceMatrix              *surface)
    : CellwiseOperator<double>(discretization, marked_unknowns(is_prescribed))
    , disc(discretization)
    , elastic(elasticity)
    , mass_matrix(mass)
    , prescribed(is_prescribed)
    , noise(std::make_unique<ForceRoundOff>(discretization, elasticity))
    , surface_matrix(surface)
  {
    if (elasticity.vertex_dilatation() != nullptr)
      disc.initialize_vector(source);
    if (surface == nullptr)
      return;
    surface_operator = std::make_unique<SurfaceOperator<double>>(disc);
    set_surface(surface_operator.get());
  }

  EffectiveOperator::~EffectiveOperator() = default;

  double
  EffectiveOperator::round_off(const Vector &v) const
  {
    return c_K * noise->of_displacement(v) +
           (surface_operator ? surface_operator->round_off(v) : 0.);
  }

  std::vector<double>
  EffectiveOperator::squares_of_node_stiffness() const
  {
    if (!surface_operator)
      return noise->squares_of_stiffness(nullptr);
    Vector springs;
    disc.initialize_vector(springs);
    surface_operator->add_diagonal(springs);
    return noise->squares_of_stiffness(&springs);
  }

  double
  EffectiveOperator::unexplained(const Vector &r, const double cause) const
  {
    const std::vector<double> squares = squares_of_node_stiffness();
    double                    sum     = 0;
    for (unsigned int n = 0; n < squares.size(); ++n)
      {
        const double square = square_at_node(r, n);
        if (square > cause * cause * squares[n])
          sum += square;
      }
    return std::sqrt(
      dealii::Utilities::MPI::sum(sum, r.get_mpi_communicator()));
  }

  void
  EffectiveOperator::update(const double c_K, const double c_M)
  {
    this->c_K = c_K;
    this->c_M = c_M;
    set_terms(c_K,
              elastic.coefficients().data(),
              c_M,
              mass_matrix.cell_masses().data(),
              mass_matrix.is_lumped() ? &mass_matrix.diagonal() : nullptr);
    if (surface_matrix != nullptr)
      {
        surface_operator->set(*surface_matrix);
        size_of_surface = surface_matrix->size() / c_K;
      }
    compute_diagonal();
    if (surface_operator)
      surface_operator->add_diagonal(diagonal_of_A);
    if (VertexDilatation *dilatation = elastic.vertex_dilatation())
      dilatation->add_diagonal(diagonal_of_A, c_K, elastic.elastic_data());
    is_assembled = false;
    ++n_updates;
  }

  void
  EffectiveOperator::vmult(Vector &dst, const Vector &src) const
  {
    VertexDilatation *const dilatation = elastic.vertex_dilatation();
    if (dilatation == nullptr)
      {
        CellwiseOperator<double>::vmult(dst, src);
        return;
      }
    const unsigned int n_owned = src.locally_owned_size();
    source.copy_locally_owned_data_from(src);
    for (const unsigned int i : prescribed_unknowns())
      if (i < n_owned)
        source.local_element(i) = 0;
    source.update_ghost_values();
    CellwiseOperator<double>::vmult(dst, source);
    dilatation->add_product(dst, source, c_K, elastic.elastic_data());
    source.zero_out_ghost_values();
    for (const unsigned int i : prescribed_unknowns())
      if (i < n_owned)
        dst.local_element(i) =
          diagonal().local_element(i) * src.local_element(i);
  }

  Vector
  EffectiveOperator::positions(const Vector &displacement) const
  {
    Vector result;
    disc.initialize_vector(result);
    result += disc.node_positions();
    if (!elastic.law().is_linear())
      result += displacement;
    return result;
  }

  const BlockMatrix &
  EffectiveOperator::other_matrix(
    const std::function<void(AssembledMatrix &)> &update,
    const double                                  stiffness_factor) const
  {
    VertexDilatation *const dilatation = elastic.vertex_dilatation();
    if (!assembled)
      assembled =
        std::make_unique<AssembledMatrix>(disc,
                                          prescribed,
                                          dilatation != nullptr ?
                                            dilatation->block_pattern() :
                                            block_pattern(disc));
    is_assembled = false;
    update(*assembled);
    if (dilatation != nullptr)
      dilatation->add_to_matrix(assembled->matrix(),
                                prescribed,
                                stiffness_factor,
                                elastic.elastic_data());
    return assembled->matrix();
  }

  const BlockMatrix &
  EffectiveOperator::matrix() const
  {
    if (!assembled || !is_assembled)
      other_matrix(
        [this](AssembledMatrix &matrix) {
          matrix.update(c_K,
                        elastic.coefficients(),
                        c_M,
                        mass_matrix.cell_masses(),
                        mass_matrix.is_lumped() ? &mass_matrix.diagonal() :
                                                  nullptr,
                        surface_operator.get());
        },
        c_K);
    is_assembled = true;
    return assembled->matrix();
  }

  BlockMatrix &
  EffectiveOperator::matrix_to_take() const
  {
    matrix();
    is_assembled = false;
    return assembled->matrix();
  }
} // namespace corotet
