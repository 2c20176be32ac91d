// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_unused_parameters_h
#define corotet_studies_unused_parameters_h

#include <corotet/base/parameter_file.h>
#include <corotet/studies/run_parameters.h>

#include <string>
#include <vector>

namespace corotet
{
  /// Lines of text about entries that are set but have no effect on the run.
  /// Throws InputError as find_unused_entries() does.
  std::vector<std::string>
  unused_parameters(const ParameterFile &file, const RunParameters &parameters);

  /// Whether the density is set although it has no effect, in statics without
  /// gravity.
  bool
  has_unused_density(const ParameterFile        &file,
                     const SimulationParameters &parameters);
} // namespace corotet

#endif
