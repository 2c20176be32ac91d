// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_exceptions_h
#define corotet_base_exceptions_h

#include <stdexcept>
#include <string>

namespace corotet
{
  /**
   * An error that ends a run. Each kind has its own exit status, which scripts
   * rely on.
   */
  class Error : public std::runtime_error
  {
  public:
    Error(const int exit_status, const std::string &message)
      : std::runtime_error(message)
      , exit_status(exit_status)
    {}

    const int exit_status;
  };

  /**
   * The input is wrong: exit status 1. The message says what is wrong, what was
   * found and what is allowed.
   *
   * @p entry is the path of the parameter to blame, as
   * "Section/Subsection/Entry" (the program shows the file and the line where
   * it is set), or empty if @p message names the place by itself.
   */
  class InputError : public Error
  {
  public:
    InputError(const std::string &entry, const std::string &message)
      : Error(1, message)
      , entry(entry)
    {}

    const std::string entry;
  };

  /**
   * The computation failed (no convergence, blow-up): exit status 2. Everything
   * computed before is saved.
   */
  class ComputationError : public Error
  {
  public:
    explicit ComputationError(const std::string &message)
      : Error(2, message)
    {}
  };

  /**
   * The value of an entry is wrong at a time that the computation has reached.
   * Before the start it would have been @p cause, but it was not checked there.
   */
  class WrongValueError : public ComputationError
  {
  public:
    explicit WrongValueError(const InputError &cause)
      : ComputationError(cause.entry + ": " + cause.what())
      , cause(cause)
    {}

    const InputError cause;
  };

  /**
   * The machine failed (disk full, no permission): exit status 3.
   */
  class MachineError : public Error
  {
  public:
    explicit MachineError(const std::string &message)
      : Error(3, message)
    {}
  };

  /**
   * A step was given up because the run is to stop; it can be repeated.
   */
  class StepInterrupted : public std::exception
  {
  public:
    const char *
    what() const noexcept override
    {
      return "a step was given up";
    }
  };

  /**
   * A signal or a limit ended the run before its end time, and it was saved:
   * exit status 4.
   */
  class Stopped : public Error
  {
  public:
    static constexpr int status = 4;

    explicit Stopped(const std::string &message)
      : Error(status, message)
    {}
  };
} // namespace corotet

#endif
