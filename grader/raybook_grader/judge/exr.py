"""OpenEXR in and out, for files that a stranger may have written.

Everything that is not one plain scan-line part with full-size R, G and B is refused with
`UnusableImage`; its size is limited before a pixel is decoded. NaN is not an error here: the
verdict tells it.
"""

import io
import os
import stat
import struct
import tempfile
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR

from ..errors import BadInput
from .pixels import Image

MAX_PIXELS = 1 << 24  # 4096 x 4096: twice a 4K frame
MAX_SAMPLES = 1 << 26  # pixels times channels: 256 MiB decoded
MAX_FILE_BYTES = 1 << 29  # incompressible 32-bit data of MAX_SAMPLES, twice

_MAGIC = 20000630  # OpenEXR file layout, "Magic number" and "Version field"
_REFUSED_FLAGS = (
    (0x200, "it is tiled; write scan lines"),
    (0x800, "it holds deep data; write flat pixels"),
    (0x1000, "it has several parts; write one"),
)
_stderr_lock = threading.Lock()


class UnusableImage(BadInput):
    """A file or buffer is no picture that can be judged; the text says why."""


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
    _check_version(data)
    with _opened(data, header_only=True, failure="its header is damaged or cut short") as file:
        width, height = _checked_size(file.header(), max_pixels)
        _check_channels(file.header()["channels"], width * height)
    with _opened(data, header_only=False, failure="it is truncated or damaged") as file:
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
    data = encode_exr(pixels, header)
    write_aside(Path(path), lambda temporary: temporary.write_bytes(data))


def write_aside(path: Path, write: Callable[[Path], object]) -> None:
    """Let `write` fill a temporary neighbour of `path`, then rename it over `path`."""
    descriptor, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    os.close(descriptor)
    temporary = Path(name)
    try:
        write(temporary)
        temporary.chmod(0o644)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


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


def _check_version(data: bytes) -> None:
    if not data:
        raise UnusableImage("it is empty, not an OpenEXR picture")
    if len(data) < 8 or struct.unpack_from("<i", data)[0] != _MAGIC:
        raise UnusableImage("it is not an OpenEXR picture")
    flags = struct.unpack_from("<I", data, 4)[0]
    for flag, reason in _REFUSED_FLAGS:
        if flags & flag:
            raise UnusableImage(reason)


def _checked_size(header: Mapping[str, Any], max_pixels: int) -> tuple[int, int]:
    window, display = (_box(header[name]) for name in ("dataWindow", "displayWindow"))
    width, height = window[2] - window[0] + 1, window[3] - window[1] + 1
    if width < 1 or height < 1:
        raise UnusableImage(f"its data window {window} is empty")
    if width * height > max_pixels:
        raise UnusableImage(
            f"its data window claims {width} x {height} pixels; at most {max_pixels} are read"
        )
    if window != display:
        raise UnusableImage(f"its data window {window} is not its display window {display}")
    return width, height


def _box(corners: Any) -> tuple[int, int, int, int]:
    (x0, y0), (x1, y1) = corners
    return int(x0), int(y0), int(x1), int(y1)


def _check_channels(channels: Any, pixels: int) -> None:
    by_name = {channel.name: channel for channel in channels}
    missing = [name for name in "RGB" if name not in by_name]
    if missing:
        found = ", ".join(sorted(by_name)[:8]) or "none"
        raise UnusableImage(f"it has no channel {', '.join(missing)} (found: {found})")
    if len(by_name) * pixels > MAX_SAMPLES:
        raise UnusableImage(f"it has {len(by_name)} channels: too many for its size")
    for channel in by_name.values():
        if (channel.xSampling, channel.ySampling) != (1, 1):
            raise UnusableImage(f"its channel {channel.name!r} is subsampled")


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
        raise UnusableImage(failure + _first_words(complaints))
    yield file


def _first_words(complaints: list[str]) -> str:
    words = " ".join(complaints).replace("<python_buffer>: ", "").splitlines()
    printable = "".join(c for c in words[0] if c.isprintable())[:160] if words else ""
    return f" ({printable})" if printable else ""


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
