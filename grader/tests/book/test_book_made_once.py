"""`make book` on a make-believe Sphinx: what is made and checked again, and what is not."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

import pytest
from small_book import make_book

from raybook_grader.book import build, checked
from raybook_grader.book.editions import Edition, Reader
from raybook_grader.book.kept import Kept, sources_key
from raybook_grader.book.sphinx_run import Outcome, Settings

NUMBERS = {"print-1": "3"}


class Workshop:
    """Stands in for Sphinx, Chromium and the compiler, and counts what is asked of them."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.sphinx: list[str] = []
        self.prints: list[dict[str, str] | None] = []
        self.programs = self.sources = 0
        self.text, self.ink = "text", b"paper"
        for name in ("run_sphinx", "print_pdf", "render_faults", "source_faults"):
            monkeypatch.setattr(checked, name, getattr(self, name))
        monkeypatch.setattr(checked, "text_faults", lambda pages, reader: [])

    def run_sphinx(
        self, settings: Settings, edition: Edition, builder: str, out: Path, *,
        doctrees: Path | None = None, pages: Sequence[Path] = (),
    ) -> Outcome:  # fmt: skip
        self.sphinx.append(builder)
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir(parents=True)
        (out / "index.html").write_text(f"<p>{self.text}</p>")
        if self.text == "restless":
            (out / "count.txt").write_text(str(len(self.sphinx)))
        warnings = ("a fault",) if self.text == "wrong" else ()
        return Outcome(out, out.with_name("read"), warnings, False)

    def print_pdf(
        self, page: Path, out: Path, numbers: dict[str, str] | None = None
    ) -> dict[str, str]:
        self.prints.append(numbers)
        ink = self.ink + str(len(self.prints)).encode() if self.ink == b"restless" else self.ink
        out.write_bytes(ink + page.read_bytes())
        return NUMBERS

    def render_faults(self, root: Path, site: Path, reader: Reader) -> list[str]:
        self.programs += 1
        return []

    def source_faults(self, root: Path, tree: object) -> list[str]:
        self.sources += 1
        return []


@pytest.fixture
def shop(monkeypatch: pytest.MonkeyPatch) -> Workshop:
    return Workshop(monkeypatch)


@pytest.fixture
def root(tmp_path: Path) -> Path:
    return make_book(tmp_path)


def make(root: Path, edition: Edition = Edition.INSTRUCTOR, fresh: bool = False) -> int:
    return build.build_book(Settings(root), [edition], fresh)


def test_what_has_not_changed_is_not_made_again(root: Path, shop: Workshop) -> None:
    assert make(root) == 0
    assert shop.sphinx == ["html", "singlehtml"] * 2, "each page made twice"
    assert shop.prints == [None, NUMBERS] and shop.programs == 1
    assert make(root) == 0
    assert len(shop.sphinx) == 4 and len(shop.prints) == 2 and shop.programs == 1
    assert make(root, fresh=True) == 0
    assert len(shop.sphinx) == 8 and len(shop.prints) == 4 and shop.programs == 2


def test_each_verdict_rests_on_its_own_content(root: Path, shop: Workshop) -> None:
    assert make(root) == 0
    chapter = root / "docs" / "index.md"
    chapter.write_text(chapter.read_text() + "\nMore of it.\n")
    assert make(root) == 0
    assert len(shop.sphinx) == 8, "words make every page anew"
    assert len(shop.prints) == 2, "but this page is the same, so its paper is"
    assert shop.programs == 1
    shop.text = "other words"
    chapter.write_text(chapter.read_text() + "\nStill more.\n")
    assert make(root) == 0
    assert shop.prints[2:] == [NUMBERS, NUMBERS], "with the numbers that are remembered"
    source = root / "src" / "shapes" / "mean.c"
    source.write_text(source.read_text().replace("0.5f", "0.50f"))
    assert make(root) == 0
    assert shop.programs == 2 and len(shop.prints) == 4


def test_a_page_that_was_touched_is_made_again(root: Path, shop: Workshop) -> None:
    assert make(root) == 0
    pages = Settings(root).pages(Edition.INSTRUCTOR)
    for touch in (lambda: (pages / "index.html").write_text("scribble"),
                  Settings(root).pdf(Edition.INSTRUCTOR).unlink):  # fmt: skip
        count = len(shop.sphinx)
        touch()
        assert make(root) == 0 and len(shop.sphinx) == count + 4
        assert (pages / "index.html").read_text() == "<p>text</p>"
    Settings(root).aside("instructor.pdf").write_bytes(b"scribble")
    (pages / "index.html").unlink()
    assert make(root) == 0 and shop.prints[2:] == [NUMBERS, NUMBERS]
    assert Settings(root).pdf(Edition.INSTRUCTOR).read_bytes().startswith(b"paper")


def test_what_is_wrong_is_told_each_time(
    root: Path, shop: Workshop, capsys: pytest.CaptureFixture[str]
) -> None:
    shop.text = "wrong"
    for _ in range(2):
        assert make(root) == 1
        assert "instructor: a fault" in capsys.readouterr().err


@pytest.mark.parametrize("what", ["pages", "paper"])
def test_made_twice_it_must_be_the_same(
    root: Path, shop: Workshop, capsys: pytest.CaptureFixture[str], what: str
) -> None:
    if what == "pages":
        shop.text = "restless"
    else:
        shop.ink = b"restless"
    name = "count.txt" if what == "pages" else "raybook-instructor.pdf"
    for _ in range(2):
        assert make(root) == 1
        assert f"instructor: {name}: made twice, it is not the same" in capsys.readouterr().err


def test_a_leak_stops_the_students_book(
    root: Path, shop: Workshop, capsys: pytest.CaptureFixture[str]
) -> None:
    assert make(root, Edition.STUDENT) == 0 and shop.sources == 1
    shop.text = "return a + 0.5f * (b - a);"
    (root / "docs" / "index.md").write_text("# Changed\n")
    assert make(root, Edition.STUDENT) == 1
    assert "LEAK src/shapes/mean.c" in capsys.readouterr().err


def test_a_verdict_rests_on_files_and_tools(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = sources_key(root)
    assert sources_key(root) == first
    note = root / "docs" / "chapters" / "new.md"
    note.write_text("New\n")
    assert sources_key(root) != first
    note.unlink()
    assert sources_key(root) == first
    monkeypatch.setattr("raybook_grader.book.kept.tools_key", lambda: "another chromium")
    assert sources_key(root) != first


def test_of_a_name_the_last_verdict_is_kept(tmp_path: Path) -> None:
    kept = Kept(tmp_path / "sound")
    assert not kept.has("a", "1")
    kept.keep("a", "1")
    assert kept.has("a", "1") and not kept.has("a", "2") and not kept.has("b", "1")
    kept.keep("a", "2")
    assert not kept.has("a", "1")
