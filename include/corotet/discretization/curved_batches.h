// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_curved_batches_h
#define corotet_discretization_curved_batches_h

#include <corotet/discretization/cell_batches.h>
#include <corotet/discretization/reference_element.h>

#include <deal.II/base/aligned_vector.h>

#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

namespace corotet
{
  /**
   * The batches of curved cells for kernels, which integrate over them by
   * quadrature. None of them holds straight cells: these would be integrated
   * differently where quadrature is not exact, and which cells they are would
   * depend on the number of ranks.
   *
   * Gradients by x are gradients by xi times J^{-1} = (J^{-1} J_c) J_c^{-1},
   * with the Jacobian J(xi) of the cell's map x(xi) and its value J_c at the
   * centre. J_c^{-1} is in the CellGeometry of the cell. So only J^{-1} J_c,
   * close to the identity, distinguishes a curved cell from a straight one:
   * gradients by xi times that matrix are gradients by the centre's
   * coordinates, and all that is done with these, rotations above all, is the
   * same.
   *
   * All elements on the same cells share the numbers and the points, which are
   * those of the finest element: coarser forms are Galerkin projections.
   */
  class CurvedBatches
  {
  public:
    /// The numbers of a point: J^{-1} J_c by rows, and the point's share of the
    /// volume.
    static constexpr unsigned int n_numbers = 10;

    /**
     * Uses @p element's own points; the numbers are at first those of straight
     * cells. @param is_curved Whether each local cell is curved; the same for
     * all cells of a register.
     */
    CurvedBatches(const Element                     element,
                  const CellBatches                &batches,
                  const std::vector<unsigned char> &is_curved);

    /// The same cells for another element.
    CurvedBatches(const Element element, const CurvedBatches &other);

    /// Sets the numbers of a point of a cell. To be called before numbers().
    void
    set(const std::pair<unsigned int, unsigned int> &place,
        const unsigned int                           point,
        const dealii::Tensor<2, 3>                  &matrix,
        const double                                 weight);

    /// Whether the register of cells that @p batch belongs to has curved cells.
    /// A register is one of floats: floats_per_batch batches.
    bool
    has(const unsigned int batch) const
    {
      return maps->index[batch / floats_per_batch] != none;
    }

    /// The numbers of the register of T that starts with @p batch,
    /// [point][number][lane].
    template <typename T>
    const T *
    numbers(const unsigned int batch) const
    {
      const std::size_t register_size =
        std::size_t(n_lanes<T>) * n_numbers * n_points();
      const std::size_t i = maps->index[batch / floats_per_batch];
      if constexpr (std::is_same_v<T, double>)
        return maps->numbers.data() +
               (i * floats_per_batch + batch % floats_per_batch) *
                 register_size;
      else
        return maps->float_numbers.data() + i * register_size;
    }

    /// Computes the numbers in single precision; called once, if they are
    /// needed.
    void
    make_floats() const;

    unsigned int
    n_points() const
    {
      return shape_functions.weights.size();
    }

    /// The element's shape functions at the points, with the weights of
    /// straight cells.
    const ReferenceElement::PointValues &
    shapes() const
    {
      return shape_functions;
    }

    /// shapes() as numbers of type T: [point][node][value, three derivatives].
    template <typename T>
    const T *
    shape_numbers() const
    {
      if constexpr (std::is_same_v<T, double>)
        return shapes_double.data();
      else
        return shapes_float.data();
    }

    /// The number of a curved batch among the curved batches.
    unsigned int
    index(const unsigned int batch) const
    {
      return maps->index[batch / floats_per_batch] * floats_per_batch +
             batch % floats_per_batch;
    }

    /// The number of curved batches, of owned and of ghost cells.
    unsigned int
    n_batches() const
    {
      return maps->n_registers * floats_per_batch;
    }

  private:
    static constexpr unsigned int none =
      std::numeric_limits<unsigned int>::max();

    struct Maps
    {
      /// The number of each register of floats among the curved ones, or none.
      std::vector<unsigned int>     index;
      unsigned int                  n_registers = 0;
      dealii::AlignedVector<double> numbers;
      dealii::AlignedVector<float>  float_numbers;
    };

    void
    set_shapes();

    ReferenceElement::PointValues shape_functions;
    std::vector<double>           shapes_double;
    std::vector<float>            shapes_float;
    std::shared_ptr<Maps>         maps;
  };

  /**
   * Calls @p function(begin, stop, is_curved) for the runs of straight and of
   * curved batches in [first, end); is_curved is std::true_type or
   * std::false_type. @p first and @p end are multiples of floats_per_batch, or
   * the ends of owned or of all batches.
   */
  template <typename Function>
  COROTET_ALWAYS_INLINE void
  for_straight_and_curved(const CellBatches &batches,
                          const unsigned int first,
                          const unsigned int end,
                          const Function    &function)
  {
    const CurvedBatches *const curved = batches.curved();
    if (curved == nullptr)
      {
        function(first, end, std::false_type());
        return;
      }
    for (unsigned int begin = first, stop = first; begin < end; begin = stop)
      {
        const bool is_curved = curved->has(begin);
        while (stop < end && curved->has(stop) == is_curved)
          ++stop;
        if (is_curved)
          function(begin, stop, std::true_type());
        else
          function(begin, stop, std::false_type());
      }
  }
} // namespace corotet

#endif
