"""One student's files of one module, with the fingerprints of what is their own in it."""

from __future__ import annotations

import io
import unicodedata
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from copydetect import CodeFingerprint
from copydetect.utils import get_token_coverage

from ..submissions import SubmittedFile
from .settings import LENGTH
from .tokens import tokenize

SHORTEST = 80
"""Tokens of their own below which a module says nothing."""

LONGEST = 256 << 10
"""Characters of one module that are still compared; the course's own are below 30,000."""

_BETWEEN_FILES = "\0"  # in no other place


@dataclass(frozen=True, order=True)
class Owner:
    """Whose it is. ``origin`` names the folder of an earlier year; empty for the class itself."""

    id: str
    origin: str = ""

    @property
    def name(self) -> str:
        return f"{self.origin}/{self.id}" if self.origin else self.id


@dataclass(frozen=True)
class Document:
    """``texts`` are (path, text); ``spans`` says for each token (text, start, end)."""

    owner: Owner
    texts: tuple[tuple[str, str], ...]
    spans: tuple[tuple[int, int, int], ...]
    prints: CodeFingerprint = field(compare=False)

    @property
    def own(self) -> int:
        """Tokens that are not the handout's."""
        return int(self.prints.token_coverage)


def fingerprints(symbols: str, base: frozenset[int] = frozenset()) -> CodeFingerprint:
    """copydetect's fingerprints of all runs of `LENGTH` symbols but those in ``base``.

    Its own tokens are not used: they lose the places behind the name of a struct. Nor is its way
    of taking out base code, which takes a run that occurs twice for base code, too.
    """
    found = CodeFingerprint("module.c", LENGTH, 1, filter=False, fp=io.StringIO(symbols))
    kept: dict[int, list[int]] = {}
    for value, places in found.hash_idx.items():
        inside = [int(i) for i in places if _BETWEEN_FILES not in symbols[i : i + LENGTH]]
        if inside and int(value) not in base:
            kept[int(value)] = inside
    found.hashes, found.hash_idx = set(kept), kept
    found.token_coverage = get_token_coverage(found.hash_idx, LENGTH, len(symbols))
    return found


def base_of(texts: Iterable[str]) -> frozenset[int]:
    """The fingerprints of what everybody was given."""
    base: set[int] = set()
    for text in texts:
        base |= fingerprints(tokenize(text).symbols).hashes
    return frozenset(base)


def document(
    owner: Owner, files: Mapping[str, SubmittedFile], base: frozenset[int]
) -> Document | str:
    """A document, or why there is none."""
    texts = [(path, readable(f.content)) for path, f in sorted(files.items()) if f.refusal is None]
    if sum(len(text) for _, text in texts) > LONGEST:
        return f"longer than {LONGEST >> 10} KiB"
    symbols: list[str] = []
    spans: list[tuple[int, int, int]] = []
    for i, (_, text) in enumerate(texts):
        tokens = tokenize(text)
        symbols.append(tokens.symbols)
        spans += [(i, start, end) for start, end in tokens.spans] + [(i, len(text), len(text))]
    prints = fingerprints(_BETWEEN_FILES.join([*symbols, ""]), base)
    found = Document(owner, tuple(texts), tuple(spans), prints)
    if found.own < SHORTEST:
        return f"fewer than {SHORTEST} tokens of its own"
    return found


def readable(content: bytes) -> str:
    """The text, with no character that hides or reorders others."""
    text = content.decode("utf-8", "replace").replace("\r\n", "\n").replace("\r", "\n")
    return "".join(_visible(c) for c in text)


def _visible(c: str) -> str:
    hides: Any = unicodedata.category(c) in ("Cc", "Cf", "Cs", "Co", "Zl", "Zp")
    return "\N{REPLACEMENT CHARACTER}" if hides and c not in "\n\t" else c
