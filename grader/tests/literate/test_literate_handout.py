"""The student edition of a miniature checkout: what is in it, and what keeps it from being made."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from literate_project import (
    ASSIGNMENT_01,
    ASSIGNMENT_01_PUBLIC,
    DISC_C_REVEALED,
    DISC_C_STUDENT,
    FILES,
    write_project,
)

from raybook_grader.literate.handout import HandoutError, LeakError, write_handout
from raybook_grader.literate.listing import list_files
from raybook_grader.literate.public_toml import public_toml
from raybook_grader.literate.tree import UnsoundSourceError

EVERYBODY = {
    ".clang-format",
    ".gitignore",
    ".raybook-handout",
    ".setup/packages.txt",
    ".setup/setup.sh",
    "LICENSE",
    "Makefile",
    "README.md",
    "assignments/01-disc/assignment.toml",
    "assignments/01-disc/handout.md",
    "assignments/01-disc/test_disc.c",
    "scenes/demo.json",
    "src/shapes/disc.c",
    "src/shapes/disc.h",
    "src/shapes/mean.c",
    "tools/view.sh",
}
SECOND = {"assignments/02-mean/assignment.toml", "assignments/02-mean/test_mean.c"}


def names(folder: Path) -> set[str]:
    return {p.relative_to(folder).as_posix() for p in folder.rglob("*") if not p.is_dir()}


@pytest.fixture
def root(tmp_path: Path) -> Path:
    return write_project(tmp_path / "checkout")


def git(root: Path, *words: str) -> None:
    identity = ["-c", "user.name=t", "-c", "user.email=t@example.org"]
    environment = {k: v for k, v in os.environ.items() if not k.startswith("GIT_")}
    command = ["git", "-C", str(root), *identity, *words]
    subprocess.run(command, check=True, capture_output=True, env=environment)


# What is in it.


def test_files(root: Path, tmp_path: Path) -> None:
    report = write_handout(root, tmp_path / "out")
    assert names(report.out) == EVERYBODY | SECOND
    assert report.files == len(EVERYBODY | SECOND) - 1  # our mark is not part of the edition


def test_contents(root: Path, tmp_path: Path) -> None:
    out = write_handout(root, tmp_path / "out").out
    assert (out / "src/shapes/disc.c").read_text() == DISC_C_STUDENT
    assert (out / "assignments/01-disc/assignment.toml").read_text() == ASSIGNMENT_01_PUBLIC
    for ours in ("Makefile", "README.md", "tools/view.sh"):
        assert (out / ours).read_text() == FILES[f"assignments/handout/{ours}"]


def test_up_to_an_assignment(root: Path, tmp_path: Path) -> None:
    out = write_handout(root, tmp_path / "out", assignment="01").out
    assert names(out) == EVERYBODY
    assert (out / "src/shapes/disc.c").read_text() == DISC_C_STUDENT


def test_reveal(root: Path, tmp_path: Path) -> None:
    out = write_handout(root, tmp_path / "out", reveal=["01"]).out
    assert (out / "src/shapes/disc.c").read_text() == DISC_C_REVEALED
    assert "return a + 0.0f * b;" in (out / "src/shapes/mean.c").read_text()


def test_student_has_own_gitignore(tmp_path: Path) -> None:
    root = write_project(tmp_path / "checkout", {"assignments/handout/.gitignore": "*.exr\n"})
    out = write_handout(root, tmp_path / "out").out
    assert (out / ".gitignore").read_text() == "*.exr\n"


def test_executables_stay_executable(root: Path, tmp_path: Path) -> None:
    (root / ".setup/setup.sh").chmod(0o755)
    out = write_handout(root, tmp_path / "out").out
    assert os.access(out / ".setup/setup.sh", os.X_OK)
    assert out.stat().st_mode & 0o055 == root.stat().st_mode & 0o055


def test_same_edition_twice_is_the_same(root: Path, tmp_path: Path) -> None:
    one, two = (write_handout(root, tmp_path / name).out for name in ("one", "two"))
    assert names(one) == names(two)
    assert all((one / name).read_bytes() == (two / name).read_bytes() for name in names(one))


# Which files are chosen.


def test_only_what_git_tracks(root: Path, tmp_path: Path) -> None:
    git(root, "init", "-q")
    git(root, "add", ".")
    git(root, "commit", "-q", "-m", "all")
    (root / "src/shapes/disc.c.orig").write_text("junk\n")
    (root / "scenes/new.json").write_text("{}\n")
    (root / "scenes/demo.json").unlink()
    report = write_handout(root, tmp_path / "out")
    assert names(report.out) == (EVERYBODY | SECOND) - {"scenes/demo.json"}
    assert report.left_out == ("scenes/new.json", "src/shapes/disc.c.orig")


def test_hidden_files_that_git_does_not_know_are_secrets(root: Path, tmp_path: Path) -> None:
    git(root, "init", "-q")
    git(root, "add", ".")
    (root / "assignments/01-disc/hidden/new.json").write_text("[1, 2, 3]\n")
    (root / "scenes/copy.json").write_text("[1, 2, 3]\n")
    git(root, "add", "scenes")
    with pytest.raises(LeakError, match=r"hidden/new\.json:1 in scenes/copy\.json:1"):
        write_handout(root, tmp_path / "out")


def test_folder_of_another_checkout_is_walked(root: Path, tmp_path: Path) -> None:
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "checkout/README.md")
    assert "src/shapes/disc.c" in list_files(root).files


def test_git_variables_of_a_hook_do_not_matter(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    git(root, "init", "-q")
    git(root, "add", "README.md")
    monkeypatch.setenv("GIT_DIR", str(tmp_path / "other.git"))
    assert list_files(root).files == ("README.md",)


def test_walk_skips_junk(root: Path) -> None:
    for name in (".cache/a", "src/__pycache__/a.pyc", "src/a.c~", "src/a.c.orig", ".venv/a"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text("junk\n")
    assert set(list_files(root).files) == set(FILES) - {"build/out.txt"}


# What keeps it from being made, and what is left then.


def test_replaces_its_own(root: Path, tmp_path: Path) -> None:
    out = write_handout(root, tmp_path / "out").out
    (out / "stale").write_text("old\n")
    write_handout(root, out)
    assert names(out) == EVERYBODY | SECOND
    assert {path.name for path in tmp_path.iterdir()} == {"checkout", "out"}


def test_fills_an_empty_folder(root: Path, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    assert names(write_handout(root, tmp_path / "out").out) == EVERYBODY | SECOND


def refused(root: Path, out: Path, reason: str, assignment: str | None = None) -> None:
    before = {path: path.read_bytes() for path in out.parent.rglob("*") if path.is_file()}
    with pytest.raises(HandoutError, match=reason):
        write_handout(root, out, assignment)
    after = {path: path.read_bytes() for path in out.parent.rglob("*") if path.is_file()}
    assert after == before


def test_refuses_a_folder_of_others(root: Path, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out/thesis.tex").write_text("years\n")
    refused(root, tmp_path / "out", "not empty and not a handout")


def test_refuses_a_file(root: Path, tmp_path: Path) -> None:
    (tmp_path / "out").write_text("years\n")
    refused(root, tmp_path / "out", "expected a folder")


def test_refuses_a_git_repository(root: Path, tmp_path: Path) -> None:
    out = write_handout(root, tmp_path / "out").out
    git(out, "init", "-q")
    refused(root, out, "has become a git repository")


def test_refuses_an_unknown_assignment(root: Path, tmp_path: Path) -> None:
    refused(root, tmp_path / "out", "no assignment '7'; expected one of: 01, 02", assignment="7")
    with pytest.raises(HandoutError, match="no assignment '3'"):
        write_handout(root, tmp_path / "out", reveal=["3"])


def test_refuses_unsound_source(tmp_path: Path) -> None:
    root = write_project(tmp_path / "checkout", {"src/bad.c": "//> x: X\n"})
    with pytest.raises(UnsoundSourceError, match=r"src/bad\.c:1"):
        write_handout(root, tmp_path / "out")
    assert not (tmp_path / "out").exists()


LEAKS = {
    "solution in the student's notes": (
        {"assignments/handout/hints.md": "try `return x*x + y*y <= radius*radius;`\n"},
        r"LEAK src/shapes/disc\.c:10 in hints\.md:1: return x \* x",
    ),
    "solution in a public test": (
        {"assignments/02-mean/test_mean.c": "\n{ return a + 0.5f * (b - a); }\n"},
        r"LEAK src/shapes/mean\.c:5 in assignments/02-mean/test_mean\.c:2: ",
    ),
    "hidden file among the scenes": (
        {"scenes/expected.bin": FILES["assignments/01-disc/hidden/expected.bin"]},
        r"LEAK assignments/01-disc/hidden/expected\.bin:1 in scenes/expected\.bin:1",
    ),
    "copy of the original": (
        {"src/shapes/disc.c.bak": FILES["src/shapes/disc.c"]},
        r"LEAK src/shapes/disc\.c:10 in src/shapes/disc\.c\.bak:10: ",
    ),
}


@pytest.mark.parametrize("case", LEAKS)
def test_leak_leaves_nothing(tmp_path: Path, case: str) -> None:
    changes, message = LEAKS[case]
    root = write_project(tmp_path / "checkout", changes)
    with pytest.raises(LeakError, match=message):
        write_handout(root, tmp_path / "out")
    assert [path.name for path in tmp_path.iterdir()] == ["checkout"]


def test_leak_keeps_the_older_handout(root: Path, tmp_path: Path) -> None:
    out = write_handout(root, tmp_path / "out").out
    (root / "scenes/a.txt").write_text("return x * x + y * y <= radius * radius;")
    with pytest.raises(LeakError):
        write_handout(root, out)
    assert names(out) == EVERYBODY | SECOND


# The public text of an assignment.toml.


def test_public_toml_golden() -> None:
    assert public_toml("a.toml", ASSIGNMENT_01) == ASSIGNMENT_01_PUBLIC


PUBLIC_TOML = {
    "nothing hidden": ('a = 1\n\n# b\n[b]\nc = "[x]"\n', 'a = 1\n\n# b\n[b]\nc = "[x]"\n'),
    "hidden = false stays": ("[[check]]\nhidden = false\n", "[[check]]\nhidden = false\n"),
    "sub-tables of hidden": ("a = 1\n[hidden]\nb = 2\n[hidden.c]\nd = 3\n[e]\n", "a = 1\n[e]\n"),
    "hidden below another": ("[a]\nb = 1\n[a.hidden]\nc = 2\n", "[a]\nb = 1\n"),
    "hidden table": ("[a]\nhidden = true\n[a.b]\nc = 2\n[d]\n", "[d]\n"),
    "all hidden": ("[[c]]\nhidden = true\n[[c]]\nhidden = true\n", "\n"),
    "lists over lines": ("a = [\n [1, 2],\n [3],\n]\n[hidden]\n", "a = [\n [1, 2],\n [3],\n]\n"),
    "spaces in the header": ("a = 1\n[ hidden ] # x\nb = 2\n", "a = 1\n"),
}  # fmt: skip


@pytest.mark.parametrize("case", PUBLIC_TOML)
def test_public_toml(case: str) -> None:
    text, expected = PUBLIC_TOML[case]
    assert public_toml("a.toml", text) == expected


@pytest.mark.parametrize(
    "text",
    [
        "hidden = { seed = 1 }\n",
        "check = [{ name = 1, hidden = true }]\n",
        "hidden.seed = 1\n",
        "[a]\nhidden.seed = 1\n",
        'hidden = ["a"]\n',
        'a = """\n[hidden]\n"""\n',
    ],
)
def test_what_cannot_be_cut_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"a\.toml: can't take the hidden part out"):
        public_toml("a.toml", text)


def test_broken_toml_is_refused() -> None:
    with pytest.raises(ValueError, match=r"a\.toml: "):
        public_toml("a.toml", "a = [\n")
