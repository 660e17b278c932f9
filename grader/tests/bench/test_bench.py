"""make bench: medians and ratios, goals, files, what is missing, and a run on a tiny mesh. What is
measured depends on the machine, and decides nothing here."""

from __future__ import annotations

import json
import shutil
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path

import bench
import bench_group_images
import numpy as np
import pytest
from bench_effort import TINY
from bench_goals import TARGETS, with_goals
from bench_group_build import build_rows
from bench_group_images import Pictures, best_row, compare, image_rows, quotient, speed_row
from bench_group_rays import KINDS, NO_EMBREE, ray_row, ray_rows, work_rows
from bench_group_start import clean_environment, copy_checkout, grid
from bench_group_textures import Point, scene_with, seconds_for
from bench_plots import plots
from bench_renderers import Failed, Renderer, Shot
from bench_rows import Goal, Row, Spread, ratios, spread
from bench_scenes import CORNELL, merged
from bench_tables import markdown, number

HERE = Path(__file__).resolve().parent
KEYS = {"group", "name", "scene", "kind", "peer", "figure", "unit", "ratio", "goal", "met"}
EMBREE = Path("/usr/include/embree3/rtcore.h").is_file()


# ---- figures ----


def test_the_median_is_quoted_and_the_extremes_are_kept() -> None:
    assert spread([5, 1, 100, 2, 3]) == Spread(3, 1, 100)


def test_a_ratio_is_of_neighbours_in_time() -> None:
    """A machine that is twice as slow in the second half changes no ratio."""
    assert ratios([2, 2, 4, 4], [1, 1, 2, 2]) == Spread(2, 2, 2)
    with pytest.raises(ValueError):
        ratios([1, 2], [1])


@pytest.mark.parametrize(
    ("goal", "figure", "ratio", "met"),
    [
        (Goal(1.0), None, 1.0, True),
        (Goal(1.0), None, 0.99, False),
        (Goal(1.25, at_least=False), None, 1.25, True),
        (Goal(1.25, at_least=False), None, 1.3, False),
        (Goal(55, at_least=False, of="figure"), 54, 2.0, True),
        (Goal(55, at_least=False, of="figure"), 56, 0.5, False),
        (Goal(1.0), None, None, False),
        (Goal(5, at_least=False, of="figure"), None, None, False),
    ],
)
def test_a_goal_judges(goal: Goal, figure: float | None, ratio: float | None, met: bool) -> None:
    assert Row("g", "n", "s", figure=figure, ratio=ratio, goal=goal).met is met


def test_a_row_at_fault_meets_nothing() -> None:
    row = Row("images", "path", "cornell", ratio=9.0, goal=Goal(1))
    assert row.met
    assert row.missing("no such thing").met is False
    assert Row("images", "path", "cornell", ratio=9.0, fault="differs", goal=Goal(1)).met is False
    assert Row("images", "path", "cornell", ratio=9.0).met is None


def test_numbers_have_three_digits() -> None:
    assert [number(v) for v in (0.0, 0.93456, 12.345, 1652.9, 7.1e4, 2e-5)] == [
        "0", "0.935", "12.3", "1653", "7.10e+04", "2.00e-05",
    ]  # fmt: skip


# ---- pictures ----


def shots(light: float, noise: float, seconds: float, seed: int) -> list[Shot]:
    random = np.random.default_rng(seed)
    shape = (64, 64, 3)
    return [
        Shot(random.normal(light, noise, shape).astype(np.float32), seconds, seconds)
        for _ in range(8)
    ]


def test_equal_pictures_are_the_same_but_for_noise() -> None:
    assert compare(*[[s.pixels for s in shots(1, 0.1, 1, seed)] for seed in (1, 2)])[1]


@pytest.mark.parametrize("where", ["everywhere", "in a corner"])
def test_other_pictures_are_not_the_same(where: str) -> None:
    one, other = ([s.pixels for s in shots(1, 0.05, 1, seed)] for seed in (1, 2))
    for pixels in one:
        pixels[: None if where == "everywhere" else 16] *= 1.05
    assert not compare(one, other)[1]


def test_a_faster_renderer_of_another_picture_is_no_faster() -> None:
    row = Row("images", "path", "cornell", goal=Goal(1))
    same = speed_row(row, Pictures(shots(1, 0.1, 1, 1), shots(1, 0.1, 3, 2), 100))
    other = speed_row(row, Pictures(shots(1.1, 0.1, 1, 1), shots(1, 0.1, 3, 2), 100))
    assert same.ratio == pytest.approx(3)
    assert same.met
    assert other.met is False and other.fault


