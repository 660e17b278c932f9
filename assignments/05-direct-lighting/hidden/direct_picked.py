"""Hand-picked cases of ``direct_light``: a floor with y = 0 that looks up, and whole numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from direct_cases import METAL, ONE_SIDED, TWO_SIDED, Case, Paint
from direct_geometry import Rect, Sphere, Thing, single, unit

FLOOR = Rect(np.zeros(3), np.array([10.0, 0, 0]), np.array([0, 0, -10.0]), "a floor")
EYE = (0, 3, 4)
RADIANCE = np.array([2.0, 4.0, 8.0])
Triple = Sequence[float]


def _case(
    label: str, target: Triple, *others: Thing, eye: Triple = EYE, kind: int = ONE_SIDED
) -> Case:
    """The floor's middle, seen from ``eye``, lit from ``target``."""
    place = np.array(target, np.float64)
    origin = np.array(eye, np.float64)
    to_light = single(unit(place))
    things = (FLOOR, *others)
    return Case(label, things, origin, -origin, to_light, place, RADIANCE, Paint(kind))


def _endless(case: Case) -> Case:
    return replace(case, infinite=True, target=np.array([0.0, 0.001, 0.0]))


def _flat(height: float, words: str, made_of: int = 0, x: float = 0.0) -> Rect:
    """A square of 1 that looks down."""
    sides = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
    return Rect(np.array([x, height, 0]), *sides, words, made_of)


def _round(height: float, radius: float, words: str, made_of: int = 0) -> Sphere:
    return Sphere(np.array([0.0, height, 0.0]), radius, words, made_of)


def _shading() -> Iterator[Case]:
    yield _case("straight above", (0, 2, 0))
    yield _case("slanting", (4, 3, 0))
    yield _case("slanting the other way", (0, 3, -4))
    yield _case("nearly grazing", (40, 1, 0))
    yield _case("seen at a slant", (0, 2, 0), eye=(30, 1, 0))
    for kind in (ONE_SIDED, TWO_SIDED):
        yield _case("lamp behind the floor", (0, -2, 0), kind=kind)
        yield _case("eye behind the floor", (0, 2, 0), eye=(0, -3, 4), kind=kind)
        yield _case("both behind the floor", (4, -3, 0), eye=(0, -3, 4), kind=kind)
    above = _case("straight above", (0, 2, 0))
    for pdf in (0.25, 4.0, 1000.0):
        yield replace(above, label=f"density {pdf:g}", pdf=pdf, delta=False)
    for radiance in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
        yield replace(above, label="one colour", radiance=np.array(radiance, np.float64))
    yield replace(above, label="white paint", paint=Paint(albedo=(1, 1, 1)))
    yield from _tilted()
    yield from _metals()
    yield _endless(_case("a light without end", (4, 3, 0)))


def _tilted() -> Iterator[Case]:
    """Shading normals that are not the surface's own."""
    for normal in ((0.6, 0.8, 0), (-0.6, 0.8, 0), (0, 0.8, 0.6), (0.28, 0.96, 0)):
        shading = np.array(normal, np.float32).astype(np.float64)
        for target in ((0, 2, 0), (4, 3, 0), (-4, 3, 0), (3, -1, 0), (-4, 1, 0)):
            case = _case("a shading normal", target)
            if abs(float(shading @ case.to_light)) > 0.02:
                yield replace(case, normal=shading)


def _metals() -> Iterator[Case]:
    """Metal is no chalk: its brightness depends on both directions."""
    for eye in ((0, 2, 0), (4, 3, 0), (0, 3, -4)):
        for alpha in (0.2, 0.5, 0.9):
            paint = Paint(METAL, (1, 0.5, 0.25), alpha)
            yield replace(_case("metal", eye, eye=eye), paint=paint)
    yield _case("metal from behind", (0, -2, 0), eye=(0, -2, 0), kind=METAL)


def _shadows() -> Iterator[Case]:
    way = (0, 2, 0)
    for made_of, name in enumerate(("", "glass ", "black ")):
        yield _case("between", way, _round(1, 0.25, f"a {name}ball at (0, 1, 0)", made_of))
        yield _case("between", way, _flat(1, f"a {name}wall at (0, 1, 0)", made_of))
    yield _case("beyond", way, _round(2.5, 0.25, "a ball at (0, 2.5, 0)"))
    yield _case("beyond", way, _round(200, 100, "a ball far behind the lamp"))
    yield _case("below", way, _round(-0.5, 0.25, "a ball under the floor"))
    yield _case("below", way, _flat(-1, "a wall under the floor"))
    yield _case("beside", way, _flat(1, "a wall beside the way", x=0.6))
    yield _case("around", way, _round(2, 50, "a ball around everything"))
    cage = _round(0, 1, "a ball around the vertex")
    yield _case("around the surface", way, cage, eye=(0.3, 0.3, 0))
    yield _case("around the lamp", way, _round(2, 0.5, "a ball around the lamp"))
    far = _endless(_case("", (0, 2, 0)))
    for label, thing in (
        ("between, a light without end", _round(1, 0.25, "a ball at (0, 1, 0)")),
        ("beyond, a light without end", _round(1e4, 100, "a ball 10 km up")),
        ("beyond, a light without end", _flat(3, "a wall at (0, 3, 0)")),
        ("below, a light without end", _round(-5, 1, "a ball under the floor")),
        ("around, a light without end", _round(0, 50, "a ball around everything")),
    ):
        yield replace(far, label=label, things=(FLOOR, thing))


def _ends() -> Iterator[Case]:
    way = (0, 2, 0)
    for gap in (0.1, 0.01, 1e-3, 1e-4):
        yield _case("just before the lamp", way, _flat(2 - gap, f"a wall {gap:g} below the lamp"))
        yield _case("just behind the lamp", way, _flat(2 + gap, f"a wall {gap:g} above the lamp"))
        speck = Sphere(np.array([0, 2 * gap, 0]), gap, f"a speck of radius {gap:g} on the floor")
        yield _case("just above the surface", way, speck)
        under = _flat(-gap, f"a wall {gap:g} under the floor")
        yield _case("just below the surface", way, under)
    up = np.array([0, 0.5, 0])
    for label, target in (("straight", way), ("slanting", (1, 2, 1))):
        lamp = np.array(target, np.float64)
        shelf = Rect(lamp, np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), "a shelf with the lamp")
        yield _case(f"lamp on a wall: {label}", target, shelf)
        globe = Sphere(lamp + up, 0.5, "a ball right above the lamp")
        yield _case(f"lamp on a ball: {label}", target, globe)
        globe = Sphere(lamp - up, 0.5, "a ball with the lamp on its top")
        yield _case(f"behind a ball: {label}", target, globe)


PICKED: dict[str, Callable[[], list[Case]]] = {
    "shading": lambda: list(_shading()),
    "shadows": lambda: list(_shadows()),
    "ends": lambda: list(_ends()),
}
