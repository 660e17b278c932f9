"""A small class for assignment 01: every way to be right, wrong, late or broken.

    build/venv/bin/python grader/tests/grade/make_class.py build/class

writes one submission each for the solution, the stub, some alternatives and mistakes of the
assignment, and for programs that do not compile, crash or never end. Then try

    make grade SUBMISSIONS=build/class
"""

from __future__ import annotations

import argparse
import io
import shutil
import sys
import tarfile
import zipfile
from pathlib import Path

from raybook_grader.checks.stub import stub_text
from raybook_grader.course import load_course
from raybook_grader.museum import exhibits_of

CHECKOUT = Path(__file__).resolve().parents[3]
OWNED = "src/shapes/triangle.c"

EXHIBITS = (
    "moller-trumbore-float", "watertight", "determinant-epsilon", "nan-passes", "one-sided",
    "open-seams", "reads-a-fourth-corner", "uv-transposed", "writes-on-a-miss",
)  # fmt: skip
"""Those of the museum that are in the class; `raybook-grader museum` judges them all."""

_STUB_LINE = "    (void)p, (void)r, (void)hit;\n"


def solution() -> str:
    """The reference's module."""
    return (CHECKOUT / OWNED).read_text(encoding="utf-8")


def make_class(out: Path) -> dict[str, str]:
    """Write the class into ``out``, which must be empty; the expected verdict by submission id."""
    out.mkdir(parents=True, exist_ok=True)
    right = solution()
    stub = stub_text(CHECKOUT, OWNED)
    verdicts = {
        _folder(out, "solution", right): "pass",
        _zip(out, "solution-zipped", right): "pass",
        _tar(out, "solution-in-a-folder", right): "pass",
        _folder(out, "stub", stub): "missing",
        _folder(out, "does-not-compile", _begin(stub, "    return 1 +;\n")): "build-error",
        _folder(out, "crashes", _begin(stub, "    *(volatile int *)0 = 1;\n")): "crash",
        _folder(out, "never-ends", _begin(stub, "    while (hit)\n        ;\n")): "timeout",
    }
    for exhibit in exhibits_of(CHECKOUT, load_course(CHECKOUT).assignment("01")):
        if exhibit.slug not in EXHIBITS:
            continue
        kind, verdict = ("right", "pass") if exhibit.is_right else ("wrong", "fail")
        text = exhibit.files[OWNED].decode()
        verdicts[_folder(out, f"{kind}-{exhibit.slug}", text)] = verdict
    return verdicts


def _begin(stub: str, lines: str) -> str:
    """The stub with other lines at the beginning of `triangle_intersect`."""
    assert stub.count(_STUB_LINE) == 1, f"the stub has no line {_STUB_LINE!r} any more"
    return stub.replace(_STUB_LINE, _STUB_LINE + lines)


def _folder(out: Path, name: str, text: str) -> str:
    file = out / name / OWNED
    file.parent.mkdir(parents=True)
    file.write_text(text, encoding="utf-8")
    return name


def _zip(out: Path, name: str, text: str) -> str:
    with zipfile.ZipFile(out / f"{name}.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(OWNED, text)
    return name


def _tar(out: Path, name: str, text: str) -> str:
    content = text.encode()
    member = tarfile.TarInfo(f"my-raybook/{OWNED}")
    member.size = len(content)
    with tarfile.open(out / f"{name}.tar.gz", "w:gz") as archive:
        archive.addfile(member, io.BytesIO(content))
    return name


def main() -> int:
    """Write the class and print the verdicts to expect."""
    parser = argparse.ArgumentParser(description="Writes a small class to try the grader on.")
    parser.add_argument("out", type=Path, help="the folder to write, replaced if it is there")
    out = parser.parse_args().out
    if out.exists():
        shutil.rmtree(out)
    for name, verdict in make_class(out).items():
        print(f"{name}: {verdict}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
