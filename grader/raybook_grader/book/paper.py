"""The book as one PDF, by Chromium, with a table of contents that has page numbers."""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from importlib.resources import files
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

from ..errors import BadInput
from ..files import write_bytes

_DATE = re.compile(rb"/(CreationDate|ModDate) \(D:[^)]*\)")
_DESTINATION = re.compile(r'\s*(\d+) \[.*\] "(print-\d+)"')
_FOOT = (
    '<div style="width: 100%; font: 8px sans-serif; color: #666; text-align: center">'
    '<span class="pageNumber"></span></div>'
)


PageNumbers = dict[str, str]
"""By the id of a heading in the table of contents."""


def print_pdf(page: Path, out: Path, numbers: PageNumbers | None = None) -> PageNumbers:
    """Print a page in light colours; the bytes depend on the page alone.

    Returns the page numbers of the contents; who knows them saves one of two prints.
    """
    program = shutil.which("chromium")
    if not program:
        raise BadInput("chromium is not there: run `make setup`")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        sheet = browser.new_page(color_scheme="light")
        sheet.goto(page.resolve().as_uri())
        sheet.evaluate("() => document.fonts.ready.then(() => true)")
        if numbers is None:
            numbers = _destinations(_printed(sheet, {}))
        data = _printed(sheet, numbers)
        browser.close()
    write_bytes(out, _without_dates(data))
    return numbers


def _printed(sheet: Page, numbers: PageNumbers) -> bytes:
    script = files(__package__ or "").joinpath("static", "print.js")
    sheet.evaluate(script.read_text(encoding="utf-8"), numbers)
    return sheet.pdf(
        prefer_css_page_size=True, print_background=True, outline=True, tagged=True,
        display_header_footer=True, header_template="<span></span>", footer_template=_FOOT,
    )  # fmt: skip


def _destinations(data: bytes) -> PageNumbers:
    """The page of each heading, by poppler's pdfinfo."""
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


def _without_dates(data: bytes) -> bytes:
    """The dates replaced by one of the same length: a PDF counts its bytes."""

    def fixed(match: re.Match[bytes]) -> bytes:
        start = b"/" + match[1] + b" (D:"
        return start + b"20000101000000+00'00'"[: len(match[0]) - len(start) - 1] + b")"

    return _DATE.sub(fixed, data)
