"""A workbench for the tests of one assignment: its module against its probes, without the box.

Any compiler and flags will do, which the grader itself does not offer: it has the kit's only. The
kit's objects give the rest of the renderer.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from raybook_grader.checks.oracles import cases_of, load_oracle
from raybook_grader.course import Assignment, CostCheck, ProbeCheck, UnitCheck, load_course
from raybook_grader.kit import load_kit
from raybook_grader.probes import Cases, Failure

ROOT = Path(__file__).resolve().parents[3]
DRIVER = ROOT / "grader" / "raybook_grader" / "checks" / "driver"
UNITY = Path(os.environ.get("UNITY_ROOT") or ROOT / "build" / "unity")
WARNINGS = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
CODE = ["-ffp-contract=off", "-fno-math-errno", "-fopenmp"]
COMPILERS = [("gcc", "-O3"), ("gcc", "-O0"), ("clang", "-O2")]


def run(*command: str) -> None:
    """Run a command that must succeed."""
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(command)}\n{done.stdout}{done.stderr}"


@dataclass
class Bench:
    """Builds one owned file with drivers and tests; keeps what it compiled.

    Of a module of several files, one is told by its name, and the others are the reference's.
    """

    folder: Path
    assignment: Assignment
    kept: dict[tuple[Path, tuple[str, ...]], Path] = field(default_factory=dict)

    @property
    def probes(self) -> dict[str, ProbeCheck]:
        """The probes by name, in the rubric's order."""
        return {c.name: c for c in self.assignment.checks if isinstance(c, ProbeCheck)}

    @property
    def units(self) -> list[UnitCheck]:
        return [c for c in self.assignment.checks if isinstance(c, UnitCheck)]

    @property
    def unit(self) -> UnitCheck:
        return self.units[0]

    @property
    def module(self) -> Path:
        """The reference's module."""
        return ROOT / self.assignment.owned[0]

    def owned(self, module: Path) -> str:
        """The owned file that this one stands for."""
        named = [path for path in self.assignment.owned if Path(path).name == module.name]
        return (named or self.assignment.owned)[0]

    def object(self, source: Path, cc: str, flags: Sequence[str]) -> Path:
        key = (source, (cc, *flags))
        if key not in self.kept:
            out = self.folder / f"{len(self.kept)}.o"
            beside = (ROOT / self.owned(source)).parent
            include = [f"-I{ROOT / 'src'}", f"-I{DRIVER}", "-iquote", str(beside)]
            include += ["-isystem", str(UNITY)]
            run(cc, *WARNINGS, *CODE, *flags, *include, "-c", str(source), "-o", str(out))
            self.kept[key] = out
        return self.kept[key]

    def program(self, main: Path, module: Path, cc: str, flags: Sequence[str]) -> Path:
        """The driver or the tests with a module, and the reference for everything else."""
        kit = load_kit(ROOT / "build" / "kit")
        shared = [flag for flag in flags if not flag.startswith("-DTODO")]
        objects = [self.object(main, cc, shared), self.object(module, cc, flags)]
        if main.name.startswith("test_"):
            objects.append(self.object(UNITY / "unity.c", cc, shared))
        left_out = {"objects/main.o", kit.modules[self.owned(module)].object}
        rest = [str(kit.folder / name) for name in kit.objects if name not in left_out]
        out = self.folder / f"{objects[1].stem}-{main.stem}"
        run("gcc", *CODE, *shared, *map(str, objects), *rest, *kit.ldlibs, "-o", str(out))
        return out

    def cases(self, check: str, seed: int | None = None) -> Cases:
        """Made once for each seed."""
        probe = self.probes[check]
        oracle = self.assignment.folder / probe.oracle
        return cases_of(oracle, probe.group, probe.seed if seed is None else seed)

    def judge(self, check: str, cases: Cases, output: bytes) -> list[Failure]:
        return load_oracle(self.assignment.folder / self.probes[check].oracle).judge(cases, output)

    def driver(
        self, check: ProbeCheck | CostCheck, module: Path, cc: str = "gcc",
        flags: Sequence[str] = ("-O2",),
    ) -> Path:  # fmt: skip
        """A check's driver with a module."""
        return self.program(self.assignment.folder / check.driver, module, cc, flags)

    def answers(
        self, check: ProbeCheck | CostCheck, cases: Cases, module: Path, cc: str = "gcc",
        flags: Sequence[str] = ("-O2",),
    ) -> bytes:  # fmt: skip
        """What a check's driver says about the module."""
        driver = self.driver(check, module, cc, flags)
        given, results = self.folder / "cases.bin", self.folder / "results.bin"
        given.write_bytes(cases.payload)
        run(str(driver), str(given), str(results), check.group)
        return results.read_bytes()

    def failures(
        self, module: Path, check: str, cc: str = "gcc", flags: Sequence[str] = ("-O2",),
        seed: int | None = None,
    ) -> list[Failure]:  # fmt: skip
        """What the oracle of a probe says of the module."""
        cases = self.cases(check, seed)
        return self.judge(check, cases, self.answers(self.probes[check], cases, module, cc, flags))

    def failing(self, module: Path, cc: str = "gcc", flags: Sequence[str] = ("-O2",)) -> set[str]:
        """The names of the checks that the module fails: unit tests and probes."""
        failing = {check for check in self.probes if self.failures(module, check, cc, flags)}
        for unit in self.units:
            tests = self.program(self.assignment.folder / unit.tests, module, cc, flags)
            if subprocess.run([tests], capture_output=True).returncode != 0:
                failing.add(unit.name)
        return failing

    def mutant(self, old: str, new: str, folder: Path, of: Path | None = None) -> Path:
        """The reference's module, or another one, with one text replaced."""
        original = of or self.module
        text = original.read_text()
        assert old in text, f"{original.name} no longer says {old!r}"
        module = folder / original.name
        module.write_text(text.replace(old, new))
        return module


def assignment_of(number: str) -> Assignment:
    return load_course(ROOT).assignment(number)


def bench_fixture(assignment: Assignment) -> object:
    """The fixture `bench` of a file of tests."""

    @pytest.fixture(scope="module")
    def bench(tmp_path_factory: pytest.TempPathFactory) -> Bench:
        return Bench(tmp_path_factory.mktemp(assignment.module), assignment)

    return bench


def right_modules(assignment: Assignment) -> list[Path]:
    """The reference and the alternatives, which are whole files; of each only what it changes."""
    alternatives = sorted((assignment.folder / "alternatives").rglob("*.c"))
    return [*(ROOT / path for path in assignment.owned), *alternatives]


def name_of(module: Path) -> str:
    """For the name of a test."""
    return f"{module.parent.name}/{module.stem}"
