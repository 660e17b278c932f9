"""Writing an export: the format by its name, a file complete or not at all, and what to tell."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ..course import Course
from ..database import Database
from ..errors import BadInput
from ..files import write_text
from ..grading.export import write_grades
from ..reports.names import page_name
from .canvas import canvas_export
from .csv_table import csv_export
from .gradebook import Gradebook, read_gradebook
from .gradescope import VISIBILITIES, open_checks, results, results_text
from .moodle import moodle_export
from .roster import read_roster

FORMATS = ("csv", "gradescope", "canvas", "moodle", "json")
FOLDER = "exports"
_NAMES = {
    "csv": "grades.csv", "gradescope": "gradescope", "canvas": "canvas.csv",
    "moodle": "moodle.csv", "json": "grades.json",
}  # fmt: skip


@dataclass(frozen=True)
class Request:
    """One export. ``assignments`` None stands for all; ``output`` None for DIR/exports/NAME."""

    format: str
    output: Path | None = None
    roster: Path | None = None
    key: str | None = None
    assignments: Collection[str] | None = None
    columns: Mapping[str, str] = field(default_factory=dict)
    scale: bool = False
    hidden: str = VISIBILITIES[0]
    submission: str | None = None


@dataclass(frozen=True)
class Written:
    """What was written, what to tell about it, and the modules that have no score in it."""

    path: Path
    notes: list[str]
    unknown: list[str]


def check_request(request: Request) -> None:
    """Fault what can be seen to be wrong before anything is graded."""
    if request.format not in FORMATS:
        raise BadInput(f"no format {request.format!r}, expected one of {', '.join(FORMATS)}")
    if request.format == "moodle" and request.roster is None:
        raise BadInput("the moodle format needs a roster: the worksheet that Moodle gave you")
    if request.roster is not None:
        if request.format not in ("canvas", "moodle"):
            raise BadInput(f"the {request.format} format has no use for a roster")
        read_roster(request.roster)


def write_export(database: Database, folder: Path, course: Course, request: Request) -> Written:
    """Write one export of the results in ``folder``."""
    check_request(request)
    gradebook = read_gradebook(database, request.assignments)
    path = request.output or folder / FOLDER / _NAMES[request.format]
    if request.output is None:
        path.parent.mkdir(exist_ok=True)
    notes: list[str] = []
    match request.format:
        case "json":
            _write(path, write_grades(database, folder).read_text(encoding="utf-8"))
        case "csv":
            _write(path, csv_export(gradebook))
        case "gradescope":
            gradebook = _one_submission(gradebook, request.submission)
            _write_gradescope(path, gradebook, course, request)
        case _:
            text, notes = _for_platform(gradebook, request)
            _write(path, text)
    if gradebook.unsafe:
        notes.append(f"graded without a sandbox, so nothing to rely on: {gradebook.unsafe} modules")
    return Written(path, notes, gradebook.unknown)


def _for_platform(gradebook: Gradebook, request: Request) -> tuple[str, list[str]]:
    roster = read_roster(request.roster) if request.roster else None
    if request.format == "moodle":
        return moodle_export(gradebook, roster, request.key, request.scale)
    return canvas_export(gradebook, roster, request.key, request.columns, request.scale)


def _one_submission(gradebook: Gradebook, name: str | None) -> Gradebook:
    if name is None:
        return gradebook
    rows = tuple(row for row in gradebook.rows if row.id == name)
    if not rows:
        raise BadInput(f"no submission {name!r}, expected an id of this class")
    return Gradebook(gradebook.course, gradebook.modules, rows)


def _write_gradescope(
    path: Path, gradebook: Gradebook, course: Course, request: Request
) -> None:  # fmt: skip
    """A folder with a file a submission; a file if one submission was asked for."""
    visible = open_checks(course)
    texts = {
        page_name(row.id).removesuffix(".html"): results_text(
            results(row, gradebook, visible, request.hidden)
        )
        for row in gradebook.rows
    }
    if request.submission is not None:
        (text,) = texts.values()
        _write(path, text)
        return
    for name, text in texts.items():
        try:
            (path / name).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise BadInput(f"{path / name}: {error.strerror}, expected a folder") from error
        _write(path / name / "results.json", text)


def _write(path: Path, text: str) -> None:
    try:
        write_text(path, text)
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror}, expected a file that can be written") from error
