"""Ways to look at a picture beside its file: more channels, one pixel's paths, viewers."""

from __future__ import annotations

import os
import pty
import re
import socket
import struct
import subprocess
import threading
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from renderer_runs import CORNELL, program, render, run

SMALL = ("--resolution", "16x12", "--spp", "4")


def channels(path: Path) -> dict[str, np.ndarray]:
    """Every channel of an EXR by itself: `albedo.R` is not gathered into an `albedo`."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: channel.pixels for name, channel in file.channels().items()}


def test_more_channels_are_written_when_asked_for(tmp_path: Path) -> None:
    names = "albedo,normal,depth,uv,bvh_cost,mip_level,variance"
    run(CORNELL, *SMALL, "--aov", names, "-o", tmp_path / "a.exr", cwd=tmp_path)
    found = channels(tmp_path / "a.exr")
    assert set(found) == {
        *("R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z"),
        *("depth.Z", "uv.U", "uv.V", "bvh_cost", "mip_level", "variance"),
    }
    plain = render(CORNELL, tmp_path, *SMALL)
    assert np.array_equal(plain[..., 0], found["R"])
    middle = 3, 9
    # The back wall of the box, 4.875 m in front of the camera.
    assert found["depth.Z"][middle] == pytest.approx(4.88, abs=0.1)
    assert found["normal.Z"][middle] == pytest.approx(1, abs=1e-5)
    assert found["albedo.R"][middle] == pytest.approx(0.725, abs=1e-5)
    assert found["bvh_cost"].min() > 0 and found["variance"].min() >= 0


def test_one_pixel_tells_the_paths_of_the_whole_picture(tmp_path: Path) -> None:
    picture = render(CORNELL, tmp_path, *SMALL)
    told = run(CORNELL, *SMALL, "--pixel", "9,7", cwd=tmp_path)
    assert told.returncode == 0
    assert list(tmp_path.glob("*.exr")) == [tmp_path / "out.exr"] or not told.stderr
    assert told.stdout.count("sample ") == 4
    assert "hit object" in told.stdout and "asks light 0 (point)" in told.stdout
    results = re.findall(r"= \((.*), (.*), (.*)\)", told.stdout)
    mean = np.array(results, dtype=float).mean(axis=0)
    assert picture[7, 9] == pytest.approx(mean, rel=1e-5)


def receive(server: socket.socket, into: list[bytes]) -> None:
    connection, _ = server.accept()
    with connection:
        while data := connection.recv(1 << 16):
            into.append(data)


def test_a_viewer_gets_the_picture(tmp_path: Path) -> None:
    """The messages of tev's protocol: length, type, name, then the picture's fields."""
    got: list[bytes] = []
    with socket.create_server(("127.0.0.1", 0)) as server:
        listener = threading.Thread(target=receive, args=(server, got))
        listener.start()
        address = f"--tev=127.0.0.1:{server.getsockname()[1]}"
        done = run(CORNELL, *SMALL, address, "-o", tmp_path / "out.exr", cwd=tmp_path)
        listener.join(timeout=30)
    assert done.returncode == 0
    stream, messages = b"".join(got), []
    while stream:
        (length,) = struct.unpack_from("<I", stream)
        messages.append(stream[:length])
        stream = stream[length:]
    assert [m[4] for m in messages[:2]] == [4, 6]
    name = str(CORNELL).encode() + b"\0"
    assert messages[0][6:].startswith(name + struct.pack("<iii", 16, 12, 3) + b"R\0G\0B\0")
    pixels = np.frombuffer(messages[-1][-16 * 12 * 12 :], dtype="<f4").reshape(12, 16, 3)
    assert np.array_equal(pixels, render(CORNELL, tmp_path, *SMALL))


def test_the_terminal_shows_the_picture(tmp_path: Path) -> None:
    leader, follower = pty.openpty()
    command = [str(program()), str(CORNELL), *SMALL, "--preview", "-o", str(tmp_path / "a.exr")]
    with subprocess.Popen(command, stderr=follower, cwd=tmp_path) as process:
        os.close(follower)
        shown = b""
        try:
            while data := os.read(leader, 1 << 16):
                shown += data
        except OSError:
            pass  # how Linux tells that the other end of a terminal is closed
        os.close(leader)
        assert process.wait(timeout=30) == 0
    text = shown.decode()
    # 16 x 12 pixels: at least one picture of 6 lines of 16 half blocks.
    assert text.count("\u2580") % (16 * 6) == 0 and text.count("\u2580") > 0
    assert "\x1b[38;2;" in text


@pytest.mark.parametrize("view", ["normal", "depth", "uv", "bvh_cost", "mip_level"])
def test_debugging_views_draw_something(tmp_path: Path, view: str) -> None:
    picture = render(CORNELL, tmp_path, *SMALL, "--integrator", view)
    assert np.isfinite(picture).all() and (picture >= 0).all()
    if view != "mip_level":
        assert picture.std() > 0
