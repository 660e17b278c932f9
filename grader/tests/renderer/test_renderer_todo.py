"""Unfinished exercises: every stub compiles without a warning, says once that it is one, and
keeps a picture coming.

The exercises are found in the sources: whatever stands under `#ifndef TODO_name` ... `#else` ...
`#endif` is taken. A new exercise whose code the scene below does not reach fails here: add what
reaches it to the scene."""

from __future__ import annotations

import functools
import re
import shlex
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from renderer_runs import (
    ROOT,
    SOURCE,
    Json,
    Pixels,
    diffuse,
    make,
    mesh,
    point_light,
    program,
    read_exr,
    run,
    sphere,
    write_mesh,
    write_scene,
)

from raybook_grader.judge.exr import write_exr


@dataclass(frozen=True)
class Stub:
    """The lines of `file` (from the top of the checkout) that stand in for the exercise."""

    name: str
    file: str
    first: int
    last: int


def stubs_of(path: Path) -> list[Stub]:
    """The `#else` parts of a file's `#ifndef TODO_name`; conditions may be nested."""
    found, open_conditions = [], []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if begin := re.match(r"#\s*if(?:ndef TODO_(\w+))?", line):
            open_conditions.append((begin[1], 0))
        elif re.match(r"#\s*else\b", line):
            open_conditions.append((open_conditions.pop()[0], number))
        elif re.match(r"#\s*endif\b", line):
            name, other = open_conditions.pop()
            if name and other:
                found.append(Stub(name, str(path.relative_to(ROOT)), other, number))
    return found


STUBS = [stub for path in sorted(SOURCE.rglob("*.c")) for stub in stubs_of(path)]
NAMES = sorted({stub.name for stub in STUBS})
WARNING = re.compile(r"assignment (\d\d) ([\w -]+): not implemented yet, (src/[\w/]+\.c):(\d+): .+")


def test_the_exercises_are_found() -> None:
    assert {"triangle_intersect", "aabb_intersect", "bvh_build", "bvh_traverse"} <= set(NAMES)


def test_every_condition_on_an_exercise_is_known() -> None:
    """A misspelt name would compile, and the exercise would not be one."""
    for path in sorted(SOURCE.rglob("*.[ch]")):
        used = set(re.findall(r"\bTODO_(?!WARN\b)(\w+)", path.read_text()))
        assert used <= set(NAMES), f"{path}: {used - set(NAMES)}"


# What only lamps with an area, a sky and an integrator that asks one of many lights reach.
LAMPS = {
    *("rect_light_place", "area_light_pdf", "area_light_emitted"),
    *("environment", "light_selection", "several_lights"),
}


def scene(folder: Path) -> Path:
    """A mesh with texture coordinates, spheres with filtered images, a clear one, two lights."""
    corners = "v -3 -1 2\nv 3 -1 2\nv 3 -1 -4\nv -3 -1 -4\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    write_mesh(folder, "floor.obj", corners + "f 1/1 2/2 3/3 4/4\n")
    paint = diffuse(paint=[0.8, 0.7, 0.6])
    paint["materials"]["clear"] = {"type": "refraction"}
    write_exr(folder / "image.exr", np.full((8, 8, 3), 0.5, np.float32))
    for kind in ("trilinear", "ewa"):
        paint["textures"][kind] = {"type": "image", "path": "image.exr", "filter": kind}
        paint["materials"][kind] = {"type": "diffuse", "texture_name": kind}
    description: Json = {
        "integrator": {"point_light_position": [2, 3, 3], "point_light_flux": [300, 300, 300]},
        "camera": {"position": [0, 0.5, 5], "fov": 50},
        "objects": [
            mesh("floor.obj", "paint"),
            sphere([0, 0, 0], 1, "trilinear"),
            sphere([1.5, 0.5, 0], 0.4, "ewa"),
            sphere([0, 0.5, 3], 0.3, "clear"),
        ],
        "lights": [point_light([-3, 2, 1], [100, 50, 20])],
        **paint,
    }
    return write_scene(folder, description)


def lamp_scene(folder: Path) -> Path:
    """A sphere under a lamp with an area, and an environment."""
    paint = diffuse(paint=[0.8, 0.7, 0.6])
    paint["textures"]["sky"] = {"type": "constant", "color": [0.1, 0.2, 0.3]}
    lamp = {
        "type": "rect",
        "transform": [1, 0, 0, 0, 0, 0, -1, 3, 0, 1, 0, 1, 0, 0, 0, 1],
        "light": {"type": "area", "radiance": [5, 4, 3]},
    }
    description: Json = {
        "integrator": {"type": "direct"},
        "camera": {"position": [0, 0.5, 5], "fov": 50},
        "objects": [sphere([0, 0, 0], 1, "paint"), lamp],
        "environment_map": {"texture_name": "sky"},
        **paint,
    }
    return write_scene(folder, description)


