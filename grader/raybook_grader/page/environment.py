"""The jinja2 environment of all pages: everything is escaped, and nothing stays invisible."""

from __future__ import annotations

from functools import cache
from typing import Any

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from .visible import shortened, visible


@cache
def environment(package: str) -> Environment:
    """For the templates of ``package``, which may extend `page.html` of this one."""
    made = Environment(
        loader=ChoiceLoader([PackageLoader(package), PackageLoader(__package__ or "")]),
        autoescape=True,
        finalize=_seen,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters["short"] = shortened
    made.filters["points"] = points
    return made


def points(value: float | None) -> str:
    """A score as it is read: "12.5", and "?" where there is none."""
    return "?" if value is None else f"{value:g}"


def _seen(value: Any) -> Any:
    """What is put in for an expression; what is marked as HTML is ours, or escaped already."""
    return visible(value) if isinstance(value, str) and not isinstance(value, Markup) else value
