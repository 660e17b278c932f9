"""Grading one module of one submission, alone: everything else is the reference."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from ..checks.artefact import check_artefact
from ..checks.build import check_build, failed_build
from ..checks.cost import check_cost
from ..checks.image import check_image
from ..checks.probe import check_probe
from ..checks.program import BuildFailure, HarnessFault, Workshop
from ..checks.reference import References
from ..checks.result import CheckResult, Status, conclude
from ..checks.robust import check_robust
from ..checks.robust import confirm as confirm_robust
from ..checks.stub import is_stub, stub_text
from ..checks.subject import Stopped, Subject
from ..checks.unit import check_unit, confirm
from ..checks.words import clean
from ..course import (
    ArtefactCheck,
    Assignment,
    BuildCheck,
    Check,
    CostCheck,
    ImageCheck,
    ProbeCheck,
    RobustCheck,
    UnitCheck,
)
from ..diagnosis import Known, nearest
from ..submissions import SubmittedFile
from .result import ModuleResult, from_checks, internal_error, missing

MOST_TIMEOUTS = 2
"""After so many checks that ran out of time the rest is not run."""


@dataclass(frozen=True)
class ModuleGrader:
    """Grades modules, one at a time, in this process."""

    workshop: Workshop
    references: References
    known: Callable[[Assignment], Sequence[Known]] = lambda assignment: ()
    """The mistakes that a failing module is compared with."""

    def grade(self, assignment: Assignment, files: Mapping[str, SubmittedFile]) -> ModuleResult:
        """The result for the owned files that were found; any fault of the harness is inside it."""
        try:
            return self._grade(assignment, files)
        except Exception as fault:
            return internal_error(_told(fault), traceback.format_exc())

    def _grade(self, assignment: Assignment, files: Mapping[str, SubmittedFile]) -> ModuleResult:
        refusals = [file.refusal for file in files.values() if file.refusal is not None]
        if refusals:
            return missing("; ".join(refusals))
        if not files:
            return missing(f"{', '.join(assignment.owned)}: not in the submission")
        if not assignment.sources:
            return self._judge_artefacts(assignment, files)
        root = self.workshop.course.root
        stubs = {path: stub_text(root, path) for path in assignment.owned}
        if all(is_stub(file.content, stubs[path]) for path, file in files.items()):
            return missing("still the stub that the course hands out")
        # What was not handed in of a module with several files is still its stub.
        contents = {p: files[p].content if p in files else stubs[p].encode() for p in stubs}
        return self._judge(assignment, contents)

    def _judge_artefacts(
        self, assignment: Assignment, files: Mapping[str, SubmittedFile]
    ) -> ModuleResult:
        contents = {path: file.content for path, file in files.items()}
        checks = [check for check in assignment.checks if isinstance(check, ArtefactCheck)]
        return from_checks([check_artefact(c, contents.get(c.file), self.workshop) for c in checks])

    def _judge(self, assignment: Assignment, contents: Mapping[str, bytes]) -> ModuleResult:
        try:
            module = self.workshop.compile_module(assignment, contents)
            renderer = self.workshop.renderer(module)
        except BuildFailure as failure:
            return from_checks([_unbuilt(check, failure) for check in assignment.checks])
        result = self._run_all(Subject(self.workshop, assignment, module, renderer))
        return replace(result, diagnosis=nearest(result.checks, self.known(assignment)))

    def _run_all(self, subject: Subject) -> ModuleResult:
        results: list[CheckResult] = []
        faults: list[str] = []
        for check in subject.assignment.checks:
            timeouts = sum(result.status is Status.TIMEOUT for result in results)
            if timeouts >= MOST_TIMEOUTS:
                message = f"not run, because {timeouts} checks ran out of time"
                results.append(conclude(check, Status.NOT_RUN, message))
                continue
            try:
                results.append(self._run(check, subject))
            except Stopped as stop:
                results.append(_stopped(check, stop))
            except Exception as fault:
                results.append(conclude(check, Status.INTERNAL_ERROR, _told(fault)))
                faults.append(traceback.format_exc())
        return from_checks(confirm_robust(confirm(results)), "\n".join(faults))

    def _run(self, check: Check, subject: Subject) -> CheckResult:
        match check:
            case BuildCheck():
                return check_build(check, subject)
            case UnitCheck():
                return check_unit(check, subject)
            case ProbeCheck():
                return check_probe(check, subject)
            case RobustCheck():
                return check_robust(check, subject)
            case CostCheck():
                return check_cost(check, subject)
            case ImageCheck():
                return check_image(check, subject, self.references)
            case ArtefactCheck():
                raise HarnessFault("an artefact is no module: it is judged without a program")


def _unbuilt(check: Check, failure: BuildFailure) -> CheckResult:
    if isinstance(check, BuildCheck):
        return failed_build(check, failure)
    return conclude(check, Status.NOT_RUN, "not run, because there is no program")


def _stopped(check: Check, stop: Stopped) -> CheckResult:
    p = stop.problem
    # What a program prints in a hidden check may be the hidden cases themselves.
    words = "" if check.hidden else clean(stop.said)
    return conclude(check, p.status, p.message, fingerprint=p.fingerprint, words=words)


def _told(fault: Exception) -> str:
    """A fault of the harness, for a student: not their doing, and no word of the hidden parts."""
    return f"the grader failed here ({type(fault).__name__}); this is not your doing"
