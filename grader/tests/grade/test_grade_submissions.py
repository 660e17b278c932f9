"""Which submissions there are, and that only their owned files are ever read."""

from __future__ import annotations

import io
import os
import stat
import tarfile
import zipfile
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pytest

from raybook_grader.errors import BadInput
from raybook_grader.submissions import Submission, find_submissions
from raybook_grader.submissions import archive as archives
from raybook_grader.submissions.submission import SIZE_LIMIT

OWNED = ("src/shapes/triangle.c", "src/accel/bvh.c")
FILE = OWNED[0]

Members = Iterable[tuple[Any, bytes]]
"""Names, or the archive library's own headers, with contents."""
Write = Callable[[Path, Members], None]


def write_zip(file: Path, members: Members) -> None:
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members:
            archive.writestr(name, content)


def write_tar(file: Path, members: Members) -> None:
    with tarfile.open(file, "w:gz") as archive:
        for name, content in members:
            member = tarfile.TarInfo(name) if isinstance(name, str) else name
            member.size = len(content)
            archive.addfile(member, io.BytesIO(content))


BOTH = pytest.mark.parametrize(
    ("name", "write"), [("s01.zip", write_zip), ("s01.tar.gz", write_tar)]
)


def only(folder: Path) -> Submission:
    """The one submission of a folder."""
    (found,), _ = find_submissions(folder, OWNED)
    return found


def contents(submission: Submission) -> dict[str, bytes | None]:
    """What was read; None for what was refused."""
    return {p: None if f.refusal else f.content for p, f in submission.files.items()}


@pytest.mark.parametrize("inside", ["", "work/", "./work/"])
@BOTH
def test_at_the_top_or_in_one_folder(tmp_path: Path, name: str, write: Write, inside: str) -> None:
    members = [(inside + FILE, b"int a;"), (inside + "Makefile", b"x"), ("notes.txt", b"y")]
    write(tmp_path / name, members)
    found = only(tmp_path)
    assert (found.id, found.problem) == ("s01", None)
    assert contents(found) == {FILE: b"int a;"}


@BOTH
@pytest.mark.parametrize(
    "odd",
    [f"../{FILE}", f"/{FILE}", f"a/../{FILE}", f"a/b/{FILE}", f"{FILE}/x", f"src//shapes/{FILE}"],
)
def test_odd_names_are_not_ours(tmp_path: Path, name: str, write: Write, odd: str) -> None:
    write(tmp_path / name, [(odd, b"evil")])
    found = only(tmp_path)
    assert (found.files, found.problem) == ({}, None)
    assert [entry.name for entry in tmp_path.iterdir()] == [name]


def test_a_folder_on_disk(tmp_path: Path) -> None:
    for place in ("s01", "s02/inner"):
        file = tmp_path / place / FILE
        file.parent.mkdir(parents=True)
        file.write_bytes(place.encode())
    found, _ = find_submissions(tmp_path, OWNED)
    assert [contents(s) for s in found] == [{FILE: b"s01"}, {FILE: b"s02/inner"}]


def test_two_folders_are_one_too_many(tmp_path: Path) -> None:
    write_zip(tmp_path / "s01.zip", [(f"a/{FILE}", b"1"), (f"b/{OWNED[1]}", b"2")])
    problem = only(tmp_path).problem
    assert problem is not None and "'a' and 'b'" in problem


@BOTH
@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_a_duplicate_is_refused(tmp_path: Path, name: str, write: Write) -> None:
    write(tmp_path / name, [(FILE, b"good"), (FILE, b"evil")])
    refusal = only(tmp_path).files[FILE].refusal
    assert refusal is not None and "more than once" in refusal


def test_links_in_archives_are_refused(tmp_path: Path) -> None:
    link = tarfile.TarInfo(FILE)
    link.type, link.linkname = tarfile.SYMTYPE, "/etc/passwd"
    write_tar(tmp_path / "s01.tar.gz", [(link, b"")])
    member = zipfile.ZipInfo(FILE)
    member.create_system = 3
    member.external_attr = (stat.S_IFLNK | 0o777) << 16
    write_zip(tmp_path / "s02.zip", [(member, b"/etc/passwd")])
    found, _ = find_submissions(tmp_path, OWNED)
    assert [contents(s) for s in found] == [{FILE: None}, {FILE: None}]


