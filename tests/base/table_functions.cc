// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Tables in files as functions of formulas: what is read, on all ranks, and the
// messages of what is refused.

#include <corotet/base/exceptions.h>
#include <corotet/base/expression.h>
#include <corotet/base/parameter_file.h>
#include <corotet/base/table_file.h>
#include <corotet/base/table_functions.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "../temporary_folder.h"

using namespace corotet;

namespace
{
  // Rows of a file with this content.
  TableRows
  rows(const std::string &content)
  {
    const TemporaryFolder folder;
    return read_table_file(folder.write("table.csv", content));
  }

  // The message about a file with this content, without the folder.
  std::string
  file_refusal(const std::string &content)
  {
    const TemporaryFolder folder;
    const std::string     path = folder.write("table.csv", content);
    try
      {
        read_table_file(path);
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.entry, "");
        const std::string message = error.what();
        EXPECT_EQ(message.find(path), 0u) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
        return message.substr(path.size());
      }
    return "accepted";
  }

  // Parameters with these values of the entries Linear and Cubic.
  TableParameters
  parameters(const std::string &linear, const std::string &cubic)
  {
    TableParameters          result;
    dealii::ParameterHandler prm;
    result.declare_parameters(prm);
    prm.set("Linear", linear);
    prm.set("Cubic", cubic);
    return result;
  }

  // "ENTRY: MESSAGE" for these entries, in a folder with the file a.csv, of two
  // rows, and no other one.
  std::string
  functions_refusal(const std::string &linear, const std::string &cubic)
  {
    const TemporaryFolder folder;
    folder.write("a.csv", "0 0\n1 1\n");
    try
      {
        read_table_functions(parameters(linear, cubic),
                             folder / "",
                             MPI_COMM_WORLD);
      }
    catch (const InputError &error)
      {
        return error.entry + ": " + error.what();
      }
    return "accepted";
  }
} // namespace

TEST(TableFile, ReadsAllSeparatorsHeadersAndComments)
{
  const std::vector<double>      arguments = {-0.5, 0, 1e-3, 2};
  const std::vector<double>      values    = {1, -2.5, 3, 4e5};
  const std::vector<std::string> contents  = {
    "-0.5,1\n0,-2.5\n1e-3,3\n2,4e5\n",
    "t [s], u [m]\n -0.5 , 1\n 0, -2.5\n.001, 3.\n2, 4e5",
    "time;value\r\n-0.5;1\r\n0;-2.5\r\n0.001;3\r\n2;+4E5\r\n",
    "# a record\n\n# of 2001\ntime of day value\n-0.5 1 # first\n0\t-2.5\n"
     "  1e-3   3\n\n2 4e+5\n\n",
    "\xEF\xBB\xBF-0.5,1\n0,-2.5\n1e-3,3\n2,4e5\n"};
  for (const std::string &content : contents)
    {
      const TableRows table = rows(content);
      EXPECT_EQ(table.arguments, arguments) << content;
      EXPECT_EQ(table.values, values) << content;
    }
}

TEST(TableFile, RefusesWhatIsNoTable)
{
  const std::string number = ": a table consists of finite numbers, with a "
                             "point for decimals: found ";
  EXPECT_EQ(file_refusal("0 1\n1 b\n"), ":2" + number + "'b'");
  EXPECT_EQ(file_refusal("0;1\n0,5;2\n"), ":2" + number + "'0,5'");
  EXPECT_EQ(file_refusal("0,1\n1,2m\n"), ":2" + number + "'2m'");
  EXPECT_EQ(file_refusal("0,1\n1,\n"), ":2" + number + "''");
  EXPECT_EQ(file_refusal("0,1\n1,nan\n"), ":2" + number + "'nan'");
  EXPECT_EQ(file_refusal("0,1\n1,1e999\n"), ":2" + number + "'1e999'");
  EXPECT_EQ(file_refusal("0,1\n1,+-2\n"), ":2" + number + "'+-2'");
  // A first line with a number is no header, and there is one header only.
  EXPECT_EQ(file_refusal("t,1\n0,1\n1,2\n"), ":1" + number + "'t'");
  EXPECT_EQ(file_refusal("t,u\ns,m\n0,1\n1,2\n"), ":2" + number + "'s'");
  EXPECT_EQ(file_refusal("0,1\n" + std::string(200, 'a') + ",2\n"),
            ":2" + number + "'" + std::string(80, 'a') +
              "... (200 characters)'");

  const std::string columns = ": a row of a table has two numbers, separated "
                              "by a comma, a semicolon or blanks: found ";
  EXPECT_EQ(file_refusal("t,u,v\n0,1,2\n"),
            ":2" + columns + "3 columns, '0,1,2'");
  EXPECT_EQ(file_refusal("0 1\n\n# end\n2\n"),
            ":4" + columns + "1 columns, '2'");

  const std::string increase = ": the first column of a table must increase: "
                               "found ";
  EXPECT_EQ(file_refusal("0 1\n0.5 2\n0.25 3\n"),
            ":3" + increase + "0.25 after 0.5");
  EXPECT_EQ(file_refusal("0 1\n\n0 2\n"), ":3" + increase + "0 after 0");

  EXPECT_EQ(
    file_refusal("0 1\n1 -2e100\n"),
    ":2: the numbers of a table are between -1e+100 and 1e+100: found 1 "
    "and -2e+100");
  EXPECT_EQ(file_refusal("0 0\n1e-90 1e30\n"),
            ":2: the slope of a table is between -1e+100 and 1e+100: found "
            "1e+120");

  const std::string few = ": a table has at least 2 rows: found ";
  EXPECT_EQ(file_refusal(""), few + "0");
  EXPECT_EQ(file_refusal("t,u\n1,2\n"), few + "1");
}

