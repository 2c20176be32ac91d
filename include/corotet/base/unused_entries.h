// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_unused_entries_h
#define corotet_base_unused_entries_h

#include <corotet/base/parameter_file.h>

#include <string>
#include <vector>

namespace corotet
{
  /**
   * A file may have parameters of several candidates of a choice, so that the
   * entry `Type` beside their subsections switches among them. This looks for
   * entries of candidates that are not selected, with other values than their
   * defaults, which have no effect on the run. Subsections @p used, such as
   * "Linear solver/amg", are left out: something else reads them.
   *
   * Throws InputError if nobody has made the choice: the file, say, has the
   * subsection `gmsh` but not `set Type = gmsh`, so its mesh would be
   * forgotten. Otherwise returns a line of text for each such subsection: which
   * entries, where they are, and what is selected.
   */
  std::vector<std::string>
  find_unused_entries(const ParameterFile            &file,
                      const std::vector<std::string> &used);

  /**
   * A line of text if the entry @p place, or an entry in the subsection of that
   * path, has another value than its default, which has no effect because of
   * the value of the entry @p choice. Empty otherwise.
   */
  std::string
  unused_entry(const ParameterFile &file,
               const std::string   &place,
               const std::string   &choice);
} // namespace corotet

#endif
