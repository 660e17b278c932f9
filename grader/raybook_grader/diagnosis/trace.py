"""What a failing check leaves behind, to be compared: which cases, in which way.

A trace is a plain JSON value, so that it can be stored with the check's result.
"""

from __future__ import annotations

import base64
import zlib
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..probes import Failure

Trace = Mapping[str, Any]

_TILES = 8
"""An image's residual is kept as so many tiles a side."""


def trace_of_cases(count: int, failures: Sequence[Failure]) -> Trace:
    """The failing cases of ``count``, packed, and how often each kind of failure was met."""
    mask = np.zeros(count, bool)
    mask[[f.case for f in failures if 0 <= f.case < count]] = True
    packed = base64.b85encode(zlib.compress(np.packbits(mask).tobytes(), 9)).decode()
    kinds = Counter(failure.fingerprint for failure in failures)
    return {"cases": count, "wrong": packed, "kinds": dict(sorted(kinds.items()))}


def trace_of_names(names: Iterable[str]) -> Trace:
    """The failing ones of things that have names, such as tests."""
    return {"names": sorted(set(names))}


def trace_of_picture(codes: Iterable[str], mean: NDArray[Any], reference: NDArray[Any]) -> Trace:
    """Which tests of the picture fail, and where it is how much too bright."""
    height, width = (side - side % _TILES for side in mean.shape[:2])
    shape = (_TILES, max(height // _TILES, 1), _TILES, max(width // _TILES, 1), 3)

    def tiles(image: NDArray[Any]) -> NDArray[Any]:
        means: NDArray[Any] = image[:height, :width].reshape(shape).mean(axis=(1, 3, 4))
        return means

    if min(height, width) == 0:
        return {"codes": sorted(set(codes)), "tiles": []}
    expected = tiles(reference)
    floor = 0.05 * float(expected.mean()) + 1e-12
    residual = (tiles(mean) - expected) / (expected + floor)
    rounded = np.clip(np.round(residual, 3), -10, 10)
    return {"codes": sorted(set(codes)), "tiles": rounded.ravel().tolist()}


def trace_of_ratio(ratio: float) -> Trace:
    """How many times the reference's work was done."""
    return {"ratio": round(ratio, 3)}


def likeness(a: Trace, b: Trace) -> float | None:
    """From 0, nothing in common, to 1, the same; None where they can't be compared."""
    if "wrong" in a and "wrong" in b and a["cases"] == b["cases"]:
        return 0.75 * _same_cases(a, b) + 0.25 * _cosine(a["kinds"], b["kinds"])
    if "names" in a and "names" in b:
        return _jaccard(set(a["names"]), set(b["names"]))
    if a.get("tiles") and b.get("tiles"):
        return max(0.0, _correlation(a["tiles"], b["tiles"]))
    if "ratio" in a and "ratio" in b:
        return float(max(0.0, 1 - abs(np.log(max(a["ratio"], 1e-3) / max(b["ratio"], 1e-3)))))
    return None


def _same_cases(a: Trace, b: Trace) -> float:
    ours, theirs = _unpacked(a), _unpacked(b)
    either = int((ours | theirs).sum())
    return float((ours & theirs).sum()) / either if either else 1.0


def _unpacked(trace: Trace) -> NDArray[np.bool_]:
    packed = np.frombuffer(zlib.decompress(base64.b85decode(trace["wrong"])), np.uint8)
    return np.unpackbits(packed, count=trace["cases"]).astype(bool)


def _cosine(a: Mapping[str, int], b: Mapping[str, int]) -> float:
    names = sorted(a.keys() | b.keys())
    x = np.sqrt([a.get(name, 0) for name in names])
    y = np.sqrt([b.get(name, 0) for name in names])
    size = float(np.linalg.norm(x) * np.linalg.norm(y))
    return float(x @ y) / size if size else 1.0


def _correlation(a: Sequence[float], b: Sequence[float]) -> float:
    """Of the residuals, and less where one is larger than the other."""
    x, y = np.asarray(a), np.asarray(b)
    larger = max(float(x @ x), float(y @ y))
    return float(x @ y) / larger if larger else 1.0


def _jaccard(a: set[str], b: set[str]) -> float:
    return len(a & b) / len(a | b) if a | b else 1.0
