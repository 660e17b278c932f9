"""The C program that measures, linked with the renderer's objects, and asking it."""

from __future__ import annotations

import functools
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

from bench_machine import pinned

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "renderer"))
from renderer_runs import make

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
BUILD = ROOT / "build" / "bench"


@functools.cache
def program(name: str = "bench", replaced: tuple[str, Path] | None = None) -> Path:
    """bench_main.c and its commands, up to date. `replaced`: an object of the renderer, named as
    "accel/bvh.o", and the source that takes its place; the program is called `name` then."""
    objects = [ROOT / path for path in _words("list-objects")]
    sources = sorted(HERE.glob("bench_*.c"))
    if replaced:
        left_out, source = replaced
        objects = [path for path in objects if f"{path.parent.name}/{path.name}" != left_out]
        sources.append(source)
    out = BUILD / name
    if _is_older(out, [*objects, *sources, *HERE.glob("bench_*.h")]):
        BUILD.mkdir(parents=True, exist_ok=True)
        files = [str(path) for path in (*sources, *objects)]
        command = [*_words("list-compiler"), f"-I{HERE}", *files, *_words("list-libraries")]
        aside = out.with_suffix(".new")
        subprocess.run([*command, "-o", str(aside)], cwd=ROOT, check=True)
        aside.replace(out)
    return out


def ask(binary: Path, *arguments: str | int, alone: bool = True) -> Any:
    """What a command says, as values; alone: bound to one processor."""
    command = [str(binary), *map(str, arguments)]
    done = subprocess.run(
        pinned(command) if alone else command, stdout=subprocess.PIPE, text=True, check=True
    )
    return json.loads(done.stdout)


def _is_older(out: Path, parts: list[Path]) -> bool:
    return not out.is_file() or out.stat().st_mtime < max(p.stat().st_mtime for p in parts)


def _words(target: str) -> list[str]:
    return make("-s", target).splitlines()[-1].split()
