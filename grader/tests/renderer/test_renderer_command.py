"""The command line: what it accepts, what it writes, and how it says no."""

from __future__ import annotations

import json
import os
import pty
import resource
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from renderer_runs import (
    CORNELL,
    Json,
    diffuse,
    program,
    read_exr,
    render,
    run,
    sphere,
    write_scene,
)

SMALL = ("--resolution", "24x20", "--spp", "2")


def small_scene(folder: Path, **more: object) -> Path:
    scene: Json = {
        "integrator": {"point_light_flux": [90, 60, 30], "spp": 3},
        "film": {"resolution": [12, 10]},
        "camera": {"position": [0, 0, 4]},
        "objects": [sphere([0, 0, 0], 1, "paint")],
        **diffuse(paint=[0.8, 0.7, 0.6]),
    }
    return write_scene(folder, {**scene, **more})


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


# What is written ----------------------------------------------------------------------------------


def test_the_default_output_is_the_scenes_name_in_the_current_folder(tmp_path: Path) -> None:
    (tmp_path / "scenes").mkdir()
    (tmp_path / "here").mkdir()
    small_scene(tmp_path / "scenes").rename(tmp_path / "scenes" / "my.box.json")
    done = run("../scenes/my.box.json", cwd=tmp_path / "here")
    assert done.returncode == 0, done.stderr
    assert names(tmp_path / "here") == {"my.box.exr"}
    assert names(tmp_path / "scenes") == {"my.box.json"}
    assert "my.box.exr" in done.stderr and done.stdout == ""


def test_the_image_is_32_bit_float_zip_and_says_where_it_comes_from(tmp_path: Path) -> None:
    small_scene(tmp_path)
    arguments = ["--seed", "42", "--spp", "5", "-o", "a.exr", "scene.json"]
    assert run(*arguments, cwd=tmp_path).returncode == 0
    exr = read_exr(tmp_path / "a.exr")
    assert exr.types == {"R": "float32", "G": "float32", "B": "float32"}
    assert exr.pixels.shape == (10, 12, 3)
    assert exr.pixels.any() and np.isfinite(exr.pixels).all()
    assert "ZIP_" in str(exr.header["compression"])
    told = {k.removeprefix("raybook:"): v for k, v in exr.header.items() if "raybook:" in k}
    version = run("--version", cwd=tmp_path).stdout.split()
    assert told == {
        "scene": "scene.json",
        "seed": "42",
        "spp": "5",
        "version": version[1],
        "variant": "reference",
        "command": f"{program()} " + " ".join(arguments),
    }