def test_links_pipes_and_folders_on_disk_are_refused(tmp_path: Path) -> None:
    secret = tmp_path / "secret.c"
    secret.write_text("secret")
    for number in range(4):
        (tmp_path / f"class/s{number}/src/shapes").mkdir(parents=True)
    (tmp_path / "class/s0" / FILE).symlink_to(secret)
    os.mkfifo(tmp_path / "class/s1" / FILE)
    (tmp_path / "class/s2" / FILE).mkdir()
    (tmp_path / "class/s3/src/shapes").rmdir()
    (tmp_path / "real").mkdir()
    (tmp_path / "real/triangle.c").write_text("secret")
    (tmp_path / "class/s3/src/shapes").symlink_to(tmp_path / "real")
    found, _ = find_submissions(tmp_path / "class", OWNED)
    assert not any(file.content for s in found for file in s.files.values())
    assert all(s.files[FILE].refusal for s in found[:3])


@pytest.mark.parametrize("size", [SIZE_LIMIT, SIZE_LIMIT + 1])
def test_the_size_limit(tmp_path: Path, size: int) -> None:
    write_zip(tmp_path / "s01.zip", [(FILE, b"x" * size)])
    write_tar(tmp_path / "s02.tar.gz", [(FILE, b"x" * size)])
    file = tmp_path / "s03" / FILE
    file.parent.mkdir(parents=True)
    file.write_bytes(b"x" * size)
    found, _ = find_submissions(tmp_path, OWNED)
    assert {s.files[FILE].refusal is None for s in found} == {size == SIZE_LIMIT}


def test_bombs_do_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(archives, "UNPACKED_LIMIT", 4 << 20)
    monkeypatch.setattr(archives, "MEMBER_LIMIT", 100)
    zeros = b"\0" * (8 << 20)
    write_zip(tmp_path / "s01.zip", [("bomb", zeros), (FILE, b"int a;")])
    write_tar(tmp_path / "s02.tar.gz", [("bomb", zeros), (FILE, b"int a;")])
    write_zip(tmp_path / "s03.zip", [(str(i), b"") for i in range(101)])
    found, _ = find_submissions(tmp_path, OWNED)
    assert contents(found[0]) == {FILE: b"int a;"}, "a member that nobody asks for is not unpacked"
    assert [s.problem and "more than" in s.problem for s in found[1:]] == [True, True]


@pytest.mark.parametrize("name", ["s01.zip", "s01.tar.gz", "s01.tgz"])
@pytest.mark.parametrize("cut", [0, 10, 60])
def test_damage_costs_only_its_student(tmp_path: Path, name: str, cut: int) -> None:
    write = write_zip if name.endswith(".zip") else write_tar
    write(tmp_path / name, [(FILE, os.urandom(2000))])
    whole = (tmp_path / name).read_bytes()
    (tmp_path / name).write_bytes(whole[:cut])
    write_zip(tmp_path / "s02.zip", [(FILE, b"fine")])
    found, _ = find_submissions(tmp_path, OWNED)
    assert found[0].problem is not None and not found[0].files
    assert contents(found[1]) == {FILE: b"fine"}


def test_ids_and_what_is_passed_over(tmp_path: Path) -> None:
    for name in ("s01.zip", "s02.zip"):
        write_zip(tmp_path / name, [(FILE, b"")])
    for folder in ("s02", ".git", "<b>"):
        (tmp_path / folder).mkdir()
    os.mkdir(os.fsencode(tmp_path) + b"/\xff")
    (tmp_path / "README.txt").touch()
    (tmp_path / "link").symlink_to("/etc")
    found, ignored = find_submissions(tmp_path, OWNED)
    assert [s.id for s in found] == ["<b>", "\\xff", "s01", "s02", "s02.zip"]
    assert ignored == ["README.txt", "link"]


def test_no_submission_is_bad_input(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="no submission"):
        find_submissions(tmp_path, OWNED)
