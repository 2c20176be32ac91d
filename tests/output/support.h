// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_output_support_h
#define corotet_tests_output_support_h

#include <corotet/base/exceptions.h>
#include <corotet/discretization/discretization.h>
#include <corotet/output/output_parameters.h>
#include <corotet/simulation/observer.h>

#include <sys/resource.h>

#include <filesystem>
#include <functional>
#include <string>

// Tools that the tests of the output layer share.
namespace test_output
{
  /**
   * A new folder, the same for all ranks, which is removed in the end.
   */
  class ScratchFolder
  {
  public:
    ScratchFolder();
    ~ScratchFolder();

    ScratchFolder(const ScratchFolder &) = delete;
    ScratchFolder &
    operator=(const ScratchFolder &) = delete;

    std::string path;
  };

  /// Waits for all ranks, so that changes of files by one of them are complete.
  void
  wait_for_all();

  unsigned int
  rank();

  bool
  on_rank_0();

  unsigned int
  n_ranks();

  std::string
  content_of(const std::string &file);

  /// The message of the error of type @p Kind that @p action throws; "no error"
  /// if it throws none.
  template <typename Kind>
  std::string
  message_of(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const Kind &error)
      {
        return error.what();
      }
    return "no error";
  }

  /**
   * While this object lives, no file of this process may grow beyond a size:
   * writing more fails as on a full disk.
   */
  class FileSizeLimit
  {
  public:
    explicit FileSizeLimit(const rlim_t bytes);
    ~FileSizeLimit();

    FileSizeLimit(const FileSizeLimit &) = delete;
    FileSizeLimit &
    operator=(const FileSizeLimit &) = delete;

  private:
    rlimit old;
    void (*handler)(int);
  };

  /**
   * A distorted box [0, 1] x [0, 0.5] x [0, 0.25] of 4 x 2 x 2 times six
   * tetrahedra and two regions: 7 for x < 0.5, 8 beyond.
   */
  corotet::SerialMesh
  distorted_box();

  /// The displacement of the model body; check_vtkhdf.py has the same formula
  /// (option --test-field).
  dealii::Tensor<1, 3>
  displacement_field(const dealii::Point<3> &x, const double t);

  /**
   * States of a body without any mechanics: displacement_field() at the nodes,
   * twice that as velocity, and cell data that check_vtkhdf.py knows.
   */
  class ModelBody
  {
  public:
    explicit ModelBody(const corotet::Element element);

    /// Shows a state to the observer (step 0 by start(), others by step()),
    /// with a record of awkward numbers.
    void
    show(corotet::Observer &observer,
         const unsigned int step,
         const double       time,
         const bool         last);

    static corotet::StepRecord
    record(const unsigned int step, const double time);

    corotet::Log            log;
    corotet::Mesh           mesh;
    corotet::Discretization discretization;
    corotet::Vector         displacement;
    corotet::Vector         velocity;
  };

  /// Runs "PYTHON-FILE ARGUMENTS" of this folder on rank 0; returns its exit
  /// status on all ranks.
  int
  run_python(const std::string &command);

  /// Points inside the box, on its face and at its vertex.
  const std::string probes =
    "inside: 0.317 0.211 0.127, face: 1 0.2 0.11, corner: 1 0.5 0.25";
} // namespace test_output

#endif