def test_half_the_noise_is_worth_four_times_the_time() -> None:
    row = Row("variance x time", "path", "cornell")
    found = best_row(row, Pictures(shots(1, 0.1, 1, 1), shots(1, 0.2, 2, 2), 100), "-")
    assert found.ratio == pytest.approx(8, rel=0.2)
    assert found.low is not None and found.high is not None and found.low < 8 < found.high


def test_relative_errors_add_as_squares() -> None:
    found = quotient(Spread(2, 1.94, 2.06), Spread(1, 0.96, 1.04))
    assert found.median == 2
    assert found.high == pytest.approx(2.1)


def test_seconds_for_an_error_lie_between_the_points() -> None:
    points = [Point(1, 1.0, 1e-2), Point(4, 4.0, 1e-3), Point(16, 16.0, 1e-4)]
    assert seconds_for(points, 1e-3) == pytest.approx(4)
    assert seconds_for(points, 10**-2.5) == pytest.approx(2)


# ---- rays ----


def test_a_missing_peer_has_a_row_that_says_so() -> None:
    row = Row("rays", "bvh", "knot", "primary", "embree")
    ours = {"bvh": {"hits": 7, "differ": 0, "seconds": [1.0, 1.0]}}
    found = ray_row(row, ours, 10)
    assert (found.figure, found.ratio, found.fault) == (1e-5, None, NO_EMBREE)
    assert ray_row(row, {}, 10).fault == "this build has no accelerator bvh"


@pytest.mark.parametrize(("differ", "counts"), [(1, True), (2, False)])
def test_rays_answered_in_another_way_do_not_count(differ: int, counts: bool) -> None:
    row = Row("rays", "bvh", "knot", "primary", "embree", goal=Goal(0.5))
    casters = {
        "bvh": {"hits": 9000, "differ": 0, "seconds": [2.0, 2.0]},
        "embree": {"hits": 9000, "differ": differ, "seconds": [1.2, 1.2]},
    }
    assert ray_row(row, casters, 10_000).met is counts


# ---- goals, files ----


