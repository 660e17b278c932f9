"""Which files a student gets, and what is in them.

The student edition is made of a list of what is public, never of a list of what is not.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

from .assignment_table import with_table
from .check import Assignment
from .export import export
from .public_toml import public_toml
from .tree import SOURCE_FOLDER, SourceTree

# Copied to the top of the edition as it is: the student's own Makefile, README.md and so on.
HANDOUT_FOLDER = "assignments/handout/"
# Beside the source and assignments: scenes, the set-up without the grader's Python packages,
# the editor's and git's settings, the licence.
_VERBATIM = re.compile(
    r"scenes/.+|\.setup/(?!requirements)[^/]+|\.clang-format|\.gitignore|(LICEN[CS]E|COPYING)[^/]*"
)
# The student's tools: the part of the grader's package that students run too.
_TOOLS = re.compile(
    r"grader/(raybook_grader/(?:(?:__init__|errors|files|handed_out)\.py|(?:student|course)/.+"
    r"|checks/(?:__init__|artefacts|diagnostics|essence|unity|words)\.py"
    r"|judge/(?:__init__|bias|differences|display|evidence|exr|exr_rules|findings|pixels|reference"
    r"|refusal|thresholds|tiles|viewing)\.py))"
)
_TOOLS_FOLDER = "tools"
_OF_ASSIGNMENT = re.compile(r"assignment\.toml|test_\w+\.c|handout\.md|hints\.md")


@dataclass(frozen=True)
class EditionFile:
    """A file of the edition: its name there, the file that it is made of, and its content.

    `content` None: a copy of the source.
    """

    name: str
    source: Path
    content: bytes | None = None

    def read(self) -> bytes:
        return self.source.read_bytes() if self.content is None else self.content


@dataclass(frozen=True)
class Selection:
    """What is handed out: whose tests, and whose solutions (numbers such as "03")."""

    assignments: frozenset[str]
    revealed: frozenset[str]

    def todos(self, assignments: Sequence[Assignment]) -> set[str]:
        """The exercises whose solutions are in the edition."""
        return {name for a in assignments if a.number in self.revealed for name in a.todos}


def select(
    assignments: Sequence[Assignment], up_to: str | None, reveal: Collection[str]
) -> Selection:
    """All assignments, or those up to a number; raises ValueError for an unknown number."""
    numbers = [a.number for a in assignments]
    for number in [*reveal, *([up_to] if up_to else [])]:
        if number not in numbers:
            known = ", ".join(numbers) or "none"
            raise ValueError(f"there is no assignment {number!r}; expected one of: {known}")
    handed_out = frozenset(n for n in numbers if up_to is None or n <= up_to)
    return Selection(handed_out, frozenset(reveal))


def student_edition(
    tree: SourceTree,
    assignments: Sequence[Assignment],
    names: Sequence[str],
    selection: Selection,
) -> list[EditionFile]:
    """The edition that is made of the files `names` (relative to the checkout), by name.

    `tree` must be sound. Raises ValueError if an assignment.toml can't be made public.
    """
    revealed = selection.todos(assignments)
    files: dict[str, EditionFile] = {}
    for name in names:
        for file in _edition_file(tree, assignments, name, selection, revealed):
            files[file.name] = file
    for name in names:  # last, so that a student's own .gitignore wins over ours
        if name.startswith(HANDOUT_FOLDER):
            ours = name.removeprefix(HANDOUT_FOLDER)
            files[ours] = EditionFile(ours, tree.root / name)
    if readme := files.get("README.md"):
        text = with_table(
            readme.read().decode(), [a for a in assignments if a.number in selection.assignments]
        )
        files["README.md"] = EditionFile(readme.name, readme.source, text.encode())
    return sorted(files.values(), key=lambda file: file.name)


def _test_beside(source: str) -> str:
    """Our own test of a module that students write: it may ask for more than the contract does,
    and tells how the solution works."""
    folder, _, base = source.rpartition("/")
    return f"{folder}/test_{base}"


def _edition_file(
    tree: SourceTree,
    assignments: Sequence[Assignment],
    name: str,
    selection: Selection,
    revealed: Collection[str],
) -> list[EditionFile]:
    """The one file that this file becomes, if any."""
    path = tree.root / name
    if name in {_test_beside(owned) for a in assignments for owned in a.owned}:
        return []
    if name in tree.files:
        text = export(tree.files[name], revealed).text
        return [EditionFile(name, path, text.encode())]
    if name.startswith(f"{SOURCE_FOLDER}/") or _VERBATIM.fullmatch(name):
        return [EditionFile(name, path)]
    if tool := _TOOLS.fullmatch(name):
        return [EditionFile(f"{_TOOLS_FOLDER}/{tool[1]}", path)]
    folder, _, base = name.rpartition("/")
    public = any(a.folder == folder and a.number in selection.assignments for a in assignments)
    if not public or not _OF_ASSIGNMENT.fullmatch(base):
        return []
    if base == "assignment.toml":
        text = public_toml(name, path.read_text(encoding="utf-8"))
        return [EditionFile(name, path, text.encode())]
    return [EditionFile(name, path)]
