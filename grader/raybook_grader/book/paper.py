"""The book as one PDF, by Chromium."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

from playwright.sync_api import sync_playwright

from ..errors import BadInput
from ..files import write_bytes

_DATE = re.compile(rb"/(CreationDate|ModDate) \(D:[^)]*\)")
_FOOT = (
    '<div style="width: 100%; font: 8px sans-serif; color: #666; text-align: center">'
    '<span class="pageNumber"></span></div>'
)


def print_pdf(page: Path, out: Path) -> None:
    """Print a page, folded parts open, in light colours; the bytes depend on the page alone."""
    program = shutil.which("chromium")
    if not program:
        raise BadInput("chromium is not there: run `make setup`")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        sheet = browser.new_page(color_scheme="light")
        sheet.goto(page.resolve().as_uri())
        sheet.evaluate("() => document.querySelectorAll('details').forEach(d => { d.open = true })")
        sheet.evaluate("() => document.fonts.ready.then(() => true)")
        data = sheet.pdf(
            prefer_css_page_size=True, print_background=True, outline=True, tagged=True,
            display_header_footer=True, header_template="<span></span>", footer_template=_FOOT,
        )  # fmt: skip
        browser.close()
    write_bytes(out, _without_dates(data))


def _without_dates(data: bytes) -> bytes:
    """The dates replaced by one of the same length: a PDF counts its bytes."""

    def fixed(match: re.Match[bytes]) -> bytes:
        start = b"/" + match[1] + b" (D:"
        return start + b"20000101000000+00'00'"[: len(match[0]) - len(start) - 1] + b")"

    return _DATE.sub(fixed, data)
