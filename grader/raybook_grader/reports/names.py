"""Safe file names for the pages of any submission."""

from __future__ import annotations

import hashlib
import re

from ..database import Module

_LONGEST = 80


def page_name(submission: str) -> str:
    """The name of a submission's page: its id where that is a plain word.

    Anything else is made plain and gets a hash of the id, so that no two share a page.
    """
    return f"{folder_name(submission)}.html"


def module_page(submission: str, module: Module) -> str:
    """The page of one module, beside the submission's own page."""
    return f"{folder_name(submission)}/{_plain(f'{module.number}-{module.module}')}.html"


def folder_name(submission: str) -> str:
    """The folder of a submission's pages of modules."""
    plain = _plain(submission)
    if plain and plain == submission:
        return plain
    mark = hashlib.sha256(submission.encode("utf-8", "surrogatepass")).hexdigest()[:8]
    return f"{plain or 'submission'}-{mark}"


def _plain(text: str) -> str:
    return re.sub(r"[^A-Za-z0-9._-]+", "_", text).strip("._-")[:_LONGEST]
