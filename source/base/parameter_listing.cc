// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/parameter_listing.h>
#include <corotet/base/text.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <regex>

namespace corotet
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    std::string
    describe_range(const std::string &noun,
                   const std::string &lower,
                   const std::string &upper)
    {
      const std::string min_int =
        std::to_string(std::numeric_limits<int>::min());
      const std::string max_int =
        std::to_string(std::numeric_limits<int>::max());
      const bool from_any = lower == "-MAX_DOUBLE" || lower == min_int;
      const bool to_any   = upper == "MAX_DOUBLE" || upper == max_int;
      if (from_any && to_any)
        return noun;
      if (from_any)
        return noun + " <= " + upper;
      if (to_any)
        return noun + " >= " + lower;
      return noun + " from " + lower + " to " + upper;
    }

    std::string
    describe_list(const std::string &element,
                  const std::string &lower,
                  const std::string &upper,
                  const std::string &separator)
    {
      const std::string max_length =
        std::to_string(std::numeric_limits<unsigned int>::max());
      std::string length;
      if (lower == upper)
        length = lower + " values";
      else if (upper != max_length)
        length = lower + " to " + upper + " values";
      else
        length = lower == "0" ? "any number of values" :
                                "at least " + lower + " values";
      return fmt::format("{} separated by \"{}\", each {}",
                         length,
                         separator.empty() ? "," : separator,
                         describe_pattern(element));
    }

    std::string
    replaced(const std::string &text,
             const std::string &from,
             const std::string &to)
    {
      return dealii::Utilities::replace_in_string(text, from, to);
    }

    std::string
    text_of(const Json &entry, const std::string &key)
    {
      return entry.value(key, "");
    }

    // Prints the entries of a section before its subsections, as parameter
    // files list them.
    void
    print_prm_section(const Json        &tree,
                      const bool         documented,
                      const std::string &indent,
                      std::ostream      &out)
    {
      std::size_t longest = 0;
      for (const auto &[name, node] : tree.items())
        if (is_entry(node))
          longest = std::max(longest, name.size());

      bool first = true;
      for (const auto &[name, node] : tree.items())
        if (is_entry(node))
          {
            if (documented)
              {
                out << (first ? "" : "\n");
                const std::string comment =
                  fmt::format("{} [{}]",
                              text_of(node, "documentation"),
                              describe_pattern(
                                text_of(node, "pattern_description")));
                for (const std::string &line :
                     dealii::Utilities::break_text_into_lines(comment,
                                                              98 -
                                                                indent.size()))
                  out << indent << "# " << line << '\n';
              }
            const std::string value = text_of(node, "value");
            out << fmt::format("{}set {:{}} ={}{}\n",
                               indent,
                               name,
                               longest,
                               value.empty() ? "" : " ",
                               value);
            first = false;
          }

      for (const auto &[name, node] : tree.items())
        if (is_section(node) && !node.empty() && node.is_object())
          {
            if (!first)
              out << '\n';
            out << indent << "subsection " << name << '\n';
            print_prm_section(node, documented, indent + "  ", out);
            out << indent << "end\n";
            first = false;
          }
    }

    Json
    readable(const Json &tree)
    {
      Json result = Json::object();
      for (const auto &[name, node] : tree.items())
        if (is_entry(node))
          result[name] = {
            {"value", node.at("value")},
            {"default_value", node.at("default_value")},
            {"documentation", node.at("documentation")},
            {"pattern_description", node.at("pattern_description")},
            {"allowed",
             describe_pattern(text_of(node, "pattern_description"))}};
        else if (is_section(node))
          result[name] = readable(node.is_object() ? node : Json::object());
      return result;
    }

    void
    print_markdown_section(const Json        &tree,
                           const std::string &path,
                           std::ostream      &out)
    {
      const auto cell = [](const std::string &text) {
        return replaced(text, "|", "\\|");
      };

      bool first = true;
      for (const auto &[name, node] : tree.items())
        if (is_entry(node))
          {
            if (first)
              out << "## " << (path.empty() ? "Top level" : path) << "\n\n"
                  << "| Entry | Default | Allowed | Meaning |\n"
                  << "|---|---|---|---|\n";
            first                   = false;
            const std::string value = text_of(node, "default_value");
            out << fmt::format("| {} | {} | {} | {} |\n",
                               cell(name),
                               value.empty() ? "" : "`" + cell(value) + "`",
                               cell(describe_pattern(
                                 text_of(node, "pattern_description"))),
                               cell(text_of(node, "documentation")));
          }
      if (!first)
        out << '\n';

      for (const auto &[name, node] : tree.items())
        if (is_section(node) && node.is_object())
          print_markdown_section(node,
                                 path.empty() ? name : path + "/" + name,
                                 out);
    }
  } // namespace

  std::vector<std::string>
  selection_names(const std::string &description)
  {
    static const std::regex selection(R"(\[Selection (.*\S)\s*\])");
    std::smatch             match;
    if (!std::regex_match(description, match, selection))
      return {};
    return dealii::Utilities::split_string_list(match[1].str(), '|');
  }

  std::string
  describe_pattern(const std::string &description)
  {
    static const std::regex range(
      R"(\[(Double|Integer range) (\S+)\.\.\.(\S+) \(inclusive\)\])");
    static const std::regex list(
      R"(\[List of <(.*)> of length (\d+)\.\.\.(\d+) \(inclusive\)(?: separated by <(.*)>)?\])");

    static const std::regex map(
      R"(\[Map of <(.*)>:<(.*)> of length 0\.\.\.\d+ \(inclusive\)\])");

    std::smatch match;
    if (std::regex_match(description, match, range))
      return describe_range(match[1] == "Double" ? "a number" :
                                                   "a whole number",
                            match[2],
                            match[3]);
    if (const auto names = selection_names(description); !names.empty())
      return (names.size() == 1 ? "only " : "one of ") + join(names);
    if (std::regex_match(description, match, list))
      return describe_list(match[1], match[2], match[3], match[4]);
    if (std::regex_match(description, match, map))
      return fmt::format("any number of pairs separated by \",\", each {} and "
                         "{} separated by \":\"",
                         describe_pattern(match[1]),
                         describe_pattern(match[2]));
    if (description == "[Double]")
      return "a number";
    if (description == "[Integer]")
      return "a whole number";
    if (description == "[Bool]")
      return "true or false";
    if (description == "[Anything]")
      return "a text";
    if (description.starts_with("[FileName"))
      return "a file name";
    if (description == "[DirectoryName]")
      return "a folder name";
    return description;
  }

  std::string
  allowed_instead(const std::string &value, const std::string &description)
  {
    static const std::regex range(
      R"(\[Integer range (\S+)\.\.\.(\S+) \(inclusive\)\])");
    std::smatch match;
    if (std::regex_match(description, match, range) &&
        std::strtod(value.c_str(), nullptr) > std::numeric_limits<int>::max())
      return fmt::format("a whole number from {} to {}",
                         match[1].str(),
                         match[2].str());
    return describe_pattern(description);
  }

  bool
  is_entry(const nlohmann::ordered_json &node)
  {
    return node.is_object() && node.contains("value") &&
           node.at("value").is_string();
  }

  bool
  is_section(const nlohmann::ordered_json &node)
  {
    // A subsection without any content is printed as an empty text.
    return !is_entry(node) && !(node.is_object() && node.contains("alias"));
  }

  void
  print_prm(const nlohmann::ordered_json &tree,
            const bool                    documented,
            std::ostream                 &out)
  {
    print_prm_section(tree, documented, "", out);
  }

  void
  print_json(const nlohmann::ordered_json &tree, std::ostream &out)
  {
    out << readable(tree).dump(2) << '\n';
  }

  void
  print_markdown(const nlohmann::ordered_json &tree, std::ostream &out)
  {
    print_markdown_section(tree, "", out);
  }
} // namespace corotet
