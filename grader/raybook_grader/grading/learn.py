"""Making ready what the diagnosis compares modules with."""

from __future__ import annotations

from collections.abc import Collection

from rich.console import Console

from ..course import load_course
from ..diagnosis import save_known
from ..kit import load_kit
from ..museum.known import known_mistakes
from .job import Worker
from .key import Keys


def learn(worker: Worker, numbers: Collection[str], jobs: int, console: Console) -> None:
    """Judge the mistakes of the museum that the diagnosis does not know yet, once."""
    course = load_course(worker.root)
    keys = Keys(course, load_kit(worker.kit), worker.unsafe)
    unknown = {
        assignment.number: keys.known_file(assignment)
        for assignment in course.assignments
        if assignment.number in numbers and not keys.known_file(assignment).is_file()
    }
    for number, file in unknown.items():
        save_known(file, known_mistakes(worker, course.assignment(number), jobs, console))
