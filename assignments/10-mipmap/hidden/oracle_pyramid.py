"""The oracle of ``mipmap_pyramid``: group "pyramid".

A texel must be the mean of the area that it covers, either of the level before, as the module
itself made it, or of the image. Both means are taken here as matrix products in float64: of rows,
then of columns, where the module may do both at once.

Tolerance: the contract's 1e-4 of the largest texel; single precision adds at most 2^-24 for each
of the at most sixteen halvings, and for each of as many texels as a sum of floats may have: not
added, as the sums of these images are of few texels or of balanced halves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from mipmap_cases import CLAMP, Array, Mipmap, half, means, packed, single, wrong_length
from raybook_grader.probes import Cases, Failure

TOLERANCE = 1e-4
CHANGED_IMAGE = 1

# Powers of two; odd and even; rows and columns; one texel; primes; long and thin.
SIZES = [
    (1, 1), (2, 1), (1, 2), (2, 2), (4, 4), (8, 8), (16, 4), (4, 16), (3, 1), (1, 3), (5, 1),
    (1, 5), (7, 1), (1, 7), (1, 64), (64, 1), (3, 3), (3, 5), (5, 3), (5, 5), (6, 6), (6, 4),
    (10, 6), (7, 7), (9, 9), (2, 9), (31, 17), (33, 64), (100, 75), (255, 3), (257, 129), (1, 255),
]  # fmt: skip


@dataclass(frozen=True)
class Context:
    mipmaps: list[Mipmap]
    counts: list[int]


def make_cases(group: str, seed: int) -> Cases:
    """Of each size: random texels, a ramp in whole numbers, one bright texel in a corner."""
    if group != "pyramid":
        raise ValueError(f"group {group!r}, expected 'pyramid'")
    rng = np.random.default_rng(seed)
    mipmaps = []
    for width, height in SIZES:
        x, y = np.meshgrid(np.arange(width), np.arange(height))
        ramp = np.stack([x, y, x + 2 * y], axis=-1).astype(np.float64)
        corner = np.zeros((height, width, 3))
        corner[-1, -1] = (1, 2, 4)
        noise = single(rng.random((height, width, 3)) * 10.0 ** rng.integers(-3, 4))
        for name, image in (
            ("a ramp", ramp),
            ("one bright texel", corner),
            ("noise", noise),
        ):
            mipmaps.append(Mipmap(name, CLAMP, (image,)))
    counts = [1 + len(_sizes(*m.levels[0].shape[1::-1])) for m in mipmaps]
    return Cases(packed(mipmaps, []), len(mipmaps), Context(mipmaps, counts))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """For each image the first thing that is wrong."""
    context: Context = cases.context
    lengths = [_words(m) for m in context.mipmaps]
    if faults := wrong_length(output, 4 * sum(lengths)):
        return faults
    failures, begin = [], 0
    for case, (m, length) in enumerate(zip(context.mipmaps, lengths, strict=True)):
        words = np.frombuffer(output, "<u4", length, 4 * begin)
        begin += length
        if wrong := _wrong(m, words, context.counts[case]):
            fingerprint, text = wrong
            message = f"pyramid over {m}: {text}".replace(" (clamp)", "")
            failures.append(Failure(case, message, fingerprint, -float(m.levels[0].size) - case))
    return failures


def _sizes(width: int, height: int) -> list[tuple[int, int]]:
    """Width and height of the levels above the image."""
    sizes = []
    while (width, height) != (1, 1):
        width, height = half(width), half(height)
        sizes.append((width, height))
    return sizes


def _words(m: Mipmap) -> int:
    return 2 + sum(2 + 3 * w * h for w, h in _sizes(*m.levels[0].shape[1::-1]))


def _wrong(m: Mipmap, words: np.ndarray, count: int) -> tuple[str, str] | None:
    if words[1] & CHANGED_IMAGE:
        return (
            "the image was changed",
            "levels[0], the image itself, is not what it was",
        )
    if words[0] != count:
        returned = int(words.view("<i4")[0])
        last = "the last one is 1 x 1"
        return "number of levels", f"expected {count} levels ({last}), got {returned}"
    image, before, at = m.levels[0], m.levels[0], 2
    for level, (width, height) in enumerate(_sizes(*image.shape[1::-1]), 1):
        found = (int(words[at]), int(words[at + 1]))
        if found != (width, height):
            text = f"level {level}: expected {width} x {height} texels, got {found[0]} x {found[1]}"
            return "size of a level", text
        texels = words[at + 2 : at + 2 + 3 * width * height].view("<f4").astype(np.float64)
        texels = texels.reshape(height, width, 3)
        if told := _wrong_texel(image, before, texels):
            return told[0], f"level {level}, {told[1]}"
        before, at = texels, at + 2 + 3 * width * height
    return None


def _wrong_texel(image: Array, before: Array, texels: Array) -> tuple[str, str] | None:
    """The first texel that is neither mean."""
    height, width = texels.shape[:2]
    step, whole = means(before, width, height), means(image, width, height)
    largest = np.abs(image).max()
    with np.errstate(invalid="ignore"):
        away = np.minimum(np.abs(texels - step), np.abs(texels - whole))
        wrong = ~(away <= TOLERANCE * largest).all(axis=-1)
    if not wrong.any():
        return None
    y, x = (int(i) for i in np.argwhere(wrong)[0])
    expected, got = (", ".join(f"{v:.5g}" for v in a[y, x]) for a in (step, texels))
    odd = before.shape[0] % 2 + before.shape[1] % 2 > 0 and before.shape[:2] != (1, 1)
    kind = "mean over an odd size" if odd else "mean over an even size"
    return kind, f"texel ({x}, {y}): expected ({expected}), got ({got})"
