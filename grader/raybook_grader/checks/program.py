"""Building programs from a student's module and the kit, in the box.

A module is compiled with nothing readable but the toolchain and the public headers. Then all of
its symbols are made local but those of its contract, and it is linked with every reference
object but its own: so whatever it defines, it can replace nothing but itself.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path, PurePosixPath

from ..course import Assignment, Course
from ..kit import Kit, is_clang
from ..sandbox import Box, BoxResult, Limits
from .sanitizers import sanitizing
from .words import clean

_INCLUDE = "/kit/include"
_OBJECTS = "/kit/objects"
_DRIVER = Path(__file__).resolve().parent / "driver"
"""What all drivers share: probe.h."""
_MAIN = "objects/main.o"
# Sections by which an object tells the linker what to do or to load.
_NO_ORDERS = (
    "--remove-section=.gnu.lto_*",
    "--remove-section=.deplibs",
    "--remove-section=.linker-options",
)
# gcc and ld take well under a second; a macro bomb takes for ever.
_BUILD_LIMITS = Limits(wall_seconds=60, cpu_seconds=20, memory_bytes=1 << 30)


class HarnessFault(Exception):
    """The harness could not do its part, whatever the submission: an internal error."""


class BuildFailure(Exception):
    """A student's module makes no program. ``words`` is what the compiler or linker said."""

    def __init__(self, message: str, words: str) -> None:
        super().__init__(message)
        self.message = message
        self.words = words


@dataclass(frozen=True)
class ModuleObjects:
    """A compiled module: its source files, its objects, and the compiler's warnings in words."""

    files: Mapping[str, bytes]
    objects: Mapping[str, bytes]
    warnings: str

    @property
    def owned(self) -> tuple[str, ...]:
        return tuple(self.files)


