"""A browser and a made-up class; the tests name this module as a plugin."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from looking import chromium
from playwright.sync_api import Browser
from report_class import assignments, made_up_class, passed, viewer, write_class

from raybook_grader.grading.result import from_checks, internal_error, missing

STUDENTS = 24


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """One a module of tests: while one runs, no other test of the session can start its own."""
    with chromium() as started:
        yield started


@pytest.fixture(scope="session")
def class_page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A made-up class; "all-right" has right modules only, with pictures."""
    results = dict(made_up_class(STUDENTS, 3))
    right = {a.number: from_checks([passed(c, viewer()) for c in a.checks]) for a in assignments()}
    broken = right | {"01": internal_error("", "OSError: disk full"), "02": missing("the stub")}
    return write_class(
        tmp_path_factory.mktemp("class"), results | {"all-right": right, "broken": broken}
    )
