"""clangd understands every module: `make compile_commands.json` tells it all that it needs."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from renderer_runs import ROOT, SOURCE, make


@pytest.fixture(scope="module")
def commands() -> list[dict[str, Any]]:
    make("compile_commands.json")
    loaded: list[dict[str, Any]] = json.loads((ROOT / "compile_commands.json").read_text())
    return loaded


def test_every_source_file_is_listed(commands: list[dict[str, Any]]) -> None:
    listed = {entry["file"] for entry in commands}
    tests = ROOT.glob("assignments/*/test_*.c")
    assert listed == {str(p.relative_to(ROOT)) for p in [*SOURCE.rglob("*.c"), *tests]}
    assert all(Path(entry["directory"]).samefile(ROOT) for entry in commands)


def complaints(file: str) -> str:
    """The lines in which clangd reports a fault; empty when it has understood the file."""
    # Features such as completion are tried on the first line only: that is most of the time.
    command = ["clangd", f"--check={file}", "--check-lines=1", "--background-index=false"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=120)
    log = done.stdout + done.stderr
    assert "All checks completed" in log, log
    found = [line for line in log.splitlines() if re.match(r"E\[|.*\berror:", line)]
    if done.returncode != 0:
        found.append(log.splitlines()[-1])
    return "\n".join(found)


@pytest.mark.skipif(shutil.which("clangd") is None, reason="clangd is an optional package")
def test_clangd_finds_no_fault(commands: list[dict[str, Any]]) -> None:
    with ThreadPoolExecutor(2) as pool:
        files = [entry["file"] for entry in commands]
        found = dict(zip(files, pool.map(complaints, files), strict=True))
    assert not any(found.values()), {k: v for k, v in found.items() if v}
