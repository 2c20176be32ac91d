# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes the page of a run, for scripts/report. Each of these modules needs only modules before it: columns and text handle names and numbers; run
and parameters read a folder of results; mesh, surface, fields and encode make the surface that the page draws; words, charts and tables make parts
of the page; page puts them together."""
