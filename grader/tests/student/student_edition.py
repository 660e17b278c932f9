"""Shared by the tests of the student edition: makes it, and runs make in it as a student would."""

from __future__ import annotations

import functools
import os
import subprocess
import tempfile
from pathlib import Path

from raybook_grader.checks.stub import stub_text
from raybook_grader.expected.ship import expected_files
from raybook_grader.literate.handout import write_handout

ROOT = Path(__file__).resolve().parents[3]
TRIANGLE = "src/shapes/triangle.c"
RIGHT = ROOT / "assignments/01-triangle/alternatives/plane-and-edges.c"


_FOLDER = tempfile.TemporaryDirectory(prefix="raybook-student-")


@functools.cache
def student_edition() -> Path:
    """One edition of this checkout for all tests of a run; what is built in it stays."""
    out = Path(_FOLDER.name, "edition")
    return write_handout(ROOT, out, make_more=lambda s: expected_files(ROOT, s)).out


def run_make(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """`make` in a folder, with nothing in the environment but what a machine has anyway; the
    packages that it would download are lent."""
    environment = {
        "PATH": os.environ["PATH"],
        "HOME": str(folder),
        "LANG": "C.UTF-8",
        "UNITY_ROOT": os.environ.get("UNITY_ROOT") or str(ROOT / "build/unity"),
        "RAYBOOK_VENV": str(ROOT / "build/venv"),
    }
    command = ["make", "-C", str(folder), "--no-print-directory", *words]
    return subprocess.run(command, env=environment, capture_output=True, text=True)


def write_module(folder: Path, text: str, path: str = TRIANGLE) -> None:
    """Write an owned file as a student would."""
    (folder / path).write_text(text, encoding="utf-8")


def stub(path: str = TRIANGLE) -> str:
    """What was handed out."""
    return stub_text(ROOT, path)
