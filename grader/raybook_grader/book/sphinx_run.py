"""One run of Sphinx, in a process of its own."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from .editions import Edition


@dataclass(frozen=True)
class Settings:
    """What `make book` was asked for. `root` is the checkout."""

    root: Path
    draft: bool = False
    accept: bool = False

    @property
    def docs(self) -> Path:
        return self.root / "docs"

    @property
    def out(self) -> Path:
        return self.root / "build" / "book"

    def pages(self, edition: Edition) -> Path:
        """Where the pages of an edition end up."""
        return self.out / edition

    def aside(self, name: str) -> Path:
        """Where something is kept that is not for readers."""
        return self.out / ".work" / name

    def pdf(self, edition: Edition) -> Path:
        """The whole edition on paper."""
        return self.pages(edition) / f"raybook-{edition}.pdf"


@dataclass(frozen=True)
class Outcome:
    """What Sphinx made: pages in `folder`, what it has read in `doctrees`, and its warnings."""

    folder: Path
    doctrees: Path
    warnings: tuple[str, ...]
    crashed: bool


def run_sphinx(
    settings: Settings, edition: Edition, builder: str, out: Path, *,
    doctrees: Path | None = None, pages: Sequence[Path] = (),
) -> Outcome:  # fmt: skip
    """Build into the fresh folder `out`. Every page is read anew, or `doctrees` are those that
    another builder has read a moment ago. `pages`: write only these."""
    shutil.rmtree(out, ignore_errors=True)
    read = doctrees or out.parent / f"doctrees-{out.name}"
    if not doctrees:
        shutil.rmtree(read, ignore_errors=True)
    options = {"book_edition": edition.value, "book_draft": int(settings.draft),
               "book_accept": int(settings.accept), "book_root": settings.root,
               "book_assets": read.with_name(f"{read.name}-assets"),
               "html_title": f"Raybook, {edition} edition"}  # fmt: skip
    command = [sys.executable, "-m", "sphinx", "-q", *([] if doctrees else ["-E"]), "-n",
               "--keep-going", "-b", builder, "-d", str(read),
               str(settings.docs), str(out), *map(str, pages)]  # fmt: skip
    for name, value in options.items():
        command += ["-D", f"{name}={value}"]
    if edition is Edition.STUDENT:
        command += ["-D", "exclude_patterns=figures/**,instructor/**,decisions/**"]
    done = subprocess.run(
        command, cwd=settings.root, env=_environment(), capture_output=True, text=True, check=False
    )
    (out / ".buildinfo").unlink(missing_ok=True)
    shutil.rmtree(out / "_sources", ignore_errors=True)
    said = _plain(done.stderr, settings.root)
    return Outcome(out, read, tuple(said), done.returncode != 0)


def _environment() -> dict[str, str]:
    """The same pages whenever they are made."""
    fixed = {"SOURCE_DATE_EPOCH": "0", "LC_ALL": "C.UTF-8", "PYTHONHASHSEED": "0"}
    return {**os.environ, **{k: os.environ.get(k, v) for k, v in fixed.items()}}


def _plain(text: str, root: Path) -> list[str]:
    """The lines of what Sphinx said, without colours and with paths from the checkout."""
    plain = re.sub(r"\x1b\[[0-9;]*m", "", text).replace(f"{root}/", "")
    return [line for line in plain.splitlines() if line.strip()]
