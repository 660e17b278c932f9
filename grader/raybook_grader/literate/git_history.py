"""Every text that a git repository holds: all versions of all files, and all messages.

Also those that no branch reaches any more: whoever has the folder can still read them.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

_WANTED = (b"blob", b"commit", b"tag")


class UnreadableHistory(Exception):
    """The repository cannot be read; the text says why."""


def git_objects(folder: Path) -> Iterator[tuple[str, bytes]]:
    """The name ("blob 1a2b...") and content of each object of the repository of ``folder``.

    Raises `UnreadableHistory`, also where objects are kept elsewhere: in another repository, or
    on the server that a shallow or partial clone was made from.
    """
    for elsewhere in ("objects/info/alternates", "shallow"):
        if (folder / ".git" / elsewhere).exists():
            raise UnreadableHistory(f"part of the history is not in it ({elsewhere})")
    command = ["git", "--no-replace-objects", "-C", str(folder), "cat-file"]
    # A git around us, in a hook, names another repository; this one's settings are not trusted.
    environment = {k: v for k, v in os.environ.items() if not k.startswith("GIT_")}
    environment |= {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
    environment["GIT_CEILING_DIRECTORIES"] = str(folder.resolve().parent)
    run = subprocess.run(
        [*command, "--batch-all-objects", "--batch"], env=environment, capture_output=True
    )
    if run.returncode != 0:
        raise UnreadableHistory(f"git: {run.stderr.decode('utf-8', 'replace').strip()}")
    yield from _parse(run.stdout)


def _parse(output: bytes) -> Iterator[tuple[str, bytes]]:
    """Each object is a line "name kind size", its bytes and a line break."""
    place = 0
    while place < len(output):
        end = output.index(b"\n", place)
        words = output[place:end].split()
        if len(words) != 3:
            raise UnreadableHistory(f"git: {output[place:end].decode('utf-8', 'replace')}")
        name, kind, size = words
        content = output[end + 1 : end + 1 + int(size)]
        place = end + 1 + int(size) + 1
        if kind in _WANTED:
            yield f"{kind.decode()} {name.decode()[:12]}", content
