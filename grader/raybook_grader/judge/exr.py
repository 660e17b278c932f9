"""OpenEXR in and out, for files that a stranger may have written.

What `exr_rules` does not allow is refused with `UnusableImage`. NaN is not an error here: the
verdict tells it.
"""

import io
import os
import stat
import tempfile
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR

from ..files import write_bytes
from .exr_rules import (
    DAMAGED_HEADER,
    DAMAGED_PIXELS,
    MAX_PIXELS,
    UnusableImage,
    Window,
    check_channels,
    check_version,
    checked_size,
    with_complaint,
)
from .pixels import Image

__all__ = ["ExrImage", "UnusableImage", "decode_exr", "encode_exr", "read_exr", "write_exr"]

MAX_FILE_BYTES = 1 << 29  # incompressible 32-bit data of MAX_SAMPLES, twice

_stderr_lock = threading.Lock()


@dataclass(frozen=True)
class ExrImage:
    """Pixels (height, width, 3) float32 and the header's attributes by name."""

    pixels: Image
    header: Mapping[str, Any]


def read_exr(path: str | os.PathLike[str], max_pixels: int = MAX_PIXELS) -> ExrImage:
    """Read a regular file; raises `UnusableImage`, its text starting with the path."""
    try:
        return decode_exr(_file_bytes(Path(path)), max_pixels)
    except UnusableImage as reason:
        raise UnusableImage(f"{path}: {reason}") from None


def decode_exr(data: bytes, max_pixels: int = MAX_PIXELS) -> ExrImage:
    """Decode a whole EXR file held in memory; raises `UnusableImage`."""
    check_version(data)
    with _opened(data, header_only=True, failure=DAMAGED_HEADER) as file:
        window, display = (_window(file.header()[n]) for n in ("dataWindow", "displayWindow"))
        width, height = checked_size(window, display, max_pixels)
        check_channels(file.header()["channels"], width * height)
    with _opened(data, header_only=False, failure=DAMAGED_PIXELS) as file:
        channels = file.channels()
        pixels = np.stack([channels[name].pixels for name in "RGB"], axis=-1)
        if pixels.shape != (height, width, 3):
            raise UnusableImage("its pixels do not fill its data window")
        return ExrImage(pixels.astype(np.float32), dict(file.header()))


def encode_exr(pixels: Image, header: Mapping[str, Any] | None = None) -> bytes:
    """An EXR file of 32-bit floats, ZIP compressed, as bytes."""
    attributes = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    attributes.update(header or {})
    planes = {c: np.ascontiguousarray(pixels[..., i], np.float32) for i, c in enumerate("RGB")}
    buffer = io.BytesIO()
    OpenEXR.File(attributes, planes).write(buffer)
    return buffer.getvalue()


def write_exr(path: str | os.PathLike[str], pixels: Image, **header: Any) -> None:
    """Write `pixels`, complete or not at all; keyword arguments become header attributes."""
    write_bytes(Path(path), encode_exr(pixels, header))


def _window(corners: Any) -> Window:
    (x0, y0), (x1, y1) = corners
    return int(x0), int(y0), int(x1), int(y1)


def _file_bytes(path: Path) -> bytes:
    try:
        # Not to hang on a pipe: nothing is opened for long before its kind is known.
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError as error:
        raise UnusableImage(f"cannot be opened: {error.strerror}") from None
    with open(descriptor, "rb") as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            raise UnusableImage("is not a regular file")
        if status.st_size > MAX_FILE_BYTES:
            raise UnusableImage(f"holds {status.st_size} bytes; at most {MAX_FILE_BYTES} are read")
        return file.read(MAX_FILE_BYTES)


@contextmanager
def _opened(data: bytes, *, header_only: bool, failure: str) -> Iterator[Any]:
    """The file, opened; its library's complaints become the text of `UnusableImage`."""
    with _captured_stderr() as complaints, redirect_stdout(io.StringIO()):
        try:
            file = OpenEXR.File(
                io.BytesIO(data), separate_channels=True, header_only=header_only, num_threads=0
            )
            readable = bool(file.parts)
        except (RuntimeError, ValueError, TypeError, MemoryError):
            readable = False
    if not readable:
        said = " ".join(complaints).replace("<python_buffer>: ", "")
        raise UnusableImage(with_complaint(failure, said))
    yield file


@contextmanager
def _captured_stderr() -> Iterator[list[str]]:
    """Catch what the C++ library prints: one bad file must give one message, ours."""
    complaints: list[str] = []
    with _stderr_lock, tempfile.TemporaryFile() as sink:
        saved = os.dup(2)
        os.dup2(sink.fileno(), 2)
        try:
            yield complaints
        finally:
            os.dup2(saved, 2)
            os.close(saved)
            sink.seek(0)
            complaints.append(sink.read(4096).decode("utf-8", "replace"))
