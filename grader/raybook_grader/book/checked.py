"""One edition, made and checked.

A check runs once for each content that it may find: its verdict is kept (see `kept`).
"""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Iterator
from contextlib import AbstractContextManager
from pathlib import Path

from ..literate.leaks import scan
from ..literate.secrets import checkout_secrets
from ..literate.tree import load_tree
from .editions import Edition, Reader
from .kept import Kept, digests, key_of, sources_key
from .links import link_faults
from .paper import PageNumbers, print_pdf
from .round_trip import render_faults, text_faults
from .source_checks import source_faults
from .sphinx_run import Outcome, Settings, run_sphinx
from .steps import Steps
from .untangle import untangle

_PROGRAMS = ("Makefile", "src", "scenes", "grader/raybook_grader")
_WEAVER = ("grader/raybook_grader/book",)


class Checked:
    """The making of one edition."""

    def __init__(self, settings: Settings, edition: Edition, steps: Steps) -> None:
        self._settings, self._edition, self._steps = settings, edition, steps
        self._kept = Kept(settings.out / ".work" / "sound")
        self._sources = "" if settings.draft else sources_key(settings.root)

    def make(self) -> list[str]:
        """The faults; none if the edition is there and sound."""
        pages = self._settings.pages(self._edition)
        if self._is_sound(pages):
            with self._steps.step(self._edition, "sound, and nothing has changed since"):
                return []
        faults, outcome = self._pages(pages)
        if faults or self._settings.draft:
            return faults
        faults = self._finish(pages, outcome)
        if not faults:
            self._kept.keep(self._edition, self._whole(pages))
        return faults

    def _is_sound(self, pages: Path) -> bool:
        asked = self._settings.draft or self._settings.accept
        return not asked and self._kept.has(self._edition, self._whole(pages))

    def _whole(self, pages: Path) -> str:
        return key_of(self._sources, digests(pages))

    def _pages(self, pages: Path) -> tuple[list[str], Outcome]:
        """The pages; they take the place of the old ones even if something is wrong with them."""
        with self._step("pages"):
            outcome = self._sphinx("html", "html")
        if outcome.crashed:
            return list(outcome.warnings) or ["sphinx failed"], outcome
        shutil.rmtree(pages, ignore_errors=True)
        outcome.folder.rename(pages)
        with self._step("links"):
            faults = [*outcome.warnings, *link_faults(pages)]
        if self._settings.draft:
            return faults, outcome  # half a book gives no whole file
        with self._step("round trip: the text"):
            return [*faults, *text_faults(pages, self._reader())], outcome

    def _finish(self, pages: Path, html: Outcome) -> list[str]:
        """The book as one page, on paper, and the checks that take longer."""
        with self._step("one page"):
            single = self._sphinx("singlehtml", "single", html.doctrees)
        if single.warnings or single.crashed:
            return list(single.warnings) or ["sphinx failed"]
        key = key_of(digests(single.folder), sources_key(self._settings.root, _WEAVER))
        printed = self._print(single, key)
        with self._step("round trip: the program"):
            faults = self._render_faults(pages)
        if self._edition is Edition.STUDENT:
            with self._step("search for solutions"):
                faults += self._leaks(pages)
            with self._step("student export, stubs"):
                faults += self._source_faults()
        return faults + list(self._changes(pages, single, key, printed))

    # Paper.

    def _print(self, single: Outcome, key: str) -> bool:
        """The PDF; returns whether it had to be printed: the same page gives the same paper."""
        out, kept = self._settings.pdf(self._edition), self._printed_before
        if kept.is_file() and self._kept.has(self._paper, key_of(key, _hash(kept))):
            shutil.copyfile(kept, out)
            return False
        with self._step("print"):
            numbers = print_pdf(single.folder / "index.html", out, self._numbers())
        self._numbers_file.write_text(json.dumps(numbers), encoding="utf-8")
        return True

    @property
    def _paper(self) -> str:
        return f"paper-{self._edition}"

    @property
    def _printed_before(self) -> Path:
        return self._settings.aside(f"{self._edition}.pdf")

    @property
    def _numbers_file(self) -> Path:
        return self._settings.aside(f"page-numbers-{self._edition}.json")

    def _numbers(self) -> PageNumbers | None:
        """The page numbers of the last print, which may still hold."""
        if not self._numbers_file.is_file():
            return None
        numbers: PageNumbers = json.loads(self._numbers_file.read_text(encoding="utf-8"))
        return numbers

    # The long checks.

    def _render_faults(self, pages: Path) -> list[str]:
        key = key_of(sources_key(self._settings.root, _PROGRAMS), untangle(pages))
        name = f"program-{self._edition}"
        if self._kept.has(name, key):
            return []
        faults = render_faults(self._settings.root, pages, self._reader())
        if not faults:
            self._kept.keep(name, key)
        return faults

    def _source_faults(self) -> list[str]:
        key = sources_key(self._settings.root, _PROGRAMS)
        if self._kept.has("source", key):
            return []
        faults = source_faults(self._settings.root, load_tree(self._settings.root))
        if not faults:
            self._kept.keep("source", key)
        return faults

    def _leaks(self, artefact: Path) -> list[str]:
        report = scan(artefact, checkout_secrets(self._settings.root))
        return [*map(str, report.leaks), *report.unread]

    def _changes(self, pages: Path, single: Outcome, key: str, printed: bool) -> Iterator[str]:
        """What is not the same when it is made again: pages, the one page, the PDF."""
        with self._step("all made again"):
            html = self._sphinx("html", "again-html")
            again = self._sphinx("singlehtml", "again-single", html.doctrees)
        pdf = self._settings.pdf(self._edition)
        first = {name: d for name, d in digests(pages).items() if name != pdf.name}
        changes = list(_different(first, digests(html.folder)))
        changes += _different(digests(single.folder), digests(again.folder), "one page: ")
        yield from changes
        if changes or not printed:
            return
        with self._step("printed again"):
            print_pdf(again.folder / "index.html", html.folder / pdf.name, self._numbers())
        if _hash(html.folder / pdf.name) != _hash(pdf):
            yield f"{pdf.name}: made twice, it is not the same"
            return
        shutil.copyfile(pdf, self._printed_before)
        self._kept.keep(self._paper, key_of(key, _hash(pdf)))

    # What these share.

    def _step(self, name: str) -> AbstractContextManager[None]:
        return self._steps.step(self._edition, name)

    def _sphinx(self, builder: str, name: str, doctrees: Path | None = None) -> Outcome:
        out = self._settings.aside(f"{name}-{self._edition}")
        return run_sphinx(self._settings, self._edition, builder, out, doctrees=doctrees)

    def _reader(self) -> Reader:
        return Reader(load_tree(self._settings.root), self._edition)


def _hash(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


def _different(first: dict[str, str], second: dict[str, str], where: str = "") -> Iterator[str]:
    for name in sorted(first.keys() | second.keys()):
        if first.get(name) != second.get(name):
            yield f"{where}{name}: made twice, it is not the same"