def picture_of(
    binary: Path, folder: Path, make_scene: Callable[[Path], Path] = scene
) -> tuple[Pixels, list[str]]:
    """The picture, and the lines that the stubs said."""
    arguments = ("--resolution", "40x32", "--spp", "2", "--threads", "2", "-q", "-o", "a.exr")
    # Where only an object is replaced, build.mk does not see that it is a stub's.
    done = run(make_scene(folder), "--accel", "bvh", *arguments, cwd=folder, binary=binary)
    assert (done.returncode, done.stdout) == (0, ""), done.stderr
    return read_exr(folder / "a.exr").pixels, done.stderr.splitlines()


def place(line: str) -> Stub:
    """The stub whose warning the line is."""
    found = WARNING.fullmatch(line)
    assert found, f"not in the documented form: {line}"
    at = [s for s in STUBS if s.file == found[3] and s.first < int(found[4]) < s.last]
    assert at, f"no stub is there: {line}"
    return at[0]


@functools.cache
def tools(compiler: str) -> tuple[list[str], list[str]]:
    """How this compiler compiles (without input and output) and links the debug build. Asked from
    make, so that only the file of an exercise has to be compiled anew."""
    linked = str(program("debug", compiler).relative_to(ROOT))
    dry = make("-n", "-B", "V=1", "build", "OPT=debug", f"CC={compiler}").splitlines()
    link = shlex.split(next(line for line in dry if line.endswith(f"-o {linked}")))
    compile_ = shlex.split(next(line for line in dry if " -c src/accel/bvh.c " in line))
    return compile_[: compile_.index("-MMD")], link[:-1]


def build(name: str, compiler: str, folder: Path) -> Path:
    """The debug build with one exercise undone."""
    compile_, link = tools(compiler)
    for file in {stub.file for stub in STUBS if stub.name == name}:
        own = str(folder / Path(file).with_suffix(".o").name)
        command = [*compile_, f"-DTODO_{name}", "-c", file, "-o", own]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        assert (done.returncode, done.stderr) == (0, "")
        plain = f"build/obj/debug-{compiler}/" + file.removeprefix("src/").replace(".c", ".o")
        assert plain in link
        link = [own if part == plain else part for part in link]
    subprocess.run([*link, str(folder / "raybook")], cwd=ROOT, check=True)
    return folder / "raybook"


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize("name", NAMES)
def test_each_exercise_alone(name: str, compiler: str, tmp_path: Path) -> None:
    reaches = lamp_scene if name in LAMPS else scene
    picture, said = picture_of(build(name, compiler, tmp_path), tmp_path, reaches)
    assert [place(line).name for line in said] == [name], "one warning, from this exercise"
    assert np.isfinite(picture).all() and picture.any(), "a stub never takes the picture away"


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_all_exercises_together(compiler: str, tmp_path: Path) -> None:
    binary = program("debug", compiler, tuple(NAMES))
    picture, said = picture_of(binary, tmp_path)
    names = [place(line).name for line in said]
    assert len(names) == len(set(names)) and "triangle_intersect" in names
    assert np.isfinite(picture).all() and picture.any(), "the sphere is still there"
    variant = read_exr(tmp_path / "a.exr").header["raybook:variant"].split()
    assert variant[1:] == [f"TODO_{name}" for name in NAMES]


# What the stub does in its exercise's place is slow, not wrong: the picture is the reference's.
SLOW_NOT_WRONG = ["aabb_intersect", "bvh_build", "bvh_traverse", "triangle_uv_differentials"]


@pytest.mark.parametrize("name", SLOW_NOT_WRONG)
def test_a_slow_stub_changes_no_bit(name: str, tmp_path: Path) -> None:
    want, said = picture_of(program("debug"), tmp_path)
    assert said == []
    got, _ = picture_of(build(name, "gcc", tmp_path), tmp_path)
    assert np.array_equal(want, got)


def test_without_triangles_the_sphere_is_seen(tmp_path: Path) -> None:
    whole, _ = picture_of(program("debug"), tmp_path)
    picture, _ = picture_of(build("triangle_intersect", "gcc", tmp_path), tmp_path)
    assert 0.02 < picture.any(axis=-1).mean() < whole.any(axis=-1).mean() - 0.2
