"""The known mistakes of an assignment with their traces, kept as one file."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

from ..checks.result import CheckResult
from ..errors import BadInput
from ..files import write_text
from .nearest import Known


def save_known(file: Path, known: Iterable[Known]) -> None:
    """Write what `load_known` reads, complete or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    values = [
        {"slug": k.slug, "hint": k.hint, "checks": [check.to_json() for check in k.checks]}
        for k in sorted(known, key=lambda k: k.slug)
    ]
    write_text(file, json.dumps(values, indent=1) + "\n")


def load_known(file: Path) -> tuple[Known, ...]:
    """The mistakes of one assignment; raises `BadInput`."""
    try:
        values = json.loads(file.read_text(encoding="utf-8"))
        return tuple(
            Known(v["slug"], v["hint"], tuple(CheckResult.from_json(c) for c in v["checks"]))
            for v in values
        )
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise BadInput(f"{file}: {error}, expected known mistakes as `grade` keeps them") from error
