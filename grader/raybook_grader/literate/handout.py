"""Writes the student edition: a folder that builds, renders and checks, and hides the rest.

It has no git history. Nothing is written in place: the edition is made and searched for leaks
in a folder beside `out`, which it then becomes.
"""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..handed_out import ABSENT, MARKER_FILE, HandedOut, digest
from .check import Assignment, load_sound
from .edition import EditionFile, Selection, select, student_edition
from .leaks import ScanReport, scan
from .listing import list_files
from .secrets import find_secrets

MakeMore = Callable[[Selection], Sequence[EditionFile]]
"""What an edition holds beside the files of the checkout: made for it, such as pictures."""


class HandoutError(Exception):
    """The request can't be met: an unknown assignment, or a folder that isn't ours."""


class LeakError(Exception):
    """The edition held a secret, so it was not kept; `report` says where."""

    def __init__(self, report: ScanReport) -> None:
        super().__init__("\n".join([*map(str, report.leaks), *report.unread]))
        self.report = report


@dataclass(frozen=True)
class HandoutReport:
    """What was written. `left_out`: public files that git doesn't track, so they are missing."""

    out: Path
    files: int
    selection: Selection
    left_out: tuple[str, ...]


def write_handout(
    root: Path,
    out: Path,
    assignment: str | None = None,
    reveal: Collection[str] = (),
    make_more: MakeMore | None = None,
) -> HandoutReport:
    """Write the student edition of the checkout `root` to the folder `out`.

    `assignment` "03" hands out the tests and texts of the assignments up to 03, None of all; the
    source is always whole, with a stub for every exercise. `reveal` names the assignments whose
    solutions stay in ("01", "02"). An `out` that this function wrote before is replaced, unless
    it has become a git repository; any other folder that is not empty is left alone.

    Raises HandoutError, UnsoundSourceError or LeakError; `out` is then as it was.
    """
    _require_writable(out)
    tree, assignments = load_sound(root)
    listing = list_files(root)
    try:
        selection = select(assignments, assignment, reveal)
        edition = student_edition(tree, assignments, listing.files, selection)
        untracked = student_edition(tree, assignments, listing.left_out, selection)
    except ValueError as fault:
        raise HandoutError(str(fault)) from None
    _require_source(edition, root)
    edition += make_more(selection) if make_more else []
    names = listing.files + listing.left_out  # what git doesn't know yet is no less a secret
    secrets = find_secrets(tree, names, edition, selection.todos(assignments))
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=out.parent, prefix=f".{out.name}.") as scratch:
        draft = Path(scratch, out.name)
        _write(draft, edition, handed_out(selection, assignments, edition))
        report = scan(draft, secrets)
        if not report.clean:
            raise LeakError(report)
        _put_in_place(draft, out, Path(scratch, "replaced"))
    return HandoutReport(out, len(edition), selection, tuple(file.name for file in untracked))


def _require_writable(out: Path) -> None:
    if out.is_symlink() or (out.exists() and not out.is_dir()):
        raise HandoutError(f"{out}: expected a folder to write, or nothing")
    if not out.exists() or not any(out.iterdir()):
        return
    if not (out / MARKER_FILE).is_file():
        raise HandoutError(f"{out}: is not empty and not a handout; expected a new folder")
    if (out / ".git").exists():
        raise HandoutError(
            f"{out}: has become a git repository; expected a new folder, to copy from"
        )


def _require_source(edition: Iterable[EditionFile], root: Path) -> None:
    if not any(file.name.startswith("src/") for file in edition):
        raise HandoutError(f"{root}/src: git tracks no file there; expected a committed source")


def handed_out(
    selection: Selection, assignments: Iterable[Assignment], edition: Iterable[EditionFile]
) -> HandedOut:
    """What the edition says of itself; its stubs are those of every assignment, known or not."""
    files = {file.name: file for file in edition}
    stubs = {
        (assignment.number, path): digest(files[path].read()) if path in files else ABSENT
        for assignment in assignments
        if assignment.number not in selection.revealed
        for path in assignment.owned
    }
    return HandedOut(selection.assignments, selection.revealed, stubs)


def _write(folder: Path, edition: Iterable[EditionFile], handed: HandedOut) -> None:
    folder.mkdir()
    for file in edition:
        path = folder / file.name
        path.parent.mkdir(parents=True, exist_ok=True)
        if file.content is None:
            shutil.copy(file.source, path)
        else:
            path.write_bytes(file.content)
    (folder / MARKER_FILE).write_text(handed.text(), encoding="utf-8")


def _put_in_place(draft: Path, out: Path, aside: Path) -> None:
    if not out.exists():
        draft.rename(out)
        return
    out.rename(aside)
    try:
        draft.rename(out)
    except OSError:
        aside.rename(out)
        raise
