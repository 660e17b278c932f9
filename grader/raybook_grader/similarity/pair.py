"""Two documents side by side: how much of each is in the other, and which parts."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np
from copydetect import compare_files
from copydetect.utils import find_fingerprint_overlap, get_copied_slices

from .document import Document
from .settings import LENGTH


@dataclass(frozen=True)
class Part:
    """A run of text that the other side has, too.

    ``text`` is its place in the document's texts, ``start`` and ``end`` the characters, ``other``
    the place of its counterpart among the other side's parts.
    """

    text: int
    start: int
    end: int
    other: int


@dataclass(frozen=True)
class Pair:
    """``share_a`` is the share of a's own tokens that b has, too, from 0 to 1."""

    a: Document
    b: Document
    share_a: float
    share_b: float

    @property
    def similarity(self) -> float:
        """The larger share: a small module may be copied whole into a larger one."""
        return max(self.share_a, self.share_b)

    @cached_property
    def parts(self) -> tuple[list[Part], list[Part]]:
        """What is alike, in order, on either side."""
        prints = self.a.prints, self.b.prints
        places = find_fingerprint_overlap(
            prints[0].hashes, prints[1].hashes, prints[0].hash_idx, prints[1].hash_idx
        )
        runs = [_runs(found) for found in places]
        # Runs that have most fingerprints in common are each other's counterparts.
        first: list[Counter[int]] = [Counter() for _ in runs[0]]
        second: list[Counter[int]] = [Counter() for _ in runs[1]]
        for value in prints[0].hashes & prints[1].hashes:
            mine = {_run_at(runs[0], i) for i in prints[0].hash_idx[value]}
            theirs = {_run_at(runs[1], i) for i in prints[1].hash_idx[value]}
            for i, j in product(mine, theirs):
                first[i][j] += 1
                second[j][i] += 1
        return (
            [_part(self.a, run, votes) for run, votes in zip(runs[0], first, strict=True)],
            [_part(self.b, run, votes) for run, votes in zip(runs[1], second, strict=True)],
        )


Run = tuple[int, int]


def compare(a: Document, b: Document) -> Pair:
    """Compare two documents of one module."""
    _, (share_a, share_b), _ = compare_files(a.prints, b.prints)
    # Short gaps between equal runs are counted in, so a little more than all may be equal.
    return Pair(a, b, min(1.0, float(share_a)), min(1.0, float(share_b)))


def _runs(places: np.ndarray[tuple[int], np.dtype[np.int64]]) -> list[Run]:
    """Where runs of tokens begin and end, given where the common fingerprints begin."""
    starts, ends = get_copied_slices(places, LENGTH)
    return [(int(start), int(end)) for start, end in zip(starts, ends, strict=True)]


def _run_at(runs: list[Run], place: int) -> int:
    """The run that a fingerprint of it lies in."""
    return bisect_right(runs, place, key=lambda run: run[0]) - 1


def _part(document: Document, run: Run, votes: Counter[int]) -> Part:
    """From tokens to characters. A run may end at the last token at most."""
    text, start, _ = document.spans[run[0]]
    last = document.spans[min(run[1], len(document.spans)) - 1]
    end = last[2] if last[0] == text else len(document.texts[text][1])
    # Of equal votes the first run, so that the same input gives the same page.
    other = min(votes, key=lambda n: (-votes[n], n))
    return Part(text, start, end, other)
