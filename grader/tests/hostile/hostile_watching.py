"""What is looked at before and after: folders that must not change, and outputs to search."""

from __future__ import annotations

import base64
import binascii
import hashlib
import os
import re
import sqlite3
import zlib
from collections.abc import Iterable, Iterator, Mapping
from html.parser import HTMLParser
from pathlib import Path

MARK = "raybook-hostile-mark"
"""In the name of every file that a case makes outside of where it may."""

_SHARED = ("/", "/tmp", "/var/tmp", "/dev/shm", "/root", "/home", "/work", "/etc")
_BASE64 = re.compile(rb"[A-Za-z0-9+/]{40,}={0,2}")


def snapshot(folders: Iterable[Path]) -> dict[str, str]:
    """Every file, link and folder below, with its contents and rights."""
    return {name: what for folder in folders for name, what in _entries(folder)}


def _entries(top: Path) -> Iterator[tuple[str, str]]:
    for folder, folders, files in os.walk(top):
        folders[:] = [name for name in folders if name != "__pycache__"]
        for name in [*folders, *files]:
            path = Path(folder, name)
            about = path.lstat()
            content = path.read_bytes() if path.is_file() and not path.is_symlink() else b""
            yield str(path), f"{about.st_mode:o} {hashlib.sha256(content).hexdigest()}"


def marks_left(more: Iterable[Path] = ()) -> list[str]:
    """Files with the cases' mark in places that others write to as well."""
    return [
        str(path)
        for folder in [*map(Path, _SHARED), *more]
        if folder.is_dir()
        for path in folder.iterdir()
        if MARK in path.name
    ]


def found(canaries: Mapping[str, str], contents: Mapping[str, bytes]) -> list[str]:
    """Which canary is in which content, written plainly, in hexadecimal, in base64 or backwards."""
    return [
        f"{secret} in {place}"
        for place, content in contents.items()
        for secret, canary in canaries.items()
        if any(form in content for form in _forms(canary.encode()))
    ]


def _forms(canary: bytes) -> set[bytes]:
    # In base64 what stands before decides how a text looks, by its length modulo three.
    aligned = {
        base64.b64encode(canary[skip:])[: 4 * ((len(canary) - skip) // 3)] for skip in range(3)
    }
    plain = {canary, canary[::-1], canary.decode().encode("utf-16-le")}
    return plain | aligned | {binascii.hexlify(canary), binascii.hexlify(canary).upper()}


def outputs(folder: Path, printed: str) -> dict[str, bytes]:
    """All that a run leaves: its files, what the database holds packed, what pages hold packed."""
    contents = {str(p): p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    for name, content in [*contents.items()]:
        if name.endswith((".html", ".js")):
            unpacked = (_unpacked(match) for match in _BASE64.findall(content))
            contents[f"{name} unpacked"] = b"\n".join(unpacked)
    contents["printed"] = printed.encode()
    contents["database"] = b"\n".join(_database(folder / "grades.sqlite"))
    return contents


def _unpacked(text: bytes) -> bytes:
    try:
        plain = base64.b64decode(text + b"=" * (-len(text) % 4))
    except binascii.Error:
        return b""
    try:
        return plain + zlib.decompress(plain)
    except zlib.error:
        return plain


def _database(file: Path) -> Iterator[bytes]:
    database = sqlite3.connect(f"file:{file}?mode=ro", uri=True)
    tables = database.execute("SELECT name FROM sqlite_master WHERE type = 'table'").fetchall()
    for (table,) in tables:
        for row in database.execute(f"SELECT * FROM {table}"):
            for value in row:
                yield value if isinstance(value, bytes) else str(value).encode("utf-8", "replace")
                if isinstance(value, bytes):
                    yield zlib.decompress(value)
    database.close()


class Elements(HTMLParser):
    """What a browser would make of a page: the names of its elements and its handlers."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.names: set[str] = set()
        self.handlers: set[str] = set()
        self.scripts = ""
        self._script = False
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.add(tag)
        self.handlers |= {name for name, _ in attrs if name.startswith("on")}
        self._script = tag == "script"

    def handle_data(self, data: str) -> None:
        self.scripts += data if self._script else ""

    def handle_endtag(self, tag: str) -> None:
        self._script = False
