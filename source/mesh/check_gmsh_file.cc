// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/mesh/check_gmsh_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <vector>

namespace corotet
{
  namespace
  {
    namespace fs = std::filesystem;

    // A token of a .geo file: a word, the content of a text, or any other
    // character.
    struct Token
    {
      enum class Kind
      {
        word,
        text,
        sign
      };
      Kind        kind;
      std::string content;
      unsigned    line;
    };



    bool
    is_of_word(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    }



    // The tokens of a text, without comments and spaces.
    std::vector<Token>
    tokens_of(const std::string &text)
    {
      std::vector<Token> tokens;
      unsigned           line = 1;
      for (std::size_t i = 0; i < text.size();)
        {
          std::size_t end  = i + 1;
          const auto  find = [&](const std::string &what,
                                const std::size_t  length = 1) {
            const std::size_t found = text.find(what, i + length);
            return found == std::string::npos ? text.size() :
                                                 found + what.size();
          };
          if (text.compare(i, 2, "//") == 0)
            end = find("\n");
          else if (text.compare(i, 2, "/*") == 0)
            // "/*/" does not close the comment that it opens.
            end = find("*/", 2);
          else if (text[i] == '"' || text[i] == '\'')
            {
              end = find(std::string(1, text[i]));
              tokens.push_back(
                {Token::Kind::text, text.substr(i + 1, end - i - 2), line});
            }
          else if (is_of_word(text[i]))
            {
              while (end < text.size() && is_of_word(text[end]))
                ++end;
              tokens.push_back(
                {Token::Kind::word, text.substr(i, end - i), line});
            }
          else if (!std::isspace(static_cast<unsigned char>(text[i])))
            tokens.push_back({Token::Kind::sign, {text[i]}, line});
          line += std::count(text.begin() + i, text.begin() + end, '\n');
          i = end;
        }
      return tokens;
    }



    // gmsh's keywords for actions that a geometry must not have, with their
    // description.
    const std::map<std::string, std::string> &
    forbidden_words()
    {
      static const std::map<std::string, std::string> words{
        {"SystemCall", "runs a command"},
        {"NonBlockingSystemCall", "runs a command"},
        {"OnelabRun", "runs a command"},
        {"OnelabAction", "runs a command"},
        {"ExternalProcess", "runs a command"},
        {"CommandLine", "runs a command"},
        {"Save", "writes a file"},
        {"Print", "writes a file"},
        {"CreateDir", "makes a folder"},
        {"Exit", "ends gmsh"},
        {"Abort", "ends gmsh"},
        {"Sleep", "waits"}};
      return words;
    }



    class GeoCheck
    {
    public:
      explicit GeoCheck(const std::string &path)
        : folder(fs::weakly_canonical(fs::absolute(path).parent_path()))
      {
        check(path);
      }

    private:
      using Kind = Token::Kind;

      // Checks a file. @p depth is the number of files that include it, one
      // inside of the other.
      void
      check(const std::string &path, const unsigned int depth = 0)
      {
        if (!seen.insert(fs::weakly_canonical(path).string()).second)
          return;
        if (depth > max_include_depth)
          throw InputError("",
                           fmt::format("{}: files include each other more than "
                                       "{} deep",
                                       path,
                                       max_include_depth));
        file                   = path;
        const std::string text = read_whole_file(path);
        // A zero byte ends comments for gmsh.
        if (text.find('\0') != std::string::npos)
          throw InputError("",
                           path + ": is no text: found a byte that is zero");
        const std::vector<Token>       tokens  = tokens_of(text);
        const std::vector<std::size_t> closing = closing_brackets(tokens);
        check_end(text, tokens, path);
        for (std::size_t i = 0; i < tokens.size(); ++i)
          if (tokens[i].kind == Kind::word)
            {
              const bool is_option = is_sign(tokens, i + 1, '.');
              if (const auto found = forbidden_words().find(tokens[i].content);
                  found != forbidden_words().end() && !is_option)
                refuse(tokens[i], found->second);
              if (tokens[i].content == "Printf" &&
                  is_redirected(tokens, closing, i + 1))
                refuse(tokens[i], "writes a file here");
              check_reading(tokens, i, depth);
              file = path;
            }
      }

      // gmsh leaves out a last line of its language without a line break.
      static void
      check_end(const std::string        &text,
                const std::vector<Token> &tokens,
                const std::string        &path)
      {
        std::string ending = fs::path(path).extension().string();
        for (char &c : ending)
          c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        const unsigned last_line =
          1 + std::count(text.begin(), text.end(), '\n');
        if (ending == ".geo" && !tokens.empty() && text.back() != '\r' &&
            tokens.back().line == last_line)
          throw InputError("",
                           fmt::format("{}:{}: the last line does not end with "
                                       "a line break: gmsh would leave it out",
                                       path,
                                       last_line));
      }

