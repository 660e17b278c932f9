"""The oracle of ``mipmap_ewa``: group "ewa". No lookup is compared with another program's, but
with what every right average must give:

- waves: the image is cos and sin of a plane wave, so a lookup gives the factor by which the wave is
  damped and how far the average is off its centre. The factor must lie between the bounds of
  mipmap_bell.py. The centre may be off by what sums over few texels make it: 0.15 texels and a
  tenth of the shortest half axis s. (Half a texel of the levels used is s / 6 at least.)
- a ramp: at uv it has its value there, with the same bound.
- one colour stays that colour; a footprint over many repeats sees the mean of the image.
- halves: left 0, right 1; far from the edge between them, inside the image and beside it, the wrap
  says which it is. A white image beside black: half at its border, white inside, black outside.
- no footprint: a bilinear lookup of level 0.

Numbers are 0 to 1 (the ramp's texels) and SLACK = 0.03 is added to each bound of a factor: an
ellipse of a texel or two is a sum of a dozen texels, not an integral.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from mipmap_bell import damping
from mipmap_cases import (
    BLACK,
    CLAMP,
    MIRROR,
    REPEAT,
    Array,
    Mipmap,
    about,
    bilinear,
    packed,
    pyramid,
    single,
    tuple_of,
    wrong_length,
)
from raybook_grader.probes import Cases, Failure

SLACK = 0.03
COLOR_TOLERANCE = 0.01
WAVE_CASES = 2400


@dataclass(frozen=True)
class Lookup:
    """``right`` tells what is wrong with a colour; nothing if it is right."""

    kind: str
    mipmap: int
    uv: Array
    uv_dx: Array
    uv_dy: Array
    max_anisotropy: float
    right: Callable[[Array], str]


@dataclass(frozen=True)
class Context:
    mipmaps: list[Mipmap]
    lookups: list[Lookup]


def make_cases(group: str, seed: int) -> Cases:
    """The same for the same seed."""
    if group != "ewa":
        raise ValueError(f"group {group!r}, expected 'ewa'")
    rng = np.random.default_rng(seed)
    mipmaps: list[Mipmap] = []
    lookups: list[Lookup] = []
    for part in (_waves, _ramps, _constants, _enormous, _borders, _points):
        lookups += part(rng, mipmaps)
    rows = [(i.mipmap, [*i.uv, *i.uv_dx, *i.uv_dy, i.max_anisotropy]) for i in lookups]
    return Cases(packed(mipmaps, rows), len(rows), Context(mipmaps, lookups))


def judge(cases: Cases, output: bytes) -> list[Failure]:
    """Every wrong colour, told in words."""
    if faults := wrong_length(output, 12 * cases.count):
        return faults
    context: Context = cases.context
    found = np.frombuffer(output, "<f4").astype(np.float64).reshape(cases.count, 3)
    failures = []
    for case, lookup in enumerate(context.lookups):
        color = found[case]
        sentence = lookup.right(color) if np.isfinite(color).all() else "expected numbers"
        if sentence:
            text = _told(context.mipmaps[lookup.mipmap], lookup)
            message = f"{lookup.kind}: {text}: {sentence}, got {tuple_of(color)}"
            failures.append(Failure(case, message, lookup.kind, -float(len(text))))
    return failures


def _told(m: Mipmap, lookup: Lookup) -> str:
    steps = f"uv_dx = {tuple_of(lookup.uv_dx)}, uv_dy = {tuple_of(lookup.uv_dy)}"
    ratio = f"max_anisotropy = {lookup.max_anisotropy:g}"
    return f"{m}, uv = {tuple_of(lookup.uv)}, {steps}, {ratio}"


# --- Ellipses ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Ellipse:
    """The longest and the shortest half axis, in texels, and the direction of the longest."""

    longest: float
    shortest: float
    angle: float

    def steps(self, rng: np.random.Generator) -> tuple[Array, Array]:
        """Two steps in texels that span it: of all the pairs that do, any."""
        c, s = np.cos(self.angle), np.sin(self.angle)
        turn = rng.uniform(0, 2 * np.pi)
        axes = np.array([[c, -s], [s, c]]) @ np.diag([self.longest, self.shortest])
        pair = axes @ np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        return pair[:, 0], pair[:, 1]

    def widened(self, max_anisotropy: float) -> Ellipse:
        shortest = max(self.shortest, self.longest / max_anisotropy)
        return Ellipse(self.longest, shortest, self.angle)

    def reach(self, k: Array) -> float:
        """rho: the root of k' E k."""
        along = k @ [np.cos(self.angle), np.sin(self.angle)]
        across = k @ [-np.sin(self.angle), np.cos(self.angle)]
        return float(np.hypot(self.longest * along, self.shortest * across))


def _random_ellipse(rng: np.random.Generator, longest: float, angle: float) -> Ellipse:
    """A fifth of them circles, some without area."""
    ratio = 2 ** rng.uniform(0, 5) if rng.random() < 0.8 else 1.0
    shortest = 0.0 if rng.random() < 0.05 else longest / ratio
    return Ellipse(longest, shortest, angle)


