// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_parameter_schema_h
#define corotet_base_parameter_schema_h

#include <nlohmann/json_fwd.hpp>

#include <ostream>

namespace corotet
{
  /**
   * Prints the JSON Schema (draft 2020-12) of parameter files in JSON, made of
   * a ParameterHandler's JSON tree: with it editors complete names and values,
   * show their meaning, and mark mistakes. It allows what the program reads: an
   * entry's value as number, true, false or text, alone or in an object as its
   * "value".
   */
  void
  print_schema(const nlohmann::ordered_json &tree, std::ostream &out);
} // namespace corotet

#endif
