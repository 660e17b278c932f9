"""Decoding pictures that a student's program wrote, in a child process with limits.

An image library that a crafted file breaks then breaks nothing else. Run as a program, this
module reads files from its standard input and writes their pixels to its standard output.
"""

from __future__ import annotations

import resource
import struct
import subprocess
import sys
from collections.abc import Sequence
from typing import BinaryIO

import numpy as np

from ..judge.exr import UnusableImage, decode_exr
from ..judge.pixels import Image
from .program import HarnessFault

_SECONDS = 60
_MEMORY = 4 << 30
_HEADER = struct.Struct("<cQII")
"""What follows, "i" for an image or "u" for a reason; its bytes; height and width."""


class Undecodable(Exception):
    """A file is no picture; the text says why."""


def decode(files: Sequence[bytes], max_pixels: int) -> list[Image]:
    """The pixels of each file; raises `Undecodable` for the first that has none."""
    stdin = b"".join(struct.pack("<Q", len(file)) + file for file in files)
    try:
        child = subprocess.run(
            [sys.executable, "-I", "-m", __name__, str(max_pixels)],
            input=stdin,
            capture_output=True,
            timeout=2 * _SECONDS,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise Undecodable("the picture takes too long to decode") from None
    if child.returncode < 0:
        raise Undecodable("the picture breaks the decoder")
    if child.returncode != 0:
        raise HarnessFault(f"the decoder failed:\n{child.stderr.decode('utf-8', 'replace')}")
    return _parse(child.stdout, len(files))


def _parse(output: bytes, count: int) -> list[Image]:
    images: list[Image] = []
    place = 0
    for _ in range(count):
        kind, size, height, width = _HEADER.unpack_from(output, place)
        place += _HEADER.size
        content = output[place : place + size]
        place += size
        if kind == b"u":
            raise Undecodable(content.decode("utf-8", "replace"))
        images.append(np.frombuffer(content, np.float32).reshape(height, width, 3))
    return images


def _serve(source: BinaryIO, sink: BinaryIO, max_pixels: int) -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (_SECONDS, _SECONDS))
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    while length := source.read(8):
        file = source.read(struct.unpack("<Q", length)[0])
        try:
            pixels = decode_exr(file, max_pixels).pixels
        except UnusableImage as reason:
            content = str(reason).encode("utf-8", "replace")
            sink.write(_HEADER.pack(b"u", len(content), 0, 0) + content)
        else:
            content = pixels.tobytes()
            sink.write(_HEADER.pack(b"i", len(content), *pixels.shape[:2]) + content)
    sink.flush()


if __name__ == "__main__":
    _serve(sys.stdin.buffer, sys.stdout.buffer, int(sys.argv[1]))
