// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The names of checkpoints and their files, and which checkpoints are removed.

#include <corotet/output/checkpoints.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <regex>
#include <system_error>

namespace corotet
{
  namespace
  {
    namespace fs = std::filesystem;
  } // namespace

  Checkpoints::Place
  Checkpoints::place_of(const Simulation &simulation)
  {
    return {simulation.step_number(), simulation.parts_made()};
  }

  std::string
  Checkpoints::in_words(const Place &place)
  {
    return fmt::format("{}step {}",
                       place.parts > 0 ? "within " : "",
                       place.step);
  }

  std::string
  Checkpoints::path_of(const Place &place) const
  {
    return fmt::format("{}/step_{:06}{}",
                       directory,
                       place.step,
                       place.parts > 0 ? fmt::format("_{}", place.parts) : "");
  }

  std::vector<Checkpoints::Place>
  Checkpoints::places() const
  {
    std::vector<Place> result;
    const std::regex   name(R"(step_(\d{6,10})(_(\d{1,10}))?\.json)");
    std::error_code    error;
    for (const auto &entry : fs::directory_iterator(directory, error))
      {
        std::smatch       match;
        const std::string file = entry.path().filename().string();
        if (!std::regex_match(file, match, name))
          continue;
        // No run has written a checkpoint with a higher number.
        constexpr auto      most  = std::numeric_limits<unsigned int>::max();
        const unsigned long step  = std::stoul(match[1]);
        const unsigned long parts = match[3].matched ? std::stoul(match[3]) : 0;
        if (step <= most && parts <= most)
          result.push_back({static_cast<unsigned int>(step),
                            static_cast<unsigned int>(parts)});
      }
    std::sort(result.rbegin(), result.rend());
    return result;
  }

  void
  Checkpoints::remove_unfinished() const
  {
    const std::regex name(
      R"((step_\d{6,10}(?:_\d{1,10})?)\.(h5|h5\.tmp|json\.tmp))");
    std::vector<fs::path> unfinished;
    std::error_code       error;
    for (const auto &entry : fs::directory_iterator(directory, error))
      {
        std::smatch       match;
        const std::string file = entry.path().filename().string();
        if (std::regex_match(file, match, name) &&
            (match[2] != "h5" ||
             !fs::exists(fmt::format("{}/{}.json", directory, match[1].str()))))
          unfinished.push_back(entry.path());
      }
    for (const fs::path &path : unfinished)
      fs::remove(path, error);
  }

  void
  Checkpoints::remove_old() const
  {
    remove_unfinished();
    const std::vector<Place> all = places();
    for (std::size_t i = parameters.keep; i < all.size(); ++i)
      for (const char *suffix : {".json", ".h5"})
        {
          const std::string path = path_of(all[i]) + suffix;
          std::error_code   error;
          fs::remove(path, error);
          if (!error)
            continue;
          // The run can go on with more checkpoints than it needs.
          log.warning(
            path + ": an old checkpoint cannot be removed: " + error.message());
          return;
        }
  }
} // namespace corotet
