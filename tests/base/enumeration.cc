// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Entries whose values are those of an enumeration.

#include <corotet/base/enumeration.h>

#include <gtest/gtest.h>

using namespace corotet;

namespace
{
  enum class Colour
  {
    red,
    dark_red,
    blue
  };

  const Enumeration<Colour> colours{{"red", Colour::red},
                                    {"dark red", Colour::dark_red},
                                    {"blue", Colour::blue}};
} // namespace

// The default is what the variable had, and every name means its own value.
TEST(Enumeration, ReadsNames)
{
  Colour                   colour = Colour::dark_red;
  dealii::ParameterHandler prm;
  add_enumeration(prm, "Colour", colour, colours, "Which one.");
  EXPECT_EQ(colour, Colour::dark_red);
  EXPECT_EQ(prm.get("Colour"), "dark red");
  for (const auto &[name, value] : colours)
    {
      prm.parse_input_from_string("set Colour = " + name + "\n");
      EXPECT_EQ(colour, value) << name;
      EXPECT_EQ(name_of(colours, colour), name);
    }
}

TEST(Enumeration, RefusesOtherNames)
{
  Colour                   colour = Colour::blue;
  dealii::ParameterHandler prm;
  add_enumeration(prm, "Colour", colour, colours, "Which one.");
  for (const char *other : {"green", "dark", "Red", ""})
    EXPECT_THROW(prm.set("Colour", other),
                 dealii::ParameterHandler::ExcValueDoesNotMatchPattern)
      << other;
  EXPECT_EQ(colour, Colour::blue);
  EXPECT_THROW(name_of(colours, static_cast<Colour>(7)), dealii::ExceptionBase);
}
