# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""The page of a run, for scripts/report. Each module needs those before it only: columns, text (names and numbers), run, parameters (what a folder
of results has), mesh, surface, fields, encode (the surface as the page draws it), words, charts, tables, page (the page's parts and the whole)."""
