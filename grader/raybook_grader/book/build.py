"""`make book`: both editions as pages and as PDF, and every check that they must pass."""

from __future__ import annotations

import hashlib
import shutil
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from ..literate.leaks import scan
from ..literate.secrets import checkout_secrets
from ..literate.tree import load_tree
from .editions import Edition, Reader
from .links import link_faults
from .paper import PageNumbers, print_pdf
from .round_trip import render_faults, text_faults
from .sphinx_run import Settings, run_sphinx


def build_book(settings: Settings, editions: Sequence[Edition]) -> int:
    """Make the editions; returns the exit code."""
    # The second edition finds the figures drawn; what comes then takes a core for each.
    faults = {edition: _make_pages(settings, edition) for edition in editions}
    if not settings.draft:
        sound = [edition for edition in editions if not faults[edition]]
        with ThreadPoolExecutor(len(editions)) as pool:
            found = pool.map(lambda edition: _finish(settings, edition), sound)
            faults |= dict(zip(sound, found, strict=True))
    for edition in editions:
        _tell(settings, edition, faults[edition])
    count = sum(map(len, faults.values()))
    if count and settings.draft:
        print(f"book: {count} faults; only a draft may have them", file=sys.stderr)
    return 1 if count and not settings.draft else 0


def _tell(settings: Settings, edition: Edition, faults: Sequence[str]) -> None:
    for fault in faults:
        print(f"{edition}: {fault}", file=sys.stderr)
    made = [settings.pages(edition) / "index.html", settings.pdf(edition)]
    names = [str(file.relative_to(settings.root)) for file in made if file.is_file()]
    print(f"book: {' and '.join(names) or 'nothing'}, {len(faults)} faults", flush=True)


def _make_pages(settings: Settings, edition: Edition) -> list[str]:
    """The pages; they take the place of the old ones even if something is wrong with them."""
    outcome = run_sphinx(settings, edition, "html", _aside(settings, f"html-{edition}"))
    if outcome.crashed:
        return list(outcome.warnings) or ["sphinx failed"]
    pages = settings.pages(edition)
    shutil.rmtree(pages, ignore_errors=True)
    outcome.folder.rename(pages)
    faults = [*outcome.warnings, *link_faults(pages)]
    if settings.draft:
        return faults  # half a book gives no whole file
    return [*faults, *text_faults(pages, Reader(load_tree(settings.root), edition))]


def _finish(settings: Settings, edition: Edition) -> list[str]:
    """The book as one page, on paper, and the checks that take longer."""
    single = run_sphinx(settings, edition, "singlehtml", _aside(settings, f"single-{edition}"))
    if single.warnings or single.crashed:
        return list(single.warnings) or ["sphinx failed"]
    numbers = print_pdf(single.folder / "index.html", settings.pdf(edition))
    pages = settings.pages(edition)
    reader = Reader(load_tree(settings.root), edition)
    faults = render_faults(settings.root, pages, reader)
    if edition is Edition.STUDENT:
        faults += _leaks(settings.root, pages)
    return faults + list(_changes(settings, edition, numbers))


def _leaks(root: Path, artefact: Path) -> Iterator[str]:
    report = scan(artefact, checkout_secrets(root))
    yield from map(str, report.leaks)
    yield from report.unread


def _changes(settings: Settings, edition: Edition, numbers: PageNumbers) -> Iterator[str]:
    """What is not the same when it is made again: pages and PDF."""
    again = run_sphinx(settings, edition, "html", _aside(settings, f"again-{edition}")).folder
    single = run_sphinx(settings, edition, "singlehtml", _aside(settings, f"single-{edition}"))
    pdf = settings.pdf(edition)
    print_pdf(single.folder / "index.html", again / pdf.name, numbers)
    first, second = digests(settings.pages(edition)), digests(again)
    for name in sorted(first.keys() | second.keys()):
        if first.get(name) != second.get(name):
            yield f"{name}: made twice, it is not the same"


def digests(folder: Path) -> dict[str, str]:
    """The hash of every file in a folder, by its name there."""
    return {
        file.relative_to(folder).as_posix(): hashlib.sha256(file.read_bytes()).hexdigest()
        for file in sorted(folder.rglob("*"))
        if file.is_file()
    }


def _aside(settings: Settings, name: str) -> Path:
    return settings.out / ".work" / name
