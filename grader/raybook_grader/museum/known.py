"""What the diagnosis learns from the museum: each mistake as the grader sees it."""

from __future__ import annotations

from dataclasses import replace

from rich.console import Console

from ..course import Assignment
from ..diagnosis import Known
from ..grading.job import Worker
from .exhibits import Exhibit, exhibits_of
from .visit import Visit, Visitor, visit_all


def known_mistakes(
    worker: Worker, assignment: Assignment, jobs: int, console: Console
) -> list[Known]:
    """Judge the mistakes of one assignment; pictures only for those that nothing else sees."""
    if not (assignment.folder / "mistakes").is_dir():
        return []
    mistakes = [e for e in exhibits_of(worker.root, assignment, strict=False) if not e.is_right]
    quickly = Visitor(worker.root, worker.kit, images=False, unsafe=worker.unsafe)
    quick = visit_all(quickly, mistakes, jobs, console)
    unseen = [e for e in mistakes if not quick[e.name].failed]
    slow = visit_all(replace(quickly, images=True), unseen, jobs, console)
    return [_known(e, quick | slow) for e in mistakes]


def _known(exhibit: Exhibit, visits: dict[str, Visit]) -> Known:
    assert exhibit.label is not None
    checks = visits[exhibit.name].result.without_pictures().checks
    return Known(exhibit.slug, exhibit.label.hint, checks)
