"""The course's first assignment without its picture: the real thing, but quick to grade."""

from __future__ import annotations

import json
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from make_class import CHECKOUT

FOLDER = Path("assignments/01-triangle")


def small_course(root: Path) -> Path:
    """A copy of the course at ``root`` whose assignment 01 has no `image` check."""
    kit = CHECKOUT / "build" / "kit" / "kit.json"
    assert kit.is_file(), f"{kit} is not there: run `make kit` first"
    root.mkdir()
    for shared in ("src", "build", "scenes"):
        (root / shared).symlink_to(CHECKOUT / shared)
    shutil.copytree(CHECKOUT / FOLDER, root / FOLDER)
    rubric = root / FOLDER / "assignment.toml"
    head, *checks = rubric.read_text(encoding="utf-8").split("[[check]]")
    kept = [check for check in checks if 'kind = "image"' not in check]
    points = sum(
        float(line.split("=")[1])
        for check in kept
        for line in check.splitlines()
        if line.startswith("points")
    )
    lines = [f"points = {points:g}" if x.startswith("points") else x for x in head.splitlines()]
    rubric.write_text("\n".join(lines) + "\n" + "".join(f"[[check]]{c}" for c in kept))
    return root


def command(*arguments: str | Path) -> list[str]:
    """The command line of the real program."""
    return [sys.executable, "-m", "raybook_grader", *map(str, arguments)]


def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Run the real program to its end."""
    return subprocess.run(command(*arguments), capture_output=True, text=True, check=False)


def grades(out: Path) -> dict[str, Any]:
    """What `grades.json` holds, by submission id."""
    values = json.loads((out / "grades.json").read_text(encoding="utf-8"))
    assert values["version"] == 1
    return {submission["id"]: submission for submission in values["submissions"]}


def verdicts(out: Path) -> dict[str, str]:
    """The verdict on the one module of each submission."""
    return {name: s["modules"][0]["verdict"] for name, s in grades(out).items()}


def done(out: Path) -> dict[str, int]:
    """The finished work, with a number that changes when it is done again."""
    file = out / "grades.sqlite"
    if not file.is_file():
        return {}
    database = sqlite3.connect(f"file:{file}?mode=ro", uri=True)
    try:
        return dict(database.execute("SELECT key, rowid FROM work").fetchall())
    except sqlite3.OperationalError:  # not made yet
        return {}
    finally:
        database.close()


def write_submissions(folder: Path, texts: dict[str, str], path: str) -> Path:
    """One folder a submission, with one file."""
    for name, text in texts.items():
        file = folder / name / path
        file.parent.mkdir(parents=True)
        file.write_text(text, encoding="utf-8")
    return folder


def checks(submission: dict[str, Any]) -> Sequence[dict[str, Any]]:
    """The checks of a submission's one module."""
    found: Sequence[dict[str, Any]] = submission["modules"][0]["checks"]
    return found
