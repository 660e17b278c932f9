"""Figures: what makes one anew, how one is told to have changed, and how it stands on a page."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from PIL import Image
from small_book import make_book, weave

from raybook_grader.book import rendering
from raybook_grader.book.editions import Edition
from raybook_grader.book.figure_spec import BOOK_MISTAKES, FigureSpec, Picture, picture_key
from raybook_grader.book.manifest import Entry, differences, read_manifest, write_manifest
from raybook_grader.errors import BadInput

ROOT = Path(__file__).resolve().parents[3]
SPEC = FigureSpec("disc", "scenes/demo.json", "--spp 4")
PLAIN = Picture("solution")


def key(root: Path, spec: FigureSpec = SPEC, picture: Picture = PLAIN) -> str:
    return picture_key(root, spec, picture)


def test_code_scene_and_options_make_a_picture_anew(tmp_path: Path) -> None:
    root = make_book(tmp_path)
    first = key(root)
    assert key(root) == first
    source = root / "src" / "shapes" / "disc.c"
    text = source.read_text()
    source.write_text(f'//> all: All of it\n{text}/* "why" it is so */ // and how\n//< all\n')
    assert key(root) == first, "comments and markers draw nothing"
    source.write_text(text.replace("radius * radius", "radius"))
    assert key(root) != first
    source.write_text(text)
    assert key(root) == first
    assert key(root, FigureSpec("disc", "scenes/demo.json", "--spp 8")) != first
    assert key(root, SPEC, Picture("stub", stubs=frozenset({"disc_hit"}))) != first
    assert key(root, SPEC, Picture("mistake", mistake="01-disc/no-square.patch")) != first
    (root / "scenes" / "demo.json").write_text('{"shapes": [1]}')
    assert key(root) != first
    with pytest.raises(BadInput, match=r"scenes/none\.json"):
        key(root, FigureSpec("disc", "scenes/none.json", ""))
    with pytest.raises(BadInput, match="01-disc/none"):
        key(root, SPEC, Picture("mistake", mistake="01-disc/none.patch"))


def test_the_books_own_mistakes_fit_the_source_and_are_shown() -> None:
    chapters = "\n".join(file.read_text() for file in (ROOT / "docs" / "chapters").glob("*.md"))
    patches = sorted((ROOT / BOOK_MISTAKES).iterdir())
    assert patches
    for patch in patches:
        (name, text), *others = rendering.mistaken_files(ROOT, patch.name).items()
        assert not others and text != (ROOT / name).read_bytes()
        assert f":mistake: {patch.name}\n" in chapters
    with pytest.raises(BadInput, match=r"slug\.patch, one of docs/figures/mistakes/"):
        rendering.mistaken_files(ROOT, "none.patch")


def test_a_change_that_can_be_seen_is_told(tmp_path: Path) -> None:
    known = {"a/solution": Entry("11", "80" * 144), "b/solution": Entry("22", "80" * 144)}
    file = tmp_path / "manifest.json"
    write_manifest(file, known)
    assert read_manifest(file) == known and read_manifest(tmp_path / "none.json") == {}
    assert differences(known, dict(known), whole=True) == []
    rounded = known | {"a/solution": Entry("33", "81" * 144)}
    assert differences(known, rounded, whole=True) == [], "another machine's rounding"
    changed = known | {"a/solution": Entry("33", "80" * 143 + "90")}
    assert differences(known, changed, whole=True) == ["figure a/solution has changed"]
    fewer = {"a/solution": known["a/solution"]}
    assert differences(known, fewer, whole=False) == []
    assert differences(known, fewer, whole=True) == ["figure b/solution is no longer in the book"]
    assert differences(fewer, known, whole=True) == ["figure b/solution is new"]


FIGURE = """\
# Discs

See {numref}`fig-try`.

:::{render} try
:scene: scenes/demo.json
:args: --spp 4
:stub: disc_hit
:alt: A disc

The *disc*.

More of it.
:::

:::{chart} speed
:alt: Speed
How fast.
:::
"""


def test_a_figure_on_its_page(tmp_path: Path) -> None:
    root = make_book(tmp_path)
    chapters = root / "docs" / "chapters"
    (chapters / "03-figure.md").write_text(FIGURE)
    cache = root / "build" / "book" / "figures"
    spec = FigureSpec("try", "scenes/demo.json", "--spp 4", frozenset({"disc_hit"}))
    for picture in spec.pictures():  # as if they had been drawn
        rendering.keep(cache, root, spec, picture, Image.new("RGB", (32, 24), "#876"))
    first = weave(root, Edition.INSTRUCTOR)
    new = [line for line in first.warnings if "figure try/" in line]
    assert len(new) == 2 and all("is new" in line and "ACCEPT=1" in line for line in new)
    page = (first.folder / "chapters" / "03-figure.html").read_text()
    figure = re.search(r"<figure[^>]*rb-figure.*?</figure>", page, re.DOTALL)
    assert figure
    assert 'id="fig-try"' in figure[0] and 'data-scene="scenes/demo.json"' in figure[0]
    assert 'data-args="--spp 4"' in figure[0] and figure[0].count("<img") == 2
    assert "your renderer before" in figure[0] and 'alt="A disc (and after)"' in figure[0]
    words = re.sub("<[^>]*>", "", figure[0])
    assert 'make render SCENE=scenes/demo.json ARGS="--spp 4"' in words.replace("&quot;", '"')
    assert "The disc." in words and "More of it." in words and "Fig. 3.1" in words
    assert "run" in page and "make bench" in re.sub("<[^>]*>", "", page)
    bench = root / "build" / "bench"
    bench.mkdir()
    (bench / "bench.json").write_text("{}")
    (bench / "speed.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"/>')
    second = weave(root, Edition.INSTRUCTOR, accept=True)
    (chart,) = cache.glob("*/chart-speed.svg")
    written = chart.stat().st_mtime_ns
    assert not second.warnings
    assert "chart-speed.svg" in (second.folder / "chapters" / "03-figure.html").read_text()
    assert not weave(root, Edition.STUDENT).warnings
    assert chart.stat().st_mtime_ns == written, "or the first edition's page counts as changed"


def test_what_a_figure_must_say(tmp_path: Path) -> None:
    root = make_book(tmp_path)
    (root / "docs" / "chapters" / "03-figure.md").write_text(
        "# Figures\n\n:::{render} a\n:scene: scenes/demo.json\nCaption.\n:::\n\n"
        ":::{render} b\n:scene: scenes/demo.json\n:alt: B\n:::\n\n"
        ":::{render} c\n:scene: scenes/none.json\n:alt: C\nCaption.\n:::\n"
    )
    warnings = "\n".join(weave(root, Edition.INSTRUCTOR).warnings)
    for words in ("figure a: no :alt:", "figure b: no caption", "figure c: scene scenes/none.json"):
        assert words in warnings
