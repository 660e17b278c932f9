"""`raybook-grader compare`: its rule, exit codes, JSON and page."""

import argparse
import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from judge_scenes import Estimator, jittered, radiance, shade

from raybook_grader.judge import viewer
from raybook_grader.judge.commands import add_commands
from raybook_grader.judge.compare import Comparison, compare
from raybook_grader.judge.exr import write_exr
from raybook_grader.judge.numbers import unpacked
from raybook_grader.judge.pixels import Image
from raybook_grader.judge.viewer import Fact, viewer_html

SIZE = 64
SCENE = Estimator(radiance(SIZE, SIZE), variance=0.5)
NO_ERROR = np.zeros((SIZE, SIZE), np.float32)
STILL: Image = radiance(SIZE, SIZE).astype(np.float32)


def codes(comparison: Comparison) -> set[str]:
    return {reason.code for reason in comparison.reasons}


def moved(image: Image) -> Image:
    """Half a pixel to the right."""
    half: Image = (image + np.roll(image, 1, axis=1)) / np.float32(2)
    return half


@pytest.mark.parametrize("spp", [2, 16, 128])
def test_two_seeds_are_the_same(spp: int) -> None:
    for seed in range(3):
        assert codes(compare(SCENE.image(seed, spp), SCENE.image(100 + seed, spp))) == set()


@pytest.mark.parametrize("spp", [4, 64])
def test_two_seeds_that_differ_only_at_edges_are_the_same(spp: int) -> None:
    assert codes(compare(jittered(1, spp, SIZE), jittered(2, spp, SIZE))) == set()


def test_a_picture_is_the_same_as_itself() -> None:
    result = compare(STILL, STILL)
    assert result.same
    assert result.as_json()["flip"] == 0
    assert compare(STILL, STILL * np.float32(1.0005)).same


def test_brightness_beyond_noise_is_different() -> None:
    reference = SCENE.image(1, 256)
    assert "G" in codes(compare(reference, SCENE.scaled(1.02).image(2, 256)))
    assert "G" in codes(compare(STILL, STILL * np.float32(1.01)))
    dark = compare(reference, SCENE.scaled(0.9).image(2, 256)).as_json()
    assert dark["bias"]["global"] == pytest.approx(-0.1, abs=0.01)
    assert dark["bias"]["rms"] == pytest.approx(0.1, abs=0.02)
    assert dark["bias"]["worst_tile"] < -0.05


def test_a_wrong_tile_is_different() -> None:
    scale = np.ones((SIZE, SIZE, 1))
    scale[32:48, 16:32] = 1.2
    result = compare(SCENE.image(1, 256), SCENE.scaled(scale).image(2, 256))
    assert "L16" in codes(result)
    assert "x=16..31, y=32..47" in result.reason


def test_half_a_pixel_is_different() -> None:
    for image in (STILL, SCENE.image(1, 1024), jittered(1, 64, SIZE)):
        result = compare(image, moved(image))
        assert "shift" in codes(result)
        text = re.search(r"moved by \+0\.(\d\d) pixels to the right", result.reason)
        assert text and 35 <= int(text[1]) <= 65


def test_missing_anti_aliasing_is_different() -> None:
    y, x = (np.mgrid[0:SIZE, 0:SIZE] + 0.5) / SIZE
    assert not compare(jittered(1, 64, SIZE), shade(x, y).astype(np.float32)).same


def test_pixels_that_are_no_radiance_are_different() -> None:
    for value in (np.nan, np.inf, -1.0):
        test = STILL.copy()
        test[5, 7, 0] = value
        result = compare(STILL, test)
        assert "nan" in codes(result)
        assert "x=7, y=5" in result.reason
        json.dumps(result.as_json(), allow_nan=False)


@pytest.mark.parametrize("size", [(1, 1), (2, 3), (9, 40)])
def test_tiny_pictures_are_compared(size: tuple[int, int]) -> None:
    image = np.random.default_rng(1).gamma(4, 0.2, (*size, 3)).astype(np.float32)
    assert compare(image, image).same
    assert not compare(image, 3 * image).same
    json.dumps(compare(image, 3 * image).as_json(), allow_nan=False)


def run(*arguments: object) -> int:
    parser = argparse.ArgumentParser()
    add_commands(parser.add_subparsers(required=True))
    parsed = parser.parse_args(["compare", *map(str, arguments)])
    return int(parsed.handler(parsed))


@pytest.fixture
def files(tmp_path: Path) -> Path:
    write_exr(tmp_path / "a.exr", SCENE.image(1, 64))
    write_exr(tmp_path / "b.exr", SCENE.image(2, 64))
    write_exr(tmp_path / "bright.exr", SCENE.scaled(1.1).image(3, 64))
    write_exr(tmp_path / "small.exr", SCENE.image(1)[:48])
    write_exr(tmp_path / "nan.exr", SCENE.image(1) * np.float32(np.nan))
    (tmp_path / "text.exr").write_text("hello")
    return tmp_path