// Only rank 0 has the files, as each rank has a folder of its own.
TEST(TableFunctions, AreKnownToFormulasOnAllRanks)
{
  const TemporaryFolder folder;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      folder.write("data/ramp.csv", "t, u\n0, 0\n2, 4\n");
      folder.write("wave.csv", "0 0\n1 1\n2 4\n3 9\n");
    }
  TableFunctions tables =
    read_table_functions(parameters("load: data/ramp.csv, Load_2:wave.csv",
                                    "wave : wave.csv"),
                         folder / "",
                         MPI_COMM_WORLD);
  EXPECT_EQ(tables.size(), 3u);

  const Expression e("3 * load(t); load(2 * x) + wave(1.5); Load_2 (t)",
                     3,
                     "",
                     tables);
  // The expression keeps the tables that it needs.
  tables.clear();
  const auto value = e.vector_value(dealii::Point<3>(0.5, 0, 0), 1.5);
  EXPECT_DOUBLE_EQ(value[0], 9);
  // Cubic interpolation reproduces the monotone parabola.
  EXPECT_DOUBLE_EQ(value[1], 2 + 2.25);
  EXPECT_DOUBLE_EQ(value[2], 2.5);
  EXPECT_TRUE(e.depends_on_time());
  EXPECT_TRUE(e.depends_on_space());
}

// The effective parameters in another folder name the same files.
TEST(TableFunctions, FilesOfEffectiveParameters)
{
  const TemporaryFolder folder;
  const std::string elsewhere = folder.write("elsewhere/b.csv", "0 0\n1 1\n");
  folder.write("output/log.txt", "");
  const std::string effective = folder / "output/parameters.prm";

  TableParameters written, read;
  for (TableParameters *table : {&written, &read})
    {
      ParameterFile file;
      table->declare_parameters(file.handler());
      if (table == &written)
        {
          file.read(folder.write("cases/a.prm",
                                 "set Linear = a:../data/a.csv , b: " +
                                   elsewhere + "\n"),
                    {});
          file.write_effective(effective);
        }
      else
        file.read(effective, {});
    }
  EXPECT_EQ(read.linear, "a: ../data/a.csv, b: " + elsewhere);
  EXPECT_EQ(read.cubic, "");
}

TEST(TableFunctions, ExpressionsKnowWhatTheyDependOn)
{
  const TemporaryFolder folder;
  folder.write("a.csv", "0 0\n1 1\n");
  const TableFunctions tables = read_table_functions(parameters("a: a.csv", ""),
                                                     folder / "",
                                                     MPI_COMM_SELF);
  EXPECT_FALSE(Expression("a(1)", 1, "", tables).depends_on_time());
  EXPECT_TRUE(Expression("a(t)", 1, "", tables).depends_on_time());
  EXPECT_FALSE(Expression("a(t)", 1, "", tables).depends_on_space());
  EXPECT_TRUE(Expression("a(y)", 1, "", tables).depends_on_space());
  EXPECT_TRUE(Expression("a(-1)", 1, "", tables).is_zero());
  EXPECT_FALSE(Expression("a(0.5)", 1, "", tables).is_zero());

  try
    {
      const Expression e("b(t)", 1, "Loads/Gravity", tables);
      FAIL() << "nothing was thrown";
    }
  catch (const InputError &error)
    {
      EXPECT_STREQ(
        error.what(),
        "the expression \"b(t)\" is no formula: it has the unknown "
        "name \"b\" (did you mean \"a\"?); known are x, y, z, t, pi, "
        "ramp, smooth_step, pulse, half_sine, triangle, a and "
        "muParser's functions");
    }
}

TEST(TableFunctions, RefusesNamesAndFiles)
{
  EXPECT_EQ(functions_refusal("a: a.csv", "b: a.csv"), "accepted");
  EXPECT_EQ(functions_refusal("", ""), "accepted");
  for (const std::string name : {"2a", "a-b", "a b", ""})
    EXPECT_EQ(functions_refusal(name + ": a.csv", ""),
              "Tables/Linear: the name of a table is no name of a function: "
              "found '" +
                name + "'; allowed are letters, digits and _, no digit first");
  for (const std::string name : {"t", "pi", "sin", "if", "ramp"})
    EXPECT_EQ(functions_refusal("", name + ": a.csv"),
              "Tables/Cubic: the name of a table is taken: found '" + name +
                "', which formulas have already; allowed is any other");
  EXPECT_EQ(functions_refusal("a: a.csv", "a: a.csv"),
            "Tables/Cubic: found two tables called 'a'; allowed is one");

  // All ranks show the path of rank 0, also where theirs is another one.
  const std::string message = functions_refusal("a: a.csv, b: none.csv", "");
  EXPECT_EQ(message.find("Tables/Linear: there is no table file: found '"), 0u)
    << message;
  EXPECT_EQ(message.substr(message.size() - 10), "/none.csv'") << message;
}
