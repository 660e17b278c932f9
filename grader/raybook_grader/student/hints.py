"""Hints in three steps, one at a time; which were taken is remembered under `build/`."""

from __future__ import annotations

import json
import re
from pathlib import Path

from ..errors import BadInput
from ..files import write_text
from .project import Assignment, Project

_MEMORY = Path("build/hints.json")
_STEP = re.compile(r"^## \d+\s*$", re.MULTILINE)


def read_hints(root: Path, assignment: Assignment) -> list[str]:
    """The hints of an assignment, in their order."""
    file = root / assignment.folder / "hints.md"
    if not file.is_file():
        return []
    _, *steps = _STEP.split(file.read_text(encoding="utf-8"))
    return [step.strip() for step in steps]


def taken(root: Path) -> dict[str, int]:
    """How many hints of each assignment have been shown."""
    try:
        values = json.loads((root / _MEMORY).read_text(encoding="utf-8"))
        return {str(number): int(count) for number, count in values.items()}
    except (OSError, ValueError, AttributeError, TypeError):
        return {}


def next_hint(project: Project, assignment: Assignment) -> tuple[int, str]:
    """The next hint and its number from 1; it counts as taken from now on."""
    hints, seen = read_hints(project.root, assignment), taken(project.root)
    if not hints:
        raise BadInput(f"assignment {assignment.number} has no hints")
    number = seen.get(assignment.number, 0) + 1
    if number > len(hints):
        raise BadInput(
            f"all {len(hints)} hints of assignment {assignment.number} are taken; "
            f"HINT=1 to HINT={len(hints)} shows one again"
        )
    _remember(project.root, {**seen, assignment.number: number})
    return number, hints[number - 1]


def hint_again(project: Project, assignment: Assignment, number: int) -> str:
    """A hint that was taken already."""
    hints = read_hints(project.root, assignment)
    seen = taken(project.root).get(assignment.number, 0)
    if not 1 <= number <= len(hints):
        raise BadInput(f"HINT={number}: assignment {assignment.number} has {len(hints)} hints")
    if number > seen:
        raise BadInput(f"HINT={number}: take hint {seen + 1} first, without HINT=")
    return hints[number - 1]


def overview(project: Project) -> list[str]:
    """A line for each assignment: how many hints there are, and how many were taken."""
    seen = taken(project.root)
    lines: list[str] = []
    for assignment in project.assignments:
        if count := len(read_hints(project.root, assignment)):
            lines.append(
                f"{assignment.name}: {seen.get(assignment.number, 0)} of {count} hints taken"
            )
    return lines


def _remember(root: Path, seen: dict[str, int]) -> None:
    (root / _MEMORY).parent.mkdir(parents=True, exist_ok=True)
    write_text(root / _MEMORY, json.dumps(seen, sort_keys=True))
