// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// What a parameter file must not say. Refusals are compared with the whole
// message that a user gets.

#include "base/parameter_example.h"
#include "refusal.h"

TEST(ParameterFile, RefusesFilesItCannotRead)
{
  Example example;
  EXPECT_EQ(example.refusal_of("absent.prm"),
            "absent.prm: there is no such file");
  EXPECT_EQ(corotet::tests::refusal(
              [] { corotet::ParameterFile().read("", {}); }),
            "no parameter file is given");
  EXPECT_EQ(example.refusal("a.txt", ""),
            "a.txt: a parameter file cannot end in \".txt\"; allowed are .prm, "
            ".json and .xml");
  example.folder.write("case.prm", "");
  EXPECT_EQ(example.refusal_of("case"),
            "case: there is no such parameter file; do you mean 'case.prm'?");
  example.folder.write("folder/x", "");
  EXPECT_EQ(example.refusal_of("folder"),
            "folder: found a folder; allowed are files .prm, .json and .xml");
  example.folder.write("folder.prm/x", "");
  EXPECT_EQ(example.refusal_of("folder.prm"),
            "folder.prm: it cannot be read as a file");
}

TEST(ParameterFile, RefusesMisspeltNames)
{
  Example example;
  EXPECT_EQ(example.refusal("a.prm",
                            "subsection Material\n  set Densty = 1\nend\n"),
            "a.prm:2: there is no entry \"Densty\" in \"Material\"; did you "
            "mean \"Density\"?");
  EXPECT_EQ(example.refusal("a.prm", "\nsubsection material\nend\n"),
            "a.prm:2: there is no subsection \"material\" at the top level; "
            "did you mean \"Material\"?");
  EXPECT_EQ(example.refusal("a.prm",
                            "subsection Mesh\n  set Density = 1\nend\n"),
            "a.prm:2: there is no entry \"Density\" in \"Mesh\"; it belongs "
            "to \"Material\"");
  EXPECT_EQ(example.refusal("a.prm", "subsection Mesh\n  set A = 1\nend\n"),
            "a.prm:2: there is no entry \"A\" in \"Mesh\"; allowed are File "
            "name");
  EXPECT_EQ(example.refusal("a.prm", "subsection Mesh\nset Box = 1\nend\n"),
            "a.prm:2: \"Box\" is a subsection, not an entry");
  EXPECT_EQ(example.refusal(
              "a.prm", "subsection Material\nsubsection Density\nend\nend\n"),
            "a.prm:2: \"Density\" is an entry, not a subsection");
}

TEST(ParameterFile, RefusesValuesThatAreNotAllowed)
{
  Example example;
  EXPECT_EQ(example.refusal("a.prm",
                            "subsection Material\n  set Density = -1\nend\n"),
            "a.prm:2: the value \"-1\" of \"Material/Density\" is not "
            "allowed; allowed is a number >= 0");
  // The message tells the limit of whole numbers where a value exceeds it.
  for (const auto &[value, allowed] :
       {std::pair("0", "a whole number >= 1"),
        std::pair("2147483648", "a whole number from 1 to 2147483647"),
        std::pair("1e400", "a whole number from 1 to 2147483647")})
    EXPECT_EQ(example.refusal("a.prm",
                              "",
                              {std::string("Mesh/Box/Cells (per side) = ") +
                               value}),
              std::string("--set: the value \"") + value +
                "\" of \"Mesh/Box/Cells (per side)\" is not allowed; allowed "
                "is " +
                allowed);
  EXPECT_EQ(example.refusal("a.prm",
                            "subsection Material\n  set Law = linea\nend\n"),
            "a.prm:2: the value \"linea\" of \"Material/Law\" is not allowed; "
            "allowed is one of linear, corotational; did you mean "
            "\"linear\"?");
  EXPECT_EQ(example.refusal("a.prm",
                            "subsection Material\n  set Law = rubber\nend\n"),
            "a.prm:2: the value \"rubber\" of \"Material/Law\" is not "
            "allowed; allowed is one of linear, corotational");
  // ParameterHandler::parse_input() would take any text with a brace.
  EXPECT_EQ(example.refusal("a.prm",
                            "subsection Material\n  set Density = {1}\nend\n"),
            "a.prm:2: the value \"{1}\" of \"Material/Density\" is not "
            "allowed; allowed is a number >= 0");
  EXPECT_EQ(example.refusal("a.prm", "", {"Mesh/File name = a#b"}),
            "--set: the value of \"Mesh/File name\" has a #, a line break or "
            "a backslash at its end; a parameter cannot have these");
  EXPECT_EQ(example.refusal("a.prm", "", {"Mesh/File name = \xff"}),
            "--set: the value of \"Mesh/File name\" is not encoded in UTF-8");
}

