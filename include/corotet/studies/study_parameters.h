// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_study_parameters_h
#define corotet_studies_study_parameters_h

#include <corotet/simulation/simulation_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The values of one run of a study that replace those of the parameter file.
   * Values that are not varied are absent.
   */
  struct StudyCase
  {
    unsigned int               degree;
    unsigned int               refinements;
    std::optional<double>      time_step;
    std::optional<std::string> mass;
    std::optional<std::string> rotation;

    bool
    operator==(const StudyCase &) const = default;

    /// The name of the run for files: "degree_2_refinements_1".
    std::string
    name() const;

    /// The values in the form of overrides on the command line.
    std::vector<std::string>
    overrides() const;
  };

  /// The reference that the fields of a study's runs are compared with.
  enum class StudyReference
  {
    exact_solution,
    finer_run,
    none
  };

  inline const Enumeration<StudyReference> study_references{
    {"exact solution", StudyReference::exact_solution},
    {"finer run", StudyReference::finer_run},
    {"none", StudyReference::none}};

  /**
   * The parameters of section Convergence study.
   */
  struct StudyParameters
  {
    /// A number among the results of a run, and its reference value.
    struct Quantity
    {
      std::string           name;
      std::optional<double> reference;
    };

    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// All runs: for each mass, rotation, degree and time step, all refinements
    /// one after another.
    std::vector<StudyCase>
    cases() const;

    /// The quantities of the list. Throws InputError.
    std::vector<Quantity>
    quantity_list() const;

    RunType                   run         = RunType::simulation;
    std::vector<unsigned int> degrees     = {1, 2, 3};
    std::vector<unsigned int> refinements = {0, 1, 2};
    std::vector<double>       time_steps;
    std::vector<std::string>  masses;
    std::vector<std::string>  rotations;
    StudyReference            reference = StudyReference::exact_solution;
    unsigned int              further_refinements = 1;
    std::string               quantities;
    bool                      pictures = true;
  };
} // namespace corotet

#endif
