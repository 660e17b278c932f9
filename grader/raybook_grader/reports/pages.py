"""Writing the pages from the database."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from ..database import Database, Student
from ..files import write_text
from ..grading.totals import totals
from ..judge.viewer import viewer_assets
from ..policy import told
from ..scoring import Verdict
from ..visible import visible
from .class_view import class_view
from .marks import mark_of
from .names import page_name

INDEX = "index.html"


def write_reports(database: Database, folder: Path) -> Path:
    """Write index.html and students/*.html; the pages of submissions that are gone go too.

    Returns the class page. Each page is complete or absent, and pages of one state of the
    database are the same bytes whenever they are written.
    """
    environment = _environment()
    course, modules, zone = database.course(), database.modules(), database.policy().zone
    pages = folder / "students"
    pages.mkdir(exist_ok=True)
    template = environment.get_template("student.html")
    written = set()
    for student in database.students(pictures=True):
        name = page_name(student.id)
        page = template.render(
            course=course,
            student=student,
            modules=modules,
            totals=totals(student, modules),
            unsafe=_is_unsafe([student]),
            reasons={number: told(one, zone) for number, one in student.settled.items()},
            viewer_assets=viewer_assets() if _has_picture(student) else "",
        )
        write_text(pages / name, page)
        written.add(name)
    for old in pages.glob("*.html"):
        if old.name not in written:
            old.unlink()
    unsafe = _is_unsafe(database.students())
    view = class_view(course, modules, database.students())
    index = folder / INDEX
    write_text(index, environment.get_template("class.html").render(view=view, unsafe=unsafe))
    return index


def _has_picture(student: Student) -> bool:
    results = [result for result in student.results.values() if result is not None]
    return any(check.picture for result in results for check in result.checks)


def _is_unsafe(students: Iterable[Student]) -> bool:
    """Whether any result was made without the sandbox."""
    return any(result and result.unsafe for s in students for result in s.results.values())


def _environment() -> Environment:
    environment = Environment(
        loader=PackageLoader(__package__ or "", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=_visible,
    )
    environment.filters["points"] = _points
    environment.filters["mark"] = mark_of
    environment.filters["verdict"] = Verdict
    # The judge makes its pictures from numbers alone.
    environment.filters["trusted"] = Markup
    return environment


def _visible(value: object) -> object:
    """Whatever a template shows; markup was made of text that was made visible before."""
    is_text = isinstance(value, str) and not isinstance(value, Markup)
    return visible(str(value)) if is_text else value


def _points(value: float | None) -> str:
    return "?" if value is None else f"{value:g}"
