"""From a checkout to the first picture: groups `start`, `loading`."""

from __future__ import annotations

import contextlib
import os
import resource
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from bench_effort import Effort
from bench_machine import busy, processors
from bench_programs import BUILD, ROOT, ask, program
from bench_rows import Row, spread

from raybook_grader.files import write_text

FIRST = Path("build/out")
LONGEST = 300.0
OF_BENCH = {"ARGS", "QUICK", "SCENE", "VARIANT", "TODO", "CC", "OPT", "CFLAGS", "LDFLAGS", "V"}
"""What may stand behind `make bench`, and would change the makes inside."""


def start_rows(effort: Effort) -> Iterator[Row]:
    """In a copy of the checkout, so that nothing here is built anew."""
    scene = "cornell-box"
    row = Row("start", "", scene, unit="s", note=busy())
    with tempfile.TemporaryDirectory(prefix="raybook-bench-") as folder:
        copy = copy_checkout(Path(folder) / "raybook")
        cores = len(processors())
        wall, cpu = _timed(copy, "make", "-s", f"-j{cores}", "build")
        note = f"{cpu:.1f} s of processor time; {row.note}".removesuffix("; ")
        yield replace(
            row, name="clean build", scene="", kind=f"{cores} cores", figure=wall, note=note
        )
        if effort.long_rows:
            fresh = first_picture(copy_checkout(Path(folder) / "fresh"))
            yield replace(
                row, name="first picture, nothing built", kind="make render", figure=fresh
            )
        first_picture(copy)  # makes the meshes
        again = [first_picture(copy) for _ in range(3 if effort.long_rows else 1)]
        yield replace(row, name="first picture", kind="make render", figure=spread(again).median)


def copy_checkout(folder: Path) -> Path:
    """The files under version control, with what `make setup` has installed in this one."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    for name in filter(None, listed.stdout.split("\0")):
        if not name.startswith(("grader/", "assignments/")) and (ROOT / name).is_file():
            target = folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target)
    tried = Path("build/setup/optional-tried")  # so that setup does not try again
    if (ROOT / tried).is_file():
        (folder / tried).parent.mkdir(parents=True)
        shutil.copy2(ROOT / tried, folder / tried)
    return folder


def first_picture(checkout: Path) -> float:
    """Seconds from `make render` until the first picture is there; the rest is not waited for."""
    out = checkout / FIRST
    shutil.rmtree(out, ignore_errors=True)
    begun = time.monotonic()
    process = subprocess.Popen(
        ["make", "-s", "render"], cwd=checkout, env=clean_environment(), start_new_session=True,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        while not any(out.glob("*.png")):
            if process.poll() is not None:
                raise RuntimeError(f"make render: exit code {process.returncode}")
            if time.monotonic() - begun > LONGEST:
                raise RuntimeError("make render: no picture")
            time.sleep(0.005)
        return time.monotonic() - begun
    finally:
        _end(process)


def _end(process: subprocess.Popen[bytes]) -> None:
    """make and what it has started, which are a group of their own."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGTERM)
    process.wait()


def _timed(folder: Path, *command: str) -> tuple[float, float]:
    """Seconds by the clock, and of processor time."""
    begun, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(
        command, cwd=folder, env=clean_environment(), check=True, stdout=subprocess.DEVNULL
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return time.monotonic() - begun, cpu


def clean_environment() -> dict[str, str]:
    """Everything is installed: in this checkout. Without what a make around this may have set."""
    kept = {
        k: v
        for k, v in os.environ.items()
        if not k.startswith(("MAKE", "MFLAGS")) and k not in OF_BENCH
    }
    unity = os.environ.get("UNITY_ROOT") or str(ROOT / "build" / "unity")
    return {**kept, "RAYBOOK_VENV": str(ROOT / "build" / "venv"), "UNITY_ROOT": unity}


def loading_rows(effort: Effort) -> Iterator[Row]:
    """Reading a mesh of a million triangles."""
    file = BUILD / f"grid-{effort.obj_triangles}.obj"
    if not file.is_file():
        BUILD.mkdir(parents=True, exist_ok=True)
        write_text(file, grid(effort.obj_triangles))
    found = ask(program(), "load", str(file), effort.repeats)
    took = spread([wall for wall, _ in found["seconds"]])
    yield Row(
        "loading", "obj", f"grid, {found['triangles'] / 1e6:.1f} Mtri", "wall clock",
        figure=took.median, unit="s", low=took.low, high=took.high,
        note=f"{file.stat().st_size / 1e6:.0f} MB",
    )  # fmt: skip


def grid(triangles: int) -> str:
    """A bumpy square of about so many triangles, with texture coordinates, as OBJ text."""
    side = max(1, round((triangles / 2) ** 0.5))
    lines = []
    for j in range(side + 1):
        for i in range(side + 1):
            height = (i * 7919 + j * 104729) % 1000 / 1e5
            lines.append(f"v {i / side:.6f} {height:.5f} {j / side:.6f}\n")
    steps = range(side + 1)
    lines += [f"vt {i / side:.6f} {j / side:.6f}\n" for j in steps for i in steps]
    for j in range(side):
        for i in range(side):
            a = j * (side + 1) + i + 1
            b = a + side + 1
            lines.append(f"f {a}/{a} {b}/{b} {a + 1}/{a + 1}\n")
            lines.append(f"f {a + 1}/{a + 1} {b}/{b} {b + 1}/{b + 1}\n")
    return "".join(lines)
