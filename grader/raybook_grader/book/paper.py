"""The book as one PDF, by Chromium, with a table of contents that has page numbers."""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.resources import files
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

from ..errors import BadInput
from ..files import write_bytes
from .pdf_file import sealed

_DESTINATION = re.compile(r'\s*(\d+) \[.*\] "(.+)"')
_FOOT = (
    '<div style="width: 100%; font: 8px sans-serif; color: #666; text-align: center">'
    '<span class="pageNumber"></span></div>'
)
_PRINTS = 4  # one settles the numbers, but for a contents that grows by a page
# Typefaces and pictures come when they are first needed, which may be too late for the print.
_ALL_THERE = """async () => {
  await Promise.all([...document.fonts].map((face) => face.load()));
  await Promise.all([...document.images].map((image) => image.decode()));
  await document.fonts.ready;
}"""


PageNumbers = dict[str, str]
"""By the id of what a link leads to."""


def print_pdf(page: Path, out: Path, numbers: PageNumbers | None = None) -> PageNumbers:
    """Print a page in light colours; the bytes depend on the page alone.

    Returns the page numbers of the contents. Who knows or remembers `numbers` saves a print, if
    they still hold; a print with numbers that don't is never kept.
    """
    if numbers is None:
        with sheet_of(page) as sheet:
            numbers = _destinations(_plain(sheet))
    for _ in range(_PRINTS):
        # A fresh sheet: one that was filled before is laid out by its history, a hair otherwise.
        with sheet_of(page) as sheet:
            data = printed(sheet, numbers)
        before, numbers = numbers, _destinations(data)
        if numbers == before:
            write_bytes(out, sealed(data))
            return numbers
    raise BadInput(f"{out.name}: the page numbers of the contents do not settle")


@contextmanager
def sheet_of(page: Path) -> Iterator[Page]:
    """The page, with all that belongs to it, as it is on paper."""
    program = shutil.which("chromium")
    if not program:
        raise BadInput("chromium is not there: run `make setup`")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        sheet = browser.new_page(color_scheme="light")
        sheet.set_default_timeout(0)  # on a busy machine this takes what it takes
        sheet.emulate_media(media="print")
        sheet.goto(page.resolve().as_uri())
        sheet.evaluate(_ALL_THERE)
        yield sheet
        browser.close()


def _plain(sheet: Page) -> bytes:
    """Pages as they will be, without what only a program reads in a PDF."""
    _prepare(sheet, {})
    return sheet.pdf(prefer_css_page_size=True, print_background=True)


def printed(sheet: Page, numbers: PageNumbers) -> bytes:
    """The book with these page numbers in its contents, as Chromium gives it."""
    _prepare(sheet, numbers)
    return sheet.pdf(
        prefer_css_page_size=True, print_background=True, outline=True, tagged=True,
        display_header_footer=True, header_template="<span></span>", footer_template=_FOOT,
    )  # fmt: skip


def _prepare(sheet: Page, numbers: PageNumbers) -> None:
    script = files(__package__ or "").joinpath("static", "print.js")
    sheet.evaluate(script.read_text(encoding="utf-8"), numbers)


def _destinations(data: bytes) -> PageNumbers:
    """The page of all that is linked to, by poppler's pdfinfo."""
    with tempfile.NamedTemporaryFile(suffix=".pdf") as file:
        file.write(data)
        file.flush()
        command = ["pdfinfo", "-dests", file.name]
        try:
            run = subprocess.run(command, capture_output=True, text=True, check=True)
        except FileNotFoundError:
            raise BadInput("pdfinfo (poppler-utils) is not there: run `make setup`") from None
    found = map(_DESTINATION.match, run.stdout.splitlines())
    return {match[2]: match[1] for match in found if match}
