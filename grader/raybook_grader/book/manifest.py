"""docs/figures/manifest.json: what each rendered figure looked like when somebody last looked.

The same code gives the same pixels on the same machine. Another processor's library of
mathematics may round otherwise, so a picture is only called changed if its mean colours are.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

_TOLERANCE = 2  # of 255, in the mean of a cell


@dataclass(frozen=True)
class Entry:
    """A picture as the manifest knows it."""

    pixels: str
    means: str

    def looks_like(self, other: Entry) -> bool:
        if self.pixels == other.pixels:
            return True
        ours, theirs = bytes.fromhex(self.means), bytes.fromhex(other.means)
        if len(ours) != len(theirs):
            return False
        return all(abs(a - b) <= _TOLERANCE for a, b in zip(ours, theirs, strict=True))


Entries = Mapping[str, Entry]
"""By the picture's name: "cornell-first/solution"."""


def read_manifest(file: Path) -> dict[str, Entry]:
    """The entries; none if there is no file."""
    if not file.is_file():
        return {}
    table = json.loads(file.read_text(encoding="utf-8"))
    return {name: Entry(entry["pixels"], entry["means"]) for name, entry in table.items()}


def write_manifest(file: Path, entries: Entries) -> None:
    table = {n: {"pixels": e.pixels, "means": e.means} for n, e in sorted(entries.items())}
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")


def differences(known: Entries, drawn: Entries, whole: bool) -> list[str]:
    """What is not as the manifest says. `whole`: every figure of the book is in `drawn`."""
    messages = []
    for name, entry in sorted(drawn.items()):
        if name not in known:
            messages.append(f"figure {name} is new")
        elif not entry.looks_like(known[name]):
            messages.append(f"figure {name} has changed")
    gone = sorted(known.keys() - drawn.keys()) if whole else []
    return messages + [f"figure {name} is no longer in the book" for name in gone]
