"""What a student's pages show, computed from the results."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from zoneinfo import ZoneInfo

from ..checks.result import CheckResult, Status
from ..database import Module, Student
from ..grading.result import ModuleResult
from ..grading.totals import Totals, totals
from ..policy import told
from .names import folder_name, module_page, page_name
from .notices import UNSAFE, Notice
from .words import first_trouble, headline


@dataclass(frozen=True)
class ModuleView:
    """One module; ``page`` is relative to the folder of all students."""

    module: Module
    result: ModuleResult | None
    page: str
    history: tuple[str, ...] = ()
    """How the points came about, a line a step, where checks alone did not decide them."""

    @property
    def file(self) -> str:
        return self.page.rpartition("/")[2]

    @property
    def why(self) -> str:
        return headline(self.result)

    @property
    def checks(self) -> tuple[CheckResult, ...]:
        return self.result.checks if self.result else ()

    @property
    def first(self) -> CheckResult | None:
        """The check to look at first."""
        return first_trouble(self.result) if self.result else None

    @property
    def passed(self) -> int:
        return sum(check.status is Status.PASSED for check in self.checks)

    @property
    def has_picture(self) -> bool:
        return any(check.picture for check in self.checks)

    @property
    def statuses(self) -> list[Status]:
        """Those that occur, each once."""
        return list(dict.fromkeys(check.status for check in self.checks))


@dataclass(frozen=True)
class StudentView:
    """A submission with its modules in the order of the course."""

    id: str
    course: str
    page: str
    folder: str
    totals: Totals
    modules: tuple[ModuleView, ...]
    notices: tuple[Notice, ...]
    history: tuple[str, ...] = ()
    """How the total came about, a line a step, where it is not the sum of the modules."""


def student_view(
    course: str,
    student: Student,
    modules: Sequence[Module],
    zone: ZoneInfo,
    notices: Iterable[Notice] = (),
) -> StudentView:
    """The pages of one submission; ``zone`` is for dates, ``notices`` are those of every page."""
    own = _own_notices(student)
    return StudentView(
        id=student.id,
        course=course,
        page=page_name(student.id),
        folder=folder_name(student.id),
        totals=totals(student, modules),
        modules=tuple(
            ModuleView(
                module,
                student.results[module.number],
                module_page(student.id, module),
                _history(student, module, zone),
            )
            for module in modules
            if module.number in student.results
        ),
        notices=(*notices, *own),
    )


def _own_notices(student: Student) -> list[Notice]:
    found = [UNSAFE] if any(r and r.unsafe for r in student.results.values()) else []
    if student.problem is not None:
        found.append(Notice("The submission could not be read.", student.problem, "bad"))
    return found


def _history(student: Student, module: Module, zone: ZoneInfo) -> tuple[str, ...]:
    settled = student.settled.get(module.number)
    return tuple(told(settled, zone)) if settled else ()
