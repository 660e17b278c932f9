"""The bibliography: sorted by author, each work under the words by which the text cites it.

On paper nobody can follow a link, so "[Wald et al., 2014]" must be a place in the alphabet.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from pybtex.database import Entry
from pybtex.plugin import register_plugin
from pybtex.style.formatting.plain import Style as PlainStyle
from pybtex.style.labels import BaseLabelStyle

STYLE = "author-year"


class AuthorYearLabels(BaseLabelStyle):  # type: ignore[misc]  # pybtex has no types
    """ "Walker, 1977", "Duff and Burgess, 2017", "Wald et al., 2014"."""

    def format_labels(self, entries: Sequence[Entry]) -> Iterator[str]:
        """One label for each entry, in their order."""
        return (f"{_names(entry)}, {entry.fields['year']}" for entry in entries)


class AuthorYearStyle(PlainStyle):  # type: ignore[misc]
    """The plain style, which sorts by author, with these labels."""

    default_label_style = STYLE


def _names(entry: Entry) -> str:
    people = entry.persons.get("author") or entry.persons["editor"]
    names = [" ".join(map(str, (*one.rich_prelast_names, *one.rich_last_names))) for one in people]
    if len(names) > 2:
        return f"{names[0]} et al."
    return " and ".join(names)


def register() -> None:
    """Make the style known to pybtex, by its name."""
    register_plugin("pybtex.style.labels", STYLE, AuthorYearLabels)
    register_plugin("pybtex.style.formatting", STYLE, AuthorYearStyle)
