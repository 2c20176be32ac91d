// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_base_parameter_example_h
#define corotet_tests_base_parameter_example_h

#include <corotet/base/exceptions.h>
#include <corotet/base/parameter_file.h>

#include <gtest/gtest.h>

#include "temporary_folder.h"

/**
 * A parameter file with a little of everything declared, the variables that its
 * entries are bound to, and a folder to write files into.
 */
struct Example
{
  Example()
  {
    dealii::ParameterHandler &prm = parameters.handler();
    prm.enter_subsection("Material");
    prm.add_parameter("Density",
                      density,
                      "Mass per volume [kg/m^3].",
                      dealii::Patterns::Double(0));
    prm.add_parameter("Law",
                      law,
                      "Which law.",
                      dealii::Patterns::Selection("linear|corotational"));
    prm.enter_subsection("No parameters");
    prm.leave_subsection();
    prm.leave_subsection();
    prm.enter_subsection("Mesh");
    prm.add_parameter("File name",
                      file_name,
                      "A mesh.",
                      dealii::Patterns::FileName());
    prm.enter_subsection("Box");
    prm.add_parameter("Cells (per side)",
                      cells,
                      "Number of cells [-].",
                      dealii::Patterns::Integer(1));
    prm.leave_subsection();
    prm.leave_subsection();
  }

  std::string
  refusal(const std::string              &name,
          const std::string              &content,
          const std::vector<std::string> &overrides = {})
  {
    folder.write(name, content);
    return refusal_of(name, overrides);
  }

  std::string
  refusal_of(const std::string              &name,
             const std::vector<std::string> &overrides = {})
  {
    try
      {
        parameters.read(folder / name, overrides);
      }
    catch (const corotet::InputError &error)
      {
        // The message itself names the place in the file. The folder is left
        // out, as it is another one in each test.
        EXPECT_EQ(error.entry, "");
        std::string       message = error.what();
        const std::string prefix  = folder / "";
        for (auto found = message.find(prefix); found != std::string::npos;
             found      = message.find(prefix))
          message.erase(found, prefix.size());
        EXPECT_EQ(message.find('\n'), std::string::npos);
        return message;
      }
    return "accepted";
  }

  double       density = 1000;
  std::string  law     = "linear";
  std::string  file_name;
  unsigned int cells = 1;

  corotet::ParameterFile parameters;
  TemporaryFolder        folder;
};

#endif
