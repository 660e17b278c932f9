"""What no student may see: lines of solutions, and whole files that only instructors have.

A line is a secret if it is long enough to mean something and occurs nowhere in the text that
students are given anyway. Lines are compared without white space, so that a re-indented or
re-wrapped line is the same line.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from .check import load_sound
from .edition import EditionFile, select, student_edition
from .export import export
from .listing import list_files
from .pieces import Role
from .tree import SourceTree

SOLUTION_LENGTH = 12  # characters without white space, at least
# A hidden test is full of common lines; a longer one is its own.
INSTRUCTOR_LENGTH = 20
INSTRUCTOR_LETTERS = 8  # rows of numbers are alike
INSTRUCTOR_FOLDERS = ("hidden", "mistakes", "alternatives", "twins")

_CODE = (".c", ".h", ".inc", ".py")
_PATCH = (".patch", ".diff")
_HUNK = re.compile(r"@@ -\d+(?:,(\d+))? \+\d+(?:,(\d+))? @@")
_LARGEST_TEXT = 1 << 20  # bytes; beyond are meshes and pictures
_INVISIBLE = {ord(c): None for c in "\u00ad\u200b\u200c\u200d\ufeff"}


@dataclass(frozen=True)
class SecretLine:
    """A line that must not be seen; `key` is its text without white space."""

    file: str
    line: int
    text: str
    key: str


@dataclass(frozen=True)
class Secrets:
    """`lines` have different keys; `files` maps the SHA-256 of a file's bytes to its name."""

    lines: tuple[SecretLine, ...]
    files: Mapping[str, str] = field(default_factory=dict)


def squeeze(text: str) -> str:
    """The text without white space and invisible characters."""
    squeezed = "".join(text.split())
    return squeezed if squeezed.isascii() else squeezed.translate(_INVISIBLE)


def digest(data: bytes) -> str:
    """The name of a file's content in `Secrets.files`."""
    return hashlib.sha256(data).hexdigest()


def checkout_secrets(root: Path, reveal: Collection[str] = ()) -> Secrets:
    """The secrets of the checkout `root`; the solutions of the assignments `reveal` are none.

    Raises UnsoundSourceError, or ValueError for an unknown assignment.
    """
    tree, assignments = load_sound(root)
    listing = list_files(root)
    selection = select(assignments, None, reveal)
    edition = student_edition(tree, assignments, listing.files, selection)
    return find_secrets(
        tree, listing.files + listing.left_out, edition, selection.todos(assignments)
    )


def find_secrets(
    tree: SourceTree, names: Sequence[str], edition: Iterable[EditionFile], reveal: Collection[str]
) -> Secrets:
    """The secrets of a checkout whose files are `names` and that publishes `edition`.

    `reveal` are the exercises whose solutions are no secret; `tree` must be sound.
    """
    source = _joined(export(file, reveal).text for file in tree.files.values())
    solutions = _select(_solution_lines(tree), source, SOLUTION_LENGTH)
    instructor = [name for name in names if _is_instructor_file(name)]
    public = source + _joined(_text(file.read()) for file in edition)
    others = _select(_instructor_lines(tree.root, instructor), public, INSTRUCTOR_LENGTH)
    lines = {line.key: line for line in [*others, *solutions]}
    contents = ((name, (tree.root / name).read_bytes()) for name in instructor)
    files = {digest(data): name for name, data in contents if data.strip()}
    return Secrets(tuple(lines.values()), files)


def _joined(texts: Iterable[str]) -> str:
    return "\0".join(squeeze(text) for text in texts) + "\0"


def _select(lines: Iterable[SecretLine], public: str, length: int) -> list[SecretLine]:
    """The first line with each key that is long enough and that `public` doesn't hold."""
    chosen: dict[str, SecretLine] = {}
    for line in lines:
        if len(line.key) >= length and line.key not in public:
            chosen.setdefault(line.key, line)
    return list(chosen.values())


def _solution_lines(tree: SourceTree) -> Iterator[SecretLine]:
    for source in tree.files.values():
        for line in source.lines():
            if line.role is Role.SOLUTION:
                yield SecretLine(source.name, line.number, line.text.strip(), squeeze(line.text))


def _is_instructor_file(name: str) -> bool:
    parts = name.split("/")
    return len(parts) > 3 and parts[0] == "assignments" and parts[2] in INSTRUCTOR_FOLDERS


def _instructor_lines(root: Path, names: Iterable[str]) -> Iterator[SecretLine]:
    for name in names:
        for number, text in _telling_lines(name, _text((root / name).read_bytes())):
            key = squeeze(text)
            if sum(map(str.isalpha, key)) >= INSTRUCTOR_LETTERS:
                yield SecretLine(name, number, text.strip(), key)


def _telling_lines(name: str, text: str) -> Iterator[tuple[int, str]]:
    """The numbered lines that would tell a student something: all that is hidden, and code.

    The words above a patch and beside it, a mistake's title and hint, are for students too.
    """
    lines = enumerate(text.split("\n"), 1)
    if name.endswith(_PATCH):
        yield from _hunk_lines(lines)
    elif name.endswith(_CODE) or name.split("/")[2] == "hidden":
        yield from lines


def _hunk_lines(lines: Iterable[tuple[int, str]]) -> Iterator[tuple[int, str]]:
    """The lines of a patch's hunks, without their first column."""
    old = new = 0  # lines that the hunk still has of either side
    for number, line in lines:
        if old > 0 or new > 0:
            old -= line[:1] in (" ", "-", "")
            new -= line[:1] in (" ", "+", "")
            yield number, line[1:]
        elif match := _HUNK.match(line):
            old, new = int(match[1] or 1), int(match[2] or 1)


def _text(data: bytes) -> str:
    """The text of a file; nothing of a large or binary one."""
    is_text = len(data) <= _LARGEST_TEXT and b"\0" not in data
    return data.decode("utf-8", "ignore") if is_text else ""
