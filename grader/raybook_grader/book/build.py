"""`make book`: both editions as pages and as PDF, and every check that they must pass."""

from __future__ import annotations

import shutil
import sys
import time
from collections.abc import Sequence

from .editions import Edition
from .sphinx_run import Outcome, Settings, run_sphinx


def build_book(settings: Settings, editions: Sequence[Edition]) -> int:
    """Make the editions; returns the exit code."""
    faults = 0
    for edition in editions:
        faults += _make(settings, edition)
    if faults and settings.draft:
        print(f"book: {faults} faults; a draft may have them", file=sys.stderr)
    return 1 if faults and not settings.draft else 0


def _make(settings: Settings, edition: Edition) -> int:
    """The number of faults of one edition."""
    began = time.monotonic()
    outcome = run_sphinx(settings, edition, "html", settings.out / ".work" / f"html-{edition}")
    faults = _tell(edition, outcome)
    if outcome.crashed:
        return max(faults, 1)
    pages = settings.pages(edition)
    shutil.rmtree(pages, ignore_errors=True)
    outcome.folder.rename(pages)
    took = time.monotonic() - began
    print(f"book: {pages.relative_to(settings.root)}/index.html, {took:.0f} s")
    return faults


def _tell(edition: Edition, outcome: Outcome) -> int:
    for line in outcome.warnings:
        print(f"{edition}: {line}", file=sys.stderr)
    return len(outcome.warnings)
