"""Texts of the course's right modules, and how a copy of one is disguised."""

from __future__ import annotations

import random
import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from raybook_grader.course import load_course
from raybook_grader.museum import exhibits_of
from raybook_grader.similarity.document import Document, Owner, document
from raybook_grader.submissions import Submission, SubmittedFile

CHECKOUT = Path(__file__).resolve().parents[3]
COURSE = load_course(CHECKOUT)
OWNED = {a.number: a.sources for a in COURSE.assignments if a.sources}

_KEPT = frozenset((
    "auto", "bool", "break", "case", "char", "const", "continue", "default", "define", "do",
    "double", "else", "enum", "extern", "float", "for", "goto", "if", "include", "inline", "int",
    "long", "register", "restrict", "return", "short", "signed", "size_t", "sizeof", "static",
    "struct", "switch", "typedef", "uint32_t", "uint64_t", "union", "unsigned", "void", "volatile",
    "while",
))  # fmt: skip


@cache
def of_museum(number: str) -> Mapping[str, dict[str, str]]:
    """The right modules of an assignment: their files by slug."""
    exhibits = exhibits_of(CHECKOUT, COURSE.assignment(number), strict=False)
    return {
        e.slug: {path: content.decode() for path, content in e.files.items()}
        for e in exhibits
        if e.is_right
    }


def submission(name: str, files: Mapping[str, str]) -> Submission:
    return Submission(name, {path: SubmittedFile(text.encode()) for path, text in files.items()})


def documents(
    number: str, museum: Mapping[str, dict[str, str]], base: frozenset[int]
) -> list[tuple[str, Document]]:
    made = [(s, document(Owner(s), submission(s, f).files, base)) for s, f in museum.items()]
    return [(slug, one) for slug, one in made if isinstance(one, Document)]


def copied(text: str, rng: random.Random) -> str:
    """The text as somebody hands it in who does not want to be asked: other names, comments moved
    and changed, other layout.
    """
    comments = re.findall(r"/\*.*?\*/", text, re.DOTALL)
    rng.shuffle(comments)
    bare = re.sub(r"/\*.*?\*/", lambda found: comments.pop() if rng.random() < 0.5 else "", text,
                  flags=re.DOTALL)  # fmt: skip
    names = {word for word in re.findall(r"\b[a-z_]\w*\b", bare) if word not in _KEPT}
    others = {
        word: f"{rng.choice(('lo', 'hi', 'my', 'the'))}_{i}" for i, word in enumerate(sorted(names))
    }
    kept = re.split(r"(/\*.*?\*/|^#[^\n]*$)", bare, flags=re.DOTALL | re.MULTILINE)
    code = [
        piece if i % 2 else re.sub(r"\b[a-z_]\w*\b", lambda f: others.get(f[0], f[0]), piece)
        for i, piece in enumerate(kept)
    ]
    return re.sub(r"\n {4}", "\n\t\t", "".join(code))
