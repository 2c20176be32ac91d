// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Checks what a restarted run must have in common with the run of its
// checkpoint.

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>
#include <corotet/output/checkpoints.h>
#include <corotet/output/table_checksums.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string_view>

namespace corotet
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    // Entries, and sections with a slash at the end, that may change when a run
    // is restarted.
    const std::vector<std::string> changeable{
      {"Checkpoint/",
       "Convergence study/",
       "Linear solver/",
       "Mesh/Partitioner",
       "Mesh/file/File",
       "Mesh/file/Time limit",
       "Mesh/gmsh/File",
       "Mesh/gmsh/Time limit",
       "Modes/",
       "Newton/",
       "Output/Directory",
       "Output/Overwrite",
       "Output/States",
       "Output/Steps between rows",
       "Output/Time between results",
       "Tables/",
       "Time integration/Adaptive step/",
       "Time integration/End time",
       "Time integration/Maximum halvings",
       "Time integration/Time step",
       "Verification/"}};

    // Whether an entry may change. Names of table files are not compared, as
    // they may be relative to another folder now; the mesh has a checksum.
    bool
    may_change(const std::string &entry)
    {
      return entry != "Time integration/Adaptive step/Enabled" &&
             std::any_of(changeable.begin(),
                         changeable.end(),
                         [&](const std::string &allowed) {
                           return allowed.back() == '/' ?
                                    entry.starts_with(allowed) :
                                    entry == allowed;
                         });
    }

    // Lists "Section/Entry" and text of all entries.
    void
    flatten(const Json                         &section,
            const std::string                  &path,
            std::map<std::string, std::string> &entries)
    {
      for (const auto &[key, node] : section.items())
        if (node.is_object())
          flatten(node, path + key + "/", entries);
        else
          entries[path + key] = node.get<std::string>();
    }

    // The items of a nested list and their separators, without blanks around
    // them.
    std::vector<std::string>
    items_and_separators(const std::string &text)
    {
      std::vector<std::string> parts(1);
      for (std::size_t i = 0; i < text.size(); ++i)
        if (const std::size_t end = end_of_quotes(text, i);
            end != std::string::npos)
          {
            parts.back() += text.substr(i, end + 1 - i);
            i = end;
          }
        else if (std::string_view(",;:&").find(text[i]) !=
                 std::string_view::npos)
          {
            parts.emplace_back(1, text[i]);
            parts.emplace_back();
          }
        else
          parts.back() += text[i] == '\t' ? ' ' : text[i];
      for (std::string &part : parts)
        part = dealii::Utilities::trim(part);
      return parts;
    }

    bool
    is_same_number(const std::string &a, const std::string &b)
    {
      char        *end_a = nullptr, *end_b = nullptr;
      const double x = std::strtod(a.c_str(), &end_a),
                   y = std::strtod(b.c_str(), &end_b);
      return !a.empty() && !b.empty() && *end_a == '\0' && *end_b == '\0' &&
             x == y;
    }

    // Compares words and numbers between blanks one by one, as in points, where
    // blanks do not matter; they matter in names without numbers.
    bool
    is_same_text_or_number(const std::string &a, const std::string &b)
    {
      if (a == b)
        return true;
      const auto words = [](const std::string &text) {
        std::istringstream stream(text);
        return std::vector<std::string>(
          std::istream_iterator<std::string>(stream), {});
      };
      const auto words_of_a = words(a), words_of_b = words(b);
      bool       has_number = false;
      return std::equal(words_of_a.begin(),
                        words_of_a.end(),
                        words_of_b.begin(),
                        words_of_b.end(),
                        [&](const std::string &x, const std::string &y) {
                          const bool is_number = is_same_number(x, y);
                          has_number           = has_number || is_number;
                          return is_number || x == y;
                        }) &&
             has_number;
    }

    // Whether all formulas with the table use it as a function of the time
    // itself.
    bool
    is_function_of_time(const std::string                        &table,
                        const std::map<std::string, std::string> &entries)
    {
      const std::regex call("\\b" + table + "\\s*\\("),
        call_of_time("\\b" + table + "\\s*\\(\\s*t\\s*\\)");
      const auto n_calls = [](const std::string &text,
                              const std::regex  &wanted) {
        return std::distance(
          std::sregex_iterator(text.begin(), text.end(), wanted), {});
      };
      return std::all_of(entries.begin(),
                         entries.end(),
                         [&](const auto &entry) {
                           return n_calls(entry.second, call) ==
                                  n_calls(entry.second, call_of_time);
                         });
    }

    // What is wrong with rows that were added to a table since the checkpoint
    // at @p time, when it had @p n_before rows; empty if nothing is.
    std::string
    refused_rows(const std::string   &name,
                 const TableFunction &table,
                 const std::size_t    n_before,
                 const double         time,
                 const Json          &parameters)
    {
      const std::vector<double> &arguments = table.rows();
      if (n_before == arguments.size())
        return "";
      std::map<std::string, std::string> entries;
      flatten(parameters, "", entries);
      if (!is_function_of_time(name, entries))
        return fmt::format("formulas have it of something else than t, so they "
                           "may change what the run has done");
      // A new row changes the slope at the last old row, and with it the
      // velocity of supports that move by this table.
      const double last = arguments[n_before - (table.is_cubic() ? 2 : 1)];
      const bool   moves_supports =
        entries["Boundary conditions/Displacement"].find(name) !=
        std::string::npos;
      if (time < last || (time == last && !moves_supports))
        return "";
      return fmt::format("they change it from {} on, and the run has come to "
                         "t = {}",
                         last,
                         time);
    }

    // Whether two texts are the same, except for the way to write numbers and
    // blanks around the items of lists.
    bool
    is_same(const std::string &a, const std::string &b)
    {
      const std::vector<std::string> parts_a = items_and_separators(a),
                                     parts_b = items_and_separators(b);
      return std::equal(parts_a.begin(),
                        parts_a.end(),
                        parts_b.begin(),
                        parts_b.end(),
                        is_same_text_or_number);
    }
  } // namespace

  std::optional<ChangedEntry>
  forbidden_change(const Json &before, const Json &now)
  {
    std::map<std::string, std::string> new_texts, old_texts;
    flatten(now, "", new_texts);
    flatten(before, "", old_texts);
    for (const auto &[entry, text] : new_texts)
      if (const auto old = old_texts.find(entry); old != old_texts.end() &&
                                                  !is_same(old->second, text) &&
                                                  !may_change(entry))
        return ChangedEntry{entry, text, old->second};
    return std::nullopt;
  }

  void
  Checkpoints::check_entries(const CheckpointReader &checkpoint) const
  {
    if (const auto change = forbidden_change(checkpoint.parameters(), values))
      throw InputError(change->entry,
                       fmt::format("--restart: found '{}', which the run "
                                   "cannot go on with; allowed: '{}', as "
                                   "before (times but for the start, the "
                                   "solvers, and when output is written may "
                                   "change)",
                                   change->now,
                                   change->before));
  }

  void
  Checkpoints::check_tables(CheckpointReader &checkpoint) const
  {
    std::string text;
    checkpoint.transfer("tables", text);
    std::vector<std::string> changed;
    std::string              name, refused;
    try
      {
        const Json before = Json::parse(text);
        changed           = changed_tables(before, body.tables);
        if (changed.empty())
          for (const auto &[known, table] : body.tables)
            // Checkpoints of older versions do not contain the time.
            if (before.contains(known) && before.at(known).contains("time"))
              if (refused = refused_rows(known,
                                         *table,
                                         before.at(known).at("rows"),
                                         before.at(known).at("time"),
                                         values);
                  !refused.empty())
                {
                  name = known;
                  break;
                }
      }
    catch (const Json::exception &)
      {
        throw InputError("",
                         directory + ": damaged: found '" + shortened(text) +
                           "' as checksums of tables");
      }
    if (changed.empty() && refused.empty())
      return;
    if (!changed.empty())
      name = changed.front();
    std::string entry = "Tables/Linear";
    for (const std::string &item : dealii::Utilities::split_string_list(
           values.at("Tables").at("Cubic").get<std::string>(), ','))
      if (dealii::Utilities::split_string_list(item, ':').front() == name)
        entry = "Tables/Cubic";
    if (changed.empty())
      throw InputError(entry,
                       fmt::format("--restart: found new rows in the table "
                                   "'{}': {}; allowed: the rows that it began "
                                   "with",
                                   name,
                                   refused));
    throw InputError(
      entry,
      fmt::format(
        "--restart: found other rows or another interpolation in the table "
        "'{}', which the run cannot go on with; allowed: the rows that it "
        "began with, and more behind them",
        name));
  }
} // namespace corotet
