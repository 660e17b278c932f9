"""Writes build/kit/: the reference renderer in pieces, for linking with one student's module.

Run by `make kit`. The kit holds ``objects/**/*.o`` (no link-time optimisation), all headers
under ``include/``, and ``kit.json``: the compiler, its flags, and for each module the symbols
that its contract asks for (what the reference's object defines). Standard library only.
"""

from __future__ import annotations

import argparse
import json
import os
import shlex
import shutil
import subprocess
from pathlib import Path


def defined_symbols(obj: Path) -> list[str]:
    """The names that an object file defines for others."""
    command = ["nm", "--defined-only", "--extern-only", "--format=posix", str(obj)]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    return sorted(line.split()[0] for line in lines)


def copy_tree(source: Path, target: Path, suffix: str) -> list[Path]:
    """Copies all files with a suffix; returns their paths below source."""
    found = sorted(p.relative_to(source) for p in source.rglob(f"*{suffix}"))
    for path in found:
        (target / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source / path, target / path)
    return found


def describe(arguments: argparse.Namespace, objects: list[Path]) -> dict[str, object]:
    """What kit.json says."""
    modules = {
        f"src/{path.with_suffix('.c')}": {
            "object": f"objects/{path}",
            "symbols": defined_symbols(arguments.objects / path),
        }
        for path in objects
        if Path("src", path.with_suffix(".h")).exists()
    }
    return {
        "version": arguments.version,
        "cc": arguments.cc,
        "cflags": shlex.split(arguments.cflags),
        "ldflags": shlex.split(arguments.ldflags),
        "ldlibs": shlex.split(arguments.ldlibs),
        "objcopy": "objcopy",
        "modules": modules,
    }


def contents(folder: Path) -> dict[Path, bytes]:
    """Every file below a folder."""
    files = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder): path.read_bytes() for path in files}


def put_in_place(fresh: Path, out: Path) -> None:
    """Replaces a kit at once and as a whole; one that is the same stays, as it may be in use."""
    old = out.with_name(f"{fresh.name}.old")
    if not out.exists():
        fresh.rename(out)
    elif contents(fresh) == contents(out):
        shutil.rmtree(fresh)
    else:
        out.rename(old)
        fresh.rename(out)
        shutil.rmtree(old)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--objects", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    for name in ("version", "cc", "cflags", "ldflags", "ldlibs"):
        parser.add_argument(f"--{name}", default="")
    arguments = parser.parse_args()
    fresh = arguments.out.with_name(f"{arguments.out.name}.{os.getpid()}")
    shutil.rmtree(fresh, ignore_errors=True)
    objects = copy_tree(arguments.objects, fresh / "objects", ".o")
    copy_tree(Path("src"), fresh / "include", ".h")
    text = json.dumps(describe(arguments, objects), indent=1)
    (fresh / "kit.json").write_text(text, encoding="utf-8")
    put_in_place(fresh, arguments.out)


if __name__ == "__main__":
    main()
