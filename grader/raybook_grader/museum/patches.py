"""Applies a diff of one file to that file's contents."""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path, PurePosixPath

from ..errors import BadInput


def target_of(diff: str) -> PurePosixPath:
    """The file that a diff changes, below the checkout: it begins with `--- a/src/...`."""
    return PurePosixPath(diff.splitlines()[0].removeprefix("--- a/").split("\t")[0])


def patched(patch: Path, diff: str, target: PurePosixPath, content: bytes) -> bytes:
    """The target with the diff applied to the letter: it may have moved, but not have changed.

    Raises `BadInput`, which names ``patch``, if the diff does not apply to ``content``.
    """
    with tempfile.TemporaryDirectory(prefix="museum") as scratch:
        file = Path(scratch, target)
        file.parent.mkdir(parents=True)
        file.write_bytes(content)
        done = subprocess.run(
            ["patch", "-p1", "--batch", "--forward", "--fuzz=0", "--no-backup-if-mismatch",
             "--directory", scratch],
            input=diff, capture_output=True, text=True, check=False,
        )  # fmt: skip
        left = [p for p in Path(scratch).rglob("*") if p.is_file() and p != file]
        if done.returncode != 0 or left:
            raise BadInput(f"{patch}: no longer applies to {target}:\n{done.stdout}{done.stderr}")
        return file.read_bytes()
