# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Lets VTK draw without a screen: by a VTK that needs no display, on the display that is there, or on an invisible display (Xvfb)."""

import atexit
import ctypes
import ctypes.util
import functools
import os
import secrets
import shutil
import struct
import subprocess
import tempfile

from commands import WrongInput


def connect():
    """A connection to the X server that DISPLAY names, or None."""
    library = ctypes.util.find_library("X11")
    if not library or not os.environ.get("DISPLAY"):
        return None
    x11 = ctypes.CDLL(library)
    x11.XOpenDisplay.restype = ctypes.c_void_p
    return x11.XOpenDisplay(None)


def needs_no_display():
    from vtkmodules import vtkRenderingOpenGL2
    return not hasattr(vtkRenderingOpenGL2, "vtkXOpenGLRenderWindow")


def end(server):
    server.terminate()
    server.wait()


@functools.cache
def have_display():
    """Call this before anything is drawn; one call is enough. If it starts a server Xvfb, that ends with this process, however the process ends: the
    server ends without connections, and this process keeps one open."""
    if needs_no_display() or connect():
        return
    if not shutil.which("Xvfb"):
        raise WrongInput("there is no display, and no Xvfb for an invisible one (package xvfb)")
    folder = tempfile.mkdtemp(prefix="corotet-display-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    # Only programs that have this key may connect to the server. The key holds for any display number (family 65535).
    authority = os.path.join(folder, "authority")
    fields = (b"", b"", b"MIT-MAGIC-COOKIE-1", secrets.token_bytes(16))
    with open(os.open(authority, os.O_CREAT | os.O_WRONLY, 0o600), "wb") as file:
        file.write(struct.pack(">H", 65535) + b"".join(struct.pack(">H", len(field)) + field for field in fields))
    pipe_end, start = os.pipe()
    command = ["Xvfb", "-displayfd", str(start), "-screen", "0", "640x480x24", "-nolisten", "tcp", "-terminate", "-auth", authority]
    server = subprocess.Popen(command, pass_fds=[start], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    atexit.register(end, server)
    os.close(start)
    with os.fdopen(pipe_end) as pipe:
        number = pipe.readline().strip()
    os.environ.update({"DISPLAY": f":{number}", "XAUTHORITY": authority})
    if not number or not connect():
        raise WrongInput("there is no display, and Xvfb could not make an invisible one")
