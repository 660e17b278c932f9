"""The bundle: complete, and its run_autograder grades as Gradescope runs it."""

from __future__ import annotations

import json
import os
import subprocess
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from gradescope_place import CHECKOUT, borrow_kit, lay_out, run_there, small_course

from raybook_grader.cli import parser
from raybook_grader.course import load_course
from raybook_grader.errors import BadInput
from raybook_grader.gradescope.bundle import Config, write_bundle
from raybook_grader.gradescope.collect import collect
from raybook_grader.gradescope.contents import NOT_NEEDED
from raybook_grader.museum import exhibits_of

SCHEMA = json.loads(Path(__file__).with_name("gradescope.schema.json").read_text())
OWNED = ("src/shapes/triangle.c", "src/accel/aabb.c")


@pytest.fixture(scope="module")
def bundle(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bundle")
    root = small_course(folder / "course", ["01-triangle", "02-aabb"])
    out = folder / "raybook.zip"
    arguments = parser().parse_args(["gradescope-bundle", str(out), "--course", str(root)])
    assert arguments.handler(arguments) == 0
    return out


@pytest.fixture(scope="module")
def place(bundle: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = lay_out(bundle, tmp_path_factory.mktemp("gradescope") / "autograder")
    borrow_kit(place)
    return place


@pytest.fixture
def submission(place: Path) -> Iterator[Path]:
    folder = place / "submission"
    yield folder
    for file in sorted(folder.rglob("*"), reverse=True):
        file.rmdir() if file.is_dir() else file.unlink()


def wrong_aabb() -> bytes:
    """The first known mistake of assignment 02."""
    assignment = load_course(CHECKOUT).assignment("02")
    return next(e for e in exhibits_of(CHECKOUT, assignment) if not e.is_right).files[OWNED[1]]


def results(place: Path) -> dict[str, Any]:
    values: dict[str, Any] = json.loads((place / "results" / "results.json").read_text())
    jsonschema.validate(values, SCHEMA)
    return values


def test_the_zip_has_its_scripts_at_the_top(bundle: Path) -> None:
    with zipfile.ZipFile(bundle) as archive:
        modes = {e.filename: e.external_attr >> 16 & 0o777 for e in archive.infolist()}
    assert modes["setup.sh"] == modes["run_autograder"] == 0o755
    assert modes["raybook/.setup/setup.sh"] == 0o755
    assert not any(name.startswith(("raybook/grader/tests", "raybook/docs")) for name in modes)


def test_the_same_contents_are_the_same_bytes(tmp_path: Path) -> None:
    course, config = load_course(CHECKOUT), Config(("02",), "hidden", False)
    for name in ("a.zip", "b.zip"):
        write_bundle(tmp_path / name, course, config)
    assert (tmp_path / "a.zip").read_bytes() == (tmp_path / "b.zip").read_bytes()
    with zipfile.ZipFile(tmp_path / "a.zip") as archive:
        names = archive.namelist()
    assert any(name.startswith("raybook/assignments/02-aabb/hidden/") for name in names)
    assert not any("assignments/03" in name for name in names), "only what was asked for"


def test_a_fresh_unpack_has_all_that_make_kit_needs(bundle: Path, tmp_path: Path) -> None:
    checkout = lay_out(bundle, tmp_path / "autograder") / "source" / "raybook"
    dry = ["make", "--dry-run", "--always-make", "kit"]
    done = subprocess.run(dry, cwd=checkout, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    sources = [p for p in (CHECKOUT / "src").rglob("*.c") if not p.name.startswith("test_")]
    assert len(sources) > 80
    for source in sources:
        name = str(source.relative_to(CHECKOUT))
        assert name in done.stdout or name == "src/accel/embree.c", f"{name} is not compiled"
    assert "--version '0." in done.stdout, "the version comes from a file, for git is not there"


def test_packages_left_out_are_in_the_list(bundle: Path) -> None:
    listed = (CHECKOUT / ".setup" / "packages.txt").read_text().split("\n")
    names = {line.split()[0] for line in listed if line and not line.startswith("#")}
    assert set(NOT_NEEDED) <= names
    with zipfile.ZipFile(bundle) as archive:
        kept = archive.read("raybook/.setup/packages.txt").decode()
    for name in ("gcc", "bubblewrap", "libseccomp2", "libopenexr-dev", "python3-venv", "dpkg-dev"):
        assert f"\n{name} " in kept
    assert "chromium" not in kept


def test_the_scripts_are_sound_shell() -> None:
    templates = CHECKOUT / "grader" / "raybook_grader" / "gradescope" / "templates"
    for script in templates.iterdir():
        assert script.stat().st_mode & 0o111
        subprocess.run(["bash", "-n", script], check=True)


def test_a_right_and_a_wrong_module_at_the_real_paths(place: Path, submission: Path) -> None:
    # One file where the course has it, the other dropped on the page without its folder.
    (submission / "src" / "shapes").mkdir(parents=True)
    (submission / OWNED[0]).write_bytes((CHECKOUT / OWNED[0]).read_bytes())
    (submission / "aabb.c").write_bytes(wrong_aabb())
    done = run_there(place, "/autograder/run_autograder")
    assert done.returncode == 0, done.stdout + done.stderr
    values = results(place)
    first = [test for test in values["tests"] if test["name"].startswith("01 triangle")]
    second = [test for test in values["tests"] if test["name"].startswith("02 aabb")]
    assert {test["status"] for test in first} == {"passed"}
    assert {test["status"] for test in second} == {"passed", "failed"}
    assert values["score"] == pytest.approx(sum(test["score"] for test in values["tests"]))
    assert values["score"] < sum(test["max_score"] for test in values["tests"])
    hidden = {test["visibility"] for test in second if "edge cases" in test["name"]}
    assert hidden == {"after_published"}


def test_a_failure_of_the_harness_is_no_grade_at_all(place: Path, submission: Path) -> None:
    (submission / "aabb.c").write_bytes(wrong_aabb())
    old = place / "results" / "results.json"
    old.write_text("{}")
    config = place / "source" / "bundle.json"
    kept = config.read_text()
    (oracle,) = (place / "source").glob("raybook/assignments/02-aabb/hidden/oracle_aabb.py")
    text = oracle.read_text()
    try:
        config.write_text(Config(("02",), "hidden", False).text())
        oracle.write_text("raise RuntimeError('the oracle is broken')\n")
        done = run_there(place, "/autograder/run_autograder")
    finally:
        oracle.write_text(text)
        config.write_text(kept)
    assert done.returncode == 3, done.stdout + done.stderr
    assert not old.exists(), "Gradescope then says that the autograder failed"
    assert "the oracle is broken" in done.stdout and "not a zero either" in done.stdout


def test_without_a_sandbox_it_grades_only_when_told_unsafe(place: Path, submission: Path) -> None:
    (submission / "aabb.c").write_bytes((CHECKOUT / OWNED[1]).read_bytes())
    config = place / "source" / "bundle.json"
    kept = config.read_text()
    try:
        config.write_text(Config(("02",), "hidden", False).text())
        refused = run_there(place, "/autograder/run_autograder", sandbox=False)
        assert refused.returncode == 1 and "not a zero either" in refused.stdout
        assert "bubblewrap" in refused.stderr and "--unsafe" in refused.stderr
        assert not (place / "results" / "results.json").exists()
        config.write_text(Config(("02",), "hidden", True).text())
        done = run_there(place, "/autograder/run_autograder", sandbox=False)
    finally:
        config.write_text(kept)
    assert done.returncode == 0, done.stdout + done.stderr
    assert {test["status"] for test in results(place)["tests"]} == {"passed"}
    assert "unsafe" in done.stdout


def test_dropped_files_find_their_places(tmp_path: Path) -> None:
    submission = tmp_path / "submission"
    (submission / "src" / "accel").mkdir(parents=True)
    (submission / "src" / "accel" / "aabb.c").write_text("the usual place")
    (submission / "aabb.c").write_text("dropped")
    (submission / "triangle.c").symlink_to("/etc/passwd")
    os.mkfifo(submission / "pipe")
    folder = collect(submission, OWNED, tmp_path / "class") / "submission"
    assert (folder / OWNED[1]).read_text() == "the usual place"
    assert not (folder / OWNED[0]).exists() and (folder / "triangle.c").is_symlink()
    assert not (folder / "pipe").exists()


def test_no_two_owned_files_share_a_name() -> None:
    owned = [path for a in load_course(CHECKOUT).assignments for path in a.owned]
    assert len({Path(path).name for path in owned}) == len(owned)


def test_an_unknown_assignment_is_told(tmp_path: Path) -> None:
    arguments = ["gradescope-bundle", str(tmp_path / "x.zip"), "--assignment", "77"]
    parsed = parser().parse_args(arguments)
    with pytest.raises(BadInput, match="no assignment '77'"):
        parsed.handler(parsed)


@pytest.mark.skipif("RAYBOOK_FULL" not in os.environ, reason="builds everything: RAYBOOK_FULL=1")
def test_setup_builds_from_the_zip_alone(bundle: Path, tmp_path: Path) -> None:
    place = lay_out(bundle, tmp_path / "autograder")
    done = run_there(place, "/autograder/source/setup.sh")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "01 triangle: pass, 02 aabb: pass" in done.stdout
    (place / "submission" / "aabb.c").write_bytes((CHECKOUT / OWNED[1]).read_bytes())
    assert run_there(place, "/autograder/run_autograder").returncode == 0
    assert {test["status"] for test in results(place)["tests"][1:]} == {"passed"}
