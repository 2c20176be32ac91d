// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/point_stress.h>
#include <corotet/operators/stress_patches.h>

#include <algorithm>
#include <array>

#include "stress_fit.h"
#include <Eigen/Dense>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // A fit whose coefficients the data determine badly is worse than one of a
    // lower degree. These are limits of the smallest eigenvalue of the normal
    // equations over the largest, by degree: a tenth of the usual minimum in
    // patches of inner vertices and, with its decay, in two layers around the
    // others. Patches with too few cells only have round-off.
    constexpr std::array<double, 4> least_of_patches{{0, 2e-2, 3e-3, 3e-4}},
      least_of_layers{{0, 2e-2, 5e-4, 5e-5}};

    // Powers of the distance by which weights decay: the best of 0 to 16 in two
    // layers, and of 0 to 8 for the remainder, see the page on stress.
    constexpr std::array<unsigned int, 4> decay_of_layers{{0, 0, 4, 4}};
    constexpr unsigned int                decay_of_rest = 2;

    using Matrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    // Sums over the samples of the first fit, with its weights, of its
    // monomials times those of the second.
    Matrix
    products(const StressFit     &first,
             const StressFit     &second,
             const StressSamples &samples)
    {
      Matrix result = Matrix::Zero(monomials::n_coefficients(first.degree),
                                   monomials::n_coefficients(second.degree));
      monomials::with_degree(first.degree, [&](const auto degree) {
        monomials::with_degree(second.degree, [&](const auto second_degree) {
          for_each_cell_of<degree>(
            first,
            samples,
            [&](const std::size_t,
                const auto &points,
                const auto &values,
                const auto &weights) {
              for (unsigned int q = 0; q < points.size(); ++q)
                {
                  const auto others =
                    monomials_of<second_degree>(second, points[q]);
                  for (unsigned int i = 0; i < values[q].size(); ++i)
                    for (unsigned int j = 0; j < others.size(); ++j)
                      result(i, j) += weights[q] * values[q][i] * others[j];
                }
            });
        });
      });
      return result;
    }

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

  StressPatches::StressPatches(const Discretization            &discretization,
                               const ReferenceElement          &reference,
                               const MaterialNodes             &nodes,
                               const AtSurface                  at_surface,
                               const std::vector<unsigned int> *cells)
    : discretization(discretization)
    , nodes(nodes)
    , samples(discretization, reference, nodes)
  {
    if (cells != nullptr)
      find_wanted(*cells);
    find_patches(reference, at_surface);
    find_targets();
    if (cells != nullptr)
      find_cells_read();
  }

  void
  StressPatches::find_patches(const ReferenceElement &reference,
                              const AtSurface         at_surface)
  {
    Vector surface;
    discretization.initialize_vector(surface);
    for (const BoundaryFace &face : discretization.boundary_faces())
      for (const unsigned int i : reference.face_nodes[face.face])
        surface.local_element(3 * discretization.cell_nodes(face.cell)[i]) = 1;
    surface.compress(dealii::VectorOperation::add);

    patches = first_patches(surface);
    if (at_surface == AtSurface::one_sided)
      {
        for (Patch &patch : patches)
          if (patch.fits.empty())
            fit_one_sided(patch);
        return;
      }
    // The second layer of cells around an owned vertex is needed; around
    // ghosts, other ranks have some of its cells.
    std::vector<unsigned int> ghosts;
    for (const Patch &patch : patches)
      if (patch.fits.empty())
        for (const unsigned int c : patch.cells)
          for (unsigned int k = 0; k < 4; ++k)
            if (const unsigned int v = discretization.cell_nodes(c)[k];
                v >= discretization.n_owned_nodes())
              ghosts.push_back(v);
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    samples.fetch_cells_around(ghosts);
    for (Patch &patch : patches)
      if (patch.fits.empty())
        widen(patch);
  }

  std::vector<StressPatches::Patch>
  StressPatches::first_patches(const Vector &surface) const
  {
    const unsigned int degree = discretization.degree();
    std::vector<Patch> result;
    for (unsigned int n = 0; n < nodes.n_owned(); ++n)
      {
        const auto [vertex, group] = nodes.copy(n);
        Patch patch{
          vertex, group, false, samples.cells_around(vertex, group), {}, {}};
        // There are no cells if the node is not a vertex.
        if (!wants_any(patch.cells))
          continue;
        const bool is_interface =
          (n > 0 && nodes.copy(n - 1).node == vertex) ||
          (n + 1 < nodes.n_owned() && nodes.copy(n + 1).node == vertex);
        if (!is_interface && surface.local_element(3 * vertex) == 0)
          if (auto inner =
                fit(vertex, patch.cells, degree, 0, least_of_patches[degree]))
            {
              patch.is_preferred = true;
              patch.fits.push_back(std::move(*inner));
            }
        result.push_back(std::move(patch));
      }
    return result;
  }

  void
  StressPatches::fit_one_sided(Patch &patch) const
  {
    const unsigned int degree = discretization.degree();
    if (auto full =
          fit(patch.vertex, patch.cells, degree, 0, least_of_patches[degree]))
      {
        // Cubic polynomials of inner vertices must not be evaluated far from
        // their samples, so this one is preferred, too.
        patch.is_preferred = degree == 3;
        patch.fits.push_back(std::move(*full));
      }
    else
      patch.fits.push_back(*fit(patch.vertex, patch.cells, degree - 1, 0, 0));
  }

  void
  StressPatches::widen(Patch &patch) const
  {
    const unsigned int        degree = discretization.degree();
    std::vector<unsigned int> layers;
    for (const unsigned int c : patch.cells)
      for (unsigned int k = 0; k < 4; ++k)
        {
          const auto more =
            samples.cells_around(discretization.cell_nodes(c)[k], patch.group);
          layers.insert(layers.end(), more.begin(), more.end());
        }
    std::sort(layers.begin(), layers.end());
    layers.erase(std::unique(layers.begin(), layers.end()), layers.end());
    if (auto wide = fit(patch.vertex,
                        layers,
                        degree,
                        decay_of_layers[degree],
                        least_of_layers[degree]))
      patch.fits.push_back(std::move(*wide));
    patch.is_preferred = degree > 1 && !patch.fits.empty();
    if (degree == 1 && !patch.fits.empty())
      return;
    // The points of one cell suffice for polynomials of degree p - 1.
    StressFit rest =
      *fit(patch.vertex, patch.cells, degree - 1, decay_of_rest, 0);
    if (!patch.fits.empty())
      {
        const Matrix with_first = products(rest, patch.fits[0], samples);
        rest.products_with_first.assign(with_first.data(),
                                        with_first.data() + with_first.size());
      }
    patch.fits.push_back(std::move(rest));
  }

  std::optional<StressFit>
  StressPatches::fit(const unsigned int               vertex,
                     const std::vector<unsigned int> &cells,
                     const unsigned int               degree,
                     const unsigned int               decay,
                     const double                     smallest_eigenvalue) const
  {
    StressFit result;
    result.degree = degree;
    result.vertex = discretization.node_position(vertex);
    result.decay  = decay;
    result.cells  = cells;

    Tensor<1, 3>    mean;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    const double    share  = 0.25 / cells.size();
    for (const unsigned int c : cells)
      for (const Point<3> &x : samples.corners(c))
        mean += share * x;
    for (const unsigned int c : cells)
      for (const Point<3> &x : samples.corners(c))
        {
          const Tensor<1, 3>    d = x - mean;
          const Eigen::Vector3d y(d[0], d[1], d[2]);
          spread += share * y * y.transpose();
        }
    result.centre = Point<3>(mean);
    const Eigen::Matrix3d scale =
      spread.llt().matrixL().solve(Eigen::Matrix3d::Identity());
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        result.scale[a][b] = scale(a, b);

    const int             n = monomials::n_coefficients(degree);
    const Matrix          A = products(result, result, samples);
    const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly)
        .eigenvalues();
    if (eigenvalues[0] < smallest_eigenvalue * eigenvalues[n - 1])
      return {};
    result.inverse.resize(std::size_t(n) * n);
    Eigen::Map<Eigen::MatrixXd>(result.inverse.data(), n, n) =
      A.llt().solve(Eigen::MatrixXd::Identity(n, n));
    return result;
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
    // node's own edge, face or cell; preferred ones of other vertices; all of
    // its own vertices. A node uses the best rank that it has.
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
        // Nodes where stress is not wanted may lack the patches that they need.
        std::erase_if(patch.targets,
                      [&](const auto &target) { return !wants(target.node); });
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
} // namespace corotet
