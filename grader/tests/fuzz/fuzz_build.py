"""Compile the harnesses: with libFuzzer to search, or with gcc to replay what was found."""

from __future__ import annotations

import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from raybook_grader.files import locked

HERE = Path(__file__).resolve().parent
CHECKOUT = HERE.parents[2]
BUILD = CHECKOUT / "build" / "fuzz"
HARNESSES = ("scene", "obj", "image")

SANITIZE = "address,undefined,float-cast-overflow"
CLANG = (
    *("clang", "-std=c99", "-O1", "-g", "-ffp-contract=off", "-fno-omit-frame-pointer"),
    *("-fno-sanitize-recover=all", "-DRAYBOOK_FUZZ"),
)


def library_flags(kind: str) -> list[str]:
    """pkg-config's --cflags or --libs, the former so that the libraries' headers do not warn."""
    names = ("OpenEXR", "libcjson", "stb")
    said = subprocess.run(
        ["pkg-config", kind, *names], check=True, capture_output=True, text=True
    ).stdout.split()
    if kind == "--cflags":
        return [flag.replace("-I", "-isystem", 1) for flag in said]
    core = [flag for flag in said if flag.startswith(("-L", "-lOpenEXRCore"))]
    return [*core, "-lcjson", "-lm"]


def build_fuzzer(name: str) -> Path:
    """The harness with the whole renderer (no OpenMP: one thread), instrumented for coverage."""
    objects = _instrumented_objects()
    program = BUILD / f"fuzz-{name}"
    _run(
        *CLANG, f"-fsanitize=fuzzer,{SANITIZE}", f"-I{CHECKOUT / 'src'}",
        str(HERE / f"fuzz_{name}.c"), *map(str, objects), *library_flags("--libs"),
        "-o", str(program),
    )  # fmt: skip
    return program


def _instrumented_objects() -> list[Path]:
    """Every source but main.c, what needs Embree, and those that have a stand-in here; made anew
    when older."""
    ours = [HERE / "fuzz_file.c", HERE / "read_limits.c"]
    left_out = {"embree.c", *(file.name for file in ours)}
    sources = sorted(
        file
        for file in (CHECKOUT / "src").glob("*/*.c")
        if not file.name.startswith("test_") and file.name not in left_out
    )
    newest_header = max(file.stat().st_mtime for file in (CHECKOUT / "src").glob("*/*.h"))
    folder = BUILD / "objects"
    folder.mkdir(parents=True, exist_ok=True)
    flags = [*library_flags("--cflags"), f"-I{CHECKOUT / 'src'}", '-DRAYBOOK_VERSION="fuzz"',
             '-DRAYBOOK_VARIANT="fuzz"']  # fmt: skip

    def compiled(source: Path) -> Path:
        out = folder / f"{source.parent.name}-{source.stem}.o"
        stale = max(source.stat().st_mtime, newest_header)
        if not out.is_file() or out.stat().st_mtime < stale:
            sanitize = [f"-fsanitize=fuzzer-no-link,{SANITIZE}"]
            if source.stem == "stb_library":  # others' code: as in build.mk, memory alone
                sanitize.append("-fno-sanitize=undefined,float-cast-overflow")
            _run(*CLANG, *sanitize, *flags, "-c", str(source), "-o", str(out))
        return out

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(compiled, [*sources, *ours]))


def build_replay(name: str, mutant: Path | None = None) -> Path:
    """The harness on files: compiled and linked as `make OPT=asan` does, with the real limits.

    mutant: a source that takes the place of the renderer's of the same name.
    """
    objects = _make_says("list-objects")
    if mutant:
        objects = [path for path in objects if not path.endswith(f"/{mutant.stem}.o")]
        objects.append(str(mutant))
    program = BUILD / f"replay-{name}"
    program.parent.mkdir(parents=True, exist_ok=True)
    mains = [str(HERE / file) for file in ("replay.c", "fuzz_file.c", f"fuzz_{name}.c")]
    libraries = _make_says("list-libraries")
    _run(*_make_says("list-compiler"), *mains, *objects, *libraries, "-o", str(program))
    return program


def _make_says(target: str) -> list[str]:
    """The words of the last line; whatever make this may run under is kept out of it."""
    alone = {k: v for k, v in os.environ.items() if not k.startswith(("MAKE", "MFLAGS"))}
    command = ["make", "-s", "OPT=asan", "CC=gcc", target]
    with locked(CHECKOUT / "build" / ".make.lock"):
        done = subprocess.run(command, cwd=CHECKOUT, env=alone, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    return done.stdout.splitlines()[-1].split()


def _run(*command: str) -> None:
    done = subprocess.run(command, cwd=CHECKOUT, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
