// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Text helpers. Expected values follow from the definition of the Levenshtein
// distance and of splitting; they are counted by hand.

#include <corotet/base/named_values.h>
#include <corotet/base/text.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace corotet;

TEST(Text, NearestFindsTheFewestChanges)
{
  EXPECT_EQ(nearest("Densty", {"Degree", "Density"}), "Density");
  // A name with one replaced character is nearer than one with two.
  EXPECT_EQ(nearest("x-mix", {"y-min", "x-max", "x-min"}), "x-max");
  // A letter too many or too few, wherever it is, is one change: no more is
  // allowed in short words.
  EXPECT_EQ(nearest("ab", {"b"}), "b");
  EXPECT_EQ(nearest("ab", {"a"}), "a");
  EXPECT_EQ(nearest("b", {"ab"}), "ab");
  EXPECT_EQ(nearest("a", {"ab"}), "ab");
}

TEST(Text, NearestIgnoresCase)
{
  EXPECT_EQ(nearest("TIME STEP", {"End time", "Time step"}), "Time step");
}

TEST(Text, NearestIsEmptyIfNothingIsNear)
{
  EXPECT_EQ(nearest("Colour", {"Density", "Degree"}), "");
  EXPECT_EQ(nearest("anything", {}), "");
  // Two of three characters are too many.
  EXPECT_EQ(nearest("abc", {"axy"}), "");
}

TEST(Text, NumbersOfFiles)
{
  EXPECT_EQ(parse_number("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_number("+1"), 1.);
  EXPECT_EQ(parse_number("+1.D-3"), 1e-3);
  EXPECT_EQ(parse_number("2d2"), 200.);
  for (const char *word : {"",
                           "+",
                           "+-1",
                           "++1",
                           "1x",
                           "1 ",
                           "1,5",
                           "d",
                           "1dd2",
                           "inf",
                           "nan",
                           "1e999"})
    EXPECT_EQ(parse_number(word), std::nullopt) << word;
}

TEST(Text, UnusedNames)
{
  const std::vector<std::string> names{"a", "b", "b (2)"};
  const auto                     is_taken = [&](const std::string &name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  EXPECT_EQ(unused_name("c", is_taken), "c");
  EXPECT_EQ(unused_name("a", is_taken), "a (2)");
  EXPECT_EQ(unused_name("b", is_taken), "b (3)");
}

TEST(Text, Join)
{
  EXPECT_EQ(join({}), "");
  EXPECT_EQ(join({"a"}), "a");
  EXPECT_EQ(join({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(join({"a", "b"}, "/"), "a/b");
}

// Messages that quote any text fit on a terminal and do not control it.
TEST(Text, ShortenedAndPrintable)
{
  EXPECT_EQ(shortened("short"), "short");
  EXPECT_EQ(shortened(std::string(80, 'a')), std::string(80, 'a'));
  EXPECT_EQ(shortened(std::string(1000000, 'a')),
            std::string(80, 'a') + "... (1000000 characters)");
  // A shortened text does not end between the two bytes of a character.
  EXPECT_EQ(shortened(std::string(79, 'a') + "\u00e9bc"),
            std::string(79, 'a') + "... (83 characters)");
  EXPECT_EQ(printable("a\033[2Jb\n\tc\r"), "a\\x1b[2Jb\\x0a\\x09c\\x0d");
  EXPECT_EQ(printable("a\033[2Jb\n\tc\r", true), "a\\x1b[2Jb\n\tc\\x0d");
  // Delete, and one of the control characters behind it; a space that does
  // not break has the same first byte, and stays.
  EXPECT_EQ(printable("\x7f\u009b\u00a0\u00e9"), "\\x7f\\x9b<U+00A0>\u00e9");
  // A zero-width space, a hyphen and a minus sign are shown by their codes; a
  // dash can be told from other characters.
  EXPECT_EQ(printable("x\u200by\u2010\u2212\u2014\ufeff"),
            "x<U+200B>y<U+2010><U+2212>\u2014<U+FEFF>");
  EXPECT_EQ(printable(std::string(5000, 'a')), std::string(4000, 'a') + "...");
}

TEST(Text, SplitOutsideBrackets)
{
  using Parts = std::vector<std::string>;
  EXPECT_EQ(split_outside_brackets(" min(1, x) , y[2,3],z ", ','),
            (Parts{"min(1, x)", "y[2,3]", "z"}));
  EXPECT_EQ(split_outside_brackets("", ';'), Parts{""});
  EXPECT_EQ(split_outside_brackets("a;;", ';'), (Parts{"a", "", ""}));
  // Names may be in quotes; a quote within a name, or without a second one, has
  // no meaning.
  EXPECT_EQ(split_outside_brackets("\"a, b\" & \"(c\" : 1,d", ','),
            (Parts{"\"a, b\" & \"(c\" : 1", "d"}));
  EXPECT_EQ(split_outside_brackets("5\" pipe, 6\" pipe, \"a", ','),
            (Parts{"5\" pipe", "6\" pipe", "\"a"}));
  // A bracket too many must not hide the separators behind it.
  EXPECT_EQ(split_outside_brackets("a);b", ';'), (Parts{"a)", "b"}));
}

TEST(Text, NamesAndValues)
{
  using Items = std::vector<std::pair<std::string, std::optional<std::string>>>;
  EXPECT_EQ(
    names_and_values("a: 1, \"b, c: d\" & \"e:\" : f(x, 2); 3, g"),
    (Items{{"a", "1"}, {"\"b, c: d\" & \"e:\"", "f(x, 2); 3"}, {"g", {}}}));
  EXPECT_EQ(names_and_values("5\" : 1, \"x: 2"),
            (Items{{"5\"", "1"}, {"\"x", "2"}}));
  EXPECT_EQ(without_quotes("\"a, b\""), "a, b");
  for (const std::string name : {"\"a\" & \"b\"", "\"", "\"\"", "a\""})
    EXPECT_EQ(without_quotes(name), name);
}
