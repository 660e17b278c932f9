"""Files that nobody could not read in place, and the doctor."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from tiny_programs import with_package

from raybook_grader.sandbox import Box, Finding, SandboxUnavailable, doctor, probe, require
from raybook_grader.sandbox.mirror import Mirror

AS_ROOT = pytest.mark.skipif(os.geteuid() != 0, reason="only root's boxes run as nobody")


@pytest.fixture
def scratch(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Where copies go, for this test alone: others may run beside it."""
    with tempfile.TemporaryDirectory(prefix="mirror-", dir="/tmp") as folder:
        Path(folder).chmod(0o755)
        monkeypatch.setenv("TMPDIR", folder)
        monkeypatch.setattr(tempfile, "tempdir", folder)
        yield Path(folder)


def leftovers(scratch: Path) -> list[Path]:
    return list(scratch.glob("raybook-box-*"))


@pytest.fixture
def hidden(tmp_path: Path) -> Path:
    """A folder below one that only its owner may enter."""
    folder = tmp_path / "private" / "folder"
    (folder / "deep").mkdir(parents=True)
    (folder / "deep" / "a.txt").write_text("first")
    (folder / "deep" / "a.txt").chmod(0o600)
    (folder / "link").symlink_to("/etc/shadow")
    (tmp_path / "private").chmod(0o700)
    return folder


def cat(box: Box, hidden: Path, name: str) -> bytes:
    return box.run(["cat", f"/bound/{name}"], binds={"/bound": hidden}).stdout


def test_unreachable_folder_is_readable_inside_and_always_fresh(
    hidden: Path, scratch: Path
) -> None:
    with Box() as box:
        assert cat(box, hidden, "deep/a.txt") == b"first"
        (hidden / "deep" / "a.txt").write_text("second")
        assert cat(box, hidden, "deep/a.txt") == b"second"
        (hidden / "b.txt").write_text("new")
        assert cat(box, hidden, "b.txt") == b"new"
        assert cat(box, hidden, "link") == b""
        assert len(leftovers(scratch)) == 1
    assert leftovers(scratch) == []


@AS_ROOT
def test_copies_are_made_only_where_needed_and_once(hidden: Path, tmp_path: Path) -> None:
    mirror = Mirror()
    first = mirror.readable(hidden)
    assert first != hidden
    assert mirror.readable(hidden) == first
    assert first.parent.parent.stat().st_mode & 0o007 == 0
    assert mirror.readable(Path("/usr/include")) == Path("/usr/include")
    mirror.close()
    assert not first.exists()


@AS_ROOT
def test_unchanging_folders_are_looked_at_once(hidden: Path) -> None:
    with Box(unchanging=[hidden]) as box:
        assert cat(box, hidden, "deep/a.txt") == b"first"
        (hidden / "deep" / "a.txt").write_text("second")
        assert cat(box, hidden, "deep/a.txt") == b"first"


@AS_ROOT
def test_leftovers_of_a_killed_run_are_removed(hidden: Path, scratch: Path) -> None:
    make = (
        "import sys, os, signal; from pathlib import Path;"
        "from raybook_grader.sandbox.mirror import Mirror;"
        "m = Mirror(); m.readable(Path(sys.argv[1])); os.kill(os.getpid(), signal.SIGKILL)"
    )
    subprocess.run([sys.executable, "-c", make, str(hidden)], check=False, env=with_package())
    (dead,) = leftovers(scratch)
    mirror = Mirror()
    mirror.readable(hidden)
    (its_own,) = leftovers(scratch)
    assert its_own != dead
    mirror.close()
    assert leftovers(scratch) == []


def test_this_machine_is_well() -> None:
    findings = probe()
    assert all(finding.ok for finding in findings), findings
    assert findings[-1].name == "trial box"


def test_missing_bubblewrap_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(name: str) -> str:
        raise SandboxUnavailable(f"{name} is not in PATH")

    monkeypatch.setattr(doctor, "find_program", absent)
    with pytest.raises(SandboxUnavailable, match="apt-get install bubblewrap"):
        require()


def test_a_failing_trial_names_the_switch(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    switch = tmp_path / "userns"
    switch.write_text("0\n")
    monkeypatch.setattr(doctor, "_SWITCHES", {str(switch): ("0", "sysctl -w userns=1")})
    monkeypatch.setattr(doctor, "_trial", lambda: Finding("trial box", False, "no uid map"))
    with pytest.raises(SandboxUnavailable, match="sysctl -w userns=1"):
        require()
