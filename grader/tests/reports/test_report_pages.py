"""The pages' text: everything that a submission can influence is escaped, and nothing is lost."""

from __future__ import annotations

import base64
import hashlib
import re
import unicodedata
from collections.abc import Mapping
from contextlib import closing
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from zoneinfo import ZoneInfo

import pytest
from report_class import viewer

from raybook_grader.checks.result import Status, conclude
from raybook_grader.course import Assignment, BuildCheck, ImageCheck, Limits, ProbeCheck
from raybook_grader.database import Database, Module, Student
from raybook_grader.diagnosis import Diagnosis
from raybook_grader.grading.result import ModuleResult, from_checks, internal_error, missing
from raybook_grader.page import shortened, visible
from raybook_grader.policy import Override, Settled
from raybook_grader.reports import Notice, write_reports
from raybook_grader.reports.names import module_page, page_name
from raybook_grader.reports.pages import class_page, student_pages
from raybook_grader.reports.student_view import student_view
from raybook_grader.reports.words import parts_of

EVIL = "<script>alert('x')</script>\"&"
BUILD = BuildCheck("compiles", 1)
PROBE = ProbeCheck("edges", 3, "probe.c", "oracle.py", "edges", 1)
IMAGE = ImageCheck("picture", 6, "a.json", (8, 8), 1, 2)


def assignment(number: str, module: str, optional: bool = False) -> Assignment:
    return Assignment(Path(), number, module, f"About {module}", 10, optional, (), (), Limits(), ())


def write(
    out: Path, results: Mapping[str, ModuleResult | None], notices: tuple[Notice, ...] = ()
) -> Database:
    """A class of one module, one result a student; None is work that is not done."""
    out.mkdir(exist_ok=True)
    database = Database(out, "A course")
    keys = {(name, "01"): f"key {name}" for name in results}
    problems = {name: EVIL if name == "unreadable" else None for name in results}
    database.plan([assignment("01", "triangle")], problems, keys)
    for name, result in results.items():
        if result is not None:
            database.store(f"key {name}", result, final=True)
    write_reports(database, out, notices)
    return database


def page_of(out: Path, name: str, module: bool = True) -> Path:
    """A student's page, of the one module or of all."""
    one = Module("01", "triangle", "", 10, False)
    return out / "students" / (module_page(name, one) if module else page_name(name))


