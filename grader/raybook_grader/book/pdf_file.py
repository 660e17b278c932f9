"""What Chromium prints, made the same every time and small.

Chromium numbers the cells of tables ("/ID (node00001538)") with a counter that also counts what
it has painted on the screen while the page was loading: on a busy machine it starts elsewhere.
And it writes each of the 100,000 parts of the reading order as plain text; packed together and
compressed they need a twentieth.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from ..errors import BadInput

_DATE = re.compile(rb"/(CreationDate|ModDate) \(D:[^)]*\)")
_NODE = re.compile(rb"\(node(\d{8})\)")


def sealed(data: bytes) -> bytes:
    """The file without the time and without the counts of the browser that made it, packed."""
    return _packed(renumbered(_without_dates(data)))


def renumbered(data: bytes) -> bytes:
    """The nodes' numbers replaced by 1, 2, 3 ... in their order, of the same length: a PDF counts
    its bytes, and lists its nodes by name."""
    names = sorted(set(_NODE.findall(data)))
    new = {name: b"(node%08d)" % number for number, name in enumerate(names, 1)}
    return _NODE.sub(lambda match: new[match[1]], data)


def _without_dates(data: bytes) -> bytes:
    """The dates replaced by one of the same length."""

    def fixed(match: re.Match[bytes]) -> bytes:
        start = b"/" + match[1] + b" (D:"
        return start + b"20000101000000+00'00'"[: len(match[0]) - len(start) - 1] + b")"

    return _DATE.sub(fixed, data)


def _packed(data: bytes) -> bytes:
    """With object streams (PDF 1.5), by qpdf; nothing that is seen changes."""
    if not shutil.which("qpdf"):
        raise BadInput("qpdf is not there: run `.setup/setup.sh book`")
    with tempfile.TemporaryDirectory(prefix="raybook-") as folder:
        plain, packed = Path(folder, "plain.pdf"), Path(folder, "packed.pdf")
        plain.write_bytes(data)
        command = ["qpdf", "--object-streams=generate", "--deterministic-id",
                   str(plain), str(packed)]  # fmt: skip
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise BadInput(f"qpdf: {done.stderr.strip()[-600:]}")
        return packed.read_bytes()
