"""What the fuzzer kept (run.py --keep) and the seeds do no harm, under the sanitizers."""

from __future__ import annotations

import re
import subprocess
import zipfile
from pathlib import Path

import pytest
from fuzz_build import CHECKOUT, HARNESSES, HERE, build_replay
from fuzz_seeds import furniture, seeds

SECONDS = 120.0
"""Takes a few; more means that a file hangs a reader."""
REFUSED = ("malformed", "cut.hdr", "dwaa-")
"""Seeds that are not right, or beyond OpenEXRCore 3.1."""


def replay(program: Path, folder: Path, files: dict[str, bytes]) -> tuple[int, str]:
    """The harness's exit code, and each file's name with the reader's answer below it."""
    for file, data in furniture().items():
        (folder / file).write_bytes(data)
    corpus = folder / "corpus"
    corpus.mkdir()
    for file, data in files.items():
        (corpus / file).write_bytes(data)
    command = [str(program), *(f"corpus/{file}" for file in sorted(files))]
    done = subprocess.run(
        command, cwd=folder, capture_output=True, text=True, errors="replace", timeout=SECONDS
    )
    return done.returncode, done.stderr


@pytest.mark.parametrize("name", HARNESSES)
def test_the_corpus_does_no_harm(name: str, tmp_path: Path) -> None:
    with zipfile.ZipFile(HERE / "corpus" / f"{name}.zip") as archive:
        files = {file: archive.read(file) for file in archive.namelist()}
    assert len(files) > 100
    code, told = replay(build_replay(name), tmp_path, files)
    assert code == 0, told[-3000:]
    assert told.count("corpus/") >= len(files)


@pytest.mark.parametrize("name", HARNESSES)
def test_the_seeds_are_read(name: str, tmp_path: Path) -> None:
    """So the fuzzer starts behind the readers' first checks."""
    right = {file: data for file, data in seeds(name).items() if not file.startswith(REFUSED)}
    code, told = replay(build_replay(name), tmp_path, right)
    assert code == 0, told[-3000:]
    assert "refused: " not in told, told
    assert told.count("  read") >= len(right) >= 3


def test_a_planted_fault_is_found(tmp_path: Path) -> None:
    text = (CHECKOUT / "src" / "scene" / "obj_reader.c").read_text()
    assert text.count("if (value > count ||") == 1
    mutant = tmp_path / "obj_reader.c"
    mutant.write_text(text.replace("if (value > count ||", "if (value > count + 9 ||"))
    code, told = replay(build_replay("obj", mutant), tmp_path, seeds("obj"))
    assert code != 0
    assert re.search("AddressSanitizer|runtime error|broken: ", told)
