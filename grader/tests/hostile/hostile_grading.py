"""Grading the corpus as one class with two honest students, and what came of it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hostile_case import CHECKOUT, KINDS, OWNED, RIGHT, STATUSES, Case
from hostile_course import CANARIES, hostile_course
from hostile_watching import marks_left, outputs, snapshot

_CHECKOUT = (
    "assignments",
    "build/kit",
    "build/meshes",
    "build/sandbox",
    "build/unity",
    "grader/raybook_grader",
    "scenes",
    "src",
)
EXPORTS = "csv,canvas,gradescope,json"
HONEST = ("honest-right", "honest-wrong")


@dataclass(frozen=True)
class Graded:
    """``alone`` and ``together`` are the submissions of `grades.json` by id."""

    ended: int
    printed: str
    out: Path
    alone: Mapping[str, Any]
    together: Mapping[str, Any]
    changed: Sequence[str]
    """Files outside of the output folder that are not as they were."""
    contents: Mapping[str, bytes]


def identity(name: str) -> str:
    """A folder's name as the grader tells it."""
    return os.fsencode(name).decode("utf-8", "backslashreplace")


def grade_corpus(cases: Sequence[Case], top: Path) -> Graded:
    """Everything is written below ``top``, which must be empty or absent."""
    root = hostile_course(top / "course")
    home = top / "home"
    home.mkdir()
    (home / ".secret").write_text(CANARIES["home"])
    temporary = top / "tmp"
    temporary.mkdir(mode=0o1777)
    temporary.chmod(0o1777)
    top.chmod(0o755)
    environment = {**os.environ, "HOME": str(home), "TMPDIR": str(temporary),
                   "RAYBOOK_SECRET": CANARIES["environment"]}  # fmt: skip

    def grade(submissions: Path, out: Path) -> subprocess.CompletedProcess[str]:
        paths = [str(submissions), "--out", str(out), "--course", str(root)]
        command = [sys.executable, "-m", "raybook_grader", "grade", *paths, "--export", EXPORTS]
        return subprocess.run(
            command, capture_output=True, text=True, errors="replace", check=False, env=environment
        )

    first = grade(_honest(top / "honest"), top / "out-alone")
    assert first.returncode == 0, first.stdout + first.stderr
    folder = _honest(top / "class")
    for case in cases:
        case.write(folder, case.name)
    watched = [root, folder, home, temporary, *(CHECKOUT / place for place in _CHECKOUT)]
    before = snapshot(watched)
    ended = grade(folder, top / "out")
    after = snapshot(watched)
    changed = sorted(name for name, _ in before.items() ^ after.items())
    printed = ended.stdout + ended.stderr
    return Graded(
        ended=ended.returncode,
        printed=printed,
        out=top / "out",
        alone=_grades(top / "out-alone"),
        together=_grades(top / "out"),
        changed=[*dict.fromkeys(changed), *marks_left([home, top])],
        contents=outputs(top / "out", printed),
    )


def _honest(folder: Path) -> Path:
    wrong = RIGHT.replace("b1 >= ", "b1 > 0.25 + ")
    assert wrong != RIGHT, "the reference has no `b1 >= ` any more"
    secret = f"/* {CANARIES['submission']} */\n"
    for name, content in zip(HONEST, (RIGHT, wrong + secret), strict=True):
        file = folder / name / OWNED
        file.parent.mkdir(parents=True)
        file.write_text(content, encoding="utf-8")
    return folder


def _grades(out: Path) -> dict[str, Any]:
    values = json.loads((out / "grades.json").read_text(encoding="utf-8"))
    return {submission["id"]: submission for submission in values["submissions"]}


def verdict_of(submission: Mapping[str, Any]) -> str:
    return str(submission["modules"][0]["verdict"])


def letters_of(submission: Mapping[str, Any]) -> str:
    """The statuses of the checks, as in `Case.checks`."""
    letter = {status: letter for letter, status in STATUSES.items()}
    checks = submission["modules"][0]["checks"]
    assert not checks or [check["kind"] for check in checks] == list(KINDS)
    return "".join(letter.get(check["status"], "?") for check in checks)


def told_of(submission: Mapping[str, Any]) -> str:
    """All that the report says on it in words."""
    module = submission["modules"][0]
    said = [
        submission["problem"] or "",
        module["message"],
        *(c["message"] for c in module["checks"]),
    ]
    return "\n".join(said)


def faults(case: Case, graded: Graded) -> list[str]:
    """What is not as the case expects; none if all is."""
    submission = graded.together.get(identity(case.name))
    if submission is None:
        return ["it is not in grades.json"]
    verdict, letters = verdict_of(submission), letters_of(submission)
    found = []
    if verdict != case.expect.verdict:
        found.append(f"verdict {verdict}, expected {case.expect.verdict}")
    if letters != case.expect.checks:
        found.append(f"checks {letters}, expected {case.expect.checks}")
    if case.expect.says not in told_of(submission):
        found.append(f"does not say {case.expect.says!r}: {told_of(submission)}")
    return found
