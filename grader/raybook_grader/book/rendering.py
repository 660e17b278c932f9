"""Draws the pictures of the book with the renderer, or takes them from build/book/figures."""

from __future__ import annotations

import hashlib
import io
import json
import subprocess
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from ..course import load_course
from ..errors import BadInput
from ..expected.programs import reference_program, variant_program
from ..files import locked, write_bytes, write_text
from ..literate.tree import load_tree
from ..museum.exhibits import exhibits_of
from ..museum.patches import patched, target_of
from .figure_spec import FigureSpec, Picture, mistake_file, picture_key

_QUALITY = 92
_CELLS = (8, 6)
_LONGEST = 600  # seconds


@dataclass(frozen=True)
class Drawn:
    """A picture in the cache. `pixels` is a hash of them; `means` are the mean colours of 8 x 6
    cells in hexadecimal, which differ little where pictures do."""

    file: Path
    pixels: str
    means: str


def draw(root: Path, cache: Path, spec: FigureSpec, picture: Picture) -> Drawn:
    """The picture, up to date; raises BadInput if it cannot be drawn."""
    file = _file(cache, root, spec, picture)
    with locked(file.parent / ".lock"):  # the other edition may want it, too
        if not file.is_file() or not file.with_suffix(".json").is_file():
            image = render_pixels(root, spec, program_of(root, picture))
            return keep(cache, root, spec, picture, image)
    facts = json.loads(file.with_suffix(".json").read_text(encoding="utf-8"))
    return Drawn(file, facts["pixels"], facts["means"])


def keep(cache: Path, root: Path, spec: FigureSpec, picture: Picture, image: Image.Image) -> Drawn:
    """Put a picture into the cache."""
    file = _file(cache, root, spec, picture)
    file.parent.mkdir(parents=True, exist_ok=True)
    facts = _facts(image)
    write_bytes(file, _jpeg(image))
    write_text(file.with_suffix(".json"), json.dumps(facts))
    return Drawn(file, facts["pixels"], facts["means"])


def _file(cache: Path, root: Path, spec: FigureSpec, picture: Picture) -> Path:
    return cache / picture_key(root, spec, picture) / f"{spec.name}-{picture.kind}.jpg"


def program_of(root: Path, picture: Picture) -> Path:
    if picture.mistake:
        return variant_program(root, mistaken_files(root, picture.mistake))
    if unknown := picture.stubs - load_tree(root).todos.keys():
        raise BadInput(f"stub {', '.join(sorted(unknown))}: no such exercise")
    return reference_program(root, picture.stubs)


def mistaken_files(root: Path, mistake: str) -> Mapping[str, bytes]:
    """The files that a mistake changes, by their paths below the checkout."""
    patch = mistake_file(root, mistake)
    assignment, _, name = mistake.rpartition("/")
    if not assignment:
        diff = patch.read_text(encoding="utf-8")
        target = target_of(diff)
        return {str(target): patched(patch, diff, target, (root / target).read_bytes())}
    of = next(a for a in load_course(root).assignments if a.folder.name == assignment)
    exhibits = exhibits_of(root, of, strict=False)
    return next(e.files for e in exhibits if e.slug == name.removesuffix(".patch"))


def render_pixels(root: Path, spec: FigureSpec, program: Path) -> Image.Image:
    with tempfile.TemporaryDirectory(prefix="raybook-") as folder:
        out = Path(folder, "figure.png")
        command = [str(program), spec.scene, *spec.options, "-o", str(out), "--quiet"]
        done = subprocess.run(
            command, cwd=root, capture_output=True, text=True, timeout=_LONGEST, check=False
        )
        if done.returncode != 0 or not out.is_file():
            raise BadInput(f"{spec.command}: {done.stderr.strip()[-600:]}")
        with Image.open(out) as image:
            return image.convert("RGB")


def _jpeg(image: Image.Image) -> bytes:
    stream = io.BytesIO()
    # Not optimised: for that Pillow has a buffer of a byte a pixel, and noise needs more.
    image.save(stream, "JPEG", quality=_QUALITY, subsampling=0)
    return stream.getvalue()


def _facts(image: Image.Image) -> dict[str, str]:
    means = image.resize(_CELLS, Image.Resampling.BOX)
    return {
        "pixels": hashlib.sha256(image.tobytes()).hexdigest()[:32],
        "means": np.asarray(means, dtype=np.uint8).tobytes().hex(),
    }
