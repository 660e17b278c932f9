"""`python -m raybook_grader.literate`: the literate core by itself."""

from __future__ import annotations

import argparse
import sys

from .commands import Handler, add_short_commands


def main(words: list[str] | None = None) -> int:
    """Run one command; returns its exit code."""
    parser = argparse.ArgumentParser(prog="raybook_grader.literate", description=__doc__)
    add_short_commands(parser.add_subparsers(required=True, metavar="COMMAND"))
    arguments = parser.parse_args(words)
    handler: Handler = arguments.handler
    return handler(arguments)


if __name__ == "__main__":
    sys.exit(main())
