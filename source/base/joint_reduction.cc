// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/joint_reduction.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace corotet
{
  namespace
  {
    // All numbers of a rank form one item of MPI, an array, so that MPI cannot
    // cut it into pieces: the number of the sums, the sums, then the numbers
    // whose maxima are wanted. The parameters are those of MPI_User_function.
    void // NOLINTNEXTLINE(readability-non-const-parameter)
    combine(void *in, void *in_out, int *n_items, MPI_Datatype *type)
    {
      int size = 0;
      MPI_Type_size(*type, &size);
      const int   n = size / static_cast<int>(sizeof(double));
      const auto *a = static_cast<const double *>(in);
      auto       *b = static_cast<double *>(in_out);
      for (int item = 0; item < *n_items; ++item, a += n, b += n)
        {
          const int end_of_sums = 1 + static_cast<int>(b[0]);
          for (int i = 1; i < end_of_sums; ++i)
            b[i] += a[i];
          for (int i = end_of_sums; i < n; ++i)
            if (a[i] > b[i] || std::isnan(a[i]))
              b[i] = a[i];
        }
    }
  } // namespace

  void
  JointReduction::run(const MPI_Comm comm) const
  {
    if (dealii::Utilities::MPI::n_mpi_processes(comm) == 1)
      return;
    std::vector<double> values{
      static_cast<double>(sums.size() + counts.size())};
    for (const double *value : sums)
      values.push_back(*value);
    for (const unsigned int *value : counts)
      values.push_back(*value);
    for (const double *value : maxima)
      values.push_back(*value);
    for (const double *value : minima)
      values.push_back(-*value);

    MPI_Datatype type = MPI_DATATYPE_NULL;
    MPI_Type_contiguous(values.size(), MPI_DOUBLE, &type);
    MPI_Type_commit(&type);
    MPI_Op operation = MPI_OP_NULL;
    MPI_Op_create(combine, 1, &operation);
    MPI_Allreduce(MPI_IN_PLACE, values.data(), 1, type, operation, comm);
    MPI_Op_free(&operation);
    MPI_Type_free(&type);

    const double *result = values.data() + 1;
    for (double *value : sums)
      *value = *result++;
    for (unsigned int *value : counts)
      *value = static_cast<unsigned int>(*result++);
    for (double *value : maxima)
      *value = *result++;
    for (double *value : minima)
      *value = -*result++;
  }
} // namespace corotet