TEST(ParameterFile, RefusesBrokenPrm)
{
  Example example;
  EXPECT_EQ(example.refusal("a.prm", "subsection Mesh\nsubsection Box\nend\n"),
            "a.prm:1: subsection \"Mesh\" is opened here and never left; an "
            "\"end\" is missing");
  EXPECT_EQ(example.refusal("a.prm", "subsection Mesh\nend\nend\n"),
            "a.prm:3: \"end\", but there is no subsection to leave here");
  EXPECT_EQ(example.refusal("a.prm", "subsection Mesh\nend of Mesh\n"),
            "a.prm:2: \"of Mesh\" behind \"end\"; nothing may follow");
  EXPECT_EQ(example.refusal("a.prm", "subsection\n"),
            "a.prm:1: \"subsection\" without a name");
  EXPECT_EQ(example.refusal("a.prm", "set Density 3\n"),
            "a.prm:1: \"set Density 3\" is not of the form \"set Entry = "
            "value\"");
  EXPECT_EQ(example.refusal("a.prm", "Density = 3\n"),
            "a.prm:1: \"Density = 3\" is no statement; allowed are \"set Entry "
            "= value\", \"subsection Name\", \"end\" and \"include FILE\"");
  EXPECT_EQ(example.refusal("a.prm", "include b.prm\n"),
            "a.prm:1: the file to include, \"b.prm\", does not exist");
  EXPECT_EQ(example.refusal("a.prm", "include a.prm\n"),
            "a.prm:1: files include each other more than 10 deep");
}

TEST(ParameterFile, RefusesBrokenJson)
{
  Example           example;
  const std::string message = example.refusal("a.json", "{\n\"Material\" 3}");
  EXPECT_EQ(message.rfind("a.json:2: it is no valid JSON: ", 0), 0) << message;
  // The message stays short, however long the text before the error is.
  const std::string start = "{\n\"Material\": \"";
  const std::string far_away =
    example.refusal("a.json", start + std::string(1'000'000, 'x') + "\" y}");
  EXPECT_EQ(far_away.rfind("a.json:2: it is no valid JSON: ", 0), 0);
  EXPECT_LT(far_away.size(), 400u);
  EXPECT_EQ(example.refusal("a.json", "[]"),
            "a.json: it must be one JSON object, {...}");
  EXPECT_EQ(example.refusal("a.json", "{\n\"Material\": {\"Density\": [1]}}"),
            "a.json:2: \"Material/Density\" is a list; allowed are a text, a "
            "number, true and false");
  // ParameterHandler::parse_input() would ignore this.
  EXPECT_EQ(
    example.refusal("a.json",
                    "{\"Material\":\n{\"Law\": \"linear\",\n\n\"Densty\": 1}}"),
    "a.json:4: there is no entry \"Densty\" in \"Material\"; did you "
    "mean \"Density\"?");
  // With entries as --print-parameters writes them, the line is that of the
  // value.
  EXPECT_EQ(example.refusal("a.json",
                            "{\"Material\": {\n\"Density\": {\n\"value\":"
                            "\n-1}}}"),
            "a.json:3: the value \"-1\" of \"Material/Density\" is not "
            "allowed; allowed is a number >= 0");
}

