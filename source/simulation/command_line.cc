// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/simd.h>
#include <corotet/base/text.h>
#include <corotet/base/version.h>
#include <corotet/simulation/command_line.h>

#include <deal.II/base/config.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>

namespace corotet
{
  namespace
  {
    const std::vector<std::string> styles = {"prm",
                                             "json",
                                             "markdown",
                                             "schema"};

    [[noreturn]] void
    fail(const std::string &message)
    {
      throw InputError("", "command line: " + message);
    }

    std::string
    version_message()
    {
      return fmt::format("corotet {} (revision {}, deal.II {}, for {})\n",
                         version,
                         git_revision,
                         DEAL_II_PACKAGE_VERSION,
                         instruction_set);
    }

    // Throws if an argument is left over: a misspelt option or one file too
    // many.
    void
    refuse_leftover(const CLI::App &app)
    {
      const std::vector<std::string> leftover = app.remaining();
      if (leftover.empty())
        return;
      const std::string &argument = leftover.front();
      if (!argument.starts_with('-'))
        fail(fmt::format("unexpected argument \"{}\"; one file is allowed",
                         shortened(argument)));

      std::vector<std::string> options;
      for (const CLI::Option *option : app.get_options())
        for (const std::string &name : option->get_lnames())
          options.push_back("--" + name);
      const std::string suggestion =
        nearest(argument.substr(0, argument.find('=')), options);
      fail(fmt::format("unknown option \"{}\"; {}",
                       shortened(argument),
                       suggestion.empty() ?
                         "allowed are " + join(options) :
                         "did you mean \"" + suggestion + "\"?"));
    }

    // The value of --print-parameters may be left out; then the parameter file
    // that follows it has been taken for the value.
    void
    separate_style_from_file(CommandLine &command_line)
    {
      std::string &style = *command_line.print_parameters;
      if (std::find(styles.begin(), styles.end(), style) != styles.end())
        return;
      if (!command_line.parameter_file.empty() ||
          style.find('.') == std::string::npos)
        fail(fmt::format("\"{}\" is no style of --print-parameters; allowed "
                         "are {}",
                         style,
                         join(styles)));
      command_line.parameter_file = style;
      style                       = styles.front();
    }

    // A check of an option's value, which must be a number. It returns an empty
    // text, or what is wrong with the value. The checks of CLI11 accept nan.
    std::function<std::string(const std::string &)>
    number_check(const std::function<bool(double)> &is_allowed,
                 const std::string                 &allowed)
    {
      return [=](const std::string &text) -> std::string {
        char        *end   = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        if (!text.empty() && *end == '\0' && std::isfinite(value) &&
            is_allowed(value))
          return "";
        return fmt::format("found '{}'; allowed is {}",
                           shortened(text),
                           allowed);
      };
    }

    // An empty name may come from a shell variable that is not set.
    std::string
    name_check(const std::string &text)
    {
      return text.empty() ? "found ''; allowed is a name" : "";
    }

    // Adds the options of a run; returns --print-parameters.
    const CLI::Option *
    add_run_options(CLI::App &app, CommandLine &command_line)
    {
      app.allow_extras();
      app.set_help_flag("-h,--help", "Print this and exit");
      app.set_version_flag("--version",
                           version_message(),
                           "Print versions, exit");
      app.add_option("FILE",
                     command_line.parameter_file,
                     "The parameter file: .prm, .json or .xml");
      // Without the last setting the option would also take the parameter file
      // that follows it.
      app
        .add_option("--set",
                    command_line.overrides,
                    "Override an entry: \"Section/Subsection/Entry = value\" "
                    "(repeatable)")
        ->type_name("TEXT")
        ->allow_extra_args(false);
      app
        .add_option("--output",
                    command_line.output_directory,
                    "Override the output directory")
        ->check(name_check, "");
      app.add_flag("--validate",
                   command_line.validate,
                   "Read and check everything, the mesh included, run nothing");
      CLI::Option *const print =
        app
          .add_option(
            "--print-parameters",
            command_line.print_parameters,
            "List every entry with allowed values, unit, meaning and default; "
            "as prm or json, with the values of FILE if it is given")
          ->expected(0, 1)
          ->type_name("[prm|json|markdown|schema]");
      app.add_flag(
        "--restart",
        command_line.restart,
        "Go on from the newest good checkpoint in the output directory, or "
        "with a convergence study that was stopped: its finished runs are "
        "kept");
      app.add_flag("--report",
                   command_line.report,
                   "Also write the page of the run, report.html, into the "
                   "output directory");
      app.add_flag("--list",
                   command_line.list,
                   "List ready cases, laws, forces, integrators, "
                   "preconditioners, mesh formats");
      app.add_flag("--quiet",
                   command_line.quiet,
                   "Show nothing on the terminal but errors");
      return print;
    }

