"""The small book in a browser: going about, the search, dark and light, a phone, and paper."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from contextlib import nullcontext
from itertools import pairwise
from pathlib import Path

import pytest
from playwright.sync_api import Browser
from reading import chromium, reading
from small_book import make_book, weave

from raybook_grader.book.editions import Edition
from raybook_grader.book.paper import PageNumbers, print_pdf, printed, sheet_of
from raybook_grader.book.pdf_file import renumbered, sealed
from raybook_grader.errors import BadInput
from raybook_grader.literate.leaks import scan
from raybook_grader.literate.secrets import checkout_secrets

DISC = "chapters/01-disc.html"
# What reaches over the right edge, but for what scrolls in a box of its own.
TOO_WIDE = """() => [...document.querySelectorAll("article *")]
  .filter((e) => e.getBoundingClientRect().right > innerWidth)
  .filter((e) => !e.closest("pre, .math-body, .table-wrapper, .katex-mathml, figure:has(> img)"))
  .map((e) => `${e.tagName} ${e.className}`)"""


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """One a module of tests: while one runs, no other test of the session can start its own."""
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def book(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_book(tmp_path_factory.mktemp("book"))


@pytest.fixture(scope="module")
def site(book: Path) -> Path:
    return weave(book, Edition.STUDENT).folder


@pytest.fixture(scope="module")
def paper(book: Path) -> Path:
    """The PDF. Before the browser is started: two do not go together."""
    page = weave(book, Edition.STUDENT, "singlehtml").folder / "index.html"
    numbers = print_pdf(page, book / "build" / "book.pdf")
    (book / "build" / "again.pdf").write_bytes(print_otherwise(page, numbers))
    return book / "build" / "book.pdf"


def print_otherwise(page: Path, numbers: PageNumbers) -> bytes:
    """What a browser prints that has counted other nodes before, as a busy one may have."""
    with sheet_of(page) as sheet:
        sheet.context.new_cdp_session(sheet).send("DOM.getDocument", {"depth": 4})
        data = printed(sheet, numbers)
    counted = re.findall(rb"/ID \(node(\d+)\)", data)
    assert len(counted) >= 3 and int(min(counted)) > 1, "the table's heads"
    return sealed(data)


def test_paper_depends_on_the_page_alone(paper: Path) -> None:
    assert paper.read_bytes() == paper.with_name("again.pdf").read_bytes()


def test_nodes_are_numbered_from_one_and_in_order() -> None:
    first = b"/ID (node00000916) /Names [(node00000916) 3 0 R (node00000940) 4 0 R]"
    second = first.replace(b"916", b"902").replace(b"940", b"999")
    assert first != second and renumbered(first) == renumbered(second)
    assert b"(node00000001) 3 0 R (node00000002) 4 0 R" in renumbered(first)
    assert len(renumbered(first)) == len(first)


def test_wrong_page_numbers_are_never_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Remembered numbers that no longer hold cost a print; numbers that never hold are a fault."""
    printed_with = []

    def printed(sheet: object, numbers: PageNumbers) -> PageNumbers:
        printed_with.append(numbers)
        return {"print-1": str(len(printed_with)) if restless else "5"}

    monkeypatch.setattr("raybook_grader.book.paper.sheet_of", lambda page: nullcontext())
    monkeypatch.setattr("raybook_grader.book.paper.printed", printed)
    monkeypatch.setattr("raybook_grader.book.paper._destinations", lambda data: data)
    monkeypatch.setattr("raybook_grader.book.paper.sealed", lambda data: b"sealed")
    restless = False
    numbers = print_pdf(tmp_path, tmp_path / "book.pdf", {"print-1": "4"})
    assert printed_with == [{"print-1": "4"}, {"print-1": "5"}] and numbers == {"print-1": "5"}
    restless = True
    with pytest.raises(BadInput, match="do not settle"):
        print_pdf(tmp_path, tmp_path / "restless.pdf", {"print-1": "0"})
    assert not (tmp_path / "restless.pdf").exists()


def test_the_pdf_has_contents_links_and_no_solution(book: Path, paper: Path) -> None:
    def tell(*command: str) -> str:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout

    text = tell("pdftotext", "-layout", str(paper), "-")
    contents = text.partition("Contents")[2].partition("\f")[0]
    pages = text.split("\f")
    for title in ("1. Discs", "2. Means"):
        row = next(line for line in contents.splitlines() if title in line)
        assert title in pages[int(row.split()[-1]) - 1], row
    for name, declared in (("disc_area", "float disc_area("), ("mean_pair", "mean_pair(")):
        at = re.search(rf"\b{name} (\d+) function", text)
        assert at and declared in pages[int(at[1]) - 1], "the index leads to the page"
    folded = " ".join(text.partition("DISC_PI is used in")[2].split()[:60])
    assert "8 places" in folded and "Use number seven" in folded, "opened on paper"
    assert "float disc_area(const struct disc" in text and "zanzibar" not in text
    assert "frag-disc-area" in tell("pdfinfo", "-dests", str(paper)), "links go to places"
    assert scan(paper, checkout_secrets(book)).clean


def test_pages_are_quiet(paper: Path, browser: Browser, site: Path) -> None:
    for page in ("index.html", DISC, "chapters/02-mean.html", "search.html"):
        with reading(browser, site, page) as read:
            read.page.wait_for_load_state("networkidle")
            assert read.faults == [] and read.page.title(), page


