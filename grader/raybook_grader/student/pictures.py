"""Rendering a public picture with the student's build, and judging it as the grader does."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..checks.words import clean
from ..course.pictures import PublicPicture
from ..judge.bias import verdict
from ..judge.exr import UnusableImage, read_exr
from ..judge.findings import Reason
from ..judge.pixels import Image, luminance
from ..judge.reference import ReferenceStatistics
from .running import all_threads, run_limited

_FRESH = 1000
"""The second look's seeds are the first look's plus this, as in the grader."""


class NoPicture(Exception):
    """The renderer gave none; the text says why."""


@dataclass(frozen=True)
class JudgedPicture:
    """``yours`` is the mean over the seeds; None, with one reason, if there is no picture.

    ``pixel`` (x, y) is where it is most wrong; None where nothing is.
    """

    picture: PublicPicture
    yours: Image | None
    expected: Image
    reasons: tuple[str, ...]
    pixel: tuple[int, int] | None = None

    @property
    def is_right(self) -> bool:
        return not self.reasons


def judge_picture(
    renderer: Path,
    root: Path,
    picture: PublicPicture,
    reference: ReferenceStatistics,
    seconds: float,
) -> JudgedPicture:
    """The picture against what is expected; each rendering may take so long."""
    first: list[Image] = []

    def render(seeds: Sequence[int]) -> list[Image]:
        images = list(render_seeds(renderer, root, picture, seeds, seconds))
        first.extend([] if first else images)
        return images

    seeds = range(1, picture.seeds + 1)
    try:
        found = verdict(
            render, reference, picture.spp, seeds=seeds, fresh_seeds=[s + _FRESH for s in seeds]
        )
    except NoPicture as reason:
        return JudgedPicture(picture, None, reference.mean, (str(reason),))
    yours: Image = np.stack(first).mean(axis=0, dtype=np.float64).astype(np.float32)
    wrong = found.status != "pass"
    return JudgedPicture(
        picture,
        yours,
        reference.mean,
        tuple(reason.sentence for reason in found.reasons) if wrong else (),
        _worst_pixel(yours, reference.mean, found.reasons) if wrong else None,
    )


def render_seeds(
    renderer: Path, root: Path, picture: PublicPicture, seeds: Sequence[int], seconds: float
) -> Iterator[Image]:
    """One rendering a seed; raises `NoPicture`."""
    with tempfile.TemporaryDirectory(prefix="raybook-") as folder:
        for seed in seeds:
            file = Path(folder, "picture.exr")
            options = ["--quiet", "--seed", str(seed), "--spp", str(picture.spp)]
            command = [str(renderer), picture.scene, *options, *picture.settings, "-o", str(file)]
            _run(command, root, seconds)
            try:
                yield read_exr(file).pixels
            except UnusableImage as reason:
                raise NoPicture(f"the picture cannot be read: {reason}") from None


def _run(command: list[str], root: Path, seconds: float) -> None:
    ended = run_limited(command, root, seconds, all_threads())
    if ended.code is None:
        raise NoPicture(f"the renderer was not done after {seconds:g} s")
    if ended.code < 0:
        raise NoPicture(f"the renderer crashed (signal {-ended.code})")
    if ended.code != 0:
        said = clean(ended.err, 5).strip()
        raise NoPicture(f"the renderer ended with exit code {ended.code}: {said}")


def _worst_pixel(
    yours: Image, expected: Image, reasons: Sequence[Reason]
) -> tuple[int, int] | None:
    """In the tile that the judge names, else in the whole picture."""
    if yours.shape != expected.shape:
        return None
    tile = next((reason.tile for reason in reasons if reason.tile), None)
    off = np.abs(luminance(np.nan_to_num(yours, posinf=1e6)) - luminance(expected))
    if tile:
        inside = np.zeros(off.shape)
        inside[tile.y0 : tile.y1 + 1, tile.x0 : tile.x1 + 1] = 1
        off = off * inside
    y, x = np.unravel_index(np.argmax(off), off.shape)
    return int(x), int(y)