    const CLI::App *
    add_mesh_command(CLI::App &app, MeshCommand &mesh)
    {
      CLI::App *const command =
        app.add_subcommand("mesh",
                           "Read or make a mesh, check it, and describe it: "
                           "shapes of cells, names with volumes and areas");
      command->allow_extras();
      command->set_help_flag("-h,--help", "Print this and exit");
      command->add_option("FILE", mesh.file, "A mesh or a geometry");
      command
        ->add_option("--size",
                     mesh.element_size,
                     "Target length of edges in cells made for a geometry, in "
                     "the unit of its file (STEP, IGES: mm)")
        ->check(number_check([](const double h) { return h > 0; },
                             "a number > 0"),
                "> 0");
      command
        ->add_option("--degree",
                     mesh.geometry_degree,
                     "Polynomial degree of the cells made for a geometry: 2 "
                     "and 3 are curved along its surface (default: 1)")
        ->check(number_check(
                  [](const double p) { return p == 1 || p == 2 || p == 3; },
                  "1, 2 or 3"),
                "1, 2 or 3");
      command
        ->add_option("--feature-angle",
                     mesh.feature_angle,
                     "Angle between normals of neighbours above which a "
                     "surface of triangles has an edge, in degrees (default: "
                     "40)")
        ->check(number_check(
                  [](const double angle) { return angle >= 1 && angle <= 180; },
                  "a number from 1 to 180"),
                "from 1 to 180");
      command
        ->add_option("--out",
                     mesh.out,
                     "Write the mesh to this file: .msh for gmsh, .h5 for runs "
                     "on many ranks")
        ->check(name_check, "")
        ->type_name("FILE");
      return command;
    }
  } // namespace

  CommandLine
  parse_command_line(const int argc, const char *const *argv)
  {
    CommandLine command_line;
    CLI::App    app("Dynamic deformation of elastic solids on tetrahedra of "
                    "degree 1, 2 and 3.",
                 "corotet");
    const CLI::Option *const print = add_run_options(app, command_line);

    MeshCommand           mesh;
    const CLI::App *const mesh_app = add_mesh_command(app, mesh);

    try
      {
        app.parse(argc, argv);
      }
    catch (const CLI::CallForHelp &)
      {
        command_line.message = app.help();
      }
    catch (const CLI::CallForVersion &)
      {
        command_line.message = version_message();
      }
    catch (const CLI::ParseError &error)
      {
        fail(error.what());
      }
    if (command_line.message)
      return command_line;

    if (mesh_app->parsed())
      {
        if (!app.parse_order().empty())
          fail(fmt::format("found {} before 'mesh'; allowed: corotet mesh "
                           "[OPTIONS] FILE",
                           app.parse_order().front()->get_name()));
        refuse_leftover(*mesh_app);
        if (mesh.file.empty())
          fail("a mesh or a geometry is needed: corotet mesh [OPTIONS] FILE");
        command_line.mesh = mesh;
        return command_line;
      }
    refuse_leftover(app);
    if (print->count() > 0)
      {
        if (!command_line.print_parameters ||
            command_line.print_parameters->empty())
          command_line.print_parameters = styles.front();
        separate_style_from_file(command_line);
        const std::string &style = *command_line.print_parameters;
        if (!command_line.parameter_file.empty() &&
            (style == "markdown" || style == "schema"))
          fail(fmt::format("--print-parameters {}: found the file \"{}\"; "
                           "allowed is none, as this style says nothing of "
                           "values that are set (prm and json do)",
                           style,
                           shortened(command_line.parameter_file)));
        if (command_line.parameter_file.empty() &&
            !command_line.overrides.empty())
          fail("--set: a parameter file is needed, whose entries it overrides");
      }
    else if (command_line.parameter_file.empty() && !command_line.list)
      fail("a parameter file is needed: corotet [OPTIONS] FILE.prm (--help "
           "lists the options)");
    return command_line;
  }
} // namespace corotet