def test_exit_codes(files: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(files / "a.exr", files / "b.exr") == 0
    assert capsys.readouterr().out.startswith("same: ")
    assert run(files / "a.exr", files / "bright.exr") == 1
    assert capsys.readouterr().out.startswith("different: the image is ")
    assert run(files / "a.exr", files / "small.exr") == 1
    assert "64 x 48 pixels, the reference 64 x 64" in capsys.readouterr().out
    assert run(files / "a.exr", files / "nan.exr") == 1
    capsys.readouterr()
    for pair in (("a", "text"), ("text", "a"), ("nan", "a"), ("a", "missing")):
        assert run(*(files / f"{name}.exr" for name in pair)) == 2
        captured = capsys.readouterr()
        assert captured.out == ""
        assert len(captured.err.splitlines()) == 1


def test_json_has_the_documented_shape(files: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, code in (("b", 0), ("bright", 1), ("small", 1), ("text", 2)):
        assert run(files / "a.exr", files / f"{name}.exr", "--json") == code
        value = json.loads(capsys.readouterr().out)
        assert list(value) == ["same", "flip", "flip_excess", "delta_e_itp", "bias", "reason"]
        assert list(value["delta_e_itp"]) == ["mean", "p95"]
        assert list(value["bias"]) == ["global", "rms", "worst_tile"]
        assert value["same"] is (code == 0)
        assert value["reason"]
        assert isinstance(value["flip"], float) is (name in ("b", "bright"))


class Elements(HTMLParser):
    """Every tag and attribute of a page."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str | None]]] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found.append((tag, dict(attrs)))


def test_the_page_is_complete_and_self_contained(files: Path) -> None:
    page = files / "page.html"
    assert run(files / "a.exr", files / "bright.exr", "--html", page) == 1
    text = page.read_text("utf-8")
    elements = Elements(text).found
    images = [a["src"] for tag, a in elements if tag == "img"]
    assert len(images) == 6, "two pictures, a map, and the colour scales of three"
    assert all(source and source.startswith("data:image/png;base64,iVBOR") for source in images)
    assert not any(a.get("src", a.get("href")) for t, a in elements if t in ("link", "script"))
    assert "http://" not in text and "https://" not in text
    assert "too bright" in text


def test_a_page_that_cannot_be_written_is_one_message(
    files: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(files / "a.exr", files / "b.exr", "--html", files / "no" / "page.html") == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert run(files / "a.exr", files / "small.exr", "--html", files / "page.html") == 1
    assert "the reference 64 x 64" in (files / "page.html").read_text("utf-8")


def numbers(fragment: str) -> dict[str, object]:
    found = re.search(r"data-numbers>(.*?)</script>", fragment, re.DOTALL)
    assert found
    value: dict[str, object] = json.loads(found[1])
    return value


def test_the_viewer_holds_true_numbers() -> None:
    test = STILL.copy()
    test[3, 5] = [0.1, 1e-30, np.nan]
    data = numbers(viewer_html(STILL, test, NO_ERROR, "A title"))
    for shown, image in zip(data["pictures"], (STILL, test), strict=True):  # type: ignore[call-overload]
        np.testing.assert_array_equal(unpacked(shown["data"]).reshape(image.shape), image)


def test_the_viewer_escapes_what_it_is_given() -> None:
    evil = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\"'"
    facts = [Fact(evil, evil, evil)]
    fragment = viewer_html(STILL, STILL, NO_ERROR, evil, test_name=evil, facts=facts)
    elements = Elements(fragment).found
    assert [a for tag, a in elements if tag == "script"] == [
        {"type": "application/json", "data-numbers": None}
    ]
    assert not any("onerror" in a for _, a in elements)
    assert numbers(fragment)["pictures"][1]["name"] == evil  # type: ignore[index]


def test_large_pictures_are_shown_reduced(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(viewer, "MAX_SHOWN", 1000)
    fragment = viewer_html(STILL[:48], STILL[:48], NO_ERROR[:48], "large")
    assert "shown at 1/2 of its size" in fragment
    assert (numbers(fragment)["width"], numbers(fragment)["height"]) == (32, 24)


def test_sizes_must_agree_in_the_viewer() -> None:
    with pytest.raises(ValueError, match="sizes differ"):
        viewer_html(STILL, STILL[1:], NO_ERROR, "x")


def test_noisier_right_pictures_are_the_same() -> None:
    assert compare(SCENE.image(1, 4096), replace(SCENE, variance=2.0).image(2, 64)).same
