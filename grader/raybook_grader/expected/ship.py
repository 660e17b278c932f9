"""What the student edition ships of the public pictures: what they look like, and some paths."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping
from itertools import chain, combinations
from pathlib import Path

from ..course.pictures import PublicPicture, read_pictures
from ..course.table import Table
from ..literate.check import Assignment, load_assignments
from ..literate.edition import EditionFile, Selection
from ..student.shipped import paths_name, statistics_name
from .paths import expected_paths_file
from .programs import reference_program
from .statistics import expected_file


def expected_files(root: Path, selection: Selection) -> list[EditionFile]:
    """The files for all public pictures of the assignments that are handed out."""
    known = {assignment.number: assignment for assignment in load_assignments(root)[0]}
    return [
        file
        for number in sorted(selection.assignments & known.keys())
        for picture in _pictures(root, known[number])
        for file in _files(root, known[number].folder, picture, known)
    ]


def _pictures(root: Path, assignment: Assignment) -> tuple[PublicPicture, ...]:
    return read_pictures(root, Table(root / assignment.file, "", tomllib.loads(assignment.text)))


def _files(
    root: Path, folder: str, picture: PublicPicture, known: Mapping[str, Assignment]
) -> Iterator[EditionFile]:
    """One set for each way in which the picture may look."""
    for undone in _subsets([n for n in picture.varies_with if n in known]):
        program = reference_program(root, frozenset(t for n in undone for t in known[n].todos))
        statistics = expected_file(root, program, picture)
        yield EditionFile(f"{folder}/{statistics_name(picture, undone)}", statistics)
        paths = expected_paths_file(root, program, picture)
        yield EditionFile(f"{folder}/{paths_name(picture, undone)}", paths)


def _subsets(numbers: list[str]) -> Iterable[tuple[str, ...]]:
    return chain.from_iterable(combinations(numbers, n) for n in range(len(numbers) + 1))
