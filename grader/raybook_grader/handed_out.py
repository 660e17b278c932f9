"""What a student edition says of itself, in the file `.raybook-handout` at its top.

`make handout` writes it; the student's tools read it, to tell a stub from a beginning.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from pathlib import Path

from .checks.essence import essence

MARKER_FILE = ".raybook-handout"
_HEAD = "The student edition of Raybook. `make handout` may replace this folder.\n"


@dataclass(frozen=True)
class HandedOut:
    """Numbers of the assignments in the edition and of those whose solutions are in it.

    ``stubs`` maps (assignment, owned file) to the digest of what was handed out.
    """

    assignments: frozenset[str]
    solutions: frozenset[str]
    stubs: dict[tuple[str, str], str] = field(default_factory=dict)

    def text(self) -> str:
        """The file's content."""
        stubs = [f"stub {n} {path} {value}" for (n, path), value in sorted(self.stubs.items())]
        lines = [
            f"assignments: {_listed(self.assignments)}",
            f"solutions: {_listed(self.solutions)}",
        ]
        return _HEAD + "".join(f"{line}\n" for line in [*lines, *stubs])

    def is_begun(self, number: str, root: Path) -> bool:
        """Whether an owned file is another than the stub; unknown assignments count as begun."""
        stubs = {path: value for (n, path), value in self.stubs.items() if n == number}
        return not stubs or any(_is_other(root / path, value) for path, value in stubs.items())


ABSENT = "absent"
"""In the place of a digest: the file was not there at all."""


def digest(text: bytes) -> str:
    """The same for texts that differ in comments and white space only."""
    return hashlib.sha256(essence(text)).hexdigest()


def read_handed_out(root: Path) -> HandedOut:
    """What the edition at ``root`` says of itself; nothing if the file is gone."""
    values: dict[str, str] = {}
    stubs: dict[tuple[str, str], str] = {}
    file = root / MARKER_FILE
    for line in file.read_text(encoding="utf-8").splitlines() if file.is_file() else []:
        words = line.split()
        if words[:1] == ["stub"] and len(words) == 4:
            stubs[words[1], words[2]] = words[3]
        elif words and words[0].endswith(":"):
            values[words[0]] = " ".join(words[1:])
    return HandedOut(_numbers(values, "assignments:"), _numbers(values, "solutions:"), stubs)


def _listed(numbers: frozenset[str]) -> str:
    return " ".join(sorted(numbers)) or "none"


def _numbers(values: dict[str, str], key: str) -> frozenset[str]:
    return frozenset(values.get(key, "").split()) - {"none"}


def _is_other(file: Path, stub: str) -> bool:
    return file.is_file() and digest(file.read_bytes()) != stub
