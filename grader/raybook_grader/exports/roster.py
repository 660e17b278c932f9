"""A class list that Canvas or Moodle has exported, and who of it handed in which submission."""

from __future__ import annotations

import csv
import io
import re
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import BadInput
from .gradebook import Row

_LARGEST = 32 << 20  # bytes

_DOWNLOADS = (
    # Moodle, "Download all submissions": a folder a student, "Full name_123_assignsubmission_...".
    re.compile(r".*_(\d+)_assignsubmission_.*", re.DOTALL),
    # Canvas, "Download Submissions": "lastfirst_123_456_name.zip", LATE after the name if it was.
    re.compile(r"[^_]+_(?:LATE_)?(\d+)_\d+_.*", re.DOTALL),
)


@dataclass(frozen=True)
class Roster:
    """The file's own words: its header and all rows under it, each as long as the header."""

    file: Path
    delimiter: str
    header: list[str]
    rows: list[list[str]]

    def column(self, name: str) -> int | None:
        """The place of a column; None if there is none of that name."""
        return self.header.index(name) if name in self.header else None

    def need(self, name: str) -> int:
        """The place of a column that has to be there."""
        place = self.column(name)
        if place is None:
            columns = ", ".join(repr(title) for title in self.header)
            raise BadInput(f"{self.file}: no column {name!r}, expected it among {columns}")
        return place


@dataclass(frozen=True)
class Matching:
    """Who is who. ``by_place`` is keyed by the place of a roster's row."""

    by_place: Mapping[int, Row]
    unmatched: list[str]
    """Submissions that are nobody's or several people's, with the reason."""


def read_roster(file: Path) -> Roster:
    """A CSV file with a header, in UTF-8; commas, semicolons or tabs between its cells."""
    try:
        if file.stat().st_size > _LARGEST:
            raise BadInput(f"{file}: is larger than {_LARGEST >> 20} MiB, expected a class list")
        text = file.read_text(encoding="utf-8-sig")
        first = text.split("\n", 1)[0]
        delimiter = max(",;\t", key=first.count)
        lines = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True))
    except OSError as error:
        raise BadInput(f"{file}: {error.strerror}, expected a class list as CSV") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise BadInput(f"{file}: {error}, expected CSV in UTF-8") from error
    if not lines:
        raise BadInput(f"{file}: is empty, expected a class list as CSV")
    header, *rows = lines
    for n, row in enumerate(rows, 2):
        if len(row) > len(header):
            raise BadInput(f"{file}: row {n} has {len(row)} cells, expected {len(header)}")
    full = [row + [""] * (len(header) - len(row)) for row in rows]
    return Roster(file, delimiter, [title.strip() for title in header], full)


def match(rows: Sequence[Row], keys: Mapping[int, Sequence[str]]) -> Matching:
    """Find the roster's row of each submission; ``keys`` has the words that name each of them.

    Case does not count. Nothing is guessed: what fits two rows, or shares one, is told instead.
    """
    places: dict[str, set[int]] = defaultdict(set)
    for place, words in keys.items():
        for word in words:
            if word.strip():
                places[word.strip().casefold()].add(place)
    found: dict[str, int] = {}
    unmatched: list[str] = []
    for row in rows:
        fits = set().union(*(places.get(name, set()) for name in _names(row.id)))
        if len(fits) == 1:
            found[row.id] = fits.pop()
        else:
            many = f"fits {len(fits)} rows of the class list"
            unmatched.append(f"{row.id}: {many if fits else 'not in the class list'}")
    uses = Counter(found.values())
    shared = [name for name, place in found.items() if uses[place] > 1]
    unmatched += [f"{name}: another submission is the same student's" for name in shared]
    by_id = {row.id: row for row in rows}
    return Matching({p: by_id[name] for name, p in found.items() if uses[p] == 1}, unmatched)


def _names(submission: str) -> list[str]:
    """What a submission may be called in a class list: its id, or the number in a file name."""
    names = [submission.strip().casefold()]
    for pattern in _DOWNLOADS:
        if matched := pattern.fullmatch(submission):
            names.append(matched[1])
    return names
