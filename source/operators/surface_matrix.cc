// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/surface_matrix.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  SurfaceMatrix::SurfaceMatrix(const Discretization   &discretization,
                               const ReferenceElement &reference)
    : disc(discretization)
    , reference(reference)
  {}

  void
  SurfaceMatrix::clear()
  {
    for (const std::size_t face : used)
      {
        std::fill_n(all_tensors.begin() + points_per_face() * face,
                    points_per_face(),
                    Tensor());
        is_used[face] = 0;
      }
    used.clear();
  }

  SurfaceMatrix::Tensor *
  SurfaceMatrix::tensors_of(const unsigned int face)
  {
    AssertIndexRange(face, all_faces.size());
    if (is_used[face] == 0)
      {
        is_used[face] = 1;
        used.push_back(face);
      }
    return all_tensors.data() + std::size_t(points_per_face()) * face;
  }

  std::vector<unsigned int>
  SurfaceMatrix::used_faces() const
  {
    std::vector<unsigned int> result = used;
    std::sort(result.begin(), result.end());
    return result;
  }

  unsigned int
  SurfaceMatrix::first_face(const unsigned int boundary)
  {
    const auto found = ranges.find(boundary);
    if (found != ranges.end())
      return found->second.first;
    const unsigned int first = all_faces.size();
    for (const auto *faces :
         {&disc.boundary_faces(), &disc.ghost_boundary_faces()})
      for (const BoundaryFace &face : *faces)
        if (face.boundary == boundary)
          all_faces.push_back({face.cell, face.face});
    ranges[boundary] = {first, all_faces.size() - first};
    all_tensors.resize(static_cast<std::size_t>(points_per_face()) *
                       all_faces.size());
    is_used.resize(all_faces.size());
    return first;
  }

  void
  SurfaceMatrix::add(const SurfaceMatrix &other, const double factor)
  {
    const std::size_t n_points = points_per_face();
    for (const auto &[boundary, range] : other.ranges)
      {
        const unsigned int first = first_face(boundary);
        for (unsigned int f = 0; f < range.second; ++f)
          if (other.is_used[range.first + f] != 0)
            {
              Tensor       *to = tensors_of(first + f);
              const Tensor *from =
                &other.all_tensors[n_points * (range.first + f)];
              for (std::size_t q = 0; q < n_points; ++q)
                to[q] += factor * from[q];
            }
      }
  }

  double
  SurfaceMatrix::size() const
  {
    const std::size_t n_points = points_per_face();
    double            largest  = 0;
    for (const std::size_t face : used)
      for (std::size_t q = 0; q < n_points; ++q)
        largest = std::max(largest, all_tensors[n_points * face + q].norm());
    return dealii::Utilities::MPI::max(largest, disc.communicator());
  }

  std::vector<RigidMotions::Spring>
  SurfaceMatrix::springs() const
  {
    std::vector<RigidMotions::Spring> result;
    const double                      least = 1e-12 * size();
    for (std::size_t f = 0; f < all_faces.size(); ++f)
      if (all_faces[f].cell < disc.n_owned_cells())
        for_each_surface_point(
          disc,
          reference,
          {all_faces[f].cell, all_faces[f].face, 0},
          nullptr,
          [&](const SurfacePoint &point) {
            const Tensor &D = all_tensors[f * points_per_face() + point.index];
            for (const auto &[stiffness, direction] : eigenvectors(D))
              if (stiffness > least)
                result.push_back({all_faces[f].cell, point.at_rest, direction});
          });
    return result;
  }

  template <typename T>
  SurfaceOperator<T>::SurfaceOperator(const Nodes &nodes)
    : nodes(nodes)
    , reference(ReferenceElement::of(nodes.element()))
  {}

  template <typename T>
  void
  SurfaceOperator<T>::find_nodes(const SurfaceMatrix &matrix)
  {
    n_points     = matrix.points_per_face();
    n_face_nodes = reference.face_nodes[0].size();
    for (unsigned int f = 0; f < 4; ++f)
      {
        const auto &rule = matrix.reference_element().face_rules[f];
        const ReferenceElement::PointValues table =
          ReferenceElement::tabulate(nodes.element(),
                                     rule.points,
                                     rule.weights);
        values[f].resize(std::size_t(n_points) * n_face_nodes);
        for (unsigned int q = 0; q < n_points; ++q)
          for (unsigned int k = 0; k < n_face_nodes; ++k)
            values[f][q * n_face_nodes + k] =
              table.values[q][reference.face_nodes[f][k]];
      }
    faces = matrix.faces();
    face_nodes.clear();
    for (const SurfaceMatrix::Face &face : faces)
      for (const unsigned int i : reference.face_nodes[face.face])
        face_nodes.push_back(nodes.cell_nodes(face.cell)[i]);
    tensors.resize(matrix.tensors().size());
    active_faces.clear();
    find_rows();
  }

  template <typename T>
  void
  SurfaceOperator<T>::find_rows()
  {
    rows.clear();
    for (const std::size_t f : active_faces)
      for (unsigned int k = 0; k < n_face_nodes; ++k)
        if (face_nodes[f * n_face_nodes + k] < nodes.n_owned_nodes())
          rows.push_back(face_nodes[f * n_face_nodes + k]);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    places.clear();
    for (const std::size_t f : active_faces)
      for (unsigned int k = 0; k < n_face_nodes; ++k)
        places.push_back(std::lower_bound(rows.begin(),
                                          rows.end(),
                                          face_nodes[f * n_face_nodes + k]) -
                         rows.begin());
    blocks.resize(rows.size());
  }

  template <typename T>
  void
  SurfaceOperator<T>::set(const SurfaceMatrix &matrix, const double factor)
  {
    if (n_points == 0 || faces.size() != matrix.faces().size())
      find_nodes(matrix);
    std::vector<unsigned int> active;
    for (const std::size_t f : matrix.used_faces())
      {
        bool is_active = false;
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const std::size_t i = f * n_points + q;
            tensors[i]          = factor * matrix.tensors()[i];
            is_active           = is_active || tensors[i] != Tensor();
          }
        if (is_active)
          active.push_back(f);
      }
    if (active != active_faces)
      {
        active_faces.swap(active);
        find_rows();
      }

    std::fill(blocks.begin(), blocks.end(), Tensor());
    const unsigned int *place = places.data();
    for (const std::size_t f : active_faces)
      for (unsigned int k = 0; k < n_face_nodes; ++k, ++place)
        if (face_nodes[f * n_face_nodes + k] < nodes.n_owned_nodes())
          for (unsigned int q = 0; q < n_points; ++q)
            {
              const double N = values[faces[f].face][q * n_face_nodes + k];
              blocks[*place] += N * N * tensors[f * n_points + q];
            }
  }

  template <typename T>
  void
  SurfaceOperator<T>::add(VectorType       &y,
                          const VectorType &x,
                          const double      factor) const
  {
    constexpr unsigned int most    = 10;
    const unsigned int     n_owned = nodes.n_owned_nodes();
    const T *const         X       = x.begin();
    T *const               Y       = y.begin();
    AssertIndexRange(n_face_nodes, most + 1);
    for (const std::size_t f : active_faces)
      {
        const unsigned int *node           = &face_nodes[f * n_face_nodes];
        const Tensor       *D              = &tensors[f * n_points];
        const double       *N              = values[faces[f].face].data();
        double              u[3 * most]    = {};
        double              sums[3 * most] = {};
        for (unsigned int k = 0; k < n_face_nodes; ++k)
          for (unsigned int a = 0; a < 3; ++a)
            u[3 * k + a] = X[3 * node[k] + a];
        for (unsigned int q = 0; q < n_points; ++q, ++D, N += n_face_nodes)
          {
            dealii::Tensor<1, 3> at_point;
            for (unsigned int k = 0; k < n_face_nodes; ++k)
              for (unsigned int a = 0; a < 3; ++a)
                at_point[a] += N[k] * u[3 * k + a];
            const dealii::Tensor<1, 3> f = factor * (*D * at_point);
            for (unsigned int k = 0; k < n_face_nodes; ++k)
              for (unsigned int a = 0; a < 3; ++a)
                sums[3 * k + a] += N[k] * f[a];
          }
        for (unsigned int k = 0; k < n_face_nodes; ++k)
          if (node[k] < n_owned)
            for (unsigned int a = 0; a < 3; ++a)
              Y[3 * node[k] + a] += sums[3 * k + a];
      }
  }

  template <typename T>
  void
  SurfaceOperator<T>::set_zero(VectorType &y) const
  {
    for (const unsigned int node : rows)
      for (unsigned int a = 0; a < 3; ++a)
        y.local_element(3 * node + a) = 0;
  }

  template <typename T>
  void
  SurfaceOperator<T>::add_diagonal(VectorType &d) const
  {
    for (unsigned int k = 0; k < rows.size(); ++k)
      for (unsigned int a = 0; a < 3; ++a)
        d.local_element(3 * rows[k] + a) += blocks[k][a][a];
  }

  template <typename T>
  double
  SurfaceOperator<T>::energy(const VectorType &x) const
  {
    double sum = 0;
    for (const std::size_t f : active_faces)
      if (faces[f].cell < nodes.n_owned_cells())
        for (unsigned int q = 0; q < n_points; ++q)
          {
            dealii::Tensor<1, 3> u;
            for (unsigned int k = 0; k < n_face_nodes; ++k)
              for (unsigned int a = 0; a < 3; ++a)
                u[a] +=
                  values[faces[f].face][q * n_face_nodes + k] *
                  x.local_element(3 * face_nodes[f * n_face_nodes + k] + a);
            sum += u * (tensors[f * n_points + q] * u);
          }
    return 0.5 * dealii::Utilities::MPI::sum(sum, nodes.communicator());
  }

  template <typename T>
  double
  SurfaceOperator<T>::round_off(const VectorType &x) const
  {
    // The other entries of a row sum up to about three times its diagonal.
    constexpr double row = 4;
    double           sum = 0;
    for (unsigned int k = 0; k < rows.size(); ++k)
      {
        // Components are treated separately: a stiff spring along one axis does
        // not limit the error of motion along another.
        for (unsigned int a = 0; a < 3; ++a)
          {
            double size = 0;
            for (unsigned int b = 0; b < 3; ++b)
              size +=
                std::abs(blocks[k][a][b] * x.local_element(3 * rows[k] + b));
            sum += size * size;
          }
      }
    return row * std::numeric_limits<T>::epsilon() *
           std::sqrt(dealii::Utilities::MPI::sum(sum, nodes.communicator()));
  }

  template class SurfaceOperator<double>;
  template class SurfaceOperator<float>;
} // namespace corotet
