"""EXR files in and out, good and bad."""

import io
import os
import resource
import struct
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import OpenEXR
import pytest

from raybook_grader.judge.exr import UnusableImage, decode_exr, encode_exr, read_exr, write_exr
from raybook_grader.judge.pixels import Image


@pytest.fixture
def pixels() -> Image:
    return np.random.default_rng(1).gamma(0.5, size=(20, 30, 3)).astype(np.float32)


def test_round_trip_keeps_every_bit(tmp_path: Path, pixels: Image) -> None:
    pixels[3, 4] = [np.nan, np.inf, -1]
    write_exr(tmp_path / "a.exr", pixels, **{"raybook:seed": "7"})
    back = read_exr(tmp_path / "a.exr")
    assert back.pixels.dtype == np.float32
    np.testing.assert_array_equal(back.pixels, pixels)
    assert back.header["raybook:seed"] == "7"
    assert os.listdir(tmp_path) == ["a.exr"]


def test_half_floats_and_more_channels_are_read(pixels: Image) -> None:
    planes = {c: np.ascontiguousarray(pixels[..., i], np.float16) for i, c in enumerate("RGB")}
    data = _encoded({"type": OpenEXR.scanlineimage}, planes | {"Z": pixels[..., 0].copy()})
    np.testing.assert_allclose(decode_exr(data).pixels, pixels, rtol=1e-3, atol=1e-7)


def _encoded(header: dict[str, object], planes: Mapping[str, object]) -> bytes:
    buffer = io.BytesIO()
    settings = {"compression": OpenEXR.ZIP_COMPRESSION, **header}
    OpenEXR.File(settings, dict(planes)).write(buffer)
    return buffer.getvalue()


@pytest.mark.parametrize("kept", [0, 3, 60, 200, 400, -1])
def test_truncated_files_are_refused(
    pixels: Image, kept: int, capfd: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(UnusableImage, match=r"empty|not an OpenEXR|cut short|truncated"):
        decode_exr(encode_exr(pixels)[:kept])
    assert capfd.readouterr() == ("", "")


def test_damaged_pixels_are_refused() -> None:
    data = bytearray(encode_exr(np.full((20, 30, 3), 0.1, np.float32)))
    data[-12:-4] = b"\xff" * 8
    with pytest.raises(UnusableImage, match="truncated or damaged"):
        decode_exr(bytes(data))


def test_other_files_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.exr").write_text("not a picture")
    with pytest.raises(UnusableImage, match=r"a\.exr: it is not an OpenEXR picture"):
        read_exr(tmp_path / "a.exr")
    with pytest.raises(UnusableImage, match="No such file"):
        read_exr(tmp_path / "b.exr")
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(UnusableImage, match="not a regular file"):
        read_exr(tmp_path / "pipe")


def test_missing_and_subsampled_channels_are_refused(pixels: Image) -> None:
    planes = {c: pixels[..., i].copy() for i, c in enumerate("RGB")}
    with pytest.raises(UnusableImage, match=r"no channel G, B \(found: R, Y\)"):
        decode_exr(_encoded({"type": OpenEXR.scanlineimage}, {"R": planes["R"], "Y": planes["G"]}))


def test_tiled_files_are_refused(pixels: Image) -> None:
    header = {"type": OpenEXR.tiledimage, "tiles": OpenEXR.TileDescription()}
    planes = {c: pixels[..., i].copy() for i, c in enumerate("RGB")}
    with pytest.raises(UnusableImage, match="tiled"):
        decode_exr(_encoded(header, planes))


@pytest.mark.parametrize(("flag", "word"), [(0x800, "deep"), (0x1000, "several parts")])
def test_deep_and_multipart_files_are_refused(pixels: Image, flag: int, word: str) -> None:
    data = encode_exr(pixels)
    version = struct.unpack_from("<I", data, 4)[0] | flag
    with pytest.raises(UnusableImage, match=word):
        decode_exr(data[:4] + struct.pack("<I", version) + data[8:])


def _with_window(data: bytes, window: tuple[int, int, int, int], *names: str) -> bytes:
    for name in names:
        key = name.encode() + b"\0box2i\0"
        at = data.index(key) + len(key) + 4
        data = data[:at] + struct.pack("<4i", *window) + data[at + 16 :]
    return data


def test_a_window_that_is_not_the_whole_picture_is_refused(pixels: Image) -> None:
    data = _with_window(encode_exr(pixels), (0, 0, 39, 19), "displayWindow")
    with pytest.raises(UnusableImage, match="not its display window"):
        decode_exr(data)


@pytest.mark.parametrize(
    "window",
    [
        (0, 0, 10**6, 10**6),
        (0, 0, 2**31 - 2, 0),
        (0, 0, 0, 2**31 - 2),
        (-(2**31), -(2**31), 2**31 - 1, 2**31 - 1),
        (5, 5, 1, 1),
    ],
)
def test_absurd_windows_are_refused(pixels: Image, window: tuple[int, int, int, int]) -> None:
    data = _with_window(encode_exr(pixels), window, "dataWindow", "displayWindow")
    with pytest.raises(UnusableImage):
        decode_exr(data)


def test_a_huge_window_is_refused_without_its_memory(tmp_path: Path, pixels: Image) -> None:
    data = _with_window(encode_exr(pixels), (0, 0, 99_999, 99_999), "dataWindow", "displayWindow")
    (tmp_path / "huge.exr").write_bytes(data)
    program = (
        "import resource, sys\n"
        "from raybook_grader.judge.exr import UnusableImage, read_exr\n"
        "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "try: read_exr(sys.argv[1])\n"
        "except UnusableImage as reason: print(reason)\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "huge.exr")],
        capture_output=True,
        text=True,
        check=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30)),
    )
    reason, kilobytes = run.stdout.splitlines()
    assert "claims 100000 x 100000 pixels" in reason
    assert int(kilobytes) < 20_000


def test_the_callers_limit_counts(pixels: Image) -> None:
    with pytest.raises(UnusableImage, match="at most 599"):
        decode_exr(encode_exr(pixels), max_pixels=599)


def test_nothing_is_left_of_a_failed_write(tmp_path: Path) -> None:
    (tmp_path / "a.exr").mkdir()
    with pytest.raises(OSError):
        write_exr(tmp_path / "a.exr", np.zeros((2, 2, 3), np.float32))
    assert os.listdir(tmp_path) == ["a.exr"]
