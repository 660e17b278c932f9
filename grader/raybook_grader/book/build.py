"""`make book`: both editions as pages and as PDF, and every check that they must pass."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor

from .checked import Checked
from .editions import Edition
from .sphinx_run import Settings, run_sphinx
from .steps import Steps


def build_book(settings: Settings, editions: Sequence[Edition], fresh: bool = False) -> int:
    """Make the editions side by side; returns the exit code. `fresh`: as if never before."""
    if fresh:
        shutil.rmtree(settings.out, ignore_errors=True)
    steps = Steps()
    with ThreadPoolExecutor(len(editions)) as pool:
        found = pool.map(lambda edition: Checked(settings, edition, steps).make(), editions)
        faults = dict(zip(editions, found, strict=True))
    print(steps.table())
    for edition in editions:
        _tell(settings, edition, faults[edition])
    count = sum(map(len, faults.values()))
    if count and settings.draft:
        print(f"book: {count} faults; only a draft may have them", file=sys.stderr)
    return 1 if count and not settings.draft else 0


def build_chapter(settings: Settings, edition: Edition, chapter: str) -> int:
    """The page of one chapter ("04"), for its writer; its faults are only told."""
    found = sorted((settings.docs / "chapters").glob(f"{chapter}-*.md"))
    if len(found) != 1:
        print(f"book: chapter {chapter}: {len(found)} of docs/chapters/ begin so", file=sys.stderr)
        return 1
    out = settings.aside(f"chapter-{edition}")
    outcome = run_sphinx(settings, edition, "html", out, pages=found)
    page = out / "chapters" / f"{found[0].stem}.html"
    for line in _of(outcome.warnings, found[0].name):
        print(f"{edition}: {line}", file=sys.stderr)
    if outcome.crashed or not page.is_file():
        print("book: no page", *outcome.warnings, sep="\n", file=sys.stderr)
        return 1
    print(f"book: {page.relative_to(settings.root)}")
    return 0


def _of(warnings: Sequence[str], name: str) -> Iterator[str]:
    return (line for line in warnings if name in line)


def _tell(settings: Settings, edition: Edition, faults: Sequence[str]) -> None:
    for fault in faults:
        print(f"{edition}: {fault}", file=sys.stderr)
    made = [settings.pages(edition) / "index.html", settings.pdf(edition)]
    names = [str(file.relative_to(settings.root)) for file in made if file.is_file()]
    print(f"book: {' and '.join(names) or 'nothing'}, {len(faults)} faults", flush=True)
