// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_surface_matrix_h
#define corotet_operators_surface_matrix_h

#include <corotet/discretization/rigid_motions.h>
#include <corotet/operators/surface.h>

#include <deal.II/base/symmetric_tensor.h>

#include <map>
#include <vector>

namespace corotet
{
  /**
   * A symmetric, positive semi-definite matrix that acts on the surface of the
   * body, for instance that of springs:
   *
   *   S_ij = sum over points q of N_i(x_q) N_j(x_q) D_q
   *
   * with the points of the rule for faces and a symmetric tensor D_q [N/m] for
   * each. As it is given by points, it applies to any element on the same
   * cells: SurfaceOperator does that. Each rank has the faces of its ghost
   * cells, too, and so all contributions to its own rows.
   *
   * The arguments of the constructor must outlive this object.
   */
  class SurfaceMatrix
  {
  public:
    using Tensor = dealii::SymmetricTensor<2, 3>;

    struct Face
    {
      /// A local cell, perhaps a ghost.
      unsigned int cell;
      /// Number of the face in the cell.
      unsigned int face;
    };

    SurfaceMatrix(const Discretization   &discretization,
                  const ReferenceElement &reference);

    /// Sets all D to zero and keeps the faces. Not collective, like all members
    /// but size() and springs().
    void
    clear();

    /// Adds @p per_area(SurfacePoint), a symmetric tensor [N/m^3], on a
    /// boundary of the body at rest.
    template <typename Function>
    void
    add(const unsigned int boundary, const Function &per_area);

    /// The number in faces() of a boundary's first face. First come own faces,
    /// then those of ghost cells, both in the order of the discretization.
    unsigned int
    first_face(const unsigned int boundary);

    /// The D_q of a face, to be added to. Valid until a boundary is added.
    Tensor *
    tensors_of(const unsigned int face);

    /// Adds @p factor times another matrix.
    void
    add(const SurfaceMatrix &other, const double factor);

    const std::vector<Face> &
    faces() const
    {
      return all_faces;
    }

    unsigned int
    points_per_face() const
    {
      return reference.face_rules[0].weights.size();
    }

    /// Faces whose D may be other than zero, by their numbers in faces(),
    /// ascending.
    std::vector<unsigned int>
    used_faces() const;

    /// D_q [N/m], [face][point].
    const std::vector<Tensor> &
    tensors() const
    {
      return all_tensors;
    }

    /// The largest norm of a D_q [N/m] over all ranks. Collective.
    double
    size() const;

    /// The springs by which S resists rigid motions: places and directions of
    /// all points in which D is not zero. Values below 1e-12 of size() are
    /// round-off. Collective.
    std::vector<RigidMotions::Spring>
    springs() const;

    /// The element whose rule for faces is used.
    const ReferenceElement &
    reference_element() const
    {
      return reference;
    }

    const Discretization &
    discretization() const
    {
      return disc;
    }

  private:
    const Discretization   &disc;
    const ReferenceElement &reference;
    std::vector<Face>       all_faces;
    std::vector<Tensor>     all_tensors;
    /// The faces whose D may be other than zero, and a mark for each of them.
    std::vector<unsigned int>  used;
    std::vector<unsigned char> is_used;
    /// For each boundary its first face and the number of its faces.
    std::map<unsigned int, std::pair<unsigned int, unsigned int>> ranges;
  };

  template <typename Function>
  void
  SurfaceMatrix::add(const unsigned int boundary, const Function &per_area)
  {
    unsigned int f = first_face(boundary);
    for (const auto *faces :
         {&disc.boundary_faces(), &disc.ghost_boundary_faces()})
      for (const BoundaryFace &face : *faces)
        if (face.boundary == boundary)
          {
            Tensor *const D = tensors_of(f++);
            for_each_surface_point(
              disc, reference, face, nullptr, [&](const SurfacePoint &point) {
                D[point.index] += point.area.norm() * per_area(point);
              });
          }
  }

  /**
   * Applies a SurfaceMatrix to vectors of numbers of type T, for the element of
   * the matrix or a coarser one on the same cells. It computes in double
   * precision: springs along a normal that is not an axis are stiff in one
   * direction, and a displacement across it must not cause forces by round-off.
   *
   * @p nodes must outlive this object. Members are not collective, except for
   * those that say so.
   */
  template <typename T>
  class SurfaceOperator
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<T>;

    explicit SurfaceOperator(const Nodes &nodes);

    /// Takes over @p factor times the values of @p matrix. All matrices with
    /// the same number of faces must have the same ones.
    void
    set(const SurfaceMatrix &matrix, const double factor = 1);

    /// y += factor S x for owned entries. x has ghost values.
    void
    add(VectorType &y, const VectorType &x, const double factor = 1) const;

    /// Sets the entries of y that add() changes to zero.
    void
    set_zero(VectorType &y) const;

    /// d += the diagonal of S, owned entries.
    void
    add_diagonal(VectorType &d) const;

    /// x . S x / 2. x has ghost values. Collective.
    double
    energy(const VectorType &x) const;

    /// The round-off that S x may have, as a Euclidean norm. Collective.
    double
    round_off(const VectorType &x) const;

    /// Calls @p function(cell, i, j, block) for the 3 x 3 blocks of all faces,
    /// with nodes i <= j of the cell: the face's contribution to S_ij.
    template <typename Function>
    void
    for_each_block(const Function &function) const;

    /// Owned nodes on which S acts, ascending.
    const std::vector<unsigned int> &
    owned_nodes() const
    {
      return rows;
    }

    /// S_ii of the owned nodes.
    const std::vector<SurfaceMatrix::Tensor> &
    diagonal_blocks() const
    {
      return blocks;
    }

  private:
    using Tensor = SurfaceMatrix::Tensor;

    void
    find_nodes(const SurfaceMatrix &matrix);
    /// Finds the rows of the active faces.
    void
    find_rows();

    const Nodes            &nodes;
    const ReferenceElement &reference;
    unsigned int            n_points     = 0;
    unsigned int            n_face_nodes = 0;
    /// N_k(x_q) on each face, [q][k].
    std::array<std::vector<double>, 4> values;
    std::vector<SurfaceMatrix::Face>   faces;
    /// Local numbers of the faces' nodes, [face][k].
    std::vector<unsigned int> face_nodes;
    /// The faces that have a tensor other than zero, and these, [face][point],
    /// which have no meaning for other faces.
    std::vector<unsigned int> active_faces;
    std::vector<Tensor>       tensors;

    /// The owned nodes of active faces, and S_ii there.
    std::vector<unsigned int> rows;
    std::vector<Tensor>       blocks;
    /// Place of the node in rows, [active face][k]; meaningless for nodes that
    /// are not owned.
    std::vector<unsigned int> places;
  };

  template <typename T>
  template <typename Function>
  void
  SurfaceOperator<T>::for_each_block(const Function &function) const
  {
    for (const std::size_t f : active_faces)
      {
        const auto   &N     = values[faces[f].face];
        const auto   &nodes = reference.face_nodes[faces[f].face];
        const Tensor *D     = &tensors[f * n_points];
        for (unsigned int k = 0; k < n_face_nodes; ++k)
          for (unsigned int l = k; l < n_face_nodes; ++l)
            {
              Tensor block;
              for (unsigned int q = 0; q < n_points; ++q)
                block +=
                  D[q] * (N[q * n_face_nodes + k] * N[q * n_face_nodes + l]);
              function(faces[f].cell, nodes[k], nodes[l], block);
            }
      }
  }
} // namespace corotet

#endif
