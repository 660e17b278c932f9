"""Writing the pages from the database."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from jinja2 import Template
from markupsafe import Markup

from ..database import Database, Module, Student
from ..files import write_text
from ..judge.viewer import VIEWER_SCRIPTS, VIEWER_STYLES
from ..page import assets, environment
from ..page.assets import File
from ..scoring import Verdict
from .class_view import TONES, class_view
from .marks import mark_of
from .notices import Notice
from .student_view import StudentView, student_view
from .words import KINDS, STATUSES, VERDICTS, parts_of

INDEX = "index.html"
STUDENTS = "students"
_HERE = __package__ or ""
_STUDENT: tuple[File, ...] = ((_HERE, "student.css"),)
_CLASS: tuple[File, ...] = ((_HERE, "class.css"),)
_GRID: tuple[File, ...] = ((_HERE, "class.js"),)


def write_reports(database: Database, folder: Path, notices: Sequence[Notice] = ()) -> Path:
    """Write index.html for the instructor, and in students/ a page for each submission and each
    of its modules; the pages of what is gone go too. ``notices`` stand on every page.

    Returns the class page. Each page is complete or absent, and pages of one state of the
    database are the same bytes whenever they are written.
    """
    course, modules, zone = database.course(), database.modules(), database.policy().zone
    top = folder / STUDENTS
    top.mkdir(exist_ok=True)
    written = set()
    for student in database.students(pictures=True):
        view = student_view(course, student, modules, zone, notices)
        for name, page in student_pages(view):
            (top / name).parent.mkdir(exist_ok=True)
            write_text(top / name, page)
            written.add(top / name)
    _remove_others(top, written)
    index = folder / INDEX
    write_text(index, class_page(course, modules, database.students(), notices))
    return index


def class_page(
    course: str,
    modules: Sequence[Module],
    students: Iterable[Student],
    notices: Sequence[Notice] = (),
) -> str:
    """The text of the instructor's page."""
    view = class_view(course, modules, students, notices)
    return _template("class.html").render(view=view, assets=assets(_CLASS, _GRID))


def student_pages(view: StudentView) -> Iterator[tuple[str, str]]:
    """Names, relative to the folder of all students, and texts."""
    yield view.page, _template("student.html").render(student=view, assets=assets(_STUDENT))
    for at, module in enumerate(view.modules):
        has_picture = module.has_picture
        yield (
            module.page,
            _template("module.html").render(
                student=view,
                view=module,
                previous=view.modules[at - 1] if at else None,
                next=view.modules[at + 1] if at + 1 < len(view.modules) else None,
                assets=assets((*VIEWER_STYLES, *_STUDENT), VIEWER_SCRIPTS)
                if has_picture
                else assets(_STUDENT),
            ),
        )


def _remove_others(top: Path, written: set[Path]) -> None:
    for page in [*top.glob("*.html"), *top.glob("*/*.html")]:
        if page not in written:
            page.unlink()
    for folder in top.iterdir():
        if folder.is_dir() and not folder.is_symlink() and not any(folder.iterdir()):
            folder.rmdir()


def _template(name: str) -> Template:
    made = environment(_HERE)
    made.filters["mark"] = mark_of
    made.filters["verdict"] = Verdict
    made.filters["parts"] = parts_of
    # The judge makes its pictures from numbers alone.
    made.filters["trusted"] = Markup
    made.globals |= {"VERDICTS": VERDICTS, "STATUSES": STATUSES, "KINDS": KINDS, "TONES": TONES}
    return made.get_template(name)
