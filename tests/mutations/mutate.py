#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""mutate.py SOURCE RESULT FROM TO: writes a copy of a file with a string replaced, which must be in it exactly once."""

import pathlib
import sys

source, result, old, new = sys.argv[1:]
text = pathlib.Path(source).read_text(encoding="utf-8")
if text.count(old) != 1:
    sys.exit(f"{source}: found {text.count(old)} times '{old}'; allowed: once. Adapt tests/mutations/CMakeLists.txt")
pathlib.Path(result).write_text(text.replace(old, new), encoding="utf-8")
