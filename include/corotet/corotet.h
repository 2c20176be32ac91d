// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_corotet_h
#define corotet_corotet_h

/**
 * The library's public headers: what a program that uses it may need. Installed
 * are those below and what they include; all others are private.
 */

// Errors and exit statuses; what runs on one rank or on all.
#include <corotet/base/exceptions.h>
#include <corotet/base/log.h>
#include <corotet/base/mpi.h>
#include <corotet/base/version.h>

// Parts that a program may add: AddedCandidate, and what to derive from.
#include <corotet/base/selectable.h>
#include <corotet/forces/dead_load.h>
#include <corotet/forces/force_kind.h>
#include <corotet/laws/law_kind.h>
#include <corotet/material/point_law.h>
#include <corotet/mesh/mesh_source.h>
#include <corotet/time_integration/time_integrator.h>

// What these parts are told: the mesh, the nodes and cells, the conditions.
#include <corotet/discretization/boundary_conditions.h>
#include <corotet/discretization/discretization.h>

// The program, and a run of it step by step.
#include <corotet/simulation/command_line.h>
#include <corotet/studies/program.h>
#include <corotet/studies/stepped_run.h>

#endif
