"""Building the student's renderer and tests with `make`, and the compiler's own words."""

from __future__ import annotations

import os
import shlex
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ..checks.words import clean
from ..files import locked

# A make around us must not lend its options and its jobs to the makes that we run; what was said
# on its command line (VARIANT, TODO, CC, OPT) is in the environment as well.
_OF_MAKE = ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")
_LINES = 40


class DoesNotBuild(Exception):
    """There is no program; the text is what the compiler or linker said."""


@dataclass(frozen=True)
class Programs:
    """What was built; ``tests`` by the name of their source."""

    renderer: Path
    tests: dict[str, Path]


@dataclass(frozen=True)
class Maker:
    """`make` at the top of a project."""

    root: Path

    def programs(self, tests: Sequence[str]) -> Programs:
        """The renderer and these tests, up to date, and what scenes need. Raises `DoesNotBuild`."""
        names = f"TESTS={' '.join(tests)}"
        said = self._make("build/meshes/done", "programs", names)
        renderer, *built = said.splitlines()[-1].split()
        paths = [self.root / path for path in built]
        return Programs(self.root / renderer, dict(zip(tests, paths, strict=True)))

    def release(self) -> Path:
        """The renderer as `make render` builds it, up to date. Raises `DoesNotBuild`."""
        said = self._make("build/meshes/done", "build", "CHECK=")
        return self.root / said.splitlines()[-1]

    def compiler_words(self, source: Path, path: str) -> tuple[bool, str]:
        """Whether ``source``, in the place of the file ``path``, compiles; what is said of it."""
        beside = ["-iquote", str(Path(path).parent)]
        command = [*self._compiler, "-fdiagnostics-color=never", *beside]
        command += ["-c", os.path.relpath(source, self.root), "-o", os.devnull]
        done = subprocess.run(command, cwd=self.root, capture_output=True)
        return done.returncode == 0, clean(done.stderr, _LINES)

    @cached_property
    def _compiler(self) -> list[str]:
        return shlex.split(self._make("-s", "list-compiler"))

    def _make(self, *words: str) -> str:
        environment = {k: v for k, v in os.environ.items() if k not in _OF_MAKE}
        command = ["make", f"-j{os.cpu_count() or 1}", "CHECK=yes", *words]
        with locked(self.root / "build" / ".make.lock"):  # `make watch` may run beside `make check`
            done = subprocess.run(
                command,
                cwd=self.root,
                env=environment,
                capture_output=True,
                text=True,
                errors="replace",
            )
        if done.returncode != 0:
            raise DoesNotBuild(clean(done.stderr, _LINES))
        return done.stdout
