"""The reports in a browser: the grid, the colours, a phone, and paper."""

from __future__ import annotations

from pathlib import Path

import pytest
from looking import looking
from playwright.sync_api import Browser
from report_class import CHECKOUT, assignments, made_up_class, module_pages

from raybook_grader.database import Module, Student
from raybook_grader.reports.pages import class_page as class_page_of

pytest_plugins = ("report_fixtures",)


def test_every_page_is_quiet(browser: Browser, class_page: Path) -> None:
    own = class_page.parent / "students" / "all-right.html"
    pages = [class_page, own, *module_pages(class_page, "all-right")]
    for page in (pages[0], pages[1], pages[2], pages[-1]):
        with looking(browser, page) as look:
            look.page.wait_for_load_state("networkidle")
            assert look.is_clean, (page, look)
            assert look.page.title()


def test_dark_and_light(browser: Browser, class_page: Path) -> None:
    colours = """() => {
      const style = getComputedStyle(document.body);
      return [style.backgroundColor, style.color];
    }"""
    page = class_page.parent / "students" / "all-right.html"
    shots, seen = [], []
    for dark in (False, True):
        with looking(browser, page, dark=dark) as look:
            shots.append(look.page.screenshot())
            seen.append(look.js(colours))
            if dark:
                button = look.page.locator("[data-theme-button]")
                assert button.get_attribute("aria-pressed") == "true"
                button.focus()
                look.page.keyboard.press("Enter")
                assert look.js(colours) == seen[0], "the button makes it light"
                look.page.reload()
                assert look.js(colours) == seen[0], "and it stays so"
            assert look.is_clean, look
    assert shots[0] != shots[1] and seen[0] != seen[1]


@pytest.mark.parametrize("dark", [False, True])
def test_text_can_be_read(browser: Browser, class_page: Path, dark: bool) -> None:
    """WCAG 2.2, 1.4.3: a contrast of at least 4.5 of all text that has a tone."""
    script = """() => {
      const rgb = (text) => text.match(/[\\d.]+/g).slice(0, 3).map(Number);
      const light = (c) => rgb(c).map((v) => v / 255)
        .map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
        .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
      const back = (e) => {
        const own = getComputedStyle(e).backgroundColor;
        return own === "rgba(0, 0, 0, 0)" ? back(e.parentElement) : own;
      };
      const worst = [];
      const texts = "p, td, th, a, h1, h2, h3, .badge, .cell, button, summary, small, label";
      for (const e of document.querySelectorAll(texts)) {
        if (!e.checkVisibility() || !e.textContent.trim()) continue;
        const [a, b] = [light(getComputedStyle(e).color), light(back(e))].sort((x, y) => y - x);
        worst.push([(a + 0.05) / (b + 0.05), `${e.tagName} ${e.className}: ${e.textContent}`]);
      }
      return worst.sort((x, y) => x[0] - y[0])[0];
    }"""
    pages = [class_page, module_pages(class_page, "all-right")[1]]
    for page in pages:
        with looking(browser, page, dark=dark) as look:
            contrast, where = look.js(script)
            assert contrast >= 4.5, where


def test_a_phone_scrolls_down_only(browser: Browser, class_page: Path) -> None:
    students = class_page.parent / "students"
    pages = [class_page, students / "all-right.html", module_pages(class_page, "all-right")[1]]
    for page in pages:
        with looking(browser, page, width=360) as look:
            look.js("() => document.querySelectorAll('details').forEach((d) => { d.open = true; })")
            look.js("() => document.querySelector('.rbv')?.scrollIntoView()")
            if page == pages[-1]:
                look.page.wait_for_selector('[data-on="ready"]')
            assert look.js("() => document.documentElement.scrollWidth") <= 360, page


