"""Full disks, folders that cannot be written, damaged files: clear words, and nothing lost."""

from __future__ import annotations

import errno
import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from policy_fixtures import Command
from policy_fixtures import course as course
from policy_fixtures import grade as grade
from policy_fixtures import grader as grader
from tiny_course import grades, hand_in

from raybook_grader.files import write_text as really_write
from raybook_grader.grading import export
from raybook_grader.reports import pages

HERE = Path(__file__).parent
NAMESPACE = ["unshare", "--user", "--map-root-user", "--mount"]


def test_a_disk_that_is_full_or_read_only(tmp_path: Path) -> None:
    trial = [*NAMESPACE, "mount", "-t", "tmpfs", "none", str(tmp_path)]
    if shutil.which("unshare") is None or subprocess.run(trial, check=False).returncode:
        pytest.skip("no mount namespaces here")
    ended = subprocess.run(
        [*NAMESPACE, sys.executable, HERE / "full_disk.py", tmp_path],
        capture_output=True, text=True, check=False, cwd=HERE,
    )  # fmt: skip
    assert ended.returncode == 0, ended.stderr
    steps = json.loads(ended.stdout)
    for step in ("full", "full again", "room for the database"):
        code, said = steps[step]
        assert code == 1 and "no room left on the disk" in said and "is kept" in said, step
        assert "Traceback" not in said
    told = steps["room for the database"][1]
    done = sum(line.startswith("s") and " of " in line for line in told.splitlines())
    assert done > 0, "some of it was done"
    code, said = steps["cured"]
    assert code == 0
    assert f"s{done - 1:02} " not in said, "what was stored is not done again"
    assert steps["same"][0]
    assert steps["read-only"] == [2, said_of_read_only(tmp_path)]
    for step in ("report", "override"):
        code, said = steps[step]
        assert code == 1 and "cannot be opened or written" in said and "Traceback" not in said


def said_of_read_only(folder: Path) -> str:
    out = folder / "disk" / "out"
    return f"raybook-grader: {out}: Read-only file system, expected a folder to write to\n"


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO])
@pytest.mark.parametrize("what", ["grades.json", "s1.html", "index.html"])
def test_no_room_for_what_is_written_at_the_end(
    tmp_path: Path, grade: Command, monkeypatch: pytest.MonkeyPatch, what: str, number: int
) -> None:
    hand_in(tmp_path / "class", "s1", {"01": "a"})

    def full(file: Path, text: str) -> None:
        if file.name == what:
            raise OSError(number, "Some error", str(file))
        really_write(file, text)

    with monkeypatch.context() as patch:
        patch.setattr(export, "write_text", full)
        patch.setattr(pages, "write_text", full)
        stopped = grade()
    assert stopped.code == 1 and f"{what}: " in stopped.err and "is kept" in stopped.err
    done = grade()
    assert done.code == 0 and "0 modules to grade" in done.out
    assert grades(tmp_path / "out")["s1"]["score"] == 4


def test_a_file_where_the_folder_should_be(tmp_path: Path, grade: Command) -> None:
    hand_in(tmp_path / "class", "s1", {"01": "a"})
    (tmp_path / "out").write_text("mine")
    done = grade()
    assert done.code == 2 and "out: File exists, expected a folder" in done.err
    assert (tmp_path / "out").read_text() == "mine"


@pytest.mark.parametrize("damage", ["page", "text", "cut"])
def test_a_damaged_database_is_told(
    tmp_path: Path, grade: Command, grader: Command, damage: str
) -> None:
    for i in range(30):
        hand_in(tmp_path / "class", f"s{i}", {"01": "a"})
        (tmp_path / "class" / f"s{i}" / "01b.exr").write_bytes(b"wrong %d" % i)
    assert grade().code == 0
    published = (tmp_path / "out" / "grades.json").read_bytes()
    file = tmp_path / "out" / "grades.sqlite"
    content = bytearray(file.read_bytes())
    if damage == "page":
        for page in range(2, len(content) // 4096):
            content[4096 * page : 4096 * page + 200] = b"\xa5" * 200
    elif damage == "text":
        content = content.replace(b'{"verdict": "', b'["verdict": "')
    else:
        del content[len(content) // 2 :]
    file.write_bytes(content)
    damaged = file.read_bytes()
    export = grader("export", tmp_path / "out", "--format", "csv")
    for done in (grade(), grader("report", tmp_path / "out"), export):
        assert done.code == 1, done.out + done.err
        assert "grades.sqlite: " in done.err and "It is damaged" in done.err
    assert (tmp_path / "out" / "grades.json").read_bytes() == published
    assert file.read_bytes() == damaged, "somebody may still save what is in it"
