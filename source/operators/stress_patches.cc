// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/point_stress.h>
#include <corotet/operators/stress_patches.h>

#include <algorithm>
#include <array>
#include <tuple>

#include <Eigen/Dense>

namespace corotet
{
  using dealii::Point;
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  namespace
  {
    // Coefficients of a polynomial of degree 3, the highest.
    constexpr int max_size = 20;
    using Basis = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_size, 1>;
    using Coefficients =
      Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor, max_size, 6>;
    using SixNumbers = Eigen::Matrix<double, 6, 1>;

    constexpr int
    n_coefficients(const unsigned int degree)
    {
      return (degree + 1) * (degree + 2) * (degree + 3) / 6;
    }

    // Monomials of a degree and all lower ones.
    Basis
    monomials(const unsigned int degree, const Tensor<1, 3> &x)
    {
      Basis result(n_coefficients(degree));
      int   n           = 0;
      result[n++]       = 1;
      int first_of_last = 0;
      // Each degree is x[0] times the one before, x[1] times what has no x[0]
      // there, and x[2] times the last.
      for (unsigned int d = 1; d <= degree; ++d)
        {
          const int                first = n;
          const std::array<int, 3> begins{
            {first_of_last, first - static_cast<int>(d), first - 1}};
          for (unsigned int a = 0; a < 3; ++a)
            for (int i = begins[a]; i < first; ++i)
              result[n++] = x[a] * result[i];
          first_of_last = first;
        }
      return result;
    }

    SixNumbers
    six_numbers(const SymmetricTensor<2, 3> &tensor)
    {
      return Eigen::Map<const SixNumbers>(tensor.begin_raw());
    }

    // A fit whose coefficients the data determine badly would be worse than one
    // of a lower degree. Smallest eigenvalue of the normal equations over the
    // largest, by degree: a tenth of what inner patches have at least. Patches
    // with too few cells have round-off.
    constexpr std::array<double, 4> smallest_eigenvalue{{0, 2e-2, 3e-3, 3e-4}};

    // Barycentric coordinates of an element's nodes.
    std::vector<std::array<double, 4>>
    barycentric_coordinates(const Discretization &discretization)
    {
      std::vector<std::array<double, 4>> result;
      for (const Point<3> &xi : discretization.finite_element()
                                  .base_element(0)
                                  .get_unit_support_points())
        result.push_back({{1 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]}});
      return result;
    }
  } // namespace

  StressPatches::StressPatches(const Discretization   &discretization,
                               const ReferenceElement &reference,
                               const MaterialNodes    &nodes)
    : discretization(discretization)
    , nodes(nodes)
    , n_points(reference.stiffness_rule.weights.size())
  {
    points.reserve(static_cast<std::size_t>(discretization.n_local_cells()) *
                   n_points);
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      for (unsigned int q = 0; q < n_points; ++q)
        points.push_back(
          point_geometry(discretization, reference.stiffness_rule, c, q)
            .position);
    find_patches(reference);
    find_targets();
  }

  void
  StressPatches::find_patches(const ReferenceElement &reference)
  {
    Vector surface;
    discretization.initialize_vector(surface);
    for (const BoundaryFace &face : discretization.boundary_faces())
      for (const unsigned int i : reference.face_nodes[face.face])
        surface.local_element(3 * discretization.cell_nodes(face.cell)[i]) = 1;
    surface.compress(dealii::VectorOperation::add);

    // (vertex, material, cell) for all cells around owned vertices.
    std::vector<std::tuple<unsigned int, unsigned int, unsigned int>> around;
    for (unsigned int c = 0; c < discretization.n_local_cells(); ++c)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int vertex = discretization.cell_nodes(c)[k];
          if (vertex < discretization.n_owned_nodes())
            around.emplace_back(vertex,
                                nodes.copy(nodes.cell_nodes(c)[k]).material,
                                c);
        }
    std::sort(around.begin(), around.end());

    for (std::size_t begin = 0, end; begin < around.size(); begin = end)
      {
        const auto [vertex, material, cell] = around[begin];
        Patch patch;
        for (end = begin;
             end < around.size() && std::get<0>(around[end]) == vertex &&
             std::get<1>(around[end]) == material;
             ++end)
          patch.cells.push_back(std::get<2>(around[end]));
        const bool has_others =
          (begin > 0 && std::get<0>(around[begin - 1]) == vertex) ||
          (end < around.size() && std::get<0>(around[end]) == vertex);
        const bool is_inner =
          !has_others && surface.local_element(3 * vertex) == 0;
        patch.vertex       = vertex;
        patch.is_preferred = is_inner || discretization.degree() == 3;
        set_up_fit(patch);
        patches.push_back(std::move(patch));
      }
  }

  void
  StressPatches::set_up_fit(Patch &patch) const
  {
    Tensor<1, 3>    mean;
    Eigen::Matrix3d spread          = Eigen::Matrix3d::Zero();
    const double    share           = 0.25 / patch.cells.size();
    const auto      for_each_vertex = [&](const auto &function) {
      for (const unsigned int c : patch.cells)
        for (unsigned int k = 0; k < 4; ++k)
          function(
            discretization.node_position(discretization.cell_nodes(c)[k]));
    };
    for_each_vertex([&](const Point<3> &x) { mean += share * x; });
    for_each_vertex([&](const Point<3> &x) {
      const Tensor<1, 3>    d = x - mean;
      const Eigen::Vector3d y(d[0], d[1], d[2]);
      spread += share * y * y.transpose();
    });
    patch.centre = Point<3>(mean);
    const Eigen::Matrix3d scale =
      spread.llt().matrixL().solve(Eigen::Matrix3d::Identity());
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        patch.scale[a][b] = scale(a, b);

    const unsigned int degree = discretization.degree();
    for (patch.degree = degree;; --patch.degree)
      {
        const int       n = n_coefficients(patch.degree);
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
        for (const unsigned int c : patch.cells)
          for (unsigned int q = 0; q < n_points; ++q)
            {
              const Basis b = monomials(
                patch.degree,
                patch.scale *
                  (points[static_cast<std::size_t>(c) * n_points + q] -
                   patch.centre));
              A += b * b.transpose();
            }
        const Eigen::VectorXd eigenvalues =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A,
                                                         Eigen::EigenvaluesOnly)
            .eigenvalues();
        // The points of one cell determine polynomials of degree p - 1.
        if (patch.degree == degree &&
            eigenvalues[0] < smallest_eigenvalue[degree] * eigenvalues[n - 1])
          {
            patch.is_preferred = false;
            continue;
          }
        patch.inverse.resize(n * n);
        Eigen::Map<Eigen::MatrixXd>(patch.inverse.data(), n, n) =
          A.llt().solve(Eigen::MatrixXd::Identity(n, n));
        return;
      }
  }

  std::vector<StressPatches::Target>
  StressPatches::nodes_of(
    const Patch                              &patch,
    const std::vector<std::array<double, 4>> &barycentric) const
  {
    std::vector<Target> result;
    for (const unsigned int c : patch.cells)
      {
        const auto   vertices = discretization.cell_nodes(c);
        unsigned int k        = 0;
        while (vertices[k] != patch.vertex)
          ++k;
        for (unsigned int i = 0; i < vertices.size(); ++i)
          result.push_back({nodes.cell_nodes(c)[i], barycentric[i][k]});
      }
    std::sort(result.begin(),
              result.end(),
              [](const Target &a, const Target &b) { return a.node < b.node; });
    result.erase(std::unique(result.begin(),
                             result.end(),
                             [](const Target &a, const Target &b) {
                               return a.node == b.node;
                             }),
                 result.end());
    return result;
  }

  void
  StressPatches::find_targets()
  {
    // Sums of weights by rank of the patches: preferred ones of vertices of the
    // node's own edge, face or cell; those of other vertices; any of its own
    // vertices. The best rank that a node has counts.
    const auto weights = [](const Patch &patch, const double barycentric) {
      const double own = barycentric > 1e-8 ? barycentric : 0;
      return std::array<double, 3>{
        {patch.is_preferred ? own : 0., patch.is_preferred ? 1. : 0., own}};
    };
    const auto barycentric = barycentric_coordinates(discretization);
    Vector     sums;
    nodes.initialize_vector(sums);
    for (Patch &patch : patches)
      {
        patch.targets = nodes_of(patch, barycentric);
        for (const Target &target : patch.targets)
          for (unsigned int rank = 0; rank < 3; ++rank)
            sums.local_element(6 * target.node + rank) +=
              weights(patch, target.weight)[rank];
      }
    sums.compress(dealii::VectorOperation::add);
    sums.update_ghost_values();
    for (Patch &patch : patches)
      {
        std::vector<Target> targets;
        for (const Target &target : patch.targets)
          {
            unsigned int rank = 0;
            while (sums.local_element(6 * target.node + rank) == 0)
              ++rank;
            const double weight = weights(patch, target.weight)[rank];
            if (weight > 0)
              targets.push_back(
                {target.node,
                 weight / sums.local_element(6 * target.node + rank)});
          }
        patch.targets = std::move(targets);
      }
  }

  void
  StressPatches::recover(const std::vector<SymmetricTensor<2, 3>> &at_points,
                         Vector &recovered) const
  {
    AssertDimension(at_points.size(), points.size());
    recovered.zero_out_ghost_values();
    recovered = 0;
    for (const Patch &patch : patches)
      {
        const int    n = n_coefficients(patch.degree);
        Coefficients right_side(n, 6);
        right_side.setZero();
        for (const unsigned int c : patch.cells)
          for (unsigned int q = 0; q < n_points; ++q)
            {
              const std::size_t i = static_cast<std::size_t>(c) * n_points + q;
              right_side +=
                monomials(patch.degree,
                          patch.scale * (points[i] - patch.centre)) *
                six_numbers(at_points[i]).transpose();
            }
        const Eigen::Map<const Eigen::MatrixXd> inverse(patch.inverse.data(),
                                                        n,
                                                        n);
        Coefficients                            coefficients(n, 6);
        coefficients.noalias() = inverse * right_side;
        for (const Target &target : patch.targets)
          {
            const Point<3> x =
              discretization.node_position(nodes.copy(target.node).node);
            Eigen::Map<SixNumbers>(recovered.begin() + 6 * target.node) +=
              target.weight *
              (coefficients.transpose() *
               monomials(patch.degree, patch.scale * (x - patch.centre)));
          }
      }
    recovered.compress(dealii::VectorOperation::add);
    recovered.update_ghost_values();
  }
} // namespace corotet
