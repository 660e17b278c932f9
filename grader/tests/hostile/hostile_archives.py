"""Submissions whose packing is the attack."""

from __future__ import annotations

import gzip
import io
import os
import stat
import struct
import tarfile
import zipfile
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from hostile_case import OWNED, RIGHT, Case, Expect, Write

GOOD = RIGHT.encode()
UNREAD = Expect("missing", "")
FULL = Expect("pass", "PPPPP")

Members = Callable[[], Iterable[tuple[Any, bytes]]]
"""Names, or the archive library's own headers, with contents; made when written."""


def zipped(members: Members, method: int = zipfile.ZIP_DEFLATED) -> Write:
    def write(folder: Path, name: str) -> None:
        with zipfile.ZipFile(folder / f"{name}.zip", "w", method) as archive:
            for member, content in members():
                archive.writestr(member, content)

    return write


def tarred(members: Members) -> Write:
    def write(folder: Path, name: str) -> None:
        with tarfile.open(folder / f"{name}.tar.gz", "w:gz", compresslevel=1) as archive:
            for member, content in members():
                header = tarfile.TarInfo(member) if isinstance(member, str) else member
                header.size = len(content)
                archive.addfile(header, io.BytesIO(content))

    return write


def bytes_of(suffix: str, content: Callable[[], bytes]) -> Write:
    def write(folder: Path, name: str) -> None:
        (folder / f"{name}{suffix}").write_bytes(content())

    return write


def special(kind: bytes, target: str = "") -> tarfile.TarInfo:
    """A tar member of the owned file's name that is no file."""
    member = tarfile.TarInfo(OWNED)
    member.type, member.linkname = kind, target
    return member


def folder_link() -> tarfile.TarInfo:
    member = tarfile.TarInfo("src2")
    member.type, member.linkname = tarfile.SYMTYPE, "/tmp"
    return member


def zip_link(target: str) -> zipfile.ZipInfo:
    member = zipfile.ZipInfo(OWNED)
    member.create_system = 3
    member.external_attr = (stat.S_IFLNK | 0o777) << 16
    member.comment = target.encode()
    return member


def encrypted() -> bytes:
    """A zip whose member says that it is encrypted."""
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w") as archive:
        archive.writestr(OWNED, GOOD)
    data = bytearray(whole.getvalue())
    for magic, flags in ((b"PK\3\4", 6), (b"PK\1\2", 8)):
        data[data.index(magic) + flags] |= 1
    return bytes(data)


def crowded_zip(members: int) -> bytes:
    """A zip that lists a great many members and holds none: the library reads the list at once."""
    entry = struct.pack("<4s6H3L5H2L", b"PK\1\2", *([0] * 16))
    end = struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 0xFFFF, 0xFFFF, members * len(entry), 0, 0)
    return entry * members + end


def long_header_tar() -> bytes:
    """A tar.gz with a pax header of 300 MiB, which libraries read into memory as a whole."""
    header = tarfile.TarInfo("pax")
    header.type, header.size = tarfile.XHDTYPE, 300 << 20
    packed = io.BytesIO()
    with gzip.open(packed, "wb", compresslevel=1) as stream:
        stream.write(header.tobuf())
        for _ in range(300):
            stream.write(bytes(1 << 20))
    return packed.getvalue()


def sparse_tar() -> bytes:
    """A tar.gz whose owned member is a sparse file of 1 TiB."""
    member = special(tarfile.GNUTYPE_SPARSE)
    block = bytearray(member.tobuf(tarfile.GNU_FORMAT))
    block[386:482] = bytes(96)
    block[386:410] = b"%011o\0%011o\0" % (0, 0)
    block[483:495] = b"\x80" + (1 << 40).to_bytes(11, "big")
    block[148:156] = b" " * 8
    block[148:156] = b"%06o\0 " % sum(block)
    return gzip.compress(bytes(block) + bytes(1024))