@pytest.mark.parametrize("size", [(1, 1), (3, 17), (17, 3), (16, 16), (33, 100)])
def test_images_of_all_shapes_are_whole(tmp_path: Path, size: tuple[int, int]) -> None:
    """Each pixel of the file is the one that a window of that pixel alone gives."""
    width, height = size
    scene = small_scene(tmp_path, film={"resolution": [width, height]})
    whole = render(scene, tmp_path, "--spp", "1")
    assert whole.shape == (height, width, 3)
    for x, y in {(0, 0), (width - 1, height - 1), (width // 2, height // 2)}:
        window = f"{x},{y},{x + 1},{y + 1}"
        one = render(scene, tmp_path, "--spp", "1", "--crop", window)
        assert np.array_equal(one[0, 0], whole[y, x])


def test_values_that_a_half_float_cannot_hold_survive(tmp_path: Path) -> None:
    bright = {"point_light_flux": [1e9, 1e-9, 0], "spp": 1}
    picture = render(small_scene(tmp_path, integrator=bright), tmp_path)
    peak = picture.max(axis=(0, 1))
    assert peak[0] > 65504 and 0 < peak[1] < 6e-8 and peak[2] == 0


def test_the_preview_is_the_image_through_the_srgb_curve(tmp_path: Path) -> None:
    linear = render(small_scene(tmp_path), tmp_path, "--png", "a.png").astype(np.float64)
    with Image.open(tmp_path / "a.png") as picture:
        assert picture.mode == "RGB"
        codes = np.asarray(picture).astype(np.float64)
    clipped = np.clip(linear, 0, 1)
    low, high = 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055
    assert np.abs(codes - 255 * np.where(clipped <= 0.0031308, low, high)).max() < 0.501
    assert len(np.unique(codes)) > 10


def test_the_output_itself_may_be_a_png(tmp_path: Path) -> None:
    scene = small_scene(tmp_path)
    assert run(scene, "-o", "a.png", "--png", "b.png", cwd=tmp_path).returncode == 0
    assert names(tmp_path) == {"scene.json", "a.png", "b.png"}
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_an_old_image_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "a.exr").write_text("old")
    assert run(small_scene(tmp_path), "-o", "a.exr", cwd=tmp_path).returncode == 0
    assert read_exr(tmp_path / "a.exr").pixels.any()


def test_a_new_image_has_the_mode_of_any_new_file(tmp_path: Path) -> None:
    assert run(small_scene(tmp_path), "-o", "a.exr", cwd=tmp_path).returncode == 0
    (tmp_path / "other").touch()
    assert (tmp_path / "a.exr").stat().st_mode == (tmp_path / "other").stat().st_mode


def test_statistics_are_json_and_agree_with_the_run(tmp_path: Path) -> None:
    arguments = [*SMALL, "--threads", "2", "--stats", "s.json", "-o", "a.exr"]
    assert run(CORNELL, *arguments, cwd=tmp_path).returncode == 0
    stats = json.loads((tmp_path / "s.json").read_text())
    samples = 24 * 20 * 2
    assert stats["samples"] == stats["rays"]["camera"] == samples
    assert 0 < stats["rays"]["shadow"] <= samples * 1
    assert stats["accel"] == "wide" and stats["threads"] == 2
    assert stats["primitives"] > 20 and 0 < stats["bvh_nodes"] < 2 * stats["primitives"]
    assert stats["boxes_tested"] > samples and stats["boxes_tested"] % 8 == 0
    assert 0 < stats["leaves_visited"] == stats["primitives_tested"] / 8
    times = ("load_seconds", "build_seconds", "render_seconds", "samples_per_second")
    assert all(stats[key] > 0 for key in (*times, "peak_memory_bytes"))


def test_statistics_may_go_to_standard_output(tmp_path: Path) -> None:
    done = run(small_scene(tmp_path), "--stats", "-", "-o", "a.exr", cwd=tmp_path)
    assert json.loads(done.stdout)["samples"] == 12 * 10 * 3
    assert names(tmp_path) == {"scene.json", "a.exr"}


def test_the_bvh_counts_box_by_box(tmp_path: Path) -> None:
    arguments = [*SMALL, "--accel", "bvh", "--stats", "-", "-o", "a.exr"]
    stats = json.loads(run(CORNELL, *arguments, cwd=tmp_path).stdout)
    assert stats["accel"] == "bvh" and 0 < stats["bvh_nodes"] < 2 * stats["primitives"]
    assert stats["boxes_tested"] > stats["samples"]
    assert 0 < stats["leaves_visited"] <= stats["primitives_tested"]


def test_linear_tests_every_primitive(tmp_path: Path) -> None:
    arguments = [*SMALL, "--accel", "linear", "--stats", "-", "-o", "a.exr"]
    stats = json.loads(run(CORNELL, *arguments, cwd=tmp_path).stdout)
    assert stats["accel"] == "linear" and stats["boxes_tested"] == stats["bvh_nodes"] == 0
    camera = stats["rays"]["camera"]
    assert stats["primitives_tested"] >= camera * stats["primitives"]


# Speaking -----------------------------------------------------------------------------------------


def test_quiet_says_nothing(tmp_path: Path) -> None:
    for flag in ("--quiet", "-q"):
        done = run(small_scene(tmp_path), flag, "--png", "a.png", cwd=tmp_path)
        assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_quiet_still_tells_faults(tmp_path: Path) -> None:
    done = run("no-such.json", "-q", cwd=tmp_path)
    assert done.returncode == 2 and done.stderr.startswith("raybook: no-such.json: ")


def test_no_progress_bar_without_a_terminal(tmp_path: Path) -> None:
    done = run(small_scene(tmp_path), "--spp", "3000", cwd=tmp_path)
    assert "\r" not in done.stderr and "%" not in done.stderr
    assert len(done.stderr.splitlines()) == 1 and "spp" in done.stderr


def on_a_terminal(folder: Path, *arguments: str) -> str:
    """What the renderer writes to standard error when that is a terminal."""
    ours, theirs = pty.openpty()
    with subprocess.Popen(
        [program(), *arguments], cwd=folder, stderr=theirs, stdout=subprocess.DEVNULL
    ) as process:
        os.close(theirs)
        text = b""
        try:
            while chunk := os.read(ours, 4096):
                text += chunk
        except OSError:
            pass  # the other end is closed: the program has ended
        os.close(ours)
        assert process.wait() == 0
    return text.decode()


def test_a_progress_bar_on_a_terminal(tmp_path: Path) -> None:
    small_scene(tmp_path)
    shown = on_a_terminal(tmp_path, "scene.json", "--time-limit", "0.5", "--spp", "16777216")
    assert "Msamples/s" in shown and " left" in shown and "%" in shown
    assert shown.rstrip().split("\r\x1b[K")[-1].startswith("scene.exr: "), "the bar is removed"
    assert on_a_terminal(tmp_path, "scene.json", "-q", "--time-limit", "0.3") == ""


def test_help_and_version_go_to_standard_output(tmp_path: Path) -> None:
    for flag in ("--help", "-h"):
        done = run(flag, cwd=tmp_path)
        assert done.returncode == 0 and done.stderr == ""
        for word in ("--output", "--spp", "--override", "--stats", "exit code"):
            assert word in done.stdout
    done = run("--version", cwd=tmp_path)
    assert done.returncode == 0 and done.stderr == ""
    assert done.stdout.startswith("raybook ") and "(reference)" in done.stdout
    assert names(tmp_path) == set()


# Overrides ----------------------------------------------------------------------------------------


def test_an_override_is_merged_into_the_scene(tmp_path: Path) -> None:
    patch = {"film": {"resolution": [7, 5]}, "integrator": {"spp": 2}}
    merged = render(small_scene(tmp_path), tmp_path, "--override", json.dumps(patch))
    by_hand = small_scene(
        tmp_path,
        film={"resolution": [7, 5]},
        integrator={"point_light_flux": [90, 60, 30], "spp": 2},
    )
    assert np.array_equal(merged, render(by_hand, tmp_path))


def test_null_in_an_override_removes(tmp_path: Path) -> None:
    scene = small_scene(tmp_path, film={"resolution": [5, 4]})
    assert render(scene, tmp_path, "--override", '{"film": null}', "--spp", "1").shape[0] == 600


def test_options_win_over_the_override(tmp_path: Path) -> None:
    patch = '{"film": {"resolution": [7, 5]}}'
    picture = render(small_scene(tmp_path), tmp_path, "--resolution", "9x8", "--override", patch)
    assert picture.shape == (8, 9, 3)


def test_the_seed_of_the_option_is_the_seed_of_the_scene(tmp_path: Path) -> None:
    by_option = render(small_scene(tmp_path), tmp_path, "--seed", "9")
    by_scene = render(small_scene(tmp_path, sampler={"seed": 9}), tmp_path)
    assert np.array_equal(by_option, by_scene)


# Refusals -----------------------------------------------------------------------------------------

REFUSED = [
    ([], "no scene file"),
    (["no-such.json"], "no-such.json: cannot read"),
    (["."], "it is a folder"),
    (["scene.json", "other.json"], "other.json: expected one scene file"),
    (["scene.json", "--spq", "3"], "unknown option --spq: did you mean --spp?"),
    (["scene.json", "-x"], "unknown option -x"),
    (["scene.json", "--spp"], "--spp: the value is missing"),
    (["scene.json", "--spp", "0"], "--spp 0: expected a whole number"),
    (["scene.json", "--spp", "3.5"], "--spp 3.5: expected a whole number"),
    (["scene.json", "--spp", "99999999999999999999"], "expected a whole number"),
    (["scene.json", "--seed", "-1"], "--seed -1: expected a whole number from 0"),
    (["scene.json", "--threads", "0"], "--threads 0"),
    (["scene.json", "--resolution", "12"], "--resolution 12: expected WIDTHxHEIGHT"),
    (["scene.json", "--resolution", "0x5"], "--resolution 0x5: expected WIDTHxHEIGHT"),
    (["scene.json", "--resolution", "60000x60000"], "too many pixels"),
    (["scene.json", "--crop", "1,2,3"], "--crop 1,2,3: expected X0,Y0,X1,Y1"),
    (["scene.json", "--crop", "3,0,3,5"], "X0 < X1"),
    (["scene.json", "--crop", "0,0,13,10"], "--crop: the window leaves the film of 12 x 10"),
    (["scene.json", "--accel", "bhv"], "did you mean bvh?"),
    (["scene.json", "--integrator", "x"], "--integrator x: unknown name"),
    (["scene.json", "--time-limit", "0"], "--time-limit 0: expected a number of seconds"),
    (["scene.json", "--time-limit", "nan"], "--time-limit nan: expected a number of seconds"),
    (["scene.json", "--quiet=yes"], "--quiet takes no value"),
    (
        ["scene.json", "-o", "a.jpg"],
        "--output a.jpg: expected a file name that ends in .exr or .png",
    ),
    (["scene.json", "-o", ".exr"], "expected a file name that ends in .exr or .png"),
    (["scene.json", "--png", "a.exr"], "--png a.exr: expected a file name that ends in .png"),
    (["scene.json", "-o", "no/such/a.exr"], "no/such/a.exr: cannot write"),
    (["scene.json", "--stats", "no/such/s.json"], "no/such/s.json: cannot write"),
    (["scene.json", "--override", "{"], "--override:1:2: "),
    (["scene.json", "--override", "[]"], "--override: "),
    (["scene.json", "--override", '{"film": {"size": 3}}'], '/film: unknown key "size"'),
    (["broken.json"], "broken.json:1:"),
    (["scene.json", "--aov", "nromal"], "--aov nromal: unknown name, did you mean normal?"),
    (["scene.json", "--aov", "normal", "-o", "a.png"], "a PNG has no such channels"),
    (["scene.json", "--pixel", "12,2"], "--pixel: the film has 12 x 10 pixels"),
    (["scene.json", "--tev=127.0.0.1:1"], "--tev 127.0.0.1:1: no viewer answers there"),
    (["scene.json", "--tev=nowhere"], "--tev nowhere: expected HOST:PORT"),
]


@pytest.mark.parametrize(
    ("arguments", "words"), REFUSED, ids=[" ".join(arguments) for arguments, _ in REFUSED]
)
def test_bad_input_is_refused_in_one_message(
    tmp_path: Path, arguments: list[str], words: str
) -> None:
    small_scene(tmp_path)
    (tmp_path / "broken.json").write_text('{"film": [1, 2}')
    before = names(tmp_path)
    done = run(*arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("raybook: ") and words in done.stderr
    assert done.stderr.count("raybook: ") == 1
    assert names(tmp_path) == before, "no output file, no temporary file"


def test_a_refused_run_leaves_the_old_image(tmp_path: Path) -> None:
    small_scene(tmp_path)
    (tmp_path / "a.exr").write_text("old")
    assert run("scene.json", "-o", "a.exr", "--crop", "0,0,99,9", cwd=tmp_path).returncode == 2
    assert (tmp_path / "a.exr").read_text() == "old"


def test_options_may_have_their_value_behind_an_equals_sign(tmp_path: Path) -> None:
    assert render(small_scene(tmp_path), tmp_path, "--resolution=6x5").shape == (5, 6, 3)


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        (["-o", "a.exr", "--resolution", "64x64"], "a.exr"),
        (["-o", "a.png", "--resolution", "64x64"], "a.png"),
        (["-o", "b.png", "--resolution", "1x1", "--stats", "a.json"], "a.json"),
    ],
    ids=["exr", "png", "stats"],
)
def test_a_disk_that_is_full_is_no_half_file(
    tmp_path: Path, arguments: list[str], name: str
) -> None:
    """Files of 300 bytes at most: writing fails half way. Exit code 1, the old file stays."""
    (tmp_path / name).write_text("old")
    small_scene(tmp_path)
    before = names(tmp_path)

    def limit() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300))

    command = [str(program()), "scene.json", *arguments]
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, preexec_fn=limit, check=False
    )
    assert done.returncode == 1, done.stderr
    assert f"raybook: {name}: cannot write" in done.stderr
    assert names(tmp_path) - {"b.png"} == before, "a temporary file is left"
    assert (tmp_path / name).read_text() == "old"