def test_from_page_to_page(paper: Path, browser: Browser, site: Path) -> None:
    with reading(browser, site, "index.html") as read:
        read.page.locator("article").get_by_role("link", name="Discs").click()
        read.page.wait_for_url("**/01-disc.html")
        read.page.locator("a.rb-id", has_text="DISC_PI").first.click()
        assert read.page.url.endswith("#id-DISC_PI")
        assert read.page.locator("#id-DISC_PI").is_visible() or read.js(
            "() => document.getElementById('id-DISC_PI').getBoundingClientRect().top < innerHeight"
        )
        read.page.keyboard.press("ArrowRight")
        read.page.wait_for_url("**/02-mean.html")
        assert read.faults == []


def test_the_search_finds_words_and_names(paper: Path, browser: Browser, site: Path) -> None:
    for word, page in (("wombat", "02-mean.html"), ("disc_area", "01-disc.html")):
        with reading(browser, site, "index.html") as read:
            field = read.page.locator("input[name=q]").first
            field.fill(word)
            field.press("Enter")
            read.page.wait_for_selector("ul.search li a")
            found = read.page.locator("ul.search li a").first.get_attribute("href") or ""
            assert page in found and read.faults == []
    with reading(browser, site, "search.html?q=zanzibar") as read:
        read.page.wait_for_function("() => /did not match/.test(document.body.innerText)")


def test_dark_and_light(paper: Path, browser: Browser, site: Path) -> None:
    colours = "() => getComputedStyle(document.body).backgroundColor"
    seen = []
    for dark in (False, True):
        with reading(browser, site, DISC, dark=dark) as read:
            seen.append(read.js(colours))
            keyword = "() => getComputedStyle(document.querySelector('.rb-code .k')).color"
            seen.append(read.js(keyword))
            if dark:
                button = read.page.locator(".theme-toggle:visible").first
                button.focus()
                read.page.keyboard.press("Enter")
                read.page.wait_for_function(f"() => ({colours})() === '{seen[0]}'")
    assert seen[0] != seen[2] and seen[1] != seen[3]


@pytest.mark.parametrize("dark", [False, True])
def test_text_can_be_read(paper: Path, browser: Browser, site: Path, dark: bool) -> None:
    """WCAG 2.2, 1.4.3: a contrast of at least 4.5, of code in every colour, too."""
    script = """() => {
      const rgb = (text) => text.match(/[\\d.]+/g).slice(0, 3).map(Number);
      const light = (c) => rgb(c).map((v) => v / 255)
        .map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
        .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
      const back = (e) => {
        const own = getComputedStyle(e).backgroundColor;
        return /^rgb\\(/.test(own) ? own : back(e.parentElement);
      };
      const worst = [];
      for (const e of document.querySelectorAll("article *, .sidebar-drawer a")) {
        const own = [...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim());
        if (!own || !e.checkVisibility() || e.matches(".headerlink, annotation")) continue;
        const [a, b] = [light(getComputedStyle(e).color), light(back(e))].sort((x, y) => y - x);
        worst.push([(a + 0.05) / (b + 0.05), `${e.tagName} ${e.className}: ${e.textContent}`]);
      }
      return worst.sort((x, y) => x[0] - y[0])[0];
    }"""
    with reading(browser, site, DISC, dark=dark) as read:
        contrast, where = read.js(script)
        assert contrast >= 4.5, where


def test_a_phone_scrolls_down_only(paper: Path, browser: Browser, site: Path) -> None:
    for page in ("index.html", DISC, "chapters/02-mean.html"):
        with reading(browser, site, page, width=360) as read:
            assert read.js("() => document.documentElement.scrollWidth") <= 360, page
            assert read.js(TOO_WIDE) == [], page
            if page == DISC:
                box = "document.querySelector('{}').getBoundingClientRect()"
                formula, number = box.format(".math-body"), box.format(".eqno")
                assert read.js(f"() => {formula}.right <= {number}.left"), "side by side"


def test_the_page_has_an_order(paper: Path, browser: Browser, site: Path) -> None:
    """One h1, no level left out, a language, a name for every picture and every landmark."""
    with reading(browser, site, DISC) as read:
        levels = read.js(
            "() => [...document.querySelectorAll('article :is(h1,h2,h3,h4)')]"
            ".map((h) => Number(h.tagName[1]))"
        )
        assert levels.count(1) == 1
        assert all(b - a <= 1 for a, b in pairwise(levels))
        assert read.js("() => document.documentElement.lang") == "en"
        assert read.js("() => document.querySelectorAll('img:not([alt])').length") == 0


def test_a_folded_list_opens_by_keyboard_and_on_paper(
    paper: Path, browser: Browser, site: Path
) -> None:
    focused = "() => document.activeElement.matches('.rb-foot summary')"
    with reading(browser, site, DISC) as read:
        link = read.page.locator(".rb-foot details a").first
        assert not link.is_visible()
        for _ in range(200):
            read.page.keyboard.press("Tab")
            if read.js(focused):
                break
        assert read.js(focused), "the list can be reached"
        read.page.keyboard.press("Enter")
        assert link.is_visible()
        read.page.keyboard.press("Enter")
        assert not link.is_visible()
        read.page.emulate_media(media="print")
        assert link.is_visible() and read.faults == []


def test_paper_is_light_and_has_no_menus(paper: Path, browser: Browser, site: Path) -> None:
    with reading(browser, site, DISC, dark=True) as read:
        read.page.emulate_media(media="print")
        assert read.js("() => getComputedStyle(document.body).backgroundColor") in (
            "rgb(255, 255, 255)", "rgba(0, 0, 0, 0)")  # fmt: skip
        colour = read.js("() => getComputedStyle(document.querySelector('article p')).color")
        assert sum(int(v) for v in colour[4:-1].split(",")) < 200, "dark ink"
        assert not read.page.locator(".sidebar-drawer").is_visible()
        assert not read.page.locator(".theme-toggle").first.is_visible()
