"""Grades the tiny course on a tiny disk; to be run in a mount namespace of its own, as its root.

Prints what each step said, as JSON: {step: [exit code, words, files]}.
"""

from __future__ import annotations

import contextlib
import io
import json
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import tiny_course

from raybook_grader import cli
from raybook_grader.checks import artefact
from raybook_grader.grading import commands, run

STUDENTS = 30


def mount(place: Path, options: str, kind: tuple[str, ...] = ()) -> None:
    subprocess.run(["mount", *kind, "-o", options, "none", place], check=True)


def step(*arguments: str | Path) -> list[Any]:
    """Run a command; its exit code and all it said."""
    sys.argv = ["raybook-grader", *map(str, arguments)]
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        code = cli.main()
    return [code, said.getvalue()]


def main() -> None:
    """All steps, in one process."""
    folder = Path(sys.argv[1])
    course = tiny_course.tiny_course(folder / "course")
    for i in range(STUDENTS):
        tiny_course.hand_in(folder / "class", f"s{i:02}", {"01": "ab", "02": "ab"[i % 2]})
        (folder / "class" / f"s{i:02}" / "01a.exr").write_bytes(b"wrong %d" % i)
    # The box cannot be made in here, and nothing of this class needs it.
    for module in (commands, run, sys.modules.get("raybook_grader.grading.place")):
        for name, stand_in in (("require", lambda: None), ("run_jobs", tiny_course.here)):
            if module is not None and hasattr(module, name):
                setattr(module, name, stand_in)
    setattr(artefact, "decode", tiny_course.decode_here)  # noqa: B010 (not exported)
    disk = folder / "disk"
    disk.mkdir()
    mount(disk, "size=80k", ("-t", "tmpfs"))
    out = disk / "out"
    grade = ("grade", folder / "class", "--out", out, "--course", course, "--jobs", "1")
    found = SimpleNamespace(steps={})
    found.steps["full"] = step(*grade)
    found.steps["full again"] = step(*grade)
    mount(disk, "remount,size=300k")
    found.steps["room for the database"] = step(*grade)
    mount(disk, "remount,size=20m")
    found.steps["cured"] = step(*grade)
    grades = (out / "grades.json").read_bytes()
    mount(disk, "remount,ro")
    found.steps["read-only"] = step(*grade)
    found.steps["report"] = step("report", out)
    found.steps["override"] = step("override", out, "s01", "01", "3", "--reason", "r")
    found.steps["elsewhere"] = step(*grade[:2], "--out", folder / "whole", "--course", course)
    found.steps["same"] = [(folder / "whole" / "grades.json").read_bytes() == grades, ""]
    print(json.dumps(found.steps))


if __name__ == "__main__":
    main()
