"""Writing a report: `build/report/report.html`, and the PDF of it."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from pathlib import Path

from ...errors import BadInput
from ...files import write_bytes, write_text
from ..findings import Finding
from .page import page_html
from .renderings import Renderer

SOURCE = "report.md"
_FOLDER = Path("build/report")


def write_report(
    root: Path, program: Path, check: Callable[[], Sequence[Finding]]
) -> tuple[list[Path], str]:
    """The files, relative to ``root``, and why there is no PDF ("" if there is one)."""
    source = root / SOURCE
    if not source.is_file():
        raise BadInput(f"{source}: does not exist, expected the text of the report")
    text = source.read_text(encoding="utf-8")
    html = page_html(text, Renderer(program, root), check)
    (root / _FOLDER).mkdir(parents=True, exist_ok=True)
    written = [_FOLDER / "report.html"]
    write_text(root / written[0], html)
    pdf, reason = _pdf(html, root)
    if pdf:
        written.append(_FOLDER / "report.pdf")
        write_bytes(root / written[1], pdf)
    return written, reason


def _pdf(html: str, root: Path) -> tuple[bytes, str]:
    # Its advice on CSS properties that it does not know is not the student's concern.
    logging.getLogger("weasyprint").setLevel(logging.ERROR)
    logging.getLogger("fontTools").setLevel(logging.ERROR)
    try:
        from weasyprint import HTML  # loads Pango, which other systems may lack
    except OSError as fault:
        return b"", f"no PDF: the library Pango is missing ({fault})"
    return HTML(string=html, base_url=str(root)).write_pdf() or b"", ""