TEST(ParameterFile, RefusesBrokenXml)
{
  Example           example;
  const std::string message = example.refusal("a.xml", "<a>\n<b></a>");
  EXPECT_EQ(message.rfind("a.xml:2: it is no valid XML: ", 0), 0) << message;
  EXPECT_EQ(example.refusal("a.xml",
                            "<ParameterHandler><Material>\n<Density>5"
                            "</Densty></Material></ParameterHandler>"),
            "a.xml:2: it is no valid XML: found '</Densty>', the end of "
            "another element; allowed: '</Density>'");
  EXPECT_EQ(example.refusal("a.xml",
                            "<ParameterHandler><Material>5<Density>5"
                            "</Density></Material></ParameterHandler>"),
            "a.xml:1: found the text '5' in \"Material\"; allowed there are "
            "elements");
  EXPECT_EQ(example.refusal("a.xml",
                            "<ParameterHandler><!--\n--><Mesh>\n"
                            "<Box/><Bux/></Mesh></ParameterHandler>"),
            "a.xml:3: there is no entry \"Bux\" in \"Mesh\"; allowed are File "
            "name");
  EXPECT_EQ(example.refusal("a.xml", "<a></a>"),
            "a.xml: it must have one outermost element, called "
            "ParameterHandler");
}

TEST(ParameterFile, RefusesWrongOverrides)
{
  Example example;
  EXPECT_EQ(example.refusal("a.prm", "", {"Material/Density"}),
            "--set: \"Material/Density\" is not of the form "
            "\"Section/Subsection/Entry = value\"");
  EXPECT_EQ(example.refusal("a.prm", "", {" = 3"}),
            "--set: \" = 3\" is not of the form \"Section/Subsection/Entry = "
            "value\"");
  EXPECT_EQ(example.refusal("a.prm", "", {"Materal/Density = 1"}),
            "--set: there is no subsection \"Materal\" at the top level; did "
            "you mean \"Material\"?");
  EXPECT_EQ(example.refusal("a.prm", "", {"Density = 1"}),
            "--set: there is no entry \"Density\" at the top level; it belongs "
            "to \"Material\"");
}

// Elements in elements without end are refused before a reader runs out of its
// stack; so are files that include each other more and more often.
TEST(ParameterFile, RefusesDeepNesting)
{
  const auto repeated = [](const std::string &text, const unsigned int n) {
    std::string result;
    for (unsigned int i = 0; i < n; ++i)
      result += text;
    return result;
  };
  const std::string reason =
    "its elements are nested too deeply; allowed are 20 levels";
  Example example;
  EXPECT_EQ(example.refusal("a.xml",
                            repeated("<a>", 100000) + repeated("</a>", 100000)),
            "a.xml: " + reason);
  // Nesting is also counted behind the shortest statement, "<?", and the
  // shortest end of an element.
  EXPECT_EQ(example.refusal("a.xml",
                            "<?"
                            "?>" +
                              repeated("<a>", 100)),
            "a.xml: " + reason);
  EXPECT_EQ(example.refusal("a.xml", repeated("<b><a></a>", 100)),
            "a.xml: " + reason);
  // Comments and statements do not count as levels.
  EXPECT_EQ(example.refusal("a.xml",
                            "<?xml version=\"1.0\"?><ParameterHandler>" +
                              repeated("<!-- a --><?b?>", 30) +
                              "</ParameterHandler>"),
            "accepted");
  EXPECT_EQ(example.refusal("a.json",
                            repeated("{\"a\":", 100000) + "1" +
                              repeated("}", 100000)),
            "a.json: " + reason);
  EXPECT_EQ(example.refusal("a.json", repeated("[", 100000)),
            "a.json: " + reason);
  EXPECT_EQ(example.refusal("a.prm", repeated("subsection a\n", 100000)),
            "a.prm:21: " + reason);
  // These texts only look as if they closed an element.
  for (const std::string closed : {"<a><!--</a>-->",
                                   "<a><![CDATA[</a>]]>",
                                   "<a><?b </a>?>",
                                   "<a b='</a>'>"})
    EXPECT_EQ(example.refusal("a.xml", repeated(closed, 50000)),
              "a.xml: " + reason);
  EXPECT_EQ(example.refusal("a.xml",
                            "<!DOCTYPE a [<!ENTITY b \"b\">]><a>&b;</a>"),
            "a.xml: it has a document type or entities; allowed are neither");
  example.folder.write("b.prm", repeated("include c.prm\n", 1000));
  example.folder.write("c.prm", "\n");
  EXPECT_EQ(example.refusal("a.prm", "include b.prm\ninclude b.prm\n"),
            "b.prm:1000: more than 1000 files are included");
}

