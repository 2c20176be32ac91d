# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Writes frames, given as files of pictures, as PNG, GIF, WebP and MP4. Needs Pillow, and for MP4 ffmpeg."""

import os
import shutil
import subprocess

import numpy as np
from PIL import Image, PngImagePlugin

from commands import FULL, MARK, WrongInput, one_line

FILMS = (".gif", ".webp", ".mp4")
SUFFIXES = (".png", *FILMS)


def images(frames):
    for frame in frames:
        with Image.open(frame) as image:
            yield image.convert("RGB")


def write_png(frame, path, notes):
    """Writes a frame as PNG. @p notes are texts that are stored in the file, by name."""
    information = PngImagePlugin.PngInfo()
    for name, text in {"Software": MARK, **notes}.items():
        information.add_itxt(name, text)
    with Image.open(frame) as image:
        image.save(path, format="PNG", optimize=True, pnginfo=information)


def palette_of(frames):
    """A palette of 255 colours for all frames, chosen from the colours of some of them."""
    chosen = [frames[i] for i in sorted({round(x) for x in np.linspace(0, len(frames) - 1, 8)})]
    rows = np.concatenate([np.asarray(image)[:: max(1, len(chosen) // 2)] for image in images(chosen)])
    return Image.fromarray(rows).quantize(255, method=Image.Quantize.MAXCOVERAGE, kmeans=1, dither=Image.Dither.NONE)


def write_gif(frames, path, fps):
    palette = palette_of(frames)
    first, *others = (image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images(frames))
    first.save(path, format="GIF", save_all=True, append_images=others, duration=10 * round(100 / fps), loop=0, optimize=False, comment=MARK)


def write_webp(frames, path, fps):
    pictures = images(frames)
    notes = Image.Exif()
    notes[0x0131] = MARK  # Software
    next(pictures).save(path, format="WEBP", save_all=True, append_images=pictures, duration=round(1000 / fps), loop=0, quality=85, method=4,
                        exif=notes.tobytes())


def write_mp4(frames, path, fps):
    """Writes H.264, which every player knows. Its width and height must be even, so a column or a row of white may be added."""
    with Image.open(frames[0]) as image:
        width, height = image.size
    command = ["ffmpeg", "-v", "error", "-nostdin", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{fps:g}", "-i", "pipe:0",
               "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-threads", "2",
               "-fflags", "+bitexact", "-flags:v", "+bitexact", "-movflags", "+faststart", "-metadata", f"comment={MARK}", "-f", "mp4", str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        try:
            for image in images(frames):
                process.stdin.write(image.tobytes())
            process.stdin.close()
        except BrokenPipeError:
            pass  # ffmpeg says why
        message = process.stderr.read().decode(errors="replace").strip()
    if process.returncode:
        for full in FULL:
            if os.strerror(full) in message:
                raise OSError(full, os.strerror(full))
        raise WrongInput(f"ffmpeg could not write the film: {one_line(RuntimeError(message))}")


WRITERS = {".gif": write_gif, ".webp": write_webp, ".mp4": write_mp4}


def check_writers(suffixes):
    if ".mp4" in suffixes and not shutil.which("ffmpeg"):
        raise WrongInput("an MP4 needs ffmpeg, which is not installed; .gif and .webp do not")
