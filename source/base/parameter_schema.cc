// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/parameter_listing.h>
#include <corotet/base/parameter_schema.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <regex>
#include <string>

namespace corotet
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    // Regular expressions of JSON Schema (ECMAScript) for numbers in a text.
    const std::string whole_number_pattern = R"(^\s*[-+]?\d+\s*$)";
    const std::string number_pattern =
      R"(^\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*$)";

    // The number that a bound of a deal.II pattern is, or nothing if it is no
    // number.
    std::optional<double>
    bound(const std::string &text)
    {
      if (text == "MAX_DOUBLE" || text == "-MAX_DOUBLE")
        return std::nullopt;
      return std::stod(text);
    }

    Json
    number_schema(const std::string &description)
    {
      static const std::regex range(
        R"(\[(Double|Integer range) (\S+)\.\.\.(\S+) \(inclusive\)\])");
      const bool  is_whole = description.starts_with("[Integer");
      Json        schema{{"type", is_whole ? "integer" : "number"}};
      std::smatch match;
      if (std::regex_match(description, match, range))
        {
          if (const auto lower = bound(match[2]))
            schema["minimum"] = *lower;
          if (const auto upper = bound(match[3]))
            schema["maximum"] = *upper;
        }
      return {
        {"anyOf",
         {schema,
          {{"type", "string"},
           {"pattern", is_whole ? whole_number_pattern : number_pattern}}}}};
    }

    // The schema of the value of an entry with this deal.II pattern.
    Json
    value_schema(const std::string &description)
    {
      if (description.starts_with("[Double") ||
          description.starts_with("[Integer"))
        return number_schema(description);
      if (const auto names = selection_names(description); !names.empty())
        return {{"enum", names}};
      if (description == "[Bool]")
        return {{"enum", {true, false, "true", "false"}}};
      // A list with one item may be a number.
      return {{"type", {"string", "number"}}};
    }

    Json
    entry_schema(const Json &entry)
    {
      const std::string description = entry.value("pattern_description", "");
      const Json        value       = value_schema(description);
      return {{"description",
               entry.value("documentation", "") + " [" +
                 describe_pattern(description) + "]"},
              {"default", entry.at("default_value")},
              {"anyOf",
               {value,
                {{"type", "object"},
                 {"required", {"value"}},
                 {"properties", {{"value", value}}}}}}};
    }

    Json
    section_schema(const Json &section)
    {
      Json properties = Json::object();
      for (const auto &[name, node] : section.items())
        if (is_entry(node))
          properties[name] = entry_schema(node);
        else if (is_section(node))
          properties[name] =
            section_schema(node.is_object() ? node : Json::object());
      return {{"type", "object"},
              {"additionalProperties", false},
              {"properties", properties}};
    }
  } // namespace

  void
  print_schema(const nlohmann::ordered_json &tree, std::ostream &out)
  {
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", "Parameters of corotet"}};
    schema.update(section_schema(tree));
    schema["properties"]["$schema"] = {{"type", "string"},
                                       {"description",
                                        "The schema of this file."}};
    out << schema.dump(1) << '\n';
  }
} // namespace corotet