// An entry is also refused where its subsection is left and entered again; but
// a file may set what a file that it includes has set.
TEST(ParameterFile, RefusesEntriesThatAreSetTwice)
{
  Example           example;
  const std::string set = "subsection Material\n  set Density = 3\nend\n";
  EXPECT_EQ(example.refusal("a.prm", set + set),
            "a.prm:5: \"Material/Density\" is set twice, first in line 2; "
            "allowed is once in a file");
  example.folder.write("b.prm", set);
  EXPECT_EQ(example.refusal("a.prm", "include b.prm\n" + set), "accepted");
  EXPECT_EQ(example.refusal("a.prm", "include b.prm\ninclude b.prm\n"),
            "accepted");
  for (const std::string entries :
       {"{\"Material\": {\n\"Density\": 1,\n\"Density\": 2}}",
        "{\n\"Density\": 1, \"Material\": {},\n\"Density\": 2}"})
    EXPECT_EQ(example.refusal("a.json", entries),
              "a.json:3: \"Density\" is set twice, first in line 2; allowed is "
              "once in a file");
  EXPECT_EQ(example.refusal("a.xml",
                            "<ParameterHandler><Material/>\n<Material/>"
                            "</ParameterHandler>"),
            "a.xml:2: \"Material\" is set twice; allowed is once in a file");
}

TEST(ParameterFile, RefusesZeroBytes)
{
  Example example;
  EXPECT_EQ(example.refusal("a.prm", "\n" + std::string(1, '\0') + "\n"),
            "a.prm:2: it has a zero byte; a parameter file is text");
}

// A parameter file must not make the program use many times the file's size in
// memory, nor hours of time.
TEST(ParameterFile, RefusesTooMuch)
{
  const auto repeated = [](const std::string &text, const unsigned int n) {
    std::string result;
    for (unsigned int i = 0; i < n; ++i)
      result += text;
    return result;
  };
  Example example;
  EXPECT_EQ(example.refusal("a.prm", std::string(2000001, '\n')),
            "a.prm: it has 2000001 bytes; a parameter file may have 2000000");
  std::string statements;
  for (unsigned int i = 0; i < 50001; ++i)
    statements += "set " + std::to_string(i) + "=1\n";
  EXPECT_EQ(example.refusal("a.prm", statements),
            "a.prm:50001: there are more than 50000 statements");
  const std::string name(600, 'a');
  EXPECT_EQ(example.refusal("a.prm",
                            "subsection " + name + "\nset " + name + " = 1\n"),
            "a.prm:2: the name \"" + std::string(80, 'a') +
              "... (1201 characters)\", with the sections it is in, is too "
              "long; allowed are 1000 characters");
  const std::string many =
    "it has more than 20000 elements; allowed are as many";
  EXPECT_EQ(example.refusal("a.xml", "<a>" + repeated("<b/>", 20000) + "</a>"),
            "a.xml: " + many);
  std::string entries;
  for (unsigned int i = 0; i < 20000; ++i)
    entries += "\"" + std::to_string(i) + "\":1,";
  EXPECT_EQ(example.refusal("a.json", "{" + entries + "\"b\":1}"),
            "a.json: " + many);
}

// Messages shorten a long value.
TEST(ParameterFile, RefusesLongValuesInShort)
{
  Example example;
  EXPECT_EQ(example.refusal("a.prm",
                            "subsection Material\n  set Law = " +
                              std::string(1000000, 'x') + "\nend\n"),
            "a.prm:2: the value \"" + std::string(80, 'x') +
              "... (1000000 characters)\" of \"Material/Law\" is not allowed; "
              "allowed is one of linear, corotational");
}

TEST(ParameterFile, SkipsAByteOrderMark)
{
  const std::string text = "subsection Material\n  set Density = 3\nend\n";
  for (const std::string mark : {"", "\xEF\xBB\xBF"})
    {
      Example example;
      EXPECT_EQ(example.refusal("a.prm", mark + text), "accepted");
      EXPECT_EQ(example.density, 3);
    }
}
