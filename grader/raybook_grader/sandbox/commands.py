"""The command `doctor` of raybook-grader: can this machine grade strangers' code safely?"""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING

from .doctor import Finding
from .survey import survey

if TYPE_CHECKING:
    # argparse has no public name for what add_subparsers() returns.
    Subparsers = argparse._SubParsersAction[argparse.ArgumentParser]


def add_commands(subparsers: Subparsers) -> None:
    """Register `doctor` with raybook-grader."""
    command = subparsers.add_parser(
        "doctor",
        help="what this machine offers for running students' code safely",
        description="Looks at everything that the sandbox needs, makes a box on trial, and says "
        "what is missing and what to do about it.",
        epilog="Exit code: 0 if grading is safe here, 1 if not.",
    )
    command.add_argument("--json", action="store_true", help="the same for programs")
    command.set_defaults(handler=_doctor)


def _doctor(arguments: argparse.Namespace) -> int:
    findings = survey()
    safe = is_safe(findings)
    if arguments.json:
        print(json.dumps({"safe": safe, "findings": [asdict(f) for f in findings]}, indent=1))
    else:
        print("\n".join(_lines(findings)))
        print("\n" + (_SAFE if safe else _UNSAFE))
    return 0 if safe else 1


_SAFE = "Safe: students' code is compiled, linked, run and decoded in boxes."
_UNSAFE = (
    "Not safe: this machine cannot make a box, so `raybook-grader grade` refuses. With --unsafe "
    "it\nwould grade with limits only, and every result would say so."
)


def is_safe(findings: Sequence[Finding]) -> bool:
    """Whether all that is needed is there."""
    return all(finding.ok for finding in findings if finding.needed)


def _lines(findings: Sequence[Finding]) -> list[str]:
    width = max(len(finding.name) for finding in findings)
    lines = []
    for finding in findings:
        state = "ok" if finding.ok else "MISSING" if finding.needed else "weak"
        lines.append(f"{finding.name:{width}}  {state:8}{finding.message}")
        if finding.remedy:
            lines.append(f"{'':{width}}  {'':8}remedy: {finding.remedy}")
    return lines
