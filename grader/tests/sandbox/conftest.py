"""Tiny C programs, compiled outside and run in a box."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import pytest
from tiny_programs import PRELUDE, QUICK, Compile, RunC

from raybook_grader.sandbox import Box, BoxResult, Limits, require


@pytest.fixture(scope="session")
def box() -> Iterator[Box]:
    require()
    with Box() as made:
        yield made


@pytest.fixture
def compile_c(tmp_path: Path) -> Compile:
    """Compiles C text (after PRELUDE) and returns the executable's bytes."""

    def compile_(text: str, *flags: str) -> bytes:
        source, program = tmp_path / "program.c", tmp_path / "program"
        source.write_text(PRELUDE + text)
        command = ["gcc", "-w", "-O1", "-o", str(program), str(source), *flags]
        subprocess.run(command, check=True)
        return program.read_bytes()

    return compile_


@pytest.fixture
def run_c(box: Box, compile_c: Compile) -> RunC:
    """Runs the body of a main(argc, argv) in a box."""

    def run(
        body: str,
        *,
        before: str = "",
        flags: Sequence[str] = (),
        limits: Limits = QUICK,
        collect: Sequence[str] = (),
        arguments: Sequence[str] = (),
        inputs: Mapping[str, bytes] | None = None,
        binds: Mapping[str, Path] | None = None,
        env: Mapping[str, str] | None = None,
        stdin: bytes = b"",
    ) -> BoxResult:
        text = f"{before}\nint main(int argc, char **argv) {{ {body} }}\n"
        return box.run(
            ["/program", *arguments],
            inputs={"/program": compile_c(text, *flags), **(inputs or {})},
            binds=binds or {},
            collect=collect,
            limits=limits,
            env=env,
            stdin=stdin,
        )

    return run
