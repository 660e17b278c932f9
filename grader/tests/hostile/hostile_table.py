"""`make hostile`: grades the whole corpus and prints what came of each case."""

from __future__ import annotations

import argparse
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

from hostile_case import CHECKOUT, Case
from hostile_corpus import CASES, QUICK
from hostile_course import CANARIES
from hostile_grading import Graded, faults, grade_corpus, identity, letters_of, verdict_of
from hostile_watching import found

from raybook_grader.files import write_text
from raybook_grader.jobs.progress import plain


def rows(cases: Sequence[Case], graded: Graded) -> list[list[str]]:
    """Class, case, what it tries, verdict, checks, as expected."""
    made = []
    for case in cases:
        submission = graded.together.get(identity(case.name))
        verdict = verdict_of(submission) if submission else "absent"
        letters = letters_of(submission) if submission else ""
        fault = faults(case, graded)
        name = plain(identity(case.name))
        made.append([case.group, name if len(name) < 40 else name[:36] + " ...", case.tries,
                     verdict, letters, "; ".join(fault) or "yes"])  # fmt: skip
    return made


def markdown(table: Sequence[Sequence[str]], words: Sequence[str]) -> str:
    head = ["class", "case", "what it tries", "verdict", "checks", "as expected"]
    lines = [head, ["---"] * len(head), *table]
    escaped = (
        " | ".join(c.replace("|", "\\|").replace("<", "&lt;").replace("\n", " ") for c in line)
        for line in lines
    )
    return "\n".join([*(f"| {line} |" for line in escaped), "", *words, ""])


def main() -> int:
    """Exit code 0 only if every case and everything round it is as expected."""
    parser = argparse.ArgumentParser(description="Grades the hostile corpus; tells case by case.")
    parser.add_argument("--out", type=Path, default=CHECKOUT / "build" / "hostile")
    parser.add_argument("--quick", action="store_true", help="only what `make test` grades")
    parser.add_argument("--case", metavar="NAME", action="append", help="only these")
    arguments = parser.parse_args()
    cases = QUICK if arguments.quick else CASES
    if arguments.case:
        cases = [case for case in CASES if case.name in arguments.case]
    shutil.rmtree(arguments.out, ignore_errors=True)
    graded = grade_corpus(cases, arguments.out)
    table = rows(cases, graded)
    as_expected = sum(row[-1] == "yes" for row in table)
    leaks = found(CANARIES, graded.contents)
    words = [
        f"as expected {as_expected} of {len(table)}",
        f"exit code of the class run: {graded.ended}",
        f"files changed outside of the output folder: {', '.join(graded.changed) or 'none'}",
        f"canaries found in the outputs: {', '.join(leaks) or 'none'}",
    ]
    for row in table:
        print(f"{row[0]:13}{row[1]:40} {row[3]:12}{row[4]:7}{row[5]}")
    print("\n".join(words))
    file = arguments.out / "table.md"
    write_text(file, markdown(table, words))
    print(f"{file}")
    good = as_expected == len(table) and not (leaks or graded.changed or graded.ended)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
