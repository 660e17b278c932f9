"""What a course begins with: every assignment a stub, alone and all together.

A stub fails its own assignment's public tests and nobody else's, and no scene of the course
crashes on it. Each assignment alone takes some minutes, and is left to RAYBOOK_FULL=1.
"""

from __future__ import annotations

import functools
import os
import shlex
import subprocess
from collections.abc import Iterable
from pathlib import Path

import pytest
from renderer_runs import ROOT, make, program, run

from raybook_grader.course import load_course

COURSE = load_course(ROOT)
TODOS = {a.number: a.todos for a in COURSE.assignments if a.todos}
TESTS = sorted(str(p.relative_to(ROOT)) for p in (ROOT / "assignments").glob("*/test_*.c"))
DEMOS = sorted(p for p in (ROOT / "scenes").glob("*.json") if not p.name.endswith(".schema.json"))
ALL = "all"
full = pytest.mark.skipif("RAYBOOK_FULL" not in os.environ, reason="RAYBOOK_FULL=1 runs it")


def owner(test: str) -> str:
    """The number of the assignment that a file of public tests belongs to."""
    return test.split("/")[1][:2]


@functools.cache
def words(target: str) -> list[str]:
    return shlex.split(make("-s", target, "OPT=debug").splitlines()[-1])


@functools.cache
def compiled_tests(folder: Path) -> dict[str, list[str]]:
    """Each file of public tests compiled, with the test framework."""
    unity = ROOT / "build" / "unity"
    flags = ["-w", "-Wno-error", "-isystem", str(unity), "-DUNITY_INCLUDE_DOUBLE"]
    compiler = [*words("list-compiler"), *flags]
    framework = compile_to(folder / "unity.o", [*compiler, "-c", str(unity / "unity.c")])
    return {
        test: [compile_to(folder / (Path(test).stem + ".o"), [*compiler, "-c", test]), framework]
        for test in TESTS
    }


def compile_to(out: Path, command: list[str]) -> str:
    done = subprocess.run([*command, "-o", str(out)], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, f"{shlex.join(command)}\n{done.stderr}"
    return str(out)


def objects_with_stubs(numbers: Iterable[str], folder: Path) -> list[str]:
    """The debug build's objects with the stubs of some assignments in their places."""
    objects = list(words("list-objects"))
    for number in numbers:
        assignment = COURSE.assignment(number)
        define = [f"-DTODO_{todo}" for todo in assignment.todos]
        for source in assignment.sources:
            plain = f"build/obj/debug-gcc/{source.removeprefix('src/').replace('.c', '.o')}"
            assert plain in objects
            command = [*words("list-compiler"), *define, "-c", source]
            stub = compile_to(folder / f"{number}-{Path(source).stem}.o", command)
            objects[objects.index(plain)] = stub
    return objects


def failing(objects: list[str], folder: Path, tests: Path) -> set[str]:
    """The files of public tests that fail."""
    found = set()
    for test, own in compiled_tests(tests).items():
        binary = folder / Path(test).stem
        command = [*words("list-compiler"), *own, *objects, *words("list-libraries")]
        compile_to(binary, command)
        done = subprocess.run([binary], capture_output=True, text=True, timeout=120)
        assert done.returncode >= 0, f"{test} crashed"
        if done.returncode != 0:
            found.add(test)
    return found


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("tests")


@full
@pytest.mark.parametrize("number", TODOS)
def test_a_stub_fails_its_own_tests_and_no_others(
    number: str, tmp_path: Path, folder: Path
) -> None:
    objects = objects_with_stubs([number], tmp_path)
    expected = {test for test in TESTS if owner(test) == number}
    assert expected
    assert failing(objects, tmp_path, folder) == expected


def test_all_stubs_fail_all_tests(tmp_path: Path, folder: Path) -> None:
    assert failing(objects_with_stubs(TODOS, tmp_path), tmp_path, folder) == set(TESTS)


def test_without_stubs_all_pass(tmp_path: Path, folder: Path) -> None:
    assert failing(objects_with_stubs([], tmp_path), tmp_path, folder) == set()


@functools.cache
def renderer(number: str) -> Path:
    todos = sum(TODOS.values(), ()) if number == ALL else TODOS[number]
    return program("release", "gcc", tuple(todos))


@pytest.mark.parametrize("scene", DEMOS, ids=lambda path: path.stem)
@pytest.mark.parametrize("number", [ALL, *(pytest.param(n, marks=full) for n in TODOS)])
def test_every_demo_scene_is_drawn(number: str, scene: Path, tmp_path: Path) -> None:
    small = ("--resolution", "6x4", "--spp", "1", "-q", "-o", "a.exr")
    done = run(scene, *small, cwd=tmp_path, binary=renderer(number))
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a.exr").is_file()
    warnings = done.stderr.splitlines()
    assert len(warnings) == len(set(warnings)), "each stub warns once"
    assert all("not implemented yet" in line for line in warnings), done.stderr
