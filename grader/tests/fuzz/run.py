"""Fuzz the readers: python grader/tests/fuzz/run.py --seconds 600 [--only image] [--keep]

For each harness in turn: compile it with clang's libFuzzer and sanitizers, start from the seeds
and the kept corpus, search for so many seconds on one core, and report. A finding is a file that
makes the harness crash, leak, or take 20 seconds or 2 GiB; it stays in build/fuzz/NAME/found/.

--keep writes the smallest set of files that covers what is known to be reachable, findings
included, to corpus/NAME.zip: commit it, and test_fuzz_corpus.py replays it in every `make test`.

Exit code: 0 nothing found, 1 findings.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from dataclasses import dataclass
from pathlib import Path

from fuzz_build import BUILD, HARNESSES, HERE, build_fuzzer
from fuzz_seeds import dictionary, furniture, seeds

CORPUS = HERE / "corpus"
LIMITS = ("-timeout=20", "-report_slow_units=20", "-rss_limit_mb=2048", "-max_len=8192")
MEMORY = "/dev/shm"
"""Where the harnesses write the file that is to be read, if it is there."""


@dataclass(frozen=True)
class Place:
    """One harness's folders under build/fuzz/NAME."""

    name: str

    @property
    def corpus(self) -> Path:
        return BUILD / self.name / "corpus"

    @property
    def found(self) -> Path:
        return BUILD / self.name / "found"

    @property
    def archive(self) -> Path:
        return CORPUS / f"{self.name}.zip"


def main(arguments: list[str] | None = None) -> int:
    """The command line; see the top of this file."""
    parser = argparse.ArgumentParser(description="Fuzz the readers of scenes, meshes and images.")
    parser.add_argument("--seconds", type=int, default=60, help="for each harness (default 60)")
    parser.add_argument("--only", choices=HARNESSES, help="this harness alone")
    parser.add_argument("--keep", action="store_true", help="write corpus/NAME.zip")
    chosen = parser.parse_args(arguments)
    findings = 0
    for name in [chosen.only] if chosen.only else HARNESSES:
        place = Place(name)
        program = build_fuzzer(name)
        prepare(place)
        if chosen.seconds > 0:
            print(f"{name}: {search(place, program, chosen.seconds)}", flush=True)
        if chosen.keep:
            print(f"{name}: {keep(place, program)}", flush=True)
        found = sorted(place.found.iterdir())
        findings += len(found)
        for path in found:
            print(f"{name}: found {path}", flush=True)
    return 1 if findings else 0


def prepare(place: Place) -> None:
    """The folders, with the seeds and what was kept."""
    place.corpus.mkdir(parents=True, exist_ok=True)
    place.found.mkdir(exist_ok=True)
    for name, data in seeds(place.name).items():
        (place.corpus / f"seed-{name}").write_bytes(data)
    if place.archive.is_file():
        with zipfile.ZipFile(place.archive) as archive:
            archive.extractall(place.corpus)
    (BUILD / "words.dict").write_text(dictionary())


def search(place: Place, program: Path, seconds: int) -> str:
    """libFuzzer in a process that it starts again after each crash; its last words, summed up."""
    options = [*LIMITS, "-fork=1", "-ignore_crashes=1", "-ignore_ooms=1", "-ignore_timeouts=1"]
    options += [f"-max_total_time={seconds}", f"-artifact_prefix={place.found}/"]
    options += [f"-dict={BUILD / 'words.dict'}"]
    log = _run(place, program, [*options, str(place.corpus)])
    (BUILD / place.name / "search.log").write_text(log)
    last = re.findall(r"#(\d+): cov: (\d+) ft: (\d+) corp: (\d+)", log)
    if not last:
        raise RuntimeError(f"{place.name}: libFuzzer did not start\n{log[-3000:]}")
    runs, edges, features, files = last[-1]
    return f"{seconds} s, {runs} runs, {edges} edges, {features} features, {files} files"


def keep(place: Place, program: Path) -> str:
    """Fewest files for all known features, and the findings, in one archive."""
    with tempfile.TemporaryDirectory() as folder:
        _run(place, program, ["-merge=1", *LIMITS, folder, str(place.corpus)])
        files = {path.name: path.read_bytes() for path in Path(folder).iterdir()}
    files.update((path.name, path.read_bytes()) for path in place.found.iterdir())
    CORPUS.mkdir(exist_ok=True)
    aside = place.archive.with_suffix(".new")
    with zipfile.ZipFile(aside, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in sorted(files):
            archive.writestr(zipfile.ZipInfo(name), files[name], zipfile.ZIP_DEFLATED)
    aside.replace(place.archive)
    return f"kept {len(files)} files, {place.archive.stat().st_size} bytes"


def _run(place: Place, program: Path, arguments: list[str]) -> str:
    """In a folder with the furniture; all that it printed."""
    home = MEMORY if Path(MEMORY).is_dir() else None
    with tempfile.TemporaryDirectory(prefix=f"fuzz-{place.name}-", dir=home) as folder:
        for name, data in furniture().items():
            (Path(folder) / name).write_bytes(data)
        done = subprocess.run(
            [program, *arguments], cwd=folder, capture_output=True, text=True, errors="replace"
        )
    return done.stdout + done.stderr


if __name__ == "__main__":
    if not shutil.which("clang"):
        sys.exit("run.py: clang is not there: run `make setup`")
    sys.exit(main())
