"""Modules that put something else in the place of the picture; their other answers are right."""

from __future__ import annotations

import io
import json
import struct
import subprocess
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR
from hostile_case import CHECKOUT, RENDERING, RIGHT, Case, Expect, Write, before_main
from hostile_course import SCENE, SIZE

from raybook_grader.judge.exr import decode_exr
from raybook_grader.judge.pixels import Image

BAD_PICTURE = Expect("fail", "PPPPf")

_INSTEAD = f"if ({RENDERING}) {{\n%s\n    _exit(0);\n}}"
_SEED = r"""
static unsigned long seed_of(void)
{
    static char line[4096];
    const int file = open("/proc/self/cmdline", O_RDONLY);
    const ssize_t size = read(file, line, sizeof line - 1);
    const char *word = memmem(line, size > 0 ? (size_t)size : 0, "--seed", 7);
    close(file);
    return word == NULL ? 0 : strtoul(word + 7, NULL, 10);
}
"""


def instead(body: str, before: str = "") -> Write:
    """C that runs in place of rendering; the program then ends well."""
    return before_main(_INSTEAD % body, RIGHT, before)


def picture(make: Callable[[], bytes], change: str = "") -> Write:
    """A file of these bytes in place of the picture; ``change`` is C that changes them first."""

    def write(folder: Path, name: str) -> None:
        content = make()
        numbers = ",".join(map(str, content))
        array = f"static unsigned char picture[] = {{{numbers or '0'}}};\n{_SEED if change else ''}"
        instead(f'{change}\n    put("out.exr", picture, {len(content)});', array)(folder, name)

    return write


def encoded(pixels: Image, compression: Any = OpenEXR.ZIP_COMPRESSION, **more: Any) -> bytes:
    planes = {c: np.ascontiguousarray(pixels[..., i], np.float32) for i, c in enumerate("RGB")}
    header = {"compression": compression, "type": OpenEXR.scanlineimage}
    buffer = io.BytesIO()
    OpenEXR.File(header, {**planes, **more}).write(buffer)
    return buffer.getvalue()


@cache
def right_picture() -> Image:
    """What the picture converges to."""
    with tempfile.TemporaryDirectory() as scratch:
        scene = json.loads(json.dumps(SCENE).replace("../build", str(CHECKOUT / "build")))
        (Path(scratch) / "scene.json").write_text(json.dumps(scene))
        out = Path(scratch) / "out.exr"
        program = CHECKOUT / "build" / "raybook"
        settings = ["--quiet", "--spp", "256", "--seed", "7", "--resolution", f"{SIZE}x{SIZE}"]
        subprocess.run([program, *settings, "-o", out, f"{scratch}/scene.json"], check=True)
        return decode_exr(out.read_bytes()).pixels


def flat() -> Image:
    return np.full((SIZE, SIZE, 3), right_picture().mean(axis=(0, 1)), np.float32)


