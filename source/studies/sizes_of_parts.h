// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_sizes_of_parts_h
#define corotet_studies_sizes_of_parts_h

#include <corotet/discretization/discretization.h>
#include <corotet/discretization/reference_element.h>

#include <map>
#include <string>

namespace corotet
{
  /// Volumes of regions [m^3] and areas of boundaries [m^2] at rest, by "the
  /// region 'name'" and "the boundary 'name'". Collective.
  std::map<std::string, double>
  sizes_of_parts(const Discretization   &discretization,
                 const ReferenceElement &reference);

  /// What to say of parts that are not as large in one run of a study as they
  /// were in an earlier one; empty if all are.
  std::string
  describe_changed_parts(const std::map<std::string, double> &before,
                         const std::map<std::string, double> &now);
} // namespace corotet

#endif
