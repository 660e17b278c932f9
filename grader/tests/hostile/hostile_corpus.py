"""All cases, by class."""

from __future__ import annotations

from dataclasses import replace

import hostile_archives
import hostile_compiling
import hostile_exhausting
import hostile_forging
import hostile_outputs
import hostile_reporting
import hostile_stealing
from hostile_case import Case

_CLASSES = {
    "archives": hostile_archives.CASES,
    "compile time": hostile_compiling.CASES,
    "forging": hostile_forging.CASES,
    "stealing": hostile_stealing.CASES,
    "exhausting": hostile_exhausting.CASES,
    "outputs": hostile_outputs.CASES,
    "reports": hostile_reporting.CASES,
}

CASES: list[Case] = [
    replace(case, group=group) for group, cases in _CLASSES.items() for case in cases
]
QUICK = [case for case in CASES if case.quick]
