"""The reference renderer, with some exercises as stubs or some files replaced where a picture asks
for it.

Only the files concerned are compiled again; the rest is the build that `make check` uses.
"""

from __future__ import annotations

import hashlib
import os
import shlex
import subprocess
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

from ..errors import BadInput
from ..files import locked
from ..literate.tree import load_tree

# A make around us has settings of its own, which the reference must not have.
_SETTINGS = {"MAKEFLAGS", "MFLAGS", "MAKELEVEL", "CC", "CFLAGS", "LDFLAGS", "OPT", "ARCH"}
_SETTINGS |= {"VARIANT", "TODO", "CHECK", "EMBREE", "V"}


@cache
def reference_program(root: Path, stubs: frozenset[str] = frozenset()) -> Path:
    """The program built from the checkout ``root``, up to date. ``stubs`` names exercises."""
    plain = root / _make(root, "build/meshes/done", "programs").splitlines()[-1]
    return _with_stubs(root, stubs) if stubs else plain


def variant_program(root: Path, files: Mapping[str, bytes]) -> Path:
    """The program with these contents in place of the files of the same names ("src/...")."""
    changed = {name: text for name, text in files.items() if (root / name).read_bytes() != text}
    plain = reference_program(root)
    if not changed:
        return plain
    words = (part for name in sorted(changed) for part in (name.encode(), changed[name]))
    key = hashlib.sha256(b"\0".join(words)).hexdigest()[:16]
    folder = root / "build" / "expected" / f"variant-{key}"
    folder.mkdir(parents=True, exist_ok=True)
    with locked(folder / ".lock"):
        return _link(root, folder, _variant_objects(root, folder, changed))


def _variant_objects(root: Path, folder: Path, files: Mapping[str, bytes]) -> dict[str, str]:
    """The objects of these files' contents; by module."""
    compiler = shlex.split(_make(root, "-s", "list-compiler"))
    objects: dict[str, str] = {}
    for name, text in files.items():
        source = folder / name
        source.parent.mkdir(parents=True, exist_ok=True)
        source.write_bytes(text)
        _run([*compiler, "-c", str(source), "-o", str(source.with_suffix(".o"))], root)
        objects[_module(name)] = str(source.with_suffix(".o"))
    return objects


def _with_stubs(root: Path, stubs: frozenset[str]) -> Path:
    key = hashlib.sha256(" ".join(sorted(stubs)).encode()).hexdigest()[:16]
    folder = root / "build" / "expected" / f"stubs-{key}"
    folder.mkdir(parents=True, exist_ok=True)
    with locked(folder / ".lock"):
        return _link(root, folder, _stub_objects(root, folder, stubs))


def _link(root: Path, folder: Path, own: Mapping[str, str]) -> Path:
    """The program in a folder, with these objects in place of the reference's."""
    objects = _make(root, "-s", "list-objects").split()
    objects.append(str(Path(objects[0]).parents[1] / "main.o"))
    linked = [own.get(_module(path), path) for path in objects]
    compiler, *_ = shlex.split(_make(root, "-s", "list-compiler"))
    libraries = shlex.split(_make(root, "-s", "list-libraries"))
    program, aside = folder / "raybook", folder / ".raybook.part"
    # The program that is there may be running.
    _run([compiler, "-fopenmp", *linked, *libraries, "-o", str(aside)], root)
    aside.replace(program)
    return program


def _stub_objects(root: Path, folder: Path, stubs: frozenset[str]) -> dict[str, str]:
    """The objects of the files that hold these exercises, as stubs; by module."""
    todos = load_tree(root).todos
    compiler = shlex.split(_make(root, "-s", "list-compiler"))
    objects: dict[str, str] = {}
    for file in sorted({todos[name].file for name in stubs}):
        defines = [f"-DTODO_{name}" for name in sorted(stubs) if todos[name].file == file]
        target = folder / f"{Path(file).parent.name}-{Path(file).stem}.o"
        _run([*compiler, *defines, "-c", file, "-o", str(target)], root)
        objects[_module(file)] = str(target)
    return objects


def _module(path: str) -> str:
    """Such as "accel/bvh", for `src/accel/bvh.c` and its object: no two modules share it."""
    return "/".join(Path(path).with_suffix("").parts[-2:])


def _make(root: Path, *words: str) -> str:
    environment = {k: v for k, v in os.environ.items() if k not in _SETTINGS}
    command = ["make", f"-j{os.cpu_count() or 1}", "--no-print-directory", "CHECK=yes", *words]
    with locked(root / "build" / ".make.lock"):
        return _run(command, root, environment)


def _run(command: Sequence[str], root: Path, environment: dict[str, str] | None = None) -> str:
    done = subprocess.run(command, cwd=root, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        raise BadInput(f"{root}: the reference cannot be built:\n{done.stderr[-2000:]}")
    return done.stdout
