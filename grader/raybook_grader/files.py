"""Writing a file so that it is complete or absent."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path


def write_bytes(file: Path, content: bytes) -> None:
    """Write aside, then rename; the folder must exist."""
    descriptor, aside = tempfile.mkstemp(dir=file.parent, prefix=f".{file.name[:50]}.")
    try:
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(content)
        os.chmod(aside, 0o644)
        os.replace(aside, file)
    except BaseException:
        Path(aside).unlink(missing_ok=True)
        raise


def write_text(file: Path, text: str) -> None:
    """`write_bytes` in UTF-8; what is no valid Unicode becomes a question mark."""
    write_bytes(file, text.encode("utf-8", "replace"))
