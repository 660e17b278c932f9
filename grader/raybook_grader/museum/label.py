"""The header of a mistake's patch: what it is, who made it, what sees it, what helps."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..errors import BadInput

_KEYS = ("What", "Seen", "Expect", "Hint")


@dataclass(frozen=True)
class Label:
    """``expect`` names the checks that fail, in any order; the rest is text for people."""

    what: str
    seen: str
    expect: tuple[str, ...]
    hint: str


def split_patch(file: Path) -> tuple[Label, str]:
    """The label and the diff of a `mistakes/*.patch`; they stand on either side of an empty line.

    Raises `BadInput` for a file that is not of that form.
    """
    head, gap, diff = file.read_text(encoding="utf-8").partition("\n\n")
    values: dict[str, str] = {}
    for line in head.splitlines():
        key, colon, value = line.partition(": ")
        if not colon or not value.strip():
            raise BadInput(f"{file}: {line[:60]!r}, expected a line like 'What: ...'")
        values[key] = value.strip()
    if tuple(values) != _KEYS:
        raise BadInput(f"{file}: the header says {', '.join(values)}, expected {', '.join(_KEYS)}")
    if not gap or not diff.lstrip("\n").startswith("--- a/"):
        raise BadInput(f"{file}: no diff after the header, expected an empty line and '--- a/...'")
    expect = tuple(name.strip() for name in values["Expect"].split(";"))
    return Label(values["What"], values["Seen"], expect, values["Hint"]), diff
