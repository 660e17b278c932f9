"""`raybook-grader`: the command line.

Exit codes: 0 done; 2 bad input or usage, with one message; 3 graded, but the harness failed in
some module; 130 interrupted; 1 anything else.
"""

from __future__ import annotations

import argparse
import sys

from .calibration import commands as calibration
from .errors import BadInput, Trouble
from .exports import commands as exports
from .gradescope import commands as gradescope
from .grading import commands as grading
from .grading import override_command as override
from .judge import commands as judge
from .literate import commands as literate
from .museum import commands as museum
from .sandbox import SandboxUnavailable
from .sandbox import commands as sandbox
from .similarity import commands as similarity


def parser() -> argparse.ArgumentParser:
    """The parser of all commands; each sets ``handler``, which gives the exit code."""
    top = argparse.ArgumentParser(
        prog="raybook-grader",
        description="Grades submissions to the Raybook course; makes its student edition.",
    )
    commands = top.add_subparsers(metavar="COMMAND", required=True)
    for part in (
        grading, override, exports, gradescope, similarity, judge, museum, calibration, literate,
        sandbox,
    ):  # fmt: skip
        part.add_commands(commands)
    return top


def main() -> int:
    """Run the command line's command."""
    arguments = parser().parse_args()
    try:
        return int(arguments.handler(arguments))
    except BadInput as fault:
        return _fail(str(fault), 2)
    except (SandboxUnavailable, Trouble) as fault:
        return _fail(str(fault), 1)
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        # Whoever read our output has gone; say nothing more.
        sys.stderr.close()
        return 1


def _fail(message: str, code: int) -> int:
    print(f"raybook-grader: {message}", file=sys.stderr)
    return code
