"""Data and printed output in the book: from the program, and compared with it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from small_book import CHECKOUT

from raybook_grader.book.outputs import difference, printed_by
from raybook_grader.book.plots.curves import Curve, Panel
from raybook_grader.book.plots.drawing import error_svg, points_svg
from raybook_grader.book.plots.measured import tiles
from raybook_grader.book.plots.points import sampler_points
from raybook_grader.book.plots.table import plot_file
from raybook_grader.errors import BadInput

LOG = "hit object 4 at t = 3.92413, (-0.3927,\n    0.687) share 0.1389, light 0"


@pytest.mark.parametrize(
    ("old", "new"), [("3.92413", "3.93"), ("object 4", "object 5"), ("share", "part"),
                     (", light 0", ""), ("light 0", "light 0 more")],
)  # fmt: skip
def test_output_that_is_out_of_date_is_told(old: str, new: str) -> None:
    said = difference(LOG, LOG.replace(old, new))
    assert "the program prints" in said and "the page has" in said


def test_where_lines_break_and_the_last_digit_may_differ() -> None:
    assert difference(LOG, LOG.replace("\n    ", " ").replace("3.92413", "3.92414")) == ""


def test_what_the_program_prints_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "program"
    program.write_text('#!/bin/sh\necho "$PWD" >>"$0.log"; echo "$1: wrong" >&2; exit 2\n')
    program.chmod(0o755)
    monkeypatch.setattr("raybook_grader.book.outputs.reference_program", lambda root: program)
    monkeypatch.setattr("raybook_grader.book.outputs.code_key", lambda root: "code")
    scenes = tmp_path / "scenes"
    scenes.mkdir()
    for name in ("a.json", "b.json"):
        (scenes / name).write_text("{}")
    commands = "raybook a.json; build/raybook b.json"
    for _ in range(2):
        said = printed_by(tmp_path, tmp_path / "cache", commands, "scenes")
        assert said == "a.json: wrong\nb.json: wrong\n"
    calls = Path(f"{program}.log")
    assert len(calls.read_text().splitlines()) == 2
    (scenes / "a.json").write_text("[]")
    printed_by(tmp_path, tmp_path / "cache", commands, "scenes")
    assert len(calls.read_text().splitlines()) == 4
    for bad in ("rm a.json", "raybook c.json"):
        with pytest.raises(BadInput):
            printed_by(tmp_path, tmp_path / "cache", bad, "scenes")


@pytest.mark.parametrize("cuts", [(16, 1), (8, 2), (4, 4), (2, 8), (1, 16)])
def test_the_net_has_a_point_in_each_cell(cuts: tuple[int, int]) -> None:
    """What the caption asks the reader to check."""
    points = sampler_points(CHECKOUT, "sobol", 16)
    assert len({(int(x * cuts[0]), int(y * cuts[1])) for x, y in points}) == 16


def test_only_even_points_fill_a_grid() -> None:
    filled = {}
    for kind in ("independent", "stratified", "sobol"):
        points = sampler_points(CHECKOUT, kind, 64)
        assert points.shape == (64, 2) and points.min() >= 0.0 and points.max() < 1.0
        filled[kind] = len({(int(x * 8), int(y * 8)) for x, y in points})
    assert filled["stratified"] == filled["sobol"] == 64 > filled["independent"]


def test_the_same_data_gives_the_same_plot() -> None:
    curves = (Curve("right", "blue", ((1, 0.5), (4, 0.25))),
              Curve("wrong", "orange-dashed", ((1, 0.5), (4, 0.4))))  # fmt: skip
    panels = [Panel("one", curves), Panel("two", curves)]
    for count in (1, 2):
        first = error_svg(panels[:count], "error of a pixel")
        assert first == error_svg(panels[:count], "error of a pixel")
        assert first.startswith(b"<?xml") and b"<dc:date>" not in first
    other = (curves[0], Curve("wrong", "orange-dashed", ((1, 0.5), (4, 0.3))))
    assert error_svg([Panel("one", other)], "") != error_svg(panels[:1], "")
    points = [np.array([[0.5, 0.25]])]
    svg = points_svg(["one"], points, [(2, 2)], 10.0)
    assert svg == points_svg(["one"], points, [(2, 2)], 10.0)


def test_tiles_are_means() -> None:
    picture = np.zeros((17, 16, 3))
    picture[:8, 8:16] = 2.0
    picture[16] = 99.0
    assert tiles(picture)[..., 0].tolist() == [[0.0, 2.0], [0.0, 0.0]]


def test_a_plot_has_a_name(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="mc-convergence"):
        plot_file(CHECKOUT, tmp_path, "mc-divergence")