class Workshop:
    """The course, the kit and a box to build and run in. One a process."""

    def __init__(self, course: Course, kit: Kit, box: Box) -> None:
        self.course = course
        self.kit = kit
        self.box = box
        self._trusted = cache(self._compile_trusted)
        self.tool = cache(self._tool)

    def compile_module(self, assignment: Assignment, files: Mapping[str, bytes]) -> ModuleObjects:
        """Compile a module's files; raises `BuildFailure`."""
        return self._compile(files)

    def renderer(self, module: ModuleObjects | None = None) -> bytes:
        """The renderer with a student's module, or all of the reference; raises `BuildFailure`."""
        return self._link(module, {}, with_main=True)

    def driver(self, module: ModuleObjects | None, source: Path) -> bytes:
        """A probe's driver linked with a student's module, or all of the reference."""
        return self._link(module, {"driver.o": self._trusted(source)}, with_main=False)

    def sanitized_driver(self, module: ModuleObjects, source: Path) -> bytes:
        """The same, with the module and the driver under the sanitizers."""
        flags = sanitizing(self.kit.cc)
        watched = self._compile(module.files, flags)
        driver = self._trusted(source, flags)
        return self._link(watched, {"driver.o": driver}, with_main=False, flags=flags)

    def _tool(self, source: Path) -> bytes:
        """A trusted program of one file, built once a process, that no student's code is in."""
        return self.driver(None, source)

    def preprocessed(self, module: ModuleObjects) -> bytes:
        """A module's texts as the compiler reads them when it compiles for the sanitizers."""
        texts = []
        for path, content in sorted(module.files.items()):
            flags = [*sanitizing(self.kit.cc), "-w", "-E", "-P"]
            done = self._run_compiler(path, content, flags, "text.i")
            if not done.ok or "text.i" not in done.files:
                raise HarnessFault(f"{path} compiled, but is not preprocessed: {done.describe()}")
            texts.append(done.files["text.i"])
        return b"\n".join(texts)

    def unit_tests(self, module: ModuleObjects, source: Path) -> bytes:
        """A file of Unity tests linked with a student's module."""
        unity = self._unity
        extra = {"tests.o": self._trusted(source), "unity.o": self._trusted(unity / "unity.c")}
        return self._link(module, extra, with_main=False)

    @property
    def _unity(self) -> Path:
        return self.course.root / "build" / "unity"

    @cached_property
    def _reference_objects(self) -> list[str]:
        return self.kit.objects

    def _compile(self, files: Mapping[str, bytes], flags: Sequence[str] = ()) -> ModuleObjects:
        objects: dict[str, bytes] = {}
        warnings: list[str] = []
        for number, (path, content) in enumerate(sorted(files.items())):
            name = f"module{number}.o"
            objects[name], said = self._compile_student(path, content, name, flags)
            warnings += [said] if said else []
        return ModuleObjects(files, objects, "\n".join(warnings))

    def _compile_student(
        self, path: str, content: bytes, name: str, flags: Sequence[str]
    ) -> tuple[bytes, str]:
        compiled = self._run_compiler(path, content, [*flags, "-c"], "raw.o")
        words = clean(compiled.stderr).replace("./src/", "src/")
        if not compiled.ok or "raw.o" not in compiled.files:
            raise BuildFailure(f"{path} does not compile{_because(compiled)}", words)
        return self._make_local(path, compiled.files["raw.o"], name), words

    def _run_compiler(
        self, path: str, content: bytes, flags: Sequence[str], output: str
    ) -> BoxResult:
        """The compiler on one of a student's files, with the public headers in reach."""
        beside = f"{_INCLUDE}/{PurePosixPath(path).parent.relative_to('src')}"
        most_errors = "-ferror-limit=20" if is_clang(self.kit.cc) else "-fmax-errors=20"
        return self.box.run(
            [self.kit.cc, *self.kit.cflags, "-Wno-error", most_errors,
             "-fdiagnostics-color=never", "-I", _INCLUDE, "-iquote", beside,
             *flags, f"./{path}", "-o", output],
            binds={_INCLUDE: self.kit.include},
            inputs={path: content},
            collect=[output],
            limits=_BUILD_LIMITS,
        )  # fmt: skip

    def _make_local(self, path: str, raw: bytes, name: str) -> bytes:
        keep = [f"--keep-global-symbol={symbol}" for symbol in self.kit.modules[path].symbols]
        done = self.box.run(
            [self.kit.objcopy, *keep, *_NO_ORDERS, "raw.o", name],
            inputs={"raw.o": raw},
            collect=[name],
            limits=_BUILD_LIMITS,
        )
        if not done.ok or name not in done.files:
            message = f"the symbols of {path} cannot be made local{_because(done)}"
            raise BuildFailure(message, clean(done.stderr))
        return done.files[name]

    def _compile_trusted(self, source: Path, flags: Sequence[str] = ()) -> bytes:
        """The object of a driver, a test or Unity, which no student wrote."""
        compiled = self.box.run(
            [self.kit.cc, *self.kit.cflags, *flags, "-w", "-Wno-error",
             "-I", _INCLUDE, "-I", "/unity", "-I", "/driver",
             "-c", source.name, "-o", "trusted.o"],
            binds={_INCLUDE: self.kit.include, "/unity": self._unity, "/driver": _DRIVER},
            inputs={source.name: source.read_bytes()},
            collect=["trusted.o"],
            limits=_BUILD_LIMITS,
        )  # fmt: skip
        if not compiled.ok or "trusted.o" not in compiled.files:
            raise HarnessFault(f"{source} does not compile:\n{clean(compiled.stderr)}")
        return compiled.files["trusted.o"]

    def _link(
        self, module: ModuleObjects | None, extra: Mapping[str, bytes], with_main: bool,
        flags: Sequence[str] = (),
    ) -> bytes:  # fmt: skip
        own = module.objects if module else {}
        # What the reference has in the module's place is not even there to be found.
        replaced = [self.kit.modules[path].object for path in (module.owned if module else ())]
        linked = self.box.run(
            [self.kit.cc, *self.kit.ldflags, *flags, "-o", "program", *own, *extra,
             *(f"/kit/{name}" for name in self._linked_with(module, with_main)),
             *self.kit.ldlibs],
            binds={_OBJECTS: self.kit.folder / "objects"},
            inputs={**own, **extra, **{f"/kit/{name}": b"" for name in replaced}},
            collect=["program"],
            limits=_BUILD_LIMITS,
        )  # fmt: skip
        if linked.ok and "program" in linked.files:
            return linked.files["program"]
        words = clean(linked.stderr)
        if module is None:
            raise HarnessFault(f"the kit does not link:\n{words}")
        raise BuildFailure(f"the module does not link{_because(linked)}", words)

    def _linked_with(self, module: ModuleObjects | None, with_main: bool) -> Sequence[str]:
        without = {self.kit.modules[path].object for path in (module.owned if module else ())}
        if not with_main:
            without.add(_MAIN)
        return [name for name in self._reference_objects if name not in without]


def _because(result: BoxResult) -> str:
    """Why a build stopped, where its own words would not say."""
    if result.outcome == "lost":
        raise HarnessFault(f"a build in the box was lost: {result.detail}")
    return "" if result.outcome == "exited" else f": {result.describe()}"
