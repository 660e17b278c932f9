"""Reading a submission that is an archive: only owned members, so that a bomb does nothing.

Nothing is ever unpacked to disk. Links, devices, absolute names and names with `..` are left
alone; an owned file that appears twice is refused, for nobody can say which one was meant.
"""

from __future__ import annotations

import gzip
import io
import stat
import tarfile
import zipfile
from collections.abc import Collection
from pathlib import Path
from typing import BinaryIO

from .place import choose_folder, split_place
from .submission import SIZE_LIMIT, SubmittedFile, Unusable

ARCHIVE_LIMIT = 64 << 20
"""The largest archive that is opened, in bytes."""

UNPACKED_LIMIT = 256 << 20
"""How much of a `.tar.gz` is decompressed in search of the owned files, in bytes."""

MEMBER_LIMIT = 20_000
"""How many members an archive may list."""

_LISTED = b"PK\x01\x02"
"""Begins a member's entry in a zip's list (.ZIP File Format Specification, section 4.3.12)."""

SUFFIXES = (".zip", ".tar.gz", ".tgz")


def read_archive(file: Path, owned: Collection[str]) -> dict[str, SubmittedFile]:
    """The owned files of an archive. Raises `Unusable` for anything that is not one."""
    if file.stat().st_size > ARCHIVE_LIMIT:
        raise Unusable(f"the archive is larger than {ARCHIVE_LIMIT >> 20} MiB")
    found = _Found(owned)
    try:
        if file.name.endswith(".zip"):
            _read_zip(file, found)
        else:
            _read_tar(file, found)
    except Unusable:
        raise
    # The archive libraries raise a score of types on damaged input, some of them by accident.
    except Exception as error:
        raise Unusable(f"the archive cannot be read ({error or type(error).__name__})") from error
    return found.chosen()


class _Found:
    """The owned members met so far, by the folder that they lie in."""

    def __init__(self, owned: Collection[str]) -> None:
        self._owned = owned
        self._places: dict[str, dict[str, SubmittedFile]] = {}
        self._members = 0

    def meet(self, name: str) -> tuple[str, str] | None:
        """Count a member; where it belongs if it is an owned file."""
        self._members += 1
        if self._members > MEMBER_LIMIT:
            raise Unusable(f"the archive lists more than {MEMBER_LIMIT} members")
        return split_place(name, self._owned)

    def add(self, place: tuple[str, str], content: bytes | None) -> None:
        """Keep an owned member; None stands for one that is no plain file."""
        folder, path = place
        files = self._places.setdefault(folder, {})
        if path in files:
            files[path] = SubmittedFile(refusal=f"{path}: is in the archive more than once")
        elif content is None:
            files[path] = SubmittedFile(refusal=f"{path}: is no regular file")
        elif len(content) > SIZE_LIMIT:
            files[path] = SubmittedFile(refusal=f"{path}: is larger than {SIZE_LIMIT >> 20} MiB")
        else:
            files[path] = SubmittedFile(content)

    def chosen(self) -> dict[str, SubmittedFile]:
        folder = choose_folder(self._places)
        return {} if folder is None else self._places[folder]


def _read_zip(file: Path, found: _Found) -> None:
    # The library reads the list of members at once, however long it is.
    if file.read_bytes().count(_LISTED) > MEMBER_LIMIT:
        raise Unusable(f"the archive lists more than {MEMBER_LIMIT} members")
    with zipfile.ZipFile(file) as archive:
        for member in archive.infolist():
            # Some Windows tools store backslashes, against the format's rules.
            place = found.meet(member.filename.replace("\\", "/"))
            if place is not None:
                found.add(place, _zip_content(archive, member))


def _zip_content(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> bytes | None:
    kind = stat.S_IFMT(member.external_attr >> 16)
    if member.is_dir() or kind not in (0, stat.S_IFREG):
        return None
    # The other methods may ask for gigabytes of memory before they give the first byte.
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise Unusable(f"{member.filename!r} is packed by a method other than store or deflate")
    with archive.open(member) as stream:
        return stream.read(SIZE_LIMIT + 1)


def _read_tar(file: Path, found: _Found) -> None:
    with gzip.open(file, "rb") as unpacked:
        stream = io.BufferedReader(_Limited(unpacked), 1 << 20)
        with tarfile.open(fileobj=stream, mode="r|") as archive:
            for member in archive:
                place = found.meet(member.name)
                if place is not None:
                    found.add(place, _tar_content(archive, member))


def _tar_content(archive: tarfile.TarFile, member: tarfile.TarInfo) -> bytes | None:
    if member.type not in (tarfile.REGTYPE, tarfile.AREGTYPE) or member.issparse():
        return None
    stream = archive.extractfile(member)
    return None if stream is None else stream.read(SIZE_LIMIT + 1)


class _Limited(io.RawIOBase):
    """The decompressed bytes of an archive, up to `UNPACKED_LIMIT`."""

    def __init__(self, source: BinaryIO | gzip.GzipFile) -> None:
        self._source = source
        self._left = UNPACKED_LIMIT

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: bytearray | memoryview) -> int:  # type: ignore[override]
        piece = self._source.read(len(buffer))
        self._left -= len(piece)
        if self._left < 0:
            raise Unusable(f"the archive unpacks to more than {UNPACKED_LIMIT >> 20} MiB")
        buffer[: len(piece)] = piece
        return len(piece)