      static bool
      is_sign(const std::vector<Token> &tokens,
              const std::size_t         i,
              const char                sign)
      {
        return i < tokens.size() && tokens[i].kind == Kind::sign &&
               tokens[i].content[0] == sign;
      }

      // The position of the closing bracket for each opening one, or the end.
      static std::vector<std::size_t>
      closing_brackets(const std::vector<Token> &tokens)
      {
        std::vector<std::size_t> result(tokens.size(), tokens.size()), open;
        for (std::size_t i = 0; i < tokens.size(); ++i)
          if (is_sign(tokens, i, '('))
            open.push_back(i);
          else if (is_sign(tokens, i, ')') && !open.empty())
            {
              result[open.back()] = i;
              open.pop_back();
            }
        return result;
      }

      // Whether '>' follows the brackets that begin at @p i.
      static bool
      is_redirected(const std::vector<Token>       &tokens,
                    const std::vector<std::size_t> &closing,
                    const std::size_t               i)
      {
        return i < tokens.size() &&
               is_sign(tokens,
                       (is_sign(tokens, i, '(') ? closing[i] : i) + 1,
                       '>');
      }

      // Checks the file whose name follows a word that makes gmsh read a file.
      void
      check_reading(const std::vector<Token> &tokens,
                    const std::size_t         i,
                    const unsigned int        depth)
      {
        static const std::set<std::string> reading{"Include",
                                                   "Merge",
                                                   "MergeFile",
                                                   "ShapeFromFile",
                                                   "ListFromFile",
                                                   "FileName"};
        if (!reading.contains(tokens[i].content))
          return;
        std::size_t next = i + 1;
        while (is_sign(tokens, next, '(') || is_sign(tokens, next, '='))
          ++next;
        if (next >= tokens.size() || tokens[next].kind != Kind::text)
          return;
        const fs::path named =
          fs::path(file).parent_path() / tokens[next].content;
        std::error_code error;
        const fs::path  real = fs::weakly_canonical(fs::absolute(named), error);
        if (error || std::mismatch(
                       folder.begin(), folder.end(), real.begin(), real.end())
                         .first != folder.end())
          refuse(tokens[next],
                 "reads a file outside of the folder of the geometry");
        // Endings of files that are not texts in gmsh's language.
        static const std::set<std::string> others{".msh",
                                                  ".stl",
                                                  ".step",
                                                  ".stp",
                                                  ".iges",
                                                  ".igs",
                                                  ".brep",
                                                  ".brp",
                                                  ".csv",
                                                  ".txt",
                                                  ".dat",
                                                  ".png",
                                                  ".jpg"};
        if (!others.contains(real.extension().string()) &&
            fs::is_regular_file(real, error) &&
            tokens[i].content != "ListFromFile" &&
            tokens[i].content != "FileName")
          check(named.lexically_normal().string(), depth + 1);
      }

      [[noreturn]] void
      refuse(const Token &token, const std::string &deed) const
      {
        throw InputError(
          "",
          fmt::format("{}:{}: found '{}', which {}; a geometry may not run "
                      "commands, write files, read files outside of its "
                      "folder, wait, or end gmsh (cells are taken from gmsh "
                      "as they are: nothing needs to be saved)",
                      file,
                      token.line,
                      shortened(token.content),
                      deed));
      }

      static constexpr unsigned int max_include_depth = 20;

      const fs::path        folder;
      std::set<std::string> seen;
      std::string           file;
    };
  } // namespace



  double
  check_msh(const std::string &path)
  {
    const std::string text   = read_whole_file(path);
    const std::string format = "$MeshFormat";
    std::size_t       begin  = 0;
    while (text.compare(begin, 9, "$Comments") == 0)
      {
        const std::size_t end = text.find("\n$EndComments", begin);
        begin                 = text.find_first_not_of(" \t\r\n",
                                       std::min(text.find('\n', end + 1),
                                                text.size()));
        if (end == std::string::npos || begin == std::string::npos)
          break;
      }
    if (begin >= text.size() || text.compare(begin, format.size(), format) != 0)
      throw InputError("",
                       path +
                         ": is no gmsh mesh: it must start with "
                         "'$MeshFormat'" +
                         (text.starts_with(byte_order_mark) ?
                            ", not with a byte order mark, which some editors "
                            "write" :
                            ""));
    for (const std::string section : {"MeshFormat", "Nodes", "Elements"})
      for (const std::string start : {"\n$", "\n$End"})
        if (section != "MeshFormat" || start != "\n$")
          if (text.find(start + section) == std::string::npos &&
              (section != "Nodes" ||
               text.find(start + "Parametric" + section) == std::string::npos))
            throw InputError("",
                             fmt::format("{}: is no whole gmsh mesh: found no "
                                         "'{}{}'",
                                         path,
                                         start.substr(1),
                                         section));
    return std::strtod(text.c_str() + begin + format.size(), nullptr);
  }



  void
  check_geo(const std::string &path)
  {
    const GeoCheck check(path);
  }
} // namespace corotet
