"""The viewer in a browser: what the sliders, the keys and the cursor do to real pixels."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from looking import Look, looking
from playwright.sync_api import Browser
from report_class import SIZE, pictures

from raybook_grader.judge.commands import add_commands
from raybook_grader.judge.display import tone_mapped
from raybook_grader.judge.exr import read_exr, write_exr
from raybook_grader.judge.pixels import Image
from raybook_grader.judge.viewing import viewing_of

pytest_plugins = ("report_fixtures",)


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page of `compare`, whose viewer is that of the reports."""
    folder = tmp_path_factory.mktemp("viewer")
    for name, image in zip(("reference", "test"), pictures(), strict=True):
        write_exr(folder / f"{name}.exr", image)
    parser = argparse.ArgumentParser()
    add_commands(parser.add_subparsers())
    names = [str(folder / name) for name in ("reference.exr", "test.exr", "page.html")]
    arguments = parser.parse_args(["compare", *names[:2], "--html", names[2]])
    assert arguments.handler(arguments) == 1
    return folder / "page.html"


@pytest.fixture
def look(browser: Browser, page: Path) -> Iterator[Look]:
    """The page, ready; at its end it must not have done anything wrong."""
    with looking(browser, page) as opened:
        opened.page.wait_for_selector('[data-on="ready"]')
        yield opened
        assert opened.is_clean, opened


def canvas(look: Look, pane: str) -> Image:
    """The pixels of a canvas, (height, width, 3)."""
    data = look.js(
        """(pane) => {
          const c = document.querySelector(pane + " .rbv-frame canvas");
          return [...c.getContext("2d").getImageData(0, 0, c.width, c.height).data];
        }""",
        pane,
    )
    shown: Image = np.array(data, np.float32).reshape(SIZE, SIZE, 4)[..., :3]
    return shown


def numbers(look: Look) -> list[list[float]]:
    """The exact values of the read-out: red, green, blue and luminance of both pictures."""
    rows = look.js(
        """() => [...document.querySelectorAll(".rbv-values:nth-child(2) tbody tr")].slice(0, 2)
          .map((row) => [...row.querySelectorAll("td")].map((cell) => cell.title))"""
    )
    return [[float(text) for text in row] for row in rows]


