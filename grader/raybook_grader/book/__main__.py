"""`python -m raybook_grader.book`: what `make book` runs."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from ..errors import BadInput
from .build import build_book, build_chapter
from .editions import Edition
from .sphinx_run import Settings


def main(words: list[str] | None = None) -> int:
    """Exit code 0: the book is made and sound; 1: it is not."""
    parser = argparse.ArgumentParser(prog="raybook_grader.book", description=__doc__)
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[3])
    parser.add_argument("--edition", type=Edition, choices=list(Edition), help="one edition only")
    parser.add_argument("--draft", action="store_true", help="pages only; faults are only told")
    parser.add_argument("--accept", action="store_true", help="the figures are as they should be")
    parser.add_argument("--chapter", metavar="NN", help="the page of one chapter, as a draft")
    parser.add_argument("--fresh", action="store_true", help="use nothing that was made before")
    asked = parser.parse_args(words)
    editions = [asked.edition] if asked.edition else list(Edition)
    draft = asked.draft or bool(asked.chapter)
    settings = Settings(asked.root.resolve(), draft, asked.accept)
    try:
        if asked.chapter:
            return build_chapter(settings, editions[0], asked.chapter)
        return build_book(settings, editions, asked.fresh)
    except BadInput as fault:
        print(f"book: {fault}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
