"""The reference's pictures: rendered once by the kit's own renderer, and kept.

They lie under `build/reference/`, in a folder named by the hash of all they were made from, so
that a change in the renderer, the scene or the settings makes new ones.

The statistics of the course's own scenes are shipped, too, in `grader/statistics/`: what a
picture converges to does not change with the renderer's version. `raybook-grader references`
makes them again, and a test compares them with the renderer as it is.
"""

from __future__ import annotations

import hashlib
import math
import os
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path

from ..files import locked, write_bytes
from ..judge.exr import decode_exr
from ..judge.pixels import Image
from ..judge.reference import MIN_CHUNKS, VERSION, ReferenceStatistics, reduce_reference
from ..sandbox import Limits
from .program import HarnessFault, Workshop
from .rendering import PICTURE, Picture
from .scene import scene_binds, scene_fingerprint

REFERENCE_SPP = 4096
"""Samples a pixel that a reference has at least, over all its seeds."""

_FIRST_SEED = 1_000_000  # far from any seed that a student's renderer is asked for
_LIMITS = Limits(wall_seconds=3600, cpu_seconds=7200, memory_bytes=8 << 30)


class References:
    """The reference's statistics and renders; in memory after their first use."""

    def __init__(self, workshop: Workshop) -> None:
        self._workshop = workshop
        self._renderer = cache(workshop.renderer)
        self.statistics = cache(self._statistics)
        self._render = cache(self._render_kept)

    def is_ready(self, picture: Picture) -> bool:
        """Whether `statistics` would answer at once."""
        return self.shipped_file(picture).is_file() or self._file(picture).is_file()

    def renders(self, picture: Picture) -> Callable[[Sequence[int]], list[Image]]:
        """The reference's renders at any seeds."""
        return lambda seeds: [self._render(picture, seed) for seed in seeds]

    def shipped_file(self, picture: Picture) -> Path:
        """Where the statistics of a picture are committed; they depend on the scene alone."""
        root, (width, height) = self._workshop.course.root, picture.resolution
        made_from = (scene_fingerprint(root, picture.scene), picture.resolution, VERSION)
        key = hashlib.sha256(repr(made_from).encode()).hexdigest()[:16]
        name = f"{Path(picture.scene).stem}-{width}x{height}-{key}.npz"
        return root / "grader" / "statistics" / name

    def _statistics(self, picture: Picture) -> ReferenceStatistics:
        shipped = self.shipped_file(picture)
        return ReferenceStatistics.load(shipped) if shipped.is_file() else self.rendered(picture)

    def rendered(self, picture: Picture) -> ReferenceStatistics:
        """The statistics of this very renderer's pictures."""
        file = self._file(picture)
        with locked(file.with_name(".lock")):
            if not file.is_file():
                spp = max(picture.spp, math.ceil(REFERENCE_SPP / MIN_CHUNKS))
                chunks = self._chunks(Picture(picture.scene, picture.resolution, spp))
                reduce_reference(chunks, spp).save(file)
        return ReferenceStatistics.load(file)

    def _chunks(self, picture: Picture) -> Iterator[Image]:
        threads = len(os.sched_getaffinity(0))
        for chunk in range(MIN_CHUNKS):
            yield decode_exr(self._run(picture, _FIRST_SEED + chunk, threads)).pixels

    def _render_kept(self, picture: Picture, seed: int) -> Image:
        file = self._file(picture).with_name(f"seed-{seed}.exr")
        if not file.is_file():
            write_bytes(file, self._run(picture, seed, 1))
        return decode_exr(file.read_bytes()).pixels

    def _run(self, picture: Picture, seed: int, threads: int) -> bytes:
        result = self._workshop.box.run(
            ["/program", *picture.arguments(seed, threads)],
            inputs={"/program": self._renderer()},
            binds=scene_binds(self._workshop.course.root, picture.scene),
            collect=[PICTURE],
            limits=_LIMITS,
        )
        if not result.ok or PICTURE not in result.files:
            said = result.stderr.decode("utf-8", "replace")[-2000:]
            raise HarnessFault(
                f"the reference of {picture.scene} cannot be rendered: {result.describe()}\n{said}"
            )
        return result.files[PICTURE]

    def _file(self, picture: Picture) -> Path:
        root = self._workshop.course.root
        made_from = (
            self._workshop.kit.fingerprint,
            scene_fingerprint(root, picture.scene),
            picture,
            (VERSION, MIN_CHUNKS, REFERENCE_SPP, _FIRST_SEED),
        )
        key = hashlib.sha256(repr(made_from).encode()).hexdigest()[:24]
        folder = root / "build" / "reference" / f"{Path(picture.scene).stem}-{key}"
        folder.mkdir(parents=True, exist_ok=True)
        return folder / "statistics.npz"
