"""The class of record: every way to be right, wrong, late or broken gets its verdict."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from make_class import make_class
from small_course import checks, grades, run


@pytest.fixture(scope="module")
def expected(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, str]]:
    folder = tmp_path_factory.mktemp("class") / "class"
    return folder, make_class(folder)


@pytest.fixture(scope="module")
def graded(
    expected: tuple[Path, dict[str, str]], tmp_path_factory: pytest.TempPathFactory
) -> tuple[Path, dict[str, Any]]:
    out = tmp_path_factory.mktemp("graded") / "out"
    ended = run("grade", expected[0], "--out", out, "--assignment", "01")
    assert ended.returncode == 0, ended.stdout + ended.stderr
    return out, grades(out)


def test_the_class_holds_each_kind(expected: tuple[Path, dict[str, str]]) -> None:
    _, verdicts = expected
    assert len(verdicts) >= 10
    assert set(verdicts.values()) == {"pass", "fail", "missing", "build-error", "crash", "timeout"}


def test_each_verdict_is_right(
    expected: tuple[Path, dict[str, str]], graded: tuple[Path, dict[str, Any]]
) -> None:
    _, submissions = graded
    found = {name: s["modules"][0]["verdict"] for name, s in submissions.items()}
    assert found == expected[1]


def test_points_follow_the_verdicts(graded: tuple[Path, dict[str, Any]]) -> None:
    for name, submission in graded[1].items():
        (module,) = submission["modules"]
        assert module["score"] == submission["score"]
        assert module["max_score"] == submission["max_score"] == 10
        assert module["score"] == round(sum(check["score"] for check in module["checks"]), 2)
        assert (module["score"] == 10) == (module["verdict"] == "pass"), name


def test_a_mistake_is_told_in_words(graded: tuple[Path, dict[str, Any]]) -> None:
    for name, submission in graded[1].items():
        if submission["modules"][0]["verdict"] == "fail":
            failed = [c for c in checks(submission) if c["status"] == "failed"]
            judged = [c for c in failed if c["kind"] in ("probe", "robust")]
            assert judged, f"{name}: nothing hidden sees it"
            for check in judged:
                word = "expected" if check["kind"] == "probe" else ", line "
                assert word in check["message"]


def test_the_compiler_is_quoted(graded: tuple[Path, dict[str, Any]]) -> None:
    out, _ = graded
    page = (out / "students/does-not-compile/01-triangle.html").read_text(encoding="utf-8")
    assert "src/shapes/triangle.c:" in page
    assert "error: expected expression" in page


def test_a_program_that_never_ends_costs_bounded_time(graded: tuple[Path, dict[str, Any]]) -> None:
    statuses = [check["status"] for check in checks(graded[1]["never-ends"])]
    assert statuses.count("timeout") == 2
    assert set(statuses[statuses.index("timeout") :]) == {"timeout", "not run"}


def test_pages_need_nothing_else(graded: tuple[Path, dict[str, Any]]) -> None:
    out, submissions = graded
    pages = list(out.rglob("*.html"))
    assert len(pages) == 1 + 2 * len(submissions), "each has its own page and one of its module"
    for page in pages:
        text = page.read_text(encoding="utf-8")
        for outside in ("http://", "https://", "<link", 'src="//', "@import"):
            if outside in text:
                allowed = text.replace("http://www.w3.org/", "")
                assert outside not in allowed, f"{page.name} asks for {outside}"
