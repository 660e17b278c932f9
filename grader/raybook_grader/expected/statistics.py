"""What a public picture looks like: many renderings by the reference, reduced, and kept.

They lie under `build/expected/`, named by the hash of all they were made from.
"""

from __future__ import annotations

import hashlib
import os
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

from ..checks.scene import scene_fingerprint
from ..course.pictures import PublicPicture
from ..errors import BadInput
from ..judge.exr import read_exr
from ..judge.pixels import Image
from ..judge.reference import MIN_CHUNKS, VERSION, ReferenceStatistics, reduce_reference

EXPECTED_SPP = 1024
"""Samples a pixel at least, over all seeds: a student's picture has some 64."""

_FIRST_SEED = 1_000_000  # far from any that a student's check asks for


def expected_file(root: Path, program: Path, picture: PublicPicture) -> Path:
    """The statistics of a picture by this program, made if they are not there."""
    file = kept(root, program, picture, "statistics", (VERSION, EXPECTED_SPP)).with_suffix(".npz")
    if not file.is_file():
        spp = max(picture.spp, -(-EXPECTED_SPP // MIN_CHUNKS))
        reduce_reference(_chunks(root, program, picture, spp), spp).save(file)
    return file


def expected_statistics(root: Path, program: Path, picture: PublicPicture) -> ReferenceStatistics:
    """The same, read."""
    return ReferenceStatistics.load(expected_file(root, program, picture))


def kept(root: Path, program: Path, picture: PublicPicture, what: str, version: object) -> Path:
    """Where something made from a picture by this program is kept."""
    built = hashlib.sha256(program.read_bytes()).hexdigest()
    made_from = (what, version, built, scene_fingerprint(root, picture.scene), picture)
    key = hashlib.sha256(repr(made_from).encode()).hexdigest()[:24]
    folder = root / "build" / "expected"
    folder.mkdir(parents=True, exist_ok=True)
    return folder / f"{picture.name}-{what}-{key}"


def _chunks(root: Path, program: Path, picture: PublicPicture, spp: int) -> Iterator[Image]:
    with tempfile.TemporaryDirectory(prefix="raybook-") as folder:
        file = Path(folder, "chunk.exr")
        for chunk in range(MIN_CHUNKS):
            options = ["--quiet", "--seed", str(_FIRST_SEED + chunk), "--spp", str(spp)]
            options += ["--threads", str(os.cpu_count() or 1), *picture.settings]
            run_reference([str(program), picture.scene, *options, "-o", str(file)], root)
            yield read_exr(file).pixels


def run_reference(command: list[str], root: Path) -> str:
    """Run the reference; what it printed."""
    done = subprocess.run(command, cwd=root, capture_output=True, text=True)
    if done.returncode != 0:
        raise BadInput(f"{' '.join(command)}: exit code {done.returncode}: {done.stderr.strip()}")
    return done.stdout