@pytest.mark.parametrize("option", ["-o", "--png", "--stats"])
def test_a_device_is_never_replaced_by_a_file(tmp_path: Path, option: str) -> None:
    """`--stats /dev/null`, as root, would put a file in the place of the device."""
    pipe = tmp_path / "pipe.png"
    os.mkfifo(pipe)
    done = run(small_scene(tmp_path), option, pipe, cwd=tmp_path)
    assert pipe.is_fifo(), "replaced by a file"
    assert done.returncode == 2 and "pipe.png" in done.stderr


# Stopping -----------------------------------------------------------------------------------------


def seconds_of_work(process: subprocess.Popen[str]) -> float:
    fields = Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return int(fields[11]) / os.sysconf("SC_CLK_TCK")


def test_an_interrupt_leaves_a_complete_image_and_says_so(tmp_path: Path) -> None:
    small_scene(tmp_path)
    command = [str(program()), "scene.json", "--spp", "16777216", "--stats", "s.json"]
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as process:
        while seconds_of_work(process) < 0.3:  # the scene loads in a thousandth of that
            assert process.poll() is None
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
    assert process.returncode == 0
    assert "interrupted" in said
    assert names(tmp_path) == {"scene.json", "scene.exr", "s.json"}
    exr = read_exr(tmp_path / "scene.exr")
    assert exr.pixels.shape == (10, 12, 3) and exr.pixels.any()
    assert 1 < int(exr.header["raybook:spp"]) < 16777216


def test_a_time_limit_gives_every_pixel_the_same_samples(tmp_path: Path) -> None:
    """The picture is bit for bit the one of that many samples: no pixel has more or fewer. One
    thread, as two on a busy machine wait for each other at the end of a pass most of the time, and
    that is when the limit would be met."""
    scene = small_scene(tmp_path, film={"resolution": [160, 170]})
    limited = ("--spp", "16777216", "--time-limit", "0.2", "--stats", "s.json", "--threads", "1")
    picture = render(scene, tmp_path, *limited)
    spp = int(read_exr(tmp_path / "picture.exr").header["raybook:spp"])
    assert 1 < spp < 16777216
    assert json.loads((tmp_path / "s.json").read_text())["samples"] == spp * 160 * 170
    assert np.array_equal(picture, render(scene, tmp_path, "--spp", str(spp)))