def blurred() -> Image:
    """Every pixel the mean of the nine by nine round it."""
    wide = np.pad(right_picture(), ((4, 4), (4, 4), (0, 0)), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(wide, (9, 9), axis=(0, 1))
    mean: Image = windows.mean(axis=(-2, -1)).astype(np.float32)
    return mean


def with_pixel(value: float) -> bytes:
    pixels = right_picture().copy()
    pixels[5, 7] = value
    return encoded(pixels)


def with_window(x: int, y: int) -> bytes:
    data = encoded(right_picture())
    for name in (b"dataWindow", b"displayWindow"):
        at = data.index(name + b"\0box2i\0") + len(name) + 7 + 4
        data = data[:at] + struct.pack("<4i", 0, 0, x, y) + data[at + 16 :]
    return data


def with_flag(flag: int) -> bytes:
    data = encoded(right_picture())
    version = struct.unpack_from("<I", data, 4)[0] | flag
    return data[:4] + struct.pack("<I", version) + data[8:]


def damaged() -> bytes:
    data = bytearray(encoded(right_picture()))
    data[len(data) // 2 :: 3] = b"\xff" * len(data[len(data) // 2 :: 3])
    return bytes(data)


def many_channels() -> bytes:
    """A thousand channels of zeros: little to read, much to unpack."""
    zeros = np.zeros((SIZE, SIZE), np.float32)
    return encoded(right_picture(), **{f"extra{i:04}": zeros for i in range(1000)})


# Two pictures of one value for different seeds would be refused as identical.
_VARY = "picture[sizeof picture - 4 * (1 + seed_of() % 90)] ^= 1;"

CASES = [
    Case(
        "no-picture",
        "ends well without a picture",
        BAD_PICTURE.saying("left no picture"),
        write=instead(""),
    ),
    Case(
        "linked-picture",
        "a link to a file of the machine in its place",
        BAD_PICTURE.saying("left no picture"),
        write=instead('const int error = symlink("/program", "out.exr");\n(void)error;'),
        quick=True,
    ),
    Case(
        "pipe-picture",
        "a FIFO in its place, on which a reader waits for ever",
        BAD_PICTURE.saying("left no picture"),
        write=instead('mkfifo("out.exr", 0644);'),
    ),
    Case(
        "folder-picture",
        "a folder in its place",
        BAD_PICTURE.saying("left no picture"),
        write=instead('mkdir("out.exr", 0755);'),
    ),
    Case(
        "locked-picture",
        "a file that nobody may read",
        BAD_PICTURE.saying("left no picture"),
        write=instead('put("out.exr", "x", 1);\nchmod("out.exr", 0);'),
    ),
    Case("empty-picture", "an empty file", BAD_PICTURE.saying("it is empty"), write=picture(bytes)),
    Case(
        "text-picture",
        "text that calls itself EXR",
        BAD_PICTURE.saying("not an OpenEXR picture"),
        write=picture(lambda: b"EXR <script>evil</script>"),
    ),
    Case(
        "huge-window",
        "a header that claims 100,000 x 100,000 pixels",
        BAD_PICTURE.saying("claims 100000 x 100000 pixels"),
        write=picture(lambda: with_window(99_999, 99_999)),
        quick=True,
    ),
    Case(
        "long-window",
        "a header that claims 2^31 - 1 pixels in a row",
        BAD_PICTURE.saying("the picture cannot be read"),
        write=picture(lambda: with_window(2**31 - 2, 0)),
    ),
    Case(
        "tiled-picture",
        "a file of tiles",
        BAD_PICTURE.saying("it is tiled"),
        write=picture(lambda: with_flag(0x200)),
    ),
    Case(
        "deep-picture",
        "a file of deep pixels",
        BAD_PICTURE.saying("deep data"),
        write=picture(lambda: with_flag(0x800)),
    ),
    Case(
        "two-part-picture",
        "a file of several parts",
        BAD_PICTURE.saying("several parts"),
        write=picture(lambda: with_flag(0x1000)),
    ),
    Case(
        "cut-picture",
        "a file that ends too early",
        BAD_PICTURE.saying("truncated or damaged"),
        write=picture(lambda: encoded(right_picture())[:-200]),
    ),
    Case(
        "damaged-picture",
        "compressed data that is none",
        BAD_PICTURE.saying("the picture cannot be read"),
        write=picture(damaged),
    ),
    Case("many-channels", "a thousand channels", BAD_PICTURE, write=picture(many_channels)),
    Case(
        "wrong-size",
        "a picture of half the size",
        BAD_PICTURE.saying(f"expected {SIZE} x {SIZE}"),
        write=picture(lambda: encoded(right_picture()[::2, ::2])),
    ),
    Case(
        "nan-picture",
        "one pixel that is not a number",
        BAD_PICTURE.saying("NaN"),
        write=picture(lambda: with_pixel(float("nan"))),
    ),
    Case(
        "infinite-picture",
        "one infinite pixel",
        BAD_PICTURE.saying("infinite"),
        write=picture(lambda: with_pixel(float("inf"))),
    ),
    Case(
        "negative-picture",
        "one negative pixel",
        BAD_PICTURE.saying("negative"),
        write=picture(lambda: with_pixel(-1.0)),
    ),
    Case(
        "replayed-picture",
        "the right picture, embedded, for every seed",
        BAD_PICTURE.saying("the seed has no effect"),
        write=picture(lambda: encoded(right_picture())),
        quick=True,
    ),
    Case(
        "mean-colour",
        "the right picture's mean colour everywhere",
        BAD_PICTURE.saying("the picture differs"),
        write=picture(lambda: encoded(flat(), OpenEXR.NO_COMPRESSION), _VARY),
    ),
    Case(
        "blurred-picture",
        "the right picture, blurred",
        BAD_PICTURE.saying("the picture differs"),
        write=picture(lambda: encoded(blurred(), OpenEXR.NO_COMPRESSION), _VARY),
    ),
]
