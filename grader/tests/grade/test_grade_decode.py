"""Decoding in the box: the same values and words as the judge's own decoder, whatever the file."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import OpenEXR
import pytest
from make_class import CHECKOUT

from raybook_grader.checks.decode import Undecodable, decode
from raybook_grader.checks.program import Workshop
from raybook_grader.grading.job import Worker
from raybook_grader.judge.exr import UnusableImage, decode_exr, encode_exr
from raybook_grader.judge.pixels import Image

MOST = 20 * 30 * 4


@pytest.fixture(scope="module")
def workshop() -> Iterator[Workshop]:
    made = Worker(CHECKOUT, CHECKOUT / "build" / "kit").workshop()
    with made.box:
        yield made


@pytest.fixture(scope="module")
def pixels() -> Image:
    made = np.random.default_rng(1).gamma(0.5, size=(20, 30, 3)).astype(np.float32)
    made[3, 4] = [np.nan, np.inf, -1]
    return made


def encoded(
    planes: Mapping[str, Any], compression: Any = OpenEXR.ZIP_COMPRESSION, **header: Any
) -> bytes:
    buffer = io.BytesIO()
    settings = {"compression": compression, "type": OpenEXR.scanlineimage, **header}
    OpenEXR.File(settings, dict(planes)).write(buffer)
    return buffer.getvalue()


def planes(pixels: Any, kind: type = np.float32) -> dict[str, Any]:
    return {c: np.ascontiguousarray(pixels[..., i]).astype(kind) for i, c in enumerate("RGB")}


def told(workshop: Workshop, file: bytes) -> str:
    """Why a file is refused, without what its library says."""
    with pytest.raises(Undecodable) as refusal:
        decode(workshop, [file], MOST)
    return str(refusal.value).split(" (found")[0].split(" (")[0]


COMPRESSIONS = ("NO", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44", "B44A")


@pytest.mark.parametrize("kind", [np.float32, np.float16, np.uint32])
@pytest.mark.parametrize("name", COMPRESSIONS)
def test_the_values_are_the_same(workshop: Workshop, pixels: Image, name: str, kind: type) -> None:
    made = planes(np.arange(1800).reshape(20, 30, 3) if kind is np.uint32 else pixels, kind)
    file = encoded(made | {"Z": made["R"]}, getattr(OpenEXR, f"{name}_COMPRESSION"))
    smaller = encoded(planes(pixels[:7, :5]))
    first, second = decode(workshop, [file, smaller], MOST)
    assert np.array_equal(first, decode_exr(file).pixels, equal_nan=True)
    assert np.array_equal(second, pixels[:7, :5], equal_nan=True)


def with_window(data: bytes, window: tuple[int, int, int, int], *names: str) -> bytes:
    for name in names:
        key = name.encode() + b"\0box2i\0"
        at = data.index(key) + len(key) + 4
        data = data[:at] + struct.pack("<4i", *window) + data[at + 16 :]
    return data


def refused() -> dict[str, bytes]:
    """Files that are no picture to judge."""
    made = np.random.default_rng(2).random((20, 30, 3), np.float32)
    good, parts = encode_exr(made), planes(made)
    version = struct.unpack_from("<I", good, 4)[0]
    flagged = {
        f"flag {flag:x}": good[:4] + struct.pack("<I", version | flag) + good[8:]
        for flag in (0x200, 0x800, 0x1000)
    }
    both = ("dataWindow", "displayWindow")
    damaged = bytearray(encode_exr(np.full((20, 30, 3), 0.1, np.float32)))
    damaged[-12:-4] = b"\xff" * 8
    return {
        "empty": b"",
        "text": b"no picture",
        "no header": good[:8] + bytes(64),
        "cut in the header": good[:100],
        "cut in the pixels": good[:-1],
        "damaged": bytes(damaged),
        "too large": encode_exr(np.zeros((100, 100, 3), np.float32)),
        "huge": with_window(good, (0, 0, 99_999, 99_999), *both),
        "wide": with_window(good, (0, 0, 2**31 - 2, 0), *both),
        "cropped": with_window(good, (0, 0, 39, 19), "displayWindow"),
        "grey": encoded({"R": parts["R"], "Y": parts["G"]}),
        "taller than its rows": with_window(good, (0, 0, 29, 29), *both),
        "narrower than its rows": with_window(good, (0, 0, 9, 19), *both),
        **flagged,
    }


@pytest.mark.parametrize("name", refused())
def test_the_refusals_are_the_same(workshop: Workshop, name: str) -> None:
    file = refused()[name]
    with pytest.raises(UnusableImage) as refusal:
        decode_exr(file, MOST)
    assert told(workshop, file) == str(refusal.value).split(" (found")[0].split(" (")[0]


def test_lossy_compression_that_the_system_s_library_lacks_is_told(
    workshop: Workshop, pixels: Image
) -> None:
    file = encoded(planes(np.nan_to_num(pixels)), OpenEXR.DWAA_COMPRESSION)
    assert "DWAA or DWAB; write ZIP" in told(workshop, file)


@pytest.mark.parametrize("seed", range(4))
def test_damage_gives_words_and_never_a_fault(workshop: Workshop, seed: int) -> None:
    """Random bytes changed: either it is refused, or the number of pixels is what it should be."""
    random = np.random.default_rng(seed)
    good = encode_exr(random.random((20, 30, 3), np.float32))
    for _ in range(10):
        file = bytearray(good)
        for at in random.integers(8, len(good), 3):
            file[at] = random.integers(256)
        try:
            [image] = decode(workshop, [bytes(file)], MOST)
        except Undecodable:
            continue
        assert image.size <= 3 * MOST and image.dtype == np.float32


def test_one_bad_picture_among_good_ones_is_told(workshop: Workshop, pixels: Image) -> None:
    good = encode_exr(pixels)
    with pytest.raises(Undecodable, match="truncated or damaged"):
        decode(workshop, [good, good[:-5], good], MOST)
