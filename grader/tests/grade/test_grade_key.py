"""What a result's key is made from: all that can change the result."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path, PurePosixPath

import raybook_grader
from raybook_grader.grading.key import has_a_say

PACKAGE = Path(raybook_grader.__file__).parent
STUBS = "literate"  # what it makes of a source for the checks, the stub, is hashed itself
PRINT = """
import sys, raybook_grader.grading.module, raybook_grader.diagnosis, raybook_grader.cases
print(*(m for m in sys.modules if m.startswith("raybook_grader.")))
"""


def test_all_that_judging_imports_has_a_say() -> None:
    said = subprocess.run([sys.executable, "-c", PRINT], capture_output=True, text=True, check=True)
    for name in said.stdout.split():
        parts = name.split(".")[1:]
        if PACKAGE.joinpath(*parts).is_dir() or parts[0] == STUBS:
            continue
        assert has_a_say(PurePosixPath(*parts).with_suffix(".py")), name


def test_reports_and_exports_do_not_make_work_stale() -> None:
    assert not has_a_say(PurePosixPath("reports/pages.py"))
    assert not has_a_say(PurePosixPath("grading/export.py"))
    assert has_a_say(PurePosixPath("checks/probe.py"))
