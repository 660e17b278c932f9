"""The weaver on a small checkout: what each reader sees, and what fails the build."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from pygments.token import STANDARD_TYPES
from small_book import USERS, edit, make_book, weave

from raybook_grader.book import weaver
from raybook_grader.book.editions import Edition, Reader
from raybook_grader.book.highlight import COLOURED
from raybook_grader.book.links import link_faults
from raybook_grader.book.round_trip import text_faults
from raybook_grader.book.untangle import untangle
from raybook_grader.literate.leaks import scan
from raybook_grader.literate.secrets import checkout_secrets
from raybook_grader.literate.tree import load_tree

BOTH = list(Edition)


@pytest.fixture(scope="module")
def book(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return make_book(tmp_path_factory.mktemp("book"))


@pytest.fixture(scope="module")
def sites(book: Path) -> dict[Edition, Path]:
    """Both editions, made without a warning."""
    made = {edition: weave(book, edition) for edition in BOTH}
    for outcome in made.values():
        assert not outcome.warnings and not outcome.crashed, outcome
    return {edition: outcome.folder for edition, outcome in made.items()}


def chapter(site: Path, name: str = "01-disc") -> str:
    return (site / "chapters" / f"{name}.html").read_text(encoding="utf-8")


def box(page: str, key: str) -> str:
    """The code box with this id."""
    found = re.search(rf'<figure class="rb-code" id="{key}".*?</figure>', page, re.DOTALL)
    assert found, key
    return found[0]


@pytest.mark.parametrize("edition", BOTH)
def test_the_pages_give_back_the_readers_files(
    book: Path, sites: dict[Edition, Path], edition: Edition
) -> None:
    reader = Reader(load_tree(book), edition)
    assert text_faults(sites[edition], reader) == []
    assert set(untangle(sites[edition])) == set(reader.files)


def test_a_page_that_was_tampered_with_is_told(
    book: Path, sites: dict[Edition, Path], tmp_path: Path
) -> None:
    page = tmp_path / "page.html"
    text = "".join(p.read_text() for p in sorted(sites[Edition.STUDENT].glob("chapters/*.html")))
    reader = Reader(load_tree(book), Edition.STUDENT)
    page.write_text(text)
    assert text_faults(tmp_path, reader) == []
    page.write_text(text.replace("d-&gt;radius", "d-&gt;diameter", 1))
    assert text_faults(tmp_path, reader) != []


@pytest.mark.parametrize("edition", BOTH)
def test_no_link_is_dead(sites: dict[Edition, Path], edition: Edition) -> None:
    assert link_faults(sites[edition]) == []


def test_students_see_no_solution(book: Path, sites: dict[Edition, Path]) -> None:
    report = scan(sites[Edition.STUDENT], checkout_secrets(book))
    assert report.clean and report.documents > 10, report.leaks
    leaky = scan(sites[Edition.INSTRUCTOR], checkout_secrets(book))
    assert not leaky.clean, "the instructors' book is what the scan must find"
    words = "".join(p.read_text() for p in sites[Edition.STUDENT].rglob("*.[hj][ts]*"))
    for secret in ("zanzibar", "quokka", "t_plane"):
        assert secret not in words
    for public in ("wombat", "Find the place, then its distance"):
        assert public in words


def test_lines_are_those_of_the_readers_file(book: Path, sites: dict[Edition, Path]) -> None:
    student = box(chapter(sites[Edition.STUDENT]), "frag-disc-area")
    theirs = Reader(load_tree(book), Edition.STUDENT).text("src/shapes/disc.c").splitlines()
    number = theirs.index("float disc_area(const struct disc *d)") + 1
    assert f"src/shapes/disc.c:{number}–{number + 3}" in student
    assert f'data-n="{number:>5}"' in student
    ours = (book / "src/shapes/disc.c").read_text().splitlines()
    number = ours.index("float disc_area(const struct disc *d)") + 1
    instructor = box(chapter(sites[Edition.INSTRUCTOR]), "frag-disc-area")
    assert f"src/shapes/disc.c:{number}–{number + 3}" in instructor


def test_a_nested_fragment_is_a_link(sites: dict[Edition, Path]) -> None:
    page = chapter(sites[Edition.INSTRUCTOR])
    assert 'href="#frag-disc-hit-plane"' in box(page, "frag-disc-hit")
    plane = box(page, "frag-disc-hit-plane")
    assert "Used in" in plane and 'href="#frag-disc-hit"' in plane
    assert 'href="#frag-disc-hit-point"' in plane, "which only instructors see"


def test_names_link_to_their_definitions(sites: dict[Edition, Path]) -> None:
    page = chapter(sites[Edition.STUDENT])
    assert 'href="#id-DISC_PI"' in box(page, "frag-disc-area")
    assert 'id="id-DISC_PI"' in box(page, "frag-disc-types")
    assert "<code>DISC_PI</code> is used in" in box(page, "frag-disc-types")
    index = chapter(sites[Edition.STUDENT], "02-mean")
    assert 'href="01-disc.html#id-disc_area"' in index
    assert "inside_radius" not in index, "a helper of the solution"
    assert "inside_radius" in chapter(sites[Edition.INSTRUCTOR], "02-mean")


def test_a_long_list_of_users_is_folded(sites: dict[Edition, Path]) -> None:
    types = box(chapter(sites[Edition.STUDENT]), "frag-disc-types")
    words = r"<details><summary><code>DISC_PI</code> is used in (\d+) places.*?</details>"
    folded = re.search(words, types, re.DOTALL)
    assert folded and int(folded[1]) == folded[0].count("<a ") == len(USERS) + 1
    assert f'href="02-mean.html#frag-many-{USERS[-1]}"' in folded[0]
    assert "<p><code>ray</code> is used in " in types, "a short one stands open"


def test_what_has_a_colour_has_an_element() -> None:
    css = (Path(weaver.__file__).parent / "static" / "site" / "book.css").read_text()
    styled = set(re.findall(r"\.rb-code \.([a-z]+\d?)\b(?=[ ,{])", css))
    assert styled & set(STANDARD_TYPES.values()) == COLOURED


def test_students_are_told_what_is_theirs(sites: dict[Edition, Path]) -> None:
    page = chapter(sites[Edition.STUDENT])
    assert "yours to write" in page and "frag-disc-hit-point" in page
    assert "make check A=01" in re.sub("<[^>]*>", "", page)
    assert "What students find here" not in page
    assert "What students find here" in chapter(sites[Edition.INSTRUCTOR])


FAULTS = (
    (":::{fragment} disc.area\n:::", "", r"src/shapes/disc\.c:44-47: shown nowhere; ':::{fragment"),
    (":::{fragment} disc.types\n:::", ":::{fragment} disc.types\n:::\n" * 2, "shown 2 times"),
    (":::{source} src/shapes/disc.c\n:::", "", r"disc\.c:1-5.*shown nowhere; ':::{source}"),
    ("{fragment} disc.hit.point", "{fragment} disc.volume", "fragment disc.volume: no"),
    ("{source} src/shapes/disc.h", "{source} src/disc.h", "no such module"),
    ("{id}`disc_area`", "{id}`disc_volume`", "no module defines disc_volume"),
    ("{frag}`disc.hit`", "{frag}`disc.his`", "no fragment and no module disc.his"),
    (":::{exercise} disc_hit Hit a disc", ":::{note}", "exercise disc_hit is set nowhere"),
    (":::{solution}", ":::{exercise} disc_miss", "no TODO_disc_miss"),
    ("\\pi r^2", "\\pie r^2", "TeX: "),
    ("{eq}`eq-area`", "{eq}`eq-volume`", "eq-volume"),
    ("Find the place", "[Find](03-none.md) {cite}`nobody1999` the place", "03-none"),
    ("then its distance", "{numref}`fig-none` then", "fig-none"),
    ("the radius is squared", "{doc}`none`", "none"),
    ("A disc has", "{ref}`sec-none` has", "sec-none"),
)


def test_faults_are_warnings(tmp_path: Path) -> None:
    book = make_book(tmp_path)
    for old, new, _ in FAULTS:
        edit(book, "chapters/01-disc.md", old, new)
    warnings = weave(book, Edition.INSTRUCTOR).warnings
    for _, new, expected in (*FAULTS, ("", "", "nobody1999")):
        assert any(re.search(expected, line) for line in warnings), (new, warnings)


def test_made_twice_the_bytes_are_the_same(book: Path, sites: dict[Edition, Path]) -> None:
    again = weave(book, Edition.STUDENT, out="again").folder
    first = {p.relative_to(sites[Edition.STUDENT]): p.read_bytes()
             for p in sites[Edition.STUDENT].rglob("*") if p.is_file()}  # fmt: skip
    second = {p.relative_to(again): p.read_bytes() for p in again.rglob("*") if p.is_file()}
    assert first == second


def test_remote_and_dead_links_are_found(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text(
        '<p id="x"></p><a href="https://elsewhere.example/paper.pdf">a paper</a><a href="#x">x</a>'
    )
    assert link_faults(tmp_path) == []
    for markup, word in {
        '<img src="https://elsewhere.example/a.png">': "fetches",
        '<script src="//elsewhere.example/a.js"></script>': "fetches",
        '<link rel="stylesheet" href="http://elsewhere.example/a.css">': "fetches",
        '<p style="background: url(https://elsewhere.example/a.png)"></p>': "fetches",
        '<a href="b.html">b</a>': "dead link b.html",
        '<a href="#y">y</a>': "no such place",
        '<p id="x"></p><p id="x"></p>': "stands twice",
    }.items():
        (tmp_path / "b").mkdir(exist_ok=True)
        (tmp_path / "b" / "page.html").write_text(markup)
        assert any(word in fault for fault in link_faults(tmp_path)), markup
