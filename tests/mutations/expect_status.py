#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""expect_status.py STATUS COMMAND...: runs a command, whose exit status must be STATUS."""

import subprocess
import sys

status = subprocess.run(sys.argv[2:], check=False).returncode
if status != int(sys.argv[1]):
    sys.exit(f"the exit status is {status}, not {sys.argv[1]}")
