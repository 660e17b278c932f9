"""Decoding pictures that a student's program wrote: in a box of its own, by a small program.

A file that breaks the image library breaks nothing but its own decoding. All of a student's
pictures at hand share one box. What comes out of it is taken for numbers of a checked count and
nothing else; whether they make a picture is said here, by the rules that hold everywhere.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path

import numpy as np

from ..judge.exr_rules import (
    DAMAGED_HEADER,
    DAMAGED_PIXELS,
    MAX_SAMPLES,
    UnusableImage,
    check_channels,
    check_version,
    checked_size,
    with_complaint,
)
from ..judge.pixels import Image
from ..sandbox import BoxResult, Limits
from .program import HarnessFault, Workshop

_SOURCE = Path(__file__).parent / "decoder" / "decode_exr.c"
_SECONDS = 60
_MEMORY = 2 << 30
_MOST_CHANNELS = 1024
_HEADER_BYTES = 1 << 16
_BROKEN = "the picture breaks the decoder"


class Undecodable(Exception):
    """A file is no picture; the text says why."""


class _Status(IntEnum):
    """As in decoder/decode_exr.c."""

    NO_HEADER = 0
    HEADER = 1
    COMPRESSION = 2
    NO_PIXELS = 3
    PIXELS = 4


@dataclass(frozen=True)
class _Channel:
    name: str
    xSampling: int
    ySampling: int


def decode(workshop: Workshop, files: Sequence[bytes], max_pixels: int) -> list[Image]:
    """The pixels of each file; raises `Undecodable` for the first that has none."""
    try:
        for file in files:
            check_version(file)
        output = _Reader(_run(workshop, files, max_pixels))
        images = [_image(output, max_pixels) for _ in files]
        output.end()
    except UnusableImage as reason:
        raise Undecodable(str(reason)) from None
    return images


def _run(workshop: Workshop, files: Sequence[bytes], max_pixels: int) -> bytes:
    largest = len(files) * (12 * max_pixels + _HEADER_BYTES)
    result = workshop.box.run(
        ["/decode", "pictures", "results", str(max_pixels), str(MAX_SAMPLES)],
        inputs={
            "/decode": workshop.tool(_SOURCE),
            "pictures": b"".join(struct.pack("=Q", len(file)) + file for file in files),
        },
        collect=["results"],
        limits=Limits(
            wall_seconds=2 * _SECONDS,
            cpu_seconds=_SECONDS,
            memory_bytes=_MEMORY,
            file_bytes=largest,
            scratch_bytes=largest + (1 << 20),
        ),
    )
    if result.ok and "results" in result.files:
        return result.files["results"]
    raise _failure(result)


def _failure(result: BoxResult) -> Exception:
    if result.outcome == "timeout":
        return UnusableImage("the picture takes too long to decode")
    if result.outcome in ("signaled", "memory"):
        return UnusableImage(_BROKEN)
    return HarnessFault(f"the decoder {result.describe()}")


class _Reader:
    """Numbers and texts out of the box; whatever does not add up is the picture's doing."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._at = 0

    def take(self, size: int) -> bytes:
        piece = self._data[self._at : self._at + size]
        if size < 0 or len(piece) != size:
            raise UnusableImage(_BROKEN)
        self._at += size
        return piece

    def number(self) -> int:
        return int(struct.unpack("=i", self.take(4))[0])

    def text(self) -> str:
        return self.take(self.number()).decode("utf-8", "replace")

    def window(self) -> tuple[int, int, int, int]:
        return self.number(), self.number(), self.number(), self.number()

    def channels(self) -> list[_Channel]:
        count = self.number()
        if count > _MOST_CHANNELS:
            raise UnusableImage(f"it has {count} channels: too many for its size")
        sampled = [(self.number(), self.number(), self.text()) for _ in range(count)]
        return [_Channel(name, x, y) for x, y, name in sampled]

    def end(self) -> None:
        if self._at != len(self._data):
            raise UnusableImage(_BROKEN)


def _image(output: _Reader, max_pixels: int) -> Image:
    status, complaint = output.number(), output.text()
    if status == _Status.NO_HEADER:
        raise UnusableImage(with_complaint(DAMAGED_HEADER, complaint))
    window, display, channels = output.window(), output.window(), output.channels()
    width, height = checked_size(window, display, max_pixels)
    check_channels(channels, width * height)
    if status == _Status.COMPRESSION:
        raise UnusableImage("its compression is DWAA or DWAB; write ZIP")
    if status != _Status.PIXELS:
        raise UnusableImage(with_complaint(DAMAGED_PIXELS, complaint))
    pixels = np.frombuffer(output.take(12 * width * height), np.float32)
    return pixels.reshape(height, width, 3)
