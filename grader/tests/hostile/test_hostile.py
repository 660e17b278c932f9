"""The hostile corpus, graded as one class: a quick choice of it, or all with RAYBOOK_FULL=1."""

from __future__ import annotations

import base64
import csv
import io
import os
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from hostile_case import Case
from hostile_corpus import CASES, QUICK
from hostile_course import CANARIES
from hostile_grading import HONEST, Graded, faults, grade_corpus, verdict_of
from hostile_watching import Elements, found, snapshot

CHOSEN = CASES if "RAYBOOK_FULL" in os.environ else QUICK


@pytest.fixture(scope="module")
def graded(tmp_path_factory: pytest.TempPathFactory) -> Graded:
    # Not below pytest's own folder, which nobody else may enter: files would be copied.
    return grade_corpus(CHOSEN, tmp_path_factory.mktemp("hostile"))


def test_the_corpus_covers_every_class() -> None:
    assert len(CASES) >= 60
    groups = Counter(case.group for case in CASES)
    assert min(groups.values()) >= 10
    assert {case.group for case in QUICK} == set(groups)
    assert len({case.name for case in CASES}) == len(CASES)


@pytest.mark.parametrize("case", CHOSEN, ids=lambda case: ascii(case.name[:60]))
def test_each_gets_its_precise_verdict(graded: Graded, case: Case) -> None:
    assert faults(case, graded) == []


def test_the_class_run_goes_on_to_its_end(graded: Graded) -> None:
    assert graded.ended == 0, graded.printed
    assert len(graded.together) == len(CHOSEN) + len(HONEST)
    assert "internal-error" not in {verdict_of(s) for s in graded.together.values()}


@pytest.mark.parametrize("name", HONEST)
def test_no_other_score_moves(graded: Graded, name: str) -> None:
    assert graded.together[name] == graded.alone[name]
    assert verdict_of(graded.alone[name]) == ("pass" if name == "honest-right" else "fail")


def test_no_file_outside_of_the_results_changes(graded: Graded) -> None:
    assert graded.changed == []


def test_no_secret_shows_in_any_output(graded: Graded) -> None:
    assert found(CANARIES, graded.contents) == []


def test_pages_hold_nothing_of_theirs_but_text(graded: Graded) -> None:
    for name, content in graded.contents.items():
        if not name.endswith(".html"):
            continue
        page = Elements(content.decode("utf-8"))
        assert "raybook-evil" not in page.names and not page.handlers, name
        assert "raybookEvil" not in page.scripts, name


def test_no_output_holds_control_characters(graded: Graded) -> None:
    """Terminal codes, and marks that hide or reorder text."""
    kinds = (".html", ".json", ".csv", "printed")
    readable = {n: c for n, c in graded.contents.items() if n.endswith(kinds)}
    assert {Path(name).suffix for name in readable} == {".html", ".json", ".csv", ""}
    for name, content in readable.items():
        text = content.decode("utf-8").replace("\r\n", "\n")
        bad = {c for c in text if not (c.isprintable() or c in "\n\t\u00a0")}
        assert bad == set(), name


def test_no_table_holds_a_formula(graded: Graded) -> None:
    tables = {n: c.decode("utf-8") for n, c in graded.contents.items() if n.endswith(".csv")}
    assert tables
    for name, text in tables.items():
        for row in csv.reader(io.StringIO(text)):
            assert [c for c in row if c.startswith(("=", "+", "@", "\t", "\r"))] == [], name
            assert len(row) > 1, name


def test_canaries_would_be_found(tmp_path: Path) -> None:
    secret = {"it": "raybook-canary-it-1234"}
    plain = secret["it"].encode()
    forms: list[Any] = [
        plain,
        b"x" + plain[::-1],
        plain.hex().encode(),
        plain.hex().upper().encode(),
    ]
    forms += [base64.b64encode(b"x" * n + plain) for n in range(5)]
    assert len(found(secret, {str(n): form for n, form in enumerate(forms)})) == len(forms)
    assert found(secret, {"other": base64.b64encode(b"raybook-canary-its-1234")}) == []


def test_changes_would_be_seen(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("a")
    before = snapshot([tmp_path])
    (tmp_path / "a").write_text("b")
    changed = snapshot([tmp_path])
    (tmp_path / "a").chmod(0o600)
    assert len({str(before), str(changed), str(snapshot([tmp_path]))}) == 3
