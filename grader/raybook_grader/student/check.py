"""One assignment checked: compiled, tested, its pictures judged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..checks.artefacts import compile_commands_faults, picture_faults
from ..checks.diagnostics import warning_count
from ..course.artefacts import ArtefactCheck
from ..course.pictures import PublicPicture
from ..judge.exr import UnusableImage, read_exr
from .findings import Finding, ShownPicture, State
from .make import DoesNotBuild, Maker, Programs
from .pictures import judge_picture
from .project import Assignment, Project
from .sheet import write_sheet
from .testing import TestRun, run_tests


@dataclass(frozen=True)
class Checker:
    """Checks assignments of a project, in its present state."""

    project: Project
    maker: Maker

    @classmethod
    def of(cls, project: Project) -> Checker:
        return cls(project, Maker(project.root))

    def check(self, assignments: Sequence[Assignment]) -> list[Finding]:
        """What is found of each assignment."""
        begun = [a for a in assignments if self.project.expected.is_begun(a.number)]
        compiled = {a.number: self._compile(a) for a in begun}
        broken = {number for number, (right, _) in compiled.items() if not right}
        programs = None if broken else self._build([a for a in begun if a.sources])
        findings: list[Finding] = []
        for assignment in assignments:
            if assignment not in begun:
                findings.append(_to_do(assignment))
            elif assignment.number in broken:
                findings.append(_broken(assignment, compiled[assignment.number][1]))
            elif not assignment.sources:
                findings.append(self._artefacts(assignment))
            elif isinstance(programs, Programs):
                words = compiled[assignment.number][1]
                findings.append(self._run(assignment, programs, words))
            else:
                findings.append(_blocked(assignment, programs, broken))
        return findings

    def _compile(self, assignment: Assignment) -> tuple[bool, str]:
        right, words = True, []
        for path in assignment.sources:
            compiles, said = self.maker.compiler_words(self.project.expected.source(path), path)
            right = right and compiles
            words += [said] if said else []
        return right, "\n".join(words)

    def _build(self, assignments: Sequence[Assignment]) -> Programs | str:
        """The programs, or what the compiler said of files that nobody here was asked about."""
        if not assignments:
            return ""
        try:
            return self.maker.programs([test for a in assignments for test in a.tests])
        except DoesNotBuild as said:
            return str(said)

    def _run(self, assignment: Assignment, programs: Programs, words: str) -> Finding:
        root, seconds = self.project.root, assignment.wall_seconds
        runs = [run_tests(programs.tests[t], root, t, seconds) for t in assignment.tests]
        shown, notes = self._pictures(assignment, programs.renderer)
        details = [line for run in runs for line in _test_details(run)]
        details += [line for picture in shown for line in _picture_details(picture)]
        warnings = warning_count(words)
        if warnings:
            notes.append(
                f"{warnings} compiler warning{'s' * (warnings > 1)}: the points for a clean build"
            )
        right = all(run.is_right for run in runs) and all(p.judged.is_right for p in shown)
        if right:
            headline = _right_headline(self.project, assignment, runs, shown)
            return Finding(assignment, State.DONE, headline, (), tuple(notes), words, tuple(shown))
        return Finding(
            assignment, State.FAILING, details[0], tuple(details), tuple(notes), words, tuple(shown)
        )

    def _pictures(
        self, assignment: Assignment, renderer: Path
    ) -> tuple[list[ShownPicture], list[str]]:
        shown: list[ShownPicture] = []
        notes: list[str] = []
        for picture in assignment.pictures:
            if waits := self._waits_for(picture):
                notes.append(f"the picture of {picture.name} waits for assignment {waits}")
                continue
            undone = self.project.undone(picture)
            expected = self.project.expected.statistics(assignment, picture, undone)
            if expected is None:
                notes.append(f"what {picture.name} should look like is not in this folder")
                continue
            root, seconds = self.project.root, assignment.wall_seconds
            judged = judge_picture(renderer, root, picture, expected, seconds)
            shown.append(ShownPicture(judged, write_sheet(root, assignment, judged)))
        return shown, notes

    def _waits_for(self, picture: PublicPicture) -> str:
        expected = self.project.expected
        return ", ".join(n for n in picture.needs if not expected.is_begun(n))

    def _artefacts(self, assignment: Assignment) -> Finding:
        faults = [f for check in assignment.artefacts for f in self._artefact_faults(check)]
        if faults:
            return Finding(assignment, State.FAILING, faults[0], tuple(faults))
        files = " and ".join(assignment.owned)
        return Finding(assignment, State.DONE, f"{files} are right")

    def _artefact_faults(self, check: ArtefactCheck) -> list[str]:
        file = self.project.root / check.file
        if not file.is_file():
            return [f"{check.file} is not there yet"]
        if check.resolution is None:
            sources = [p for a in self.project.assignments for p in a.sources]
            faults = compile_commands_faults(file.read_bytes(), sources)
        else:
            try:
                faults = picture_faults(read_exr(file).pixels, check.resolution)
            except UnusableImage as reason:
                return [str(reason)]
        return [f"{check.file}: {fault}" for fault in faults]


def _to_do(assignment: Assignment) -> Finding:
    first = assignment.sources or assignment.owned
    return Finding(
        assignment,
        State.TO_DO,
        f"not begun: {', '.join(first)}; start with {assignment.folder}/handout.md",
    )


def _broken(assignment: Assignment, words: str) -> Finding:
    error = next((line for line in words.splitlines() if "error:" in line), "it does not compile")
    return Finding(assignment, State.FAILING, f"does not compile: {error}", words=words)


def _blocked(assignment: Assignment, words: Programs | str | None, broken: set[str]) -> Finding:
    if broken:
        headline = f"cannot be tried until {', '.join(sorted(broken))} compiles"
    else:
        headline = "the program cannot be built"
    return Finding(
        assignment, State.FAILING, headline, words=words if isinstance(words, str) else ""
    )


def _test_details(run: TestRun) -> list[str]:
    lines = [f"{test} ({run.places.get(test.name, test.file)})" for test in run.failures]
    if run.stopped:
        lines.insert(0, f"{run.stopped}; `make OPT=asan check` may say why")
    if lines and run.left:
        lines.append(f"still to write: {', '.join(run.left)}")
    return lines


def _picture_details(shown: ShownPicture) -> list[str]:
    return [f"picture of {shown.judged.picture.name}: {r}" for r in shown.judged.reasons]


def _right_headline(
    project: Project, assignment: Assignment, runs: Sequence[TestRun], shown: Sequence[ShownPicture]
) -> str:
    count = sum(run.report.count or 0 for run in runs)
    parts = [f"{count} test{'s' * (count != 1)} pass"] if runs else []
    parts += [
        f"the picture{'s' * (len(shown) > 1)} {'are' if len(shown) > 1 else 'is'} right"
    ] * bool(shown)
    if project.expected.is_solution(assignment.number):
        parts.append("this is the solution that was handed out")
    return ", ".join(parts) or "it compiles"
