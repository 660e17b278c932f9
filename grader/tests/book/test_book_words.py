"""Formulas and their punctuation; how the bibliography names a work."""

from __future__ import annotations

from pathlib import Path

from pybtex.database import parse_string
from small_book import make_book, weave

from raybook_grader.book.bibliography import AuthorYearStyle, register
from raybook_grader.book.editions import Edition

JOINED = "</span>\u2060"


def test_punctuation_stays_with_its_formula(tmp_path: Path) -> None:
    root = make_book(tmp_path)
    text = "# Words\n\nTake $x$, *or* $y$. Not $z$ *there*, and ($w$) here.\n"
    (root / "docs" / "chapters" / "03-words.md").write_text(text)
    page = (weave(root, Edition.STUDENT).folder / "chapters" / "03-words.html").read_text()
    assert page.count("\u2060") == 3
    for words in (", <em>or</em>", ". Not", ") here"):
        assert JOINED + words in page


def test_works_are_sorted_and_named_as_they_are_cited() -> None:
    people = ("Zed, Ann", 'de Low, Bo and M{\\"o}ller, Cy', "Ash, D. and Fir, E. and Oak, F.")
    entries = "".join(
        f"@misc{{k{n}, author = {{{one}}}, title = {{T}}, year = {{200{n}}}}}\n"
        for n, one in enumerate(people)
    )
    register()
    works = parse_string(entries, "bibtex")
    found = [work.label for work in AuthorYearStyle().format_bibliography(works)]
    assert found == ["Ash et al., 2002", "de Low and Möller, 2001", "Zed, 2000"]