def links_on_disk(folder: Path, name: str) -> None:
    """A folder in which the way to the owned file is a link to another student's."""
    (folder / name / "src").mkdir(parents=True)
    (folder / name / "src" / "shapes").symlink_to("../../honest-wrong/src/shapes")


def pipe_on_disk(folder: Path, name: str) -> None:
    file = folder / name / OWNED
    file.parent.mkdir(parents=True)
    os.mkfifo(file)


# What other tools would run or read; each leaves a mark if anything here does.
PLANTED = {
    "conftest.py": b"open('/tmp/raybook-hostile-mark-conftest', 'w')",
    "sitecustomize.py": b"open('/tmp/raybook-hostile-mark-site', 'w')",
    "Makefile": b"x := $(shell touch /tmp/raybook-hostile-mark-make)\n",
    ".git/config": b"[core]\n\tfsmonitor = touch /tmp/raybook-hostile-mark-git\n",
    "@options.c": b"-fplugin=./evil.so",
    "-fplugin=.": b"",
    "build/kit/kit.json": b"{}",
    "assignments/01-triangle/assignment.toml": b"points = 1000",
    "assignments/01-triangle/hidden/oracle_triangle.py": b"judge = lambda *_: []",
    "grader/raybook_grader/__init__.py": b"open('/tmp/raybook-hostile-mark-package', 'w')",
}
SHADOWS = {
    "src/shapes/triangle.h": b"#error shadowed\n",
    "src/base/ray.h": b"#error shadowed\n",
    "src/stdbool.h": b"#error shadowed\n",
    "src/shapes/stdio.h": b"#error shadowed\n",
}
OBJECTS = {
    "src/shapes/triangle.o": b"\x7fELF",
    "build/obj/release-gcc/shapes/triangle.o": b"\x7fELF",
    "src/accel/bvh.c": b"#error not of this assignment\n",
    "src/main.c": b"int main(void) { return 0; }\n",
}

