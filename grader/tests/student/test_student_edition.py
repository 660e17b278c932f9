"""The student edition is a project of its own, and holds no trace of a solution."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from student_edition import ROOT, run_make, student_edition

from raybook_grader.handed_out import read_handed_out
from raybook_grader.literate.equivalence import unifdef_difference
from raybook_grader.literate.export import export
from raybook_grader.literate.leaks import scan
from raybook_grader.literate.secrets import Secrets, checkout_secrets
from raybook_grader.literate.tree import load_tree
from raybook_grader.student.project import read_assignments

ASSIGNMENTS = read_assignments(ROOT)


def git(folder: Path, *words: str) -> None:
    identity = ["-c", "user.name=s", "-c", "user.email=s@example.org"]
    subprocess.run(["git", "-C", str(folder), *identity, *words], check=True, capture_output=True)


@pytest.fixture(scope="module")
def edition() -> Path:
    return student_edition()


@pytest.fixture(scope="module")
def secrets() -> Secrets:
    return checkout_secrets(ROOT)


@pytest.fixture
def clone(edition: Path, tmp_path: Path) -> Path:
    """The edition without what was built in it."""
    return Path(
        shutil.copytree(edition, tmp_path / "clone", ignore=shutil.ignore_patterns("build"))
    )


def test_neither_folder_nor_history_holds_a_secret(clone: Path, secrets: Secrets) -> None:
    git(clone, "init", "-q")
    git(clone, "add", "-A")
    git(clone, "commit", "-q", "-m", "Raybook")
    assert len(secrets.lines) > 500
    assert scan(clone, secrets).clean


def test_a_solution_that_was_committed_once_is_found(clone: Path, secrets: Secrets) -> None:
    path = "src/shapes/triangle.c"
    stub = (clone / path).read_bytes()
    git(clone, "init", "-q")
    shutil.copy(ROOT / path, clone / path)
    git(clone, "add", path)
    git(clone, "commit", "-q", "-m", "oh")
    (clone / path).write_bytes(stub)
    git(clone, "commit", "-q", "--amend", "-a", "-m", "better")
    report = scan(clone, secrets)
    assert report.leaks and not report.unread
    assert all(leak.artefact.startswith(".git!blob") for leak in report.leaks)


def test_source_is_the_export_and_unifdef_agrees(edition: Path) -> None:
    ours = {f"{Path(p).parent}/test_{Path(p).name}" for a in ASSIGNMENTS for p in a.owned}
    for name, source in load_tree(ROOT).files.items():
        if name in ours:
            assert not (edition / name).exists(), "our own test of a module that students write"
            continue
        exported = export(source)
        assert (edition / name).read_text() == exported.text, name
        if source.regions:
            assert unifdef_difference(source, exported) is None


def test_no_file_of_the_instructors(edition: Path) -> None:
    names = {
        p.relative_to(edition).as_posix() for p in edition.rglob("*") if "build" not in p.parts
    }
    assert not [n for n in names if re.search(r"/(hidden|mistakes|alternatives)(/|$)", n)]
    shipped = {n for n in names if n.startswith("tools/")}
    unwanted = r"/(grading|sandbox|museum|literate|expected|reports|database)(/|\.py|$)"
    assert not [n for n in shipped if re.search(unwanted, n)]


def test_it_knows_its_stubs(edition: Path) -> None:
    handed = read_handed_out(edition)
    assert set(handed.stubs) == {(a.number, path) for a in ASSIGNMENTS for path in a.owned}
    assert not any(handed.is_begun(a.number, ROOT / "nowhere") for a in ASSIGNMENTS)
    assert handed.is_begun("01", ROOT), "the reference is no stub"


@pytest.mark.parametrize("name", ["README.md", "report.md", ".gitignore", ".clangd", "Makefile"])
def test_it_has_what_a_project_has(edition: Path, name: str) -> None:
    assert (edition / name).stat().st_size > 20


def test_the_readme_lists_every_assignment(edition: Path) -> None:
    text = (edition / "README.md").read_text()
    for assignment in ASSIGNMENTS:
        assert f"]({assignment.folder}/handout.md)" in text
        for path in assignment.owned:
            assert f"`{path}`" in text
        assert (edition / assignment.folder / "handout.md").is_file()


def test_git_keeps_what_is_handed_in(edition: Path, tmp_path: Path) -> None:
    git(tmp_path, "init", "-q")
    shutil.copy(edition / ".gitignore", tmp_path)
    for assignment in ASSIGNMENTS:
        for path in assignment.owned:
            ignored = ["git", "-C", str(tmp_path), "check-ignore", "-q", path]
            assert subprocess.run(ignored, check=False).returncode == 1, path


def test_settings_of_the_editor(edition: Path) -> None:
    settings = {p.name: json.loads(p.read_text()) for p in (edition / ".vscode").glob("*.json")}
    labels = {task["label"] for task in settings["tasks.json"]["tasks"]}
    assert {"build", "check", "debug one pixel"} <= labels
    for configuration in settings["launch.json"]["configurations"]:
        assert configuration["preLaunchTask"] in labels
    [schema] = settings["settings.json"]["json.schemas"]
    assert (edition / schema["url"]).is_file()
    for task in settings["tasks.json"]["tasks"]:
        target = task["command"].split()[1]
        assert re.search(rf"^{target}:", (edition / "Makefile").read_text(), re.MULTILINE), target


def test_the_container_is_made_from_the_list_of_packages(edition: Path) -> None:
    container = json.loads((edition / ".devcontainer/devcontainer.json").read_text())
    recipe = (edition / ".devcontainer" / container["build"]["dockerfile"]).read_text()
    assert "setup.sh --print-command" in recipe
    command = [str(edition / ".setup/setup.sh"), "--print-command"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert {"gcc", "libopenexr-dev", "python3-venv"} <= set(printed.split())
    assert "bubblewrap" not in printed


def test_the_workflow_runs_the_check(edition: Path) -> None:
    workflow = (edition / ".github/workflows/classroom.yml").read_text()
    assert "run: make check" in workflow


def test_from_a_clean_folder(edition: Path) -> None:
    """Must hold: an unpacked handout renders and checks, and a newcomer sees no wall of red."""
    rendered = run_make(edition, "render", "ARGS=--spp 1 --resolution 64x64")
    assert rendered.returncode == 0, rendered.stderr
    assert (edition / "build/out/cornell-box.png").is_file()
    assert "assignment 01 triangle: not implemented yet" in rendered.stderr
    checked = run_make(edition, "check")
    assert (checked.returncode, checked.stderr) == (0, "")
    begun = [line for line in checked.stdout.splitlines()[2:] if "not begun" not in line]
    assert begun == []
    assert checked.stdout.count("not begun") == len(ASSIGNMENTS)
    assert run_make(edition, "check", "STRICT=1").returncode != 0


def test_the_first_assignment(edition: Path) -> None:
    """As its sheet says: two commands, then both files are right."""
    assert run_make(edition, "build", "build/meshes/done", "compile_commands.json").returncode == 0
    words = ["scenes/cornell-box.json", "--resolution", "128x128", "--spp", "1"]
    picture = edition / "first-picture.exr"
    subprocess.run(["build/raybook", *words, "-q", "-o", picture], cwd=edition, check=True)
    try:
        checked = run_make(edition, "check", "A=00")
        assert checked.returncode == 0, checked.stdout
        assert "are right" in checked.stdout
        picture.write_bytes(b"nothing")
        checked = run_make(edition, "check", "A=0")
        assert checked.returncode != 0
        assert "not an OpenEXR picture" in checked.stdout
    finally:
        picture.unlink()
        (edition / "compile_commands.json").unlink()
