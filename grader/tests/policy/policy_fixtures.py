"""Fixtures: a tiny course, and the grader's commands in this process.

Tests import them by name."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import pytest
import tiny_course
from tiny_course import Run

from raybook_grader.checks import artefact

Command = Callable[..., Run]


@pytest.fixture
def course(tmp_path: Path) -> Path:
    return tiny_course.tiny_course(tmp_path / "course")


@pytest.fixture
def grader(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Command:
    """Gives a command's exit code and what it said."""
    for name in ("run", "place"):
        try:
            module = import_module(f"raybook_grader.grading.{name}")
        except ModuleNotFoundError:
            continue
        if hasattr(module, "run_jobs"):
            monkeypatch.setattr(module, "run_jobs", tiny_course.here)
    monkeypatch.setattr(artefact, "decode", tiny_course.decode_here)
    return lambda *arguments: tiny_course.run(monkeypatch, capsys, *arguments)


@pytest.fixture
def grade(grader: Command, course: Path, tmp_path: Path) -> Command:
    """`grade` of the folder `class` into the folder `out`."""
    fixed = ("grade", tmp_path / "class", "--out", tmp_path / "out", "--course", course)
    return lambda *arguments: grader(*fixed, *arguments)