def _lookup(
    rng: np.random.Generator, mipmaps: Sequence[Mipmap], kind: str, uv: Array, ellipse: Ellipse,
    max_anisotropy: float, right: Callable[[Array], str],
) -> Lookup:  # fmt: skip
    """In the last of the mipmaps."""
    dx, dy = (single(step / mipmaps[-1].size) for step in ellipse.steps(rng))
    return Lookup(kind, len(mipmaps) - 1, single(uv), dx, dy, max_anisotropy, right)


def _near(expected: Array, tolerance: float) -> Callable[[Array], str]:
    def right(color: Array) -> str:
        good = (np.abs(color - expected) <= tolerance).all()
        return "" if good else f"expected {about(np.asarray(expected))} within {tolerance:.2g}"

    return right


# --- Waves and ramps --------------------------------------------------------------------------

_WAVES = [  # width, height, waves across, waves down
    (128, 128, 1, 0), (128, 128, 0, 2), (128, 128, 3, 4), (128, 128, 8, -3), (128, 128, 0, 16),
    (128, 128, 20, 5), (256, 64, 4, 1), (256, 64, 24, -2), (64, 256, 2, 9), (200, 120, 5, 2),
    (200, 120, 12, 10), (99, 150, 7, -4),
]  # fmt: skip


def _middles(width: int, height: int) -> tuple[Array, Array]:
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    return x, y


def _waves(rng: np.random.Generator, mipmaps: list[Mipmap]) -> Iterator[Lookup]:
    for width, height, across, down in _WAVES:
        x, y = _middles(width, height)
        k = np.array([across / width, down / height])
        phase = 2 * np.pi * (k[0] * x + k[1] * y)
        image = 0.5 + 0.5 * np.stack([np.cos(phase), np.sin(phase), np.zeros_like(x)], axis=-1)
        mipmaps.append(Mipmap(f"{across} by {down} waves", REPEAT, pyramid(single(image))))
        made = 0
        while made < WAVE_CASES // len(_WAVES):
            lookup = _wave(rng, mipmaps, k)
            if lookup is not None:
                made += 1
                yield lookup


def _wave(rng: np.random.Generator, mipmaps: list[Mipmap], k: Array) -> Lookup | None:
    """None where the bounds would say nothing: the wave is as short as the ellipse."""
    size = np.hypot(*k)
    angle = rng.uniform(0, np.pi)
    if rng.random() < 0.6:
        angle = np.arctan2(k[1], k[0]) + rng.choice([0, np.pi / 2])
    given = _random_ellipse(rng, 2 ** rng.uniform(-2, 6), angle)
    max_anisotropy = float(rng.choice([1, 4, 8, 16, 64]))
    seen = given.widened(max_anisotropy)
    rho, quarter = seen.reach(k), mipmaps[-1].size.min() / 4
    if not (0.03 < rho < 1.0 and seen.shortest * size < 0.3 and seen.shortest < quarter):
        return None
    uv = single(rng.uniform(-1, 2, 2))
    phase = 2 * np.pi * float(k @ (uv * mipmaps[-1].size))
    bounds = damping(rho, _least_reach(seen, k), float(size), seen.shortest)
    shift = (0.15 + 0.1 * seen.shortest) * 2 * np.pi * float(size)

    def right(color: Array) -> str:
        factor = complex(2 * color[0] - 1, 2 * color[1] - 1) * np.exp(-1j * phase)
        if not bounds[0] - SLACK <= factor.real <= bounds[1] + SLACK:
            return (
                f"expected the wave damped by a factor from {bounds[0]:.3f} to {bounds[1]:.3f}, "
                f"it is {factor.real:.3f}"
            )
        if abs(factor.imag) > SLACK + shift * abs(factor):
            return "expected an average around uv, its centre is beside it"
        return _near(np.array([color[0], color[1], 0.5]), COLOR_TOLERANCE)(color)

    kind = "wave" if given.longest > 1.5 else "magnified wave"
    if rho < 0.3 and size * seen.longest > 0.6:
        kind = "wave along the shorter axis"
    return _lookup(rng, mipmaps, kind, uv, given, max_anisotropy, right)


def _least_reach(seen: Ellipse, k: Array) -> float:
    """rho, without the shorter axis where a texel may stand for it: a bilinear lookup in the
    middle of a texel of level 0 does not blur at all."""
    return replace(seen, shortest=0.0).reach(k) if seen.shortest < 1.5 else seen.reach(k)


def _ramps(rng: np.random.Generator, mipmaps: list[Mipmap]) -> Iterator[Lookup]:
    for width, height in ((256, 256), (150, 99)):
        x, y = _middles(width, height)
        image = np.stack([x, y, 0 * x], axis=-1)
        mipmaps.append(Mipmap("a ramp", CLAMP, pyramid(image)))
        for _ in range(150):
            ellipse = _random_ellipse(rng, 2 ** rng.uniform(-1, 3.5), rng.uniform(0, np.pi))
            uv = single(rng.uniform(0.45, 0.55, 2))
            tolerance = 0.15 + 0.1 * ellipse.widened(8).shortest
            place = np.append(uv * [width, height], 0)
            yield _lookup(rng, mipmaps, "ramp", uv, ellipse, 8, _near(place, tolerance))