CASES = [
    Case(
        "zip-slip",
        "members named ../ and / beside the real one",
        FULL,
        write=zipped(
            lambda: [
                (f"../../{OWNED}", b"evil"),
                ("/tmp/raybook-hostile-mark-slip", b"evil"),
                (f"a/../../{OWNED}", b"evil"),
                (OWNED, GOOD),
            ]
        ),
        quick=True,
    ),
    Case(
        "tar-slip",
        "the same in a tar",
        FULL,
        write=tarred(
            lambda: [
                ("../raybook-hostile-mark-slip", b"evil"),
                ("/tmp/raybook-hostile-mark-slip", b"evil"),
                (OWNED, GOOD),
            ]
        ),
    ),
    Case(
        "tar-symlink",
        "the owned file is a symbolic link to a file of the machine",
        UNREAD.saying("is no regular file"),
        write=tarred(lambda: [(special(tarfile.SYMTYPE, "/etc/passwd"), b"")]),
        quick=True,
    ),
    Case(
        "tar-hard-link",
        "the owned file is a hard link to another's",
        UNREAD.saying("is no regular file"),
        write=tarred(lambda: [(special(tarfile.LNKTYPE, f"../honest-wrong/{OWNED}"), b"")]),
    ),
    Case(
        "zip-symlink",
        "a symbolic link in a zip",
        UNREAD.saying("is no regular file"),
        write=zipped(lambda: [(zip_link("/etc/passwd"), b"/etc/passwd")]),
    ),
    Case(
        "link-then-file",
        "a link to a folder, then a file through it",
        FULL,
        write=tarred(lambda: [(folder_link(), b""), (f"src2/{OWNED}", b"evil"), (OWNED, GOOD)]),
    ),
    Case(
        "tar-device",
        "a device node",
        UNREAD.saying("is no regular file"),
        write=tarred(lambda: [(special(tarfile.CHRTYPE), b"")]),
    ),
    Case(
        "tar-pipe",
        "a FIFO, on which a reader waits for ever",
        UNREAD.saying("is no regular file"),
        write=tarred(lambda: [(special(tarfile.FIFOTYPE), b"")]),
    ),
    Case(
        "links-on-disk",
        "a folder that is a link to another submission",
        UNREAD.saying("is a link"),
        write=links_on_disk,
        quick=True,
    ),
    Case(
        "pipe-on-disk",
        "a FIFO in a folder",
        UNREAD.saying("is no regular file"),
        write=pipe_on_disk,
    ),
    Case(
        "zip-bomb",
        "256 MiB of zeros in the owned file",
        UNREAD.saying("larger than 1 MiB"),
        write=zipped(lambda: [(OWNED, bytes(1 << 28))]),
    ),
    Case(
        "tar-bomb",
        "300 MiB of zeros before the owned file",
        UNREAD.saying("unpacks to more than 256 MiB"),
        write=tarred(lambda: [("zeros", bytes(300 << 20)), (OWNED, GOOD)]),
    ),
    Case(
        "tar-long-header",
        "a header of 300 MiB",
        UNREAD.saying("unpacks to more than 256 MiB"),
        write=bytes_of(".tar.gz", long_header_tar),
    ),
    Case(
        "tar-sparse",
        "a sparse file of 1 TiB",
        UNREAD.saying("is no regular file"),
        write=bytes_of(".tar.gz", sparse_tar),
    ),
    Case(
        "zip-crowd",
        "1,000,000 members, listed and not there",
        UNREAD.saying("lists more than 20000 members"),
        write=bytes_of(".zip", lambda: crowded_zip(1_000_000)),
    ),
    Case(
        "tar-crowd",
        "30,000 members",
        UNREAD.saying("lists more than 20000 members"),
        write=tarred(lambda: [(f"{i}", b"") for i in range(30_000)]),
    ),
    Case(
        "twice",
        "the owned file twice: which one is meant?",
        UNREAD.saying("more than once"),
        write=tarred(lambda: [(OWNED, GOOD), (OWNED, b"evil")]),
        quick=True,
    ),
    Case(
        "odd-names",
        "almost the owned name: case, dots, spaces, a null",
        UNREAD.saying("not in the submission"),
        write=tarred(
            lambda: [
                (OWNED.upper(), b"evil"),
                (OWNED + " ", b"evil"),
                (OWNED + ".", b"evil"),
                (f"src/./../{OWNED}", b"evil"),
                ("src\u2215shapes\u2215triangle.c", b"e"),
            ]
        ),
    ),
    Case(
        "two-folders",
        "two folders with an owned file each",
        UNREAD.saying("both hold files"),
        write=zipped(lambda: [(f"<b>a/{OWNED}", GOOD), (f"\x1b[31mb/{OWNED}", b"evil")]),
    ),
    Case(
        "encrypted",
        "an encrypted member",
        UNREAD.saying("encrypted"),
        write=bytes_of(".zip", encrypted),
    ),
    Case(
        "odd-method",
        "a compression that asks for gigabytes",
        UNREAD.saying("method other than store or deflate"),
        write=zipped(lambda: [(OWNED, GOOD)], zipfile.ZIP_LZMA),
    ),
    Case(
        "no-archive",
        "random bytes called .zip",
        UNREAD.saying("cannot be read"),
        write=bytes_of(".zip", lambda: b"\x1b[31mPK\3\4 no archive"),
    ),
    Case(
        "planted-files",
        "conftest.py, Makefile, .git/config, kit.json, an oracle",
        FULL,
        write=zipped(lambda: [*PLANTED.items(), (OWNED, GOOD)]),
    ),
    Case(
        "shadow-headers",
        "its own triangle.h, ray.h and stdbool.h",
        FULL,
        write=zipped(lambda: [*SHADOWS.items(), (OWNED, GOOD)]),
    ),
    Case(
        "prebuilt-objects",
        "objects and other modules' sources",
        FULL,
        write=zipped(lambda: [*OBJECTS.items(), (OWNED, GOOD)]),
    ),
]