def test_every_goal_has_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever is missing on a machine: a row says so."""
    monkeypatch.setattr(bench_group_images, "mitsuba_missing", lambda may_install: "not here")
    rows = list(with_goals([*ray_rows(TINY), *build_rows(TINY), *work_rows(TINY)]))
    rows += with_goals(image_rows(TINY))
    rows += with_goals(
        Row(group, name, "", kind)
        for group, name, kind in (
            ("sampling", "sky by luminance", ""),
            ("start", "first picture", ""),
            ("start", "clean build", ""),
            ("loading", "obj", ""),
            ("large", "one mesh", ""),
            ("large", "instances", ""),
        )
    )
    for target in TARGETS:
        judged = [row for row in rows if row.goal is target.goal]
        assert judged, target
    mitsuba = [row for row in rows if row.group in ("images", "variance x time")]
    assert len(mitsuba) == 12
    assert all(row.fault == "not here" and row.met is False for row in mitsuba)


@pytest.fixture(scope="module")
def tiny(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bench")
    only = "rays,build,work,threads,textures,loading"
    assert bench.main(["--tiny", "--only", only, "--out", str(folder)]) == 0
    return folder


def test_the_file_has_the_keys_that_others_read(tiny: Path) -> None:
    rows = json.loads((tiny / "bench.json").read_text())["rows"]
    assert all(row.keys() >= KEYS for row in rows)
    assert not [row for row in rows if row["name"] == "failed"]
    rays = {(r["name"], r["kind"], r["peer"]) for r in rows if r["group"] == "rays"}
    peers = {"bvh": "embree", "wide": "embree", "wide-robust": "embree-robust"}
    assert rays == {(name, kind, peer) for name, peer in peers.items() for kind in KINDS}
    assert {r["group"] for r in rows} == {
        "rays", "build", "memory", "work", "threads", "textures", "loading",
    }  # fmt: skip


@pytest.mark.skipif(not EMBREE, reason="without Embree")
def test_embree_answers_as_ours(tiny: Path) -> None:
    rows = json.loads((tiny / "bench.json").read_text())["rows"]
    rays = [row for row in rows if row["group"] == "rays"]
    assert all(row["ratio"] > 0 and row["fault"] == "" for row in rays)
    assert all(" 0 of 2000 answers differ" in row["note"] for row in rays)


def test_a_tree_spares_most_of_the_work(tiny: Path) -> None:
    rows = json.loads((tiny / "bench.json").read_text())["rows"]
    work = [row for row in rows if row["group"] == "work"]
    assert len(work) == 6 and not any(row["fault"] for row in work)
    assert all(row["ratio"] > 5 for row in work if row["peer"] == "linear")


def test_table_and_plots_are_written_with_the_figures(tiny: Path) -> None:
    text = (tiny / "bench.md").read_text()
    assert "| rays | bvh, primary | box | embree |" in text
    assert {path.stem for path in tiny.glob("*.svg")} >= {"work", "textures"}
    assert all(path.read_text().rstrip().endswith("</svg>") for path in tiny.glob("*.svg"))


def test_plots_leave_out_what_was_not_measured(tmp_path: Path) -> None:
    rows = [Row("rays", "bvh", "knot").missing("no Embree"), Row("rays", "bvh", "knot", ratio=1.0)]
    assert [path.name for path in plots(rows, None, tmp_path)] == ["rays.svg"]
    assert plots(rows[:1], None, tmp_path) == []
    assert "no Embree" in markdown(rows, {"cores": 2}, "quick", 1.0)


def test_a_group_that_fails_has_a_row_that_says_why(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(effort: object) -> Iterator[Row]:
        yield Row("start", "clean build", "")
        raise RuntimeError("the disk is full")

    monkeypatch.setattr(bench, "GROUPS", {"start": broken})
    first, second = bench.measured(TINY, [])
    assert first.goal is not None
    assert second.fault == "the disk is full"


def test_ctrl_c_writes_nothing(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def stopped(effort: object) -> Iterator[Row]:
        yield Row("start", "clean build", "")
        raise KeyboardInterrupt

    monkeypatch.setattr(bench, "GROUPS", {"start": stopped})
    assert bench.main(["--tiny", "--out", str(tmp_path)]) == 128 + signal.SIGINT
    assert not list(tmp_path.iterdir())


# ---- programs ----


def test_a_renderer_that_dies_says_why(tmp_path: Path) -> None:
    with (
        pytest.raises(Failed, match="no such scene"),
        Renderer(["sh", "-c", "echo no such scene >&2; exit 3"], tmp_path, (1, 1)),
    ):
        pass


def test_scenes_name_files_that_are_there(tmp_path: Path) -> None:
    scene = json.loads(CORNELL.write(tmp_path, (8, 8), best=True).read_text())
    assert scene["film"]["resolution"] == [8, 8]
    assert scene["sampler"] == {"type": "sobol"}
    assert all(Path(item["path"]).is_absolute() for item in scene["objects"])
    textures = json.loads(scene_with("nearest").write(tmp_path, (8, 8)).read_text())["textures"]
    assert {texture["filter"] for texture in textures.values()} == {"nearest"}


def test_the_copy_of_the_checkout_can_be_built(tmp_path: Path) -> None:
    copy = copy_checkout(tmp_path / "copy")
    assert (copy / "src/main.c").is_file() and (copy / ".setup/setup.sh").is_file()
    assert not (copy / "build/raybook").exists()


def test_what_stands_behind_make_bench_is_not_handed_on(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ARGS", "--only start")
    monkeypatch.setenv("MAKEFLAGS", "-s")
    assert not {"ARGS", "MAKEFLAGS"} & clean_environment().keys()


def test_changes_merge_as_in_the_renderer() -> None:
    assert merged({"a": {"b": 1, "c": 2}, "d": [1]}, {"a": {"b": None}, "d": [2]}) == {
        "a": {"c": 2},
        "d": [2],
    }


def test_the_grid_has_as_many_triangles_as_asked() -> None:
    text = grid(1800)
    assert (text.count("\nf "), text.count("v "), text.count("vt ")) == (1800, 961, 961)


@pytest.mark.skipif(not shutil.which("clang"), reason="without clang")
def test_the_c_files_are_plain_c99(tmp_path: Path) -> None:
    command = ["clang", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only"]
    top = HERE.parents[2]
    for file in HERE.glob("*.c"):
        if file.name != "bench_image.c":  # it includes cJSON's header, which is where it is
            subprocess.run([*command, f"-I{top / 'src'}", f"-I{HERE}", str(file)], check=True)
