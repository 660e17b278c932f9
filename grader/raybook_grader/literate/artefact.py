"""Reads whatever a student may be given, down to the texts in it.

A folder, an archive in an archive, a web page, a search index or a PDF: each becomes documents,
and each document has readings, the ways in which its text may be meant.
"""

from __future__ import annotations

import bz2
import gzip
import html
import io
import lzma
import re
import subprocess
import tarfile
import tempfile
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from .git_history import UnreadableHistory, git_objects

# Pictures and fonts: compressed, so their bytes hold no text.
_NO_TEXT = (b"\x89PNG", b"\xff\xd8\xff", b"v/1\x01", b"GIF8", b"wOFF", b"wOF2")
_DECOMPRESS = {b"\x1f\x8b": gzip.decompress, b"BZh": bz2.decompress, b"\xfd7zXZ": lzma.decompress}
_TAG = re.compile(r"<[^<>]*>")
_ESCAPE = re.compile(r"\\(?:u([0-9a-fA-F]{4})|x([0-9a-fA-F]{2})|(.))")
_BAD_ARCHIVE = (zipfile.BadZipFile, tarfile.TarError, zlib.error, lzma.LZMAError)
_FAULTS = (*_BAD_ARCHIVE, OSError, EOFError, RuntimeError, NotImplementedError)


@dataclass(frozen=True)
class Document:
    """One file. A member of an archive is called `archive.zip!member`.

    `unread` says why the text of the document, or the members of it, could not be read.
    """

    name: str
    data: bytes
    text: str = ""
    unread: str | None = None

    def readings(self) -> list[str]:
        """The text as it is, and with the escapes of strings, tags and entities undone.

        All readings have the same line breaks.
        """
        plain = [self.text]
        if "\\" in self.text:
            plain.append(_ESCAPE.sub(_unescaped, self.text))
        marked_up = [text for text in plain if "<" in text or "&" in text]
        with_attributes = [_decode_entities(text) for text in marked_up]
        without_tags = [_decode_entities(_TAG.sub(_line_breaks, text)) for text in marked_up]
        return list(dict.fromkeys([*plain, *with_attributes, *without_tags]))


def documents(path: Path) -> Iterator[Document]:
    """Every document of a file or folder, by name. Raises FileNotFoundError if it isn't there."""
    if not path.exists():
        raise FileNotFoundError(f"{path}: no such file or folder to scan")
    if path.is_file():
        yield from _read(path.name, path.read_bytes())
        return
    for file in sorted(path.rglob("*")):
        if file.name == ".git":
            yield from _history(file.relative_to(path).as_posix(), file.parent)
        elif file.is_file() and ".git" not in file.relative_to(path).parts:
            yield from _read(file.relative_to(path).as_posix(), file.read_bytes())


def _history(name: str, folder: Path) -> Iterator[Document]:
    """All versions of all files of a repository, and its messages."""
    try:
        for kind, content in git_objects(folder):
            yield from _read(f"{name}!{kind}", content)
    except (UnreadableHistory, OSError) as fault:
        yield Document(name, b"", unread=str(fault))


def _read(name: str, data: bytes) -> Iterator[Document]:
    """The document with these bytes and, if it is an archive, each member of it."""
    try:
        members = _members(data)
    except _FAULTS as fault:
        yield Document(name, data, unread=f"{type(fault).__name__}: {fault}")
        return
    if members is not None:
        yield Document(name, data)
        for member, content in members:
            yield from _read(f"{name}!{member}", content)
    elif data.startswith(b"%PDF"):
        yield _pdf(name, data)
    elif data.startswith(_NO_TEXT):
        yield Document(name, data)
    else:
        encoding = "utf-16" if data.startswith((b"\xff\xfe", b"\xfe\xff")) else "utf-8"
        yield Document(name, data, data.decode(encoding, "ignore"))


def _members(data: bytes) -> list[tuple[str, bytes]] | None:
    """The members of an archive; None if it is none."""
    if data.startswith(b"PK\x03\x04"):
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return [(i.filename, archive.read(i)) for i in archive.infolist() if not i.is_dir()]
    for magic, decompress in _DECOMPRESS.items():
        if data.startswith(magic):
            return [("", decompress(data))]
    if data[257:262] == b"ustar":
        return _tar_members(data)
    return None


def _tar_members(data: bytes) -> list[tuple[str, bytes]]:
    with tarfile.open(fileobj=io.BytesIO(data)) as archive:
        files = [(m.name, archive.extractfile(m)) for m in archive.getmembers() if m.isfile()]
        return [(name, content.read()) for name, content in files if content is not None]


def _pdf(name: str, data: bytes) -> Document:
    """The text of a PDF, by poppler's pdftotext."""
    with tempfile.NamedTemporaryFile(suffix=".pdf") as file:
        file.write(data)
        file.flush()
        command = ["pdftotext", "-enc", "UTF-8", "-nopgbrk", file.name, "-"]
        try:
            run = subprocess.run(command, capture_output=True, check=True)
        except FileNotFoundError:
            return Document(name, data, unread="pdftotext (poppler-utils) is not installed")
        except subprocess.CalledProcessError as fault:
            return Document(name, data, unread=f"pdftotext: {fault.stderr.decode().strip()}")
    return Document(name, data, run.stdout.decode("utf-8", "ignore"))


def _unescaped(match: re.Match[str]) -> str:
    code = match[1] or match[2]
    character = chr(int(code, 16)) if code else match[3]
    blank = character in "\r\n" if code else character in "nrt"
    return " " if blank else character


def _decode_entities(text: str) -> str:
    # Line by line, so that &#10; adds no line.
    return "\n".join(html.unescape(line).replace("\n", " ") for line in text.split("\n"))


def _line_breaks(match: re.Match[str]) -> str:
    return "\n" * match[0].count("\n")