# --- Colours that are known -------------------------------------------------------------------


def _constants(rng: np.random.Generator, mipmaps: list[Mipmap]) -> Iterator[Lookup]:
    color = single(np.array([0.75, 0.5, 0.3]))
    for width, height in ((64, 64), (7, 5), (1, 1), (1, 16), (33, 2)):
        for wrap in (REPEAT, CLAMP, MIRROR):
            image = np.broadcast_to(color, (height, width, 3)).copy()
            mipmaps.append(Mipmap("one colour", wrap, pyramid(image)))
            for _ in range(40):
                ellipse = _random_ellipse(rng, 2 ** rng.uniform(-6, 9), rng.uniform(0, np.pi))
                uv, ratio = rng.uniform(-2, 3, 2), float(rng.choice([1, 4, 16, 64]))
                right = _near(color, 0.001)
                yield _lookup(rng, mipmaps, "one colour", uv, ellipse, ratio, right)


def _enormous(rng: np.random.Generator, mipmaps: list[Mipmap]) -> Iterator[Lookup]:
    """Footprints over 20 to 2000 repeats, even across the shorter axis. The image of 512 x 512
    texels is there for averages that read each of them: these do not end."""
    for width, height, count in ((512, 512, 200), (16, 16, 60), (5, 9, 60), (1, 1, 60)):
        for wrap in (REPEAT, MIRROR):
            image = single(rng.random((height, width, 3)))
            mipmaps.append(Mipmap("noise", wrap, pyramid(image)))
            mean = _near(image.mean(axis=(0, 1)), COLOR_TOLERANCE)
            for _ in range(count):
                longest = 8 * max(width, height) * 10 ** rng.uniform(0.4, 2.4)
                ellipse = Ellipse(longest, longest / rng.uniform(1, 20), rng.uniform(0, np.pi))
                uv = rng.uniform(-1, 2, 2)
                yield _lookup(rng, mipmaps, "over many repeats", uv, ellipse, 8, mean)


def _borders(rng: np.random.Generator, mipmaps: list[Mipmap]) -> Iterator[Lookup]:
    halves = np.repeat(np.concatenate([np.zeros((64, 32)), np.ones((64, 32))], 1)[..., None], 3, 2)
    white = np.ones((64, 64, 3))
    #      u: -0.25 0.25 0.75 1.25
    beside = {
        REPEAT: (1, 0, 1, 0),
        CLAMP: (0, 0, 1, 1),
        MIRROR: (0, 0, 1, 1),
        BLACK: (0, 0, 1, 0),
    }
    for turned in (False, True):
        for wrap, colors in beside.items():
            image = halves.transpose(1, 0, 2) if turned else halves
            mipmaps.append(Mipmap("halves", wrap, pyramid(image)))
            for u, color in zip((-0.25, 0.25, 0.75, 1.25), colors, strict=True):
                right = _near(np.full(3, color), COLOR_TOLERANCE)
                yield from _small(rng, mipmaps, "halves", u, turned, right)
        mipmaps.append(Mipmap("white", BLACK, pyramid(white)))
        for u, value, tolerance in (
            (-0.25, 0, 0.01),
            (0, 0.5, 0.12),
            (0.5, 1, 0.01),
            (1, 0.5, 0.12),
        ):
            right = _near(np.full(3, value), tolerance)
            yield from _small(rng, mipmaps, "white beside black", u, turned, right)


def _small(
    rng: np.random.Generator, mipmaps: list[Mipmap], kind: str, u: float, turned: bool,
    right: Callable[[Array], str],
) -> Iterator[Lookup]:  # fmt: skip
    """Ellipses that stay, bell and texels, within 16 texels of (u, 0.5)."""
    uv = np.array([0.5, u] if turned else [u, 0.5])
    for _ in range(12):
        longest = rng.uniform(1, 4)
        ellipse = Ellipse(longest, longest / rng.uniform(1, 4), rng.uniform(0, np.pi))
        yield _lookup(rng, mipmaps, kind, uv, ellipse, 8, right)


def _points(rng: np.random.Generator, mipmaps: list[Mipmap]) -> Iterator[Lookup]:
    """Both steps are zero, or no numbers."""
    none = np.zeros(2)
    for wrap in (REPEAT, CLAMP, MIRROR, BLACK):
        mipmaps.append(Mipmap("noise", wrap, pyramid(single(rng.random((7, 12, 3))))))
        for i in range(30):
            uv = single(rng.uniform(-1, 2, 2))
            right = _near(bilinear(mipmaps[-1], 0, uv), COLOR_TOLERANCE)
            step = (
                none if i < 20 else np.array([np.nan, 0.1]) if i < 25 else np.array([0.1, np.inf])
            )
            kind = "no footprint" if i < 20 else "steps that are not finite"
            yield Lookup(kind, len(mipmaps) - 1, uv, step, step, 8, right)
