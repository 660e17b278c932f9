"""The header of a patch: of a mistake what it is, who made it, what sees it, what helps; of a
twin which mistake it is, and how it differs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..errors import BadInput

_MISTAKE = ("What", "Seen", "Expect", "Hint")
_TWIN = ("Twin", "Differs")


@dataclass(frozen=True)
class Label:
    """``expect`` names the checks that fail, in any order; the rest is text for people."""

    what: str
    seen: str
    expect: tuple[str, ...]
    hint: str


def split_mistake(file: Path) -> tuple[Label, str]:
    """The label and the diff of a `mistakes/*.patch`; raises `BadInput`."""
    values, diff = _split(file, _MISTAKE)
    expect = tuple(name.strip() for name in values["Expect"].split(";"))
    return Label(values["What"], values["Seen"], expect, values["Hint"]), diff


def split_twin(file: Path) -> tuple[str, str]:
    """The slug of the mistake that a `twins/*.patch` mirrors, and the diff; raises `BadInput`."""
    values, diff = _split(file, _TWIN)
    return values["Twin"], diff


def _split(file: Path, keys: tuple[str, ...]) -> tuple[dict[str, str], str]:
    """The header, of exactly these keys, and the diff, on either side of an empty line."""
    head, gap, diff = file.read_text(encoding="utf-8").partition("\n\n")
    values: dict[str, str] = {}
    for line in head.splitlines():
        key, colon, value = line.partition(": ")
        if not colon or not value.strip():
            raise BadInput(f"{file}: {line[:60]!r}, expected a line like 'What: ...'")
        values[key] = value.strip()
    if tuple(values) != keys:
        raise BadInput(f"{file}: the header says {', '.join(values)}, expected {', '.join(keys)}")
    if not gap or not diff.lstrip("\n").startswith("--- a/"):
        raise BadInput(f"{file}: no diff after the header, expected an empty line and '--- a/...'")
    return values, diff
