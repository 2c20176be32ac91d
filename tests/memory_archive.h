// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_memory_archive_h
#define corotet_tests_memory_archive_h

#include <corotet/base/archive.h>

#include <map>
#include <string>

namespace corotet::tests
{
  /// A checkpoint that is kept in memory.
  class MemoryArchive : public Archive
  {
  public:
    using Archive::transfer;

    bool
    is_reading() const override
    {
      return reading;
    }

    void
    transfer(const std::string &name, std::string &text) override
    {
      if (reading)
        text = texts.at(section + name);
      else
        texts[section + name] = text;
    }

    void
    transfer(const std::string &name, Vector &vector) override
    {
      if (reading)
        vector = vectors.at(section + name);
      else
        vectors[section + name] = vector;
    }

    bool                               reading = false;
    std::map<std::string, std::string> texts;
    std::map<std::string, Vector>      vectors;
  };
} // namespace corotet::tests

#endif
