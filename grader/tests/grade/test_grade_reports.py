"""The pages: everything that a submission can influence is escaped, and nothing is lost."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import closing
from html.parser import HTMLParser
from pathlib import Path

import pytest

from raybook_grader.checks.result import Status, conclude
from raybook_grader.course import Assignment, BuildCheck, ImageCheck, Limits, ProbeCheck
from raybook_grader.database import Database
from raybook_grader.grading.result import ModuleResult, from_checks, internal_error, missing
from raybook_grader.reports import write_reports
from raybook_grader.reports.names import page_name

EVIL = "<script>alert('x')</script>\"&"
BUILD = BuildCheck("compiles", 1)
PROBE = ProbeCheck("edges", 3, "probe.c", "oracle.py", "edges", 1)
IMAGE = ImageCheck("picture", 6, "a.json", (8, 8), 1, 2)


def assignment(number: str, module: str, optional: bool = False) -> Assignment:
    return Assignment(Path(), number, module, f"About {module}", 10, optional, (), (), Limits(), ())


def write(out: Path, results: Mapping[str, ModuleResult | None]) -> Database:
    """A class of one module, one result a student; None is work that is not done."""
    out.mkdir(exist_ok=True)
    database = Database(out, "A course")
    keys = {(name, "01"): f"key {name}" for name in results}
    problems = {name: EVIL if name == "unreadable" else None for name in results}
    database.plan([assignment("01", "triangle")], problems, keys)
    for name, result in results.items():
        if result is not None:
            database.store(f"key {name}", result, final=True)
    write_reports(database, out)
    return database


class Scripts(HTMLParser):
    """Collects the elements of a page."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.elements: list[str] = []
        self.text = ""
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append(tag)

    def handle_data(self, data: str) -> None:
        self.text += data


def test_all_texts_are_escaped(tmp_path: Path) -> None:
    wrong = from_checks(
        [
            conclude(BUILD, Status.PARTIAL, EVIL, words=EVIL, fingerprint=EVIL),
            conclude(PROBE, Status.FAILED, EVIL, cases=(EVIL, EVIL), fingerprint=EVIL),
        ]
    )
    results = {EVIL: wrong, "unreadable": missing(EVIL), "ours": internal_error(EVIL, EVIL)}
    with closing(write(tmp_path / "out", results)):
        pages = [tmp_path / "out" / "index.html", *(tmp_path / "out" / "students").iterdir()]
        assert len(pages) == 4
        for page in pages:
            assert "script" not in Scripts(page).elements
            assert "alert('x')" not in page.read_text() or "&lt;script&gt;" in page.read_text()
        assert EVIL in Scripts(tmp_path / "out" / "students" / page_name(EVIL)).text


def test_the_judge_s_picture_is_shown(tmp_path: Path) -> None:
    shown = conclude(IMAGE, Status.PASSED, "", picture="<figure id='viewer'></figure>")
    with closing(write(tmp_path / "out", {"s1": from_checks([shown])})):
        text = (tmp_path / "out" / "students" / "s1.html").read_text()
    assert "<figure id='viewer'></figure>" in text
    assert "<script" in text, "the viewer's own"


def test_internal_errors_come_first(tmp_path: Path) -> None:
    right = from_checks([conclude(BUILD, Status.PASSED, "")])
    results = {"a": right, "b": internal_error("", "Traceback: here"), "c": None}
    with closing(write(tmp_path / "out", results)):
        text = Scripts(tmp_path / "out" / "index.html").text
    names = text[text.index("Students and modules") :].split()
    assert [name for name in names if name in ("a", "b", "c")] == ["b", "a", "c"]
    assert text.index("The grader failed here") < text.index("Distribution")
    assert "Traceback: here" in text
    assert "not graded yet" in text


def test_failures_are_counted_by_student(tmp_path: Path) -> None:
    def wrong(words: str) -> ModuleResult:
        return from_checks([conclude(PROBE, Status.FAILED, "", fingerprint=words)])

    results = {f"s{i}": wrong("missed an edge" if i else "t out of range") for i in range(5)}
    with closing(write(tmp_path / "out", results)):
        text = Scripts(tmp_path / "out" / "index.html").text
    assert text.index("missed an edge") < text.index("t out of range")


def test_pages_of_gone_submissions_go(tmp_path: Path) -> None:
    out = tmp_path / "out"
    with closing(write(out, {"old": missing(""), "new": missing("")})) as database:
        database.plan([], {"new": None}, {})
        write_reports(database, out)
    assert [page.name for page in (out / "students").iterdir()] == ["new.html"]


@pytest.mark.parametrize(
    "name", ["s01", "Anna_B-2.c", "../../etc", "a/b", "", ".hidden", "x" * 300, "é", "a b", "CON\n"]
)
def test_page_names_are_plain(name: str) -> None:
    page = page_name(name)
    assert page == Path(page).name and page.isascii() and not page.startswith(".")
    assert len(page) < 120
    assert " " not in page and page.isprintable()


def test_page_names_differ() -> None:
    names = ["a b", "a_b", "a?b", "a", "a ", "A"]
    assert len({page_name(name) for name in names}) == len(names)