class Elements(HTMLParser):
    """Collects the elements, their attributes and the text of a page."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.elements: list[str] = []
        self.attributes: list[dict[str, str]] = []
        self.text = ""
        self.inline: dict[str, str] = {}
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append(tag)
        self.attributes.append({name: value or "" for name, value in attrs})

    def handle_data(self, data: str) -> None:
        self.text += data
        if self.elements and self.elements[-1] in ("style", "script"):
            self.inline.setdefault(self.elements[-1], data)


def pages(out: Path) -> list[Path]:
    return sorted(out.rglob("*.html"))


def test_all_texts_are_escaped(tmp_path: Path) -> None:
    looks = (Diagnosis("off-by-one", 0.9, EVIL, EVIL),)
    wrong = from_checks(
        [
            conclude(BUILD, Status.PARTIAL, EVIL, words=EVIL, fingerprint=EVIL),
            conclude(PROBE, Status.FAILED, EVIL, cases=(EVIL, EVIL), fingerprint=EVIL),
        ]
    )
    wrong = ModuleResult(wrong.verdict, wrong.score, EVIL, wrong.checks, "", looks)
    results = {EVIL: wrong, "unreadable": missing(EVIL), "ours": internal_error(EVIL, EVIL)}
    out = tmp_path / "out"
    with closing(write(out, results, (Notice(EVIL, EVIL),))):
        assert len(pages(out)) == 1 + 2 * len(results)
        for page in pages(out):
            found = Elements(page)
            assert found.elements.count("script") == 1, "our own"
            assert not any(name.startswith("on") for a in found.attributes for name in a)
            assert EVIL in found.text
            assert EVIL not in page.read_text(encoding="utf-8")
        assert EVIL in Elements(page_of(out, EVIL)).text


def test_every_page_allows_its_own_parts_only(tmp_path: Path) -> None:
    shown = from_checks([conclude(IMAGE, Status.PASSED, "", picture=viewer())])
    out = tmp_path / "out"
    with closing(write(out, {"s1": shown, "s2": missing("")})):
        for page in pages(out):
            found = Elements(page)
            policy = next(a["content"] for a in found.attributes if "http-equiv" in a)
            assert policy.startswith("default-src 'none';") and "unsafe" not in policy
            for tag, text in found.inline.items():
                digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
                assert f"{tag}-src 'sha256-{digest}'" in policy
            assert not any("style" in a for a in found.attributes), "the policy forbids these"
            sources = [a["src"] for a in found.attributes if "src" in a]
            assert all(source.startswith("data:image/png;base64,") for source in sources)
            assert not {"link", "iframe", "object", "base"} & set(found.elements)


def test_links_lead_somewhere(tmp_path: Path) -> None:
    right = from_checks([conclude(BUILD, Status.PASSED, "")])
    out = tmp_path / "out"
    with closing(write(out, {"s1": right, "a b/c": right, "later": None})):
        for page in pages(out):
            for attributes in Elements(page).attributes:
                target, _, _ = attributes.get("href", "").partition("#")
                assert not target or (page.parent / target).is_file(), f"{page}: {target}"


def test_the_judge_s_picture_is_shown(tmp_path: Path) -> None:
    shown = conclude(IMAGE, Status.PASSED, "", picture="<figure id='viewer'></figure>")
    out = tmp_path / "out"
    with closing(write(out, {"s1": from_checks([shown])})):
        text = page_of(out, "s1").read_text()
    assert "<figure id='viewer'></figure>" in text
    assert "DecompressionStream" in text, "the viewer's script"
    assert "DecompressionStream" not in page_of(out, "s1", module=False).read_text()


def test_internal_errors_come_first(tmp_path: Path) -> None:
    right = from_checks([conclude(BUILD, Status.PASSED, "")])
    results = {"ann": right, "bob": internal_error("", "Traceback: here"), "cy": None}
    out = tmp_path / "out"
    with closing(write(out, results)):
        text = Elements(out / "index.html").text
    names = text[text.index("Students and modules") :].split()
    assert [name for name in names if name in results][:3] == ["bob", "ann", "cy"]
    assert text.index("The grader failed here") < text.index("Distribution")
    assert "Traceback: here" in text
    assert "not graded yet" in text
    for page in (out / "students").rglob("*.html"):
        assert "Traceback" not in page.read_text(), "for the instructor only"


def test_failures_are_counted_by_student(tmp_path: Path) -> None:
    def wrong(words: str) -> ModuleResult:
        return from_checks([conclude(PROBE, Status.FAILED, "", fingerprint=words)])

    results = {f"s{i}": wrong("missed an edge" if i else "t out of range") for i in range(5)}
    with closing(write(tmp_path / "out", results)):
        text = Elements(tmp_path / "out" / "index.html").text
    text = text[text.index("The commonest failures") :]
    assert text.index("missed an edge") < text.index("t out of range")
    assert re.search(r"missed an edge.*?\b4\b", text, re.DOTALL)


def test_mistakes_and_the_stuck_are_named(tmp_path: Path) -> None:
    def wrong(slug: str, score: float) -> ModuleResult:
        found = (Diagnosis(slug, 0.9, f"think of {slug}", "it fails the same"),)
        checks = from_checks([conclude(PROBE, Status.FAILED, "", share=score)])
        return ModuleResult(checks.verdict, 10 * score, "", checks.checks, "", found)

    results = {f"s{i}": wrong("far-child" if i else "leaf", 0.6 if i else 0.2) for i in range(4)}
    with closing(write(tmp_path / "out", results | {"idle": missing("the stub")})):
        text = Elements(tmp_path / "out" / "index.html").text
    mistakes = text[text.index("The commonest mistakes") :]
    assert mistakes.index("far child") < mistakes.index("leaf")
    stuck = text[text.index("Who is stuck") : text.index("The commonest mistakes")]
    assert "s0" in stuck and "looks like leaf" in stuck
    assert "s1" not in stuck, "more than half of the points"
    assert "1 with nothing to grade yet" in stuck and "idle" in stuck


def test_notices_stand_on_every_page(tmp_path: Path) -> None:
    right = from_checks([conclude(BUILD, Status.PASSED, "")])
    out = tmp_path / "out"
    with closing(write(out, {"s1": right}, (Notice("Without a sandbox.", "As asked for."),))):
        for page in pages(out):
            text = Elements(page).text
            assert "Without a sandbox." in text and "As asked for." in text


def test_a_grade_s_history_is_told() -> None:
    right = from_checks([conclude(BUILD, Status.PASSED, "")])
    one = Module("01", "triangle", "", 10, False)
    by_hand = Settled(
        0, None, 4.0, 7.5, override=Override(7.5, "<b>agreed</b>", "A. Meier", "2026-10-01")
    )
    student = Student("s1", None, {"01": right}, {"01": by_hand})
    view = student_view("A course", student, [one], ZoneInfo("UTC"))
    for _, page in student_pages(view):
        assert "Set to 7.5 points by A. Meier" in page and "&lt;b&gt;agreed" in page
    assert "set by hand" in class_page("A course", [one], [student])


def test_results_without_a_sandbox_are_marked(tmp_path: Path) -> None:
    right = from_checks([conclude(BUILD, Status.PASSED, "")])
    out = tmp_path / "out"
    with closing(write(out, {"s1": right, "s2": replace(right, unsafe=True)})):
        marked = {p.relative_to(out).as_posix() for p in pages(out) if "Unsafe" in p.read_text()}
    assert marked == {"index.html", "students/s2.html", "students/s2/01-triangle.html"}


def test_pages_of_gone_submissions_go(tmp_path: Path) -> None:
    out = tmp_path / "out"
    with closing(write(out, {"old": missing(""), "new": missing("")})) as database:
        database.plan([], {"new": None}, {})
        write_reports(database, out)
    names = {path.relative_to(out / "students").as_posix() for path in out.rglob("students/**/*")}
    assert names == {"new.html", "new", "new/01-triangle.html"}


def test_a_failing_case_is_told_apart() -> None:
    told = parts_of("ray 3: hit, then: expected t = 2, got no hit, got lost")
    assert told == {"case": "ray 3: hit, then", "expected": "t = 2", "got": "no hit, got lost"}
    assert parts_of("the image is 3 % too bright") == {}


@pytest.mark.parametrize(
    "name",
    [
        "s01",
        "Anna_B-2.c",
        "../../etc",
        "a/b",
        "",
        ".hidden",
        "x" * 300,
        "é",
        "a b",
        "CON\n",
        "--rf",
    ],
)
def test_page_names_are_plain(name: str) -> None:
    page = page_name(name)
    assert page == Path(page).name and page.isascii() and page[0] not in ".-"
    assert len(page) < 120
    assert " " not in page and page.isprintable()


def test_page_names_differ() -> None:
    names = ["a b", "a_b", "a?b", "a", "a ", "A"]
    assert len({page_name(name) for name in names}) == len(names)


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("plain\n\tcode", "plain\n\tcode"),
        ("user\u202egpj.exe", "user[U+202E]gpj.exe"),
        ("\x1b[31mred\x07", "[U+001B][31mred[U+0007]"),
        ("zero\u200bwidth\ufeff\u2066", "zero[U+200B]width[U+FEFF][U+2066]"),
        ("bad \udcff byte", "bad [U+DCFF] byte"),
        ("\u00e9t\u00e9 \u6f22 \u05d0", "\u00e9t\u00e9 \u6f22 \u05d0"),
        ("Z" + 5 * "\u0335", "Z" + 3 * "\u0335" + 2 * "[U+0335]"),
        ("\U000e0041", "[U+E0041]"),
    ],
)
def test_what_hides_is_seen(text: str, shown: str) -> None:
    assert visible(text) == shown


def test_nothing_hidden_is_left_of_any_character() -> None:
    everything = "".join(
        map(chr, [*range(0x3000), *range(0xD700, 0x10000), *range(0xE0000, 0xE0200)])
    )
    for start in range(0, len(everything), 4096):
        for character in visible(everything[start : start + 4096]):
            hidden = unicodedata.category(character)[0] in "C" or character in "\u2028\u2029"
            assert not hidden or character in "\t\n", hex(ord(character))


def test_long_texts_are_cut_and_say_so() -> None:
    assert shortened("abc", 3) == "abc"
    assert shortened("abcd", 3) == "abc ... and 1 more characters"
    assert len(visible("x" * 10_000_000)) < 40_000
    assert len(visible("\u202e" * 10_000_000)) < 40_000
