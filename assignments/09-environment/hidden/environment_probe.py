"""The files of probe_environment.c: what is asked of each map, and the answers taken apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from environment_truth import Array, Map, place_of
from numpy.typing import NDArray
from raybook_grader.probes import Cases, Failure

DIRECTION_WORDS, PICK_WORDS = 4, 10


@dataclass(frozen=True)
class Block:
    """One map, the world directions to look in and the pairs of numbers to pick with."""

    map: Map
    directions: Array
    numbers: Array

    @property
    def count(self) -> int:
        return len(self.directions) + len(self.numbers)

    @property
    def answer_size(self) -> int:
        return 4 * (DIRECTION_WORDS * len(self.directions) + PICK_WORDS * len(self.numbers))


@dataclass(frozen=True)
class Answer:
    """``radiance`` and ``density`` of the directions; what was ``picked`` with the numbers, with
    the ``returned`` density, the one of environment_pdf (``same``) and those ``beside``."""

    radiance: Array
    density: Array
    picked: Array
    returned: Array
    same: Array
    beside: Array
    repeats: NDArray[np.bool_]


def cases_for(blocks: list[Block], context: object) -> Cases:
    payload = b"".join(_bytes(block) for block in blocks)
    return Cases(payload, sum(block.count for block in blocks), context)


def _bytes(block: Block) -> bytes:
    m = block.map
    head = np.array(
        [m.width, m.height, len(block.directions), len(block.numbers)], dtype="<u4"
    ).tobytes()
    # A number just below 1 must not become 1 in single precision.
    numbers = np.minimum(block.numbers, 1.0 - 2.0**-24)
    parts = (np.array([m.scale]), m.rotation, m.image, block.directions, numbers)
    return head + b"".join(np.ascontiguousarray(part, dtype="<f4").tobytes() for part in parts)


def answers(blocks: list[Block], output: bytes) -> list[Answer] | Failure:
    """One for each block; the failure of an output that has another length."""
    expected = sum(block.answer_size for block in blocks)
    if len(output) != expected:
        message = f"the probe wrote {len(output)} bytes, expected {expected}"
        return Failure(0, message, "output of a wrong length")
    found, start = [], 0
    for block in blocks:
        found.append(_answer(block, output[start : start + block.answer_size]))
        start += block.answer_size
    return found


def _answer(block: Block, output: bytes) -> Answer:
    words = np.frombuffer(output, "<u4")
    values = words.view("<f4").astype(np.float64)
    cut = DIRECTION_WORDS * len(block.directions)
    seen = values[:cut].reshape(-1, DIRECTION_WORDS)
    picks = values[cut:].reshape(-1, PICK_WORDS)
    flags = words[cut:].reshape(-1, PICK_WORDS)[:, 9]
    return Answer(
        seen[:, :3], seen[:, 3], picks[:, :3], picks[:, 3], picks[:, 4], picks[:, 5:9], flags == 0
    )


# --- Words ------------------------------------------------------------------------------------


def number(x: float) -> str:
    """Five digits at most."""
    return f"{x:.5g}"


def triple(a: Array) -> str:
    """ "(1, 2.5, 0)"."""
    return "(" + ", ".join(str(np.float32(x)).removesuffix(".0") for x in a) + ")"


def colour(a: Array) -> str:
    return "(" + ", ".join(number(x) for x in a) + ")"


def map_text(m: Map) -> str:
    turned = "" if np.array_equal(m.rotation, np.eye(3)) else ", turned"
    mirrored = ", mirrored" if np.linalg.det(m.rotation) < 0 else ""
    scaled = "" if m.scale == 1 else f", scale {number(m.scale)}"
    return f"{m.name}: a map of {m.width} x {m.height} texels{turned}{mirrored}{scaled}"


def place_text(m: Map, world: Array) -> str:
    """Where in the image a direction falls."""
    u, v = place_of(m.to_local(world[None, :]))
    return (
        f"direction {triple(world)}, which is at column {number(float(u[0]) * m.width)}, row "
        f"{number(float(v[0]) * m.height)} of the map"
    )
