"""What a result was made from, as one hash: equal keys mean equal work, to be done once."""

from __future__ import annotations

import hashlib
from collections.abc import Collection, Iterable, Mapping
from functools import cached_property
from pathlib import Path, PurePath

from ..checks.scene import scene_fingerprint
from ..checks.stub import stub_text
from ..course import Assignment, Course, ImageCheck
from ..kit import Kit
from ..submissions import SubmittedFile

_PACKAGE = Path(__file__).resolve().parents[1]
_HAS_A_SAY = (
    "cases.py", "checks", "course", "diagnosis", "errors.py", "files.py", "grading/module.py",
    "grading/result.py", "judge", "kit.py", "museum", "page", "probes.py", "sandbox", "scoring.py",
    "submissions",
)  # fmt: skip
"""Parts of the grader that a result depends on; of `literate` the stubs, which are hashed."""
_MUSEUM = ("mistakes", "alternatives", "twins")


def has_a_say(module: PurePath) -> bool:
    """Whether a part of this package can change a result."""
    return any(module.is_relative_to(part) for part in _HAS_A_SAY)


class Keys:
    """The keys of one run's work."""

    def __init__(self, course: Course, kit: Kit, unsafe: bool = False) -> None:
        self._course = course
        self._kit = kit
        self._unsafe = unsafe
        self._assignments: dict[str, str] = {}

    def key(self, assignment: Assignment, files: Mapping[str, SubmittedFile]) -> str:
        """The key of grading these files of a submission in an assignment."""
        return self._key(self.of_assignment(assignment), files)

    def judged(self, assignment: Assignment, files: Mapping[str, SubmittedFile]) -> str:
        """The same without the diagnosis: the museum has no say in it."""
        return self._key(self._assignment(assignment, _MUSEUM), files)

    def _key(self, first: str, files: Mapping[str, SubmittedFile]) -> str:
        parts = [first]
        for path in sorted(files):
            file = files[path]
            parts += [path, file.refusal or "", hashlib.sha256(file.content).hexdigest()]
        return _hash(parts)

    def known_file(self, assignment: Assignment) -> Path:
        """Where the known mistakes of an assignment are kept, with what they look like."""
        name = f"{assignment.number}-{assignment.module}-{self.of_assignment(assignment)[:24]}.json"
        return self._course.root / "build" / "diagnosis" / name

    def of_assignment(self, assignment: Assignment) -> str:
        """What the keys of all submissions to an assignment have in common."""
        if assignment.number not in self._assignments:
            self._assignments[assignment.number] = self._assignment(assignment)
        return self._assignments[assignment.number]

    def _assignment(self, assignment: Assignment, without: Collection[str] = ()) -> str:
        root = self._course.root
        scenes = {check.scene for check in assignment.checks if isinstance(check, ImageCheck)}
        used = [
            path
            for path in _files(assignment.folder)
            if path.relative_to(assignment.folder).parts[0] not in without
        ]
        return _hash([
            self.grader,
            self._kit.fingerprint,
            *(["unsafe"] if self._unsafe else []),
            *(_content(path, assignment.folder) for path in used),
            *(stub_text(root, path) for path in assignment.sources),
            *([] if assignment.sources else self._course.sources),
            *(scene_fingerprint(root, scene) for scene in sorted(scenes)),
        ])  # fmt: skip

    @cached_property
    def grader(self) -> str:
        return grader_version()


def grader_version() -> str:
    """The grader's version is its text."""
    modules = [
        path
        for path in _files(_PACKAGE)
        if path.suffix in (".py", ".c", ".h") and has_a_say(path.relative_to(_PACKAGE))
    ]
    return _hash(_content(path, _PACKAGE) for path in modules)


def _files(folder: Path) -> list[Path]:
    return sorted(p for p in folder.rglob("*") if p.is_file() and "__pycache__" not in p.parts)


def _content(path: Path, base: Path) -> str:
    return f"{path.relative_to(base)} {hashlib.sha256(path.read_bytes()).hexdigest()}"


def _hash(parts: Iterable[str]) -> str:
    return hashlib.sha256(repr(list(parts)).encode()).hexdigest()
