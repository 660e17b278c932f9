"""A safe file name for any submission."""

from __future__ import annotations

import hashlib
import re

_LONGEST = 80


def page_name(submission: str) -> str:
    """The name of a submission's page: its id where that is a plain word.

    Anything else is made plain and gets a hash of the id, so that no two share a page.
    """
    plain = re.sub(r"[^A-Za-z0-9._-]+", "_", submission).strip("._")[:_LONGEST]
    if plain and plain == submission:
        return f"{plain}.html"
    mark = hashlib.sha256(submission.encode("utf-8", "surrogatepass")).hexdigest()[:8]
    return f"{plain or 'submission'}-{mark}.html"