def slide(look: Look, selector: str, value: float) -> None:
    look.page.locator(selector).fill(str(value))
    look.js("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def point(look: Look, pane: str, x: int, y: int) -> None:
    """Move the cursor over a pixel of the unzoomed picture."""
    box = look.page.locator(f"{pane} canvas").bounding_box()
    assert box
    step = box["width"] / SIZE
    look.page.mouse.move(box["x"] + (x + 0.5) * step, box["y"] + (y + 0.5) * step)


REFERENCE, TEST, SPLIT = (f'[data-pane="{p}"]' for p in ("0", "1", "split"))
FLIP = '[data-error="0"]'


def test_exposure_moves_all_three(look: Look) -> None:
    reference, test = pictures()
    white = viewing_of(reference).white
    before = [canvas(look, pane) for pane in (REFERENCE, TEST, FLIP)]
    np.testing.assert_allclose(before[0], tone_mapped(reference, white), atol=1)
    slide(look, "[data-exposure]", -1)
    after = [canvas(look, pane) for pane in (REFERENCE, TEST, FLIP)]
    np.testing.assert_allclose(after[0], tone_mapped(reference, 2 * white), atol=1)
    np.testing.assert_allclose(after[1], tone_mapped(test, 2 * white), atol=1)
    assert after[2].sum() < before[2].sum(), "errors count half as much"
    assert look.page.locator("[data-stops]").text_content() == "-1.0"
    legend = look.page.locator(f"{FLIP} [data-high]")
    darker = float(legend.text_content() or "")
    look.page.locator("[data-reset]").click()
    assert float(legend.text_content() or "") == pytest.approx(darker / 2)
    np.testing.assert_array_equal(canvas(look, REFERENCE), before[0])


def test_the_split_shows_both(look: Look) -> None:
    look.page.locator('[data-layout="split"]').click()
    assert not look.page.locator(REFERENCE).is_visible()
    left, right = canvas(look, REFERENCE), canvas(look, TEST)
    for share, column in ((50, SIZE // 2), (25, SIZE // 4), (0, 0), (100, SIZE)):
        slide(look, "[data-split]", share)
        shown = canvas(look, SPLIT)
        np.testing.assert_array_equal(shown[:, :column], left[:, :column])
        np.testing.assert_array_equal(shown[:, column:], right[:, column:])
    slide(look, "[data-split]", 50)
    seam = look.page.locator(".rbv-seam").bounding_box()
    assert seam
    look.page.mouse.move(seam["x"] + 12, seam["y"] + 40)
    look.page.mouse.down()
    look.page.mouse.move(seam["x"] + 92, seam["y"] + 40)
    look.page.mouse.up()
    moved = float(look.page.locator("[data-split]").input_value())
    assert moved > 55, "the seam itself can be drawn"
    look.page.locator("[data-split]").focus()
    look.page.keyboard.press("ArrowLeft")
    assert float(look.page.locator("[data-split]").input_value()) < moved


@pytest.mark.parametrize(("x", "y"), [(0, 0), (17, 40), (SIZE - 1, SIZE - 1)])
def test_the_read_out_is_the_float_of_the_file(look: Look, page: Path, x: int, y: int) -> None:
    images = [read_exr(page.with_name(f"{name}.exr")).pixels for name in ("reference", "test")]
    point(look, TEST, x, y)
    assert look.page.get_by_text(f"x = {x}, y = {y}").is_visible()
    for read, image in zip(numbers(look), images, strict=True):
        np.testing.assert_array_equal(np.array(read[:3], np.float32), image[y, x])
    cell = look.page.locator(".rbv-values:nth-child(2) tbody tr:first-child td").first
    assert float(cell.text_content() or "") == pytest.approx(float(images[0][y, x, 0]), rel=1e-5)


def test_keys_walk_and_zoom(look: Look) -> None:
    target = look.page.locator(f"{REFERENCE} canvas")
    point(look, REFERENCE, 30, 30)
    target.click()
    target.focus()
    look.page.keyboard.press("ArrowRight")
    look.page.keyboard.press("ArrowDown")
    look.page.keyboard.press("Shift+ArrowDown")
    x, y = map(
        int,
        look.js("""() => /x = (\\d+), y = (\\d+)/.exec(
      document.querySelector("[data-readout]").textContent).slice(1)"""),
    )
    centre = look.js("""() => document.querySelector("[data-told]").textContent""")
    assert centre.startswith(f"x {x}, y {y}: Reference "), "a screen reader is told, too"
    look.page.keyboard.press("+")
    look.page.keyboard.press("+")
    assert look.page.locator("[data-scale]").text_content() == "4\u00d7"
    stage = look.js(
        """() => [...document.querySelectorAll(".rbv-stage")].map((s) => s.style.transform)"""
    )
    assert len(set(stage)) == 1 and "scale(4)" in stage[0], "all panes look at the same part"
    for _ in range(7):
        look.page.keyboard.press("Shift+ArrowRight")
    cross = look.page.locator(f"{REFERENCE} .rbv-cross").bounding_box()
    frame = look.page.locator(f"{REFERENCE} .rbv-frame").bounding_box()
    assert cross and frame
    inside = frame["x"] < cross["x"] + cross["width"] / 2 < frame["x"] + frame["width"]
    assert inside, "the view follows the pixel"
    assert f"x = {SIZE - 1}," in (look.page.locator("[data-readout]").text_content() or "")
    look.page.keyboard.press("0")
    assert look.page.locator("[data-scale]").text_content() == "1\u00d7"


def test_the_cursor_reads_a_zoomed_picture(look: Look) -> None:
    reference, _ = pictures()
    look.page.locator('[data-zoom="in"]').click()
    look.page.locator('[data-zoom="in"]').click()
    frame = look.page.locator(f"{REFERENCE} .rbv-frame").bounding_box()
    assert frame
    middle = frame["x"] + frame["width"] / 2, frame["y"] + frame["height"] / 2
    look.page.mouse.move(*middle)
    read = look.page.locator("[data-readout]").text_content() or ""
    look.page.mouse.down()
    look.page.mouse.move(middle[0] + frame["width"] / 4, middle[1] + 1)
    look.page.mouse.up()
    look.page.mouse.move(*middle)
    moved = look.page.locator("[data-readout]").text_content() or ""
    before, after = (int(text.split("x = ")[1].split(",")[0]) for text in (read, moved))
    assert before - SIZE // 16 - 1 <= after <= before - SIZE // 16 + 1
    y = int(moved.split("y = ")[1].split("red")[0])
    np.testing.assert_array_equal(np.array(numbers(look)[0][:3], np.float32), reference[y, after])


def test_the_error_maps_take_turns(look: Look) -> None:
    buttons = look.page.locator("[data-map]")
    assert buttons.count() == 3
    seen = set()
    for at in range(3):
        buttons.nth(at).focus()
        look.page.keyboard.press("Enter")
        panes = look.page.locator("[data-error]")
        assert [panes.nth(i).is_visible() for i in range(3)] == [i == at for i in range(3)]
        seen.add(canvas(look, f'[data-error="{at}"]').tobytes())
    assert len(seen) == 3


def test_without_a_script_the_pictures_are_there(browser: Browser, page: Path) -> None:
    context = browser.new_context(java_script_enabled=False)
    try:
        plain = context.new_page()
        plain.goto(page.as_uri())
        images = plain.locator(".rbv-stage img")
        assert images.count() == 3
        assert all(images.nth(i).is_visible() for i in range(3))
        assert not plain.locator("[data-exposure]").is_visible(), "no dead controls"
    finally:
        context.close()