def test_the_grid_is_sorted_and_filtered(browser: Browser, class_page: Path) -> None:
    with looking(browser, class_page) as look:

        def ids() -> list[str]:
            shown: list[str] = look.js(
                """() => [...document.querySelectorAll("[data-grid] tbody tr")]
                  .filter((row) => !row.hidden).map((row) => row.dataset.id)"""
            )
            return shown

        whole = ids()
        assert whole.index("broken") < whole.index("all-right"), "where the grader failed"
        student = look.page.get_by_role("button", name="Student")
        student.focus()
        look.page.keyboard.press("Enter")
        assert ids() == sorted(whole)
        look.page.keyboard.press("Enter")
        assert ids() == sorted(whole, reverse=True)
        head = look.page.locator("[data-grid] thead th").first
        assert head.get_attribute("aria-sort") == "descending"
        look.page.locator("[data-grid] thead button").nth(1).click()
        assert ids()[0] == "broken", "what has no score is looked at first"
        look.page.locator("[data-search]").fill("ALL-")
        assert ids() == ["all-right"]
        status = look.page.locator("[data-shown]")
        assert status.text_content() == f"1 of {len(whole)} shown"
        look.page.get_by_role("button", name="Clear").click()
        look.page.wait_for_function(
            "() => document.querySelector('[data-shown]').textContent[0] !== '1'"
        )
        look.page.locator("[data-verdict]").select_option("internal-error")
        look.page.locator("[data-module]").select_option("1")
        assert "broken" in ids() and len(ids()) < len(whole)
        assert look.is_clean, look


def test_keys_walk_the_grid(browser: Browser, class_page: Path) -> None:
    pages = tuple(class_page.parent.rglob("*.html"))
    with looking(browser, class_page, allowed=pages) as look:
        focused = "() => document.activeElement.getAttribute('href')"
        stops = "() => document.querySelectorAll('[data-grid] tbody a[tabindex=\"0\"]').length"
        assert look.js(stops) == 1, "one stop of the Tab key"
        look.page.locator('[data-grid] tbody a[tabindex="0"]').focus()
        start = look.js(focused)
        look.page.keyboard.press("ArrowRight")
        assert look.js(focused) == start.removesuffix(".html") + "/00-build.html"
        look.page.keyboard.press("End")
        assert look.js(focused).endswith("/10-mipmap.html")
        look.page.keyboard.press("ArrowDown")
        look.page.keyboard.press("Home")
        assert look.js(focused).endswith(".html") and look.js(focused) != start
        look.page.keyboard.press("Control+Home")
        assert look.js(focused) == start
        outline = look.js("() => getComputedStyle(document.activeElement).outlineStyle")
        assert outline == "solid", "the focus is seen"
        assert look.js(stops) == 1
        look.page.keyboard.press("Enter")
        look.page.wait_for_url("**/students/*.html")
        assert look.is_clean, look


def test_paper_shows_what_is_folded(browser: Browser, class_page: Path) -> None:
    with looking(browser, module_pages(class_page, "all-right")[1], dark=True) as look:
        assert look.page.locator("details.check[open]").count() == 0, "all passed"
        look.js("() => dispatchEvent(new Event('beforeprint'))")
        assert look.page.locator("details.check:not([open])").count() == 0
        look.page.emulate_media(media="print")
        assert look.js("() => getComputedStyle(document.body).color") == "rgb(27, 32, 40)"
        assert not look.page.locator("[data-theme-button]").is_visible()
        look.js("() => dispatchEvent(new Event('afterprint'))")
        assert look.page.locator("details.check[open]").count() == 0


def test_a_whole_class_is_light_enough(browser: Browser, tmp_path: Path) -> None:
    """Two hundred students and all modules: what is sorted is at hand, in one small file."""
    modules = [Module(a.number, a.module, a.title, a.points, a.optional) for a in assignments()]
    students = [Student(name, None, own) for name, own in made_up_class(200, 4).items()]
    page = tmp_path / "index.html"
    page.write_text(class_page_of("Raybook", modules, students), encoding="utf-8")
    assert page.stat().st_size < 1_000_000
    with looking(browser, page) as look:
        assert look.js("() => document.querySelectorAll('[data-grid] .cell').length") == 200 * len(
            assignments()
        )
        assert look.js("() => document.querySelectorAll('*').length") < 25_000
        assert look.is_clean, look
    assert CHECKOUT.as_posix() not in page.read_text(encoding="utf-8")
