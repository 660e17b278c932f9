"""Assignment 01 judges rightly: what is right passes, what is wrong fails, and where it should.

The C files are compiled straight from the checkout, without the box and without the kit.
"""

from __future__ import annotations

import os
import subprocess
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from raybook_grader.checks.oracles import cases_of, load_oracle
from raybook_grader.probes import Cases, Failure

ROOT = Path(__file__).resolve().parents[3]
FOLDER = ROOT / "assignments" / "01-triangle"
MODULE = ROOT / "src" / "shapes" / "triangle.c"
UNITY = Path(os.environ.get("UNITY_ROOT") or ROOT / "build" / "unity")
FLAGS = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-ffp-contract=off"]
SANITIZE = ["-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
TODOS = ["triangle_intersect", "triangle_uv_differentials"]

CHECKS: list[dict[str, Any]] = tomllib.loads((FOLDER / "assignment.toml").read_text())["check"]
PROBES = {check["name"]: check for check in CHECKS if check["kind"] == "probe"}
UNIT = next(check["name"] for check in CHECKS if check["kind"] == "unit")
ALTERNATIVES = sorted((FOLDER / "alternatives").glob("*.c"))
MISTAKES = sorted((FOLDER / "mistakes").glob("*.patch"))
UNIT_FAILS, EDGES, RANDOM, DIFFERENTIALS = UNIT, *PROBES


@dataclass
class Workshop:
    """Compiles modules with the probe's driver and with the public tests; keeps the objects."""

    folder: Path
    kept: dict[tuple[Path, tuple[str, ...]], Path] = field(default_factory=dict)

    def object(self, source: Path, cc: str, flags: Sequence[str]) -> Path:
        key = (source, (cc, *flags))
        if key not in self.kept:
            out = self.folder / f"{len(self.kept)}.o"
            include = [f"-I{ROOT / 'src'}", f"-I{FOLDER}", "-isystem", str(UNITY)]
            _run(cc, *FLAGS, *flags, *include, "-c", str(source), "-o", str(out))
            self.kept[key] = out
        return self.kept[key]

    def program(self, main: Path, module: Path, cc: str, flags: Sequence[str]) -> Path:
        shared = [flag for flag in flags if not flag.startswith("-DTODO")]
        sources = [main, ROOT / "src" / "base" / "todo.c"]
        if main.name.startswith("test_"):
            sources.append(UNITY / "unity.c")
        objects = [self.object(source, cc, shared) for source in sources]
        objects.append(self.object(module, cc, flags))
        out = self.folder / f"{objects[-1].stem}-{main.stem}"
        _run(cc, *shared, *map(str, objects), "-lm", "-o", str(out))
        return out

    def output(
        self, module: Path, check: str, cases: Cases, cc: str, flags: Sequence[str]
    ) -> bytes:
        driver = self.program(FOLDER / PROBES[check]["driver"], module, cc, flags)
        given, results = self.folder / "cases.bin", self.folder / "results.bin"
        given.write_bytes(cases.payload)
        _run(str(driver), str(given), str(results), PROBES[check]["group"])
        return results.read_bytes()

    def failures(
        self, module: Path, check: str, cc: str = "gcc", flags: Sequence[str] = ("-O2",)
    ) -> list[Failure]:
        cases = _cases(check)
        oracle = load_oracle(FOLDER / PROBES[check]["oracle"])
        return oracle.judge(cases, self.output(module, check, cases, cc, flags))

    def failing(self, module: Path, cc: str = "gcc", flags: Sequence[str] = ("-O2",)) -> set[str]:
        """The names of the checks, unit tests and probes, that the module fails."""
        failing = {check for check in PROBES if self.failures(module, check, cc, flags)}
        tests = self.program(FOLDER / "test_triangle.c", module, cc, flags)
        if subprocess.run([tests], capture_output=True).returncode != 0:
            failing.add(UNIT)
        return failing


def _run(*command: str) -> None:
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(command)}\n{done.stdout}{done.stderr}"


def _cases(check: str, seed: int | None = None) -> Cases:
    """Made once for each seed."""
    probe = PROBES[check]
    return cases_of(FOLDER / probe["oracle"], probe["group"], seed or probe["seed"])


def _table(name: str) -> list[list[str]]:
    lines = (FOLDER / "hidden" / name).read_text().splitlines()
    return [
        [cell.strip() for cell in line.split("|")]
        for line in lines
        if line.strip() and not line.startswith("#")
    ]


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    assert (UNITY / "unity.c").is_file(), f"{UNITY} has no unity.c: run `make setup` first"
    return Workshop(tmp_path_factory.mktemp("triangle"))


# --- What is right passes ---------------------------------------------------------------------

COMPILERS = [("gcc", "-O3"), ("gcc", "-O0"), ("clang", "-O2")]


@pytest.mark.parametrize("cc, level", COMPILERS)
@pytest.mark.parametrize("module", [MODULE, *ALTERNATIVES], ids=lambda file: file.stem)
def test_right_modules_pass(workshop: Workshop, module: Path, cc: str, level: str) -> None:
    assert workshop.failing(module, cc, (level,)) == set()


def test_there_are_alternatives_and_mistakes() -> None:
    assert len(ALTERNATIVES) >= 2
    assert len(MISTAKES) >= 3


@pytest.mark.parametrize("module", [MODULE, *ALTERNATIVES], ids=lambda file: file.stem)
def test_right_modules_pass_with_other_seeds(workshop: Workshop, module: Path) -> None:
    for check in (RANDOM, DIFFERENTIALS):
        oracle = load_oracle(FOLDER / PROBES[check]["oracle"])
        for seed in range(100, 106):
            cases = _cases(check, seed)
            output = workshop.output(module, check, cases, "gcc", ("-O2",))
            assert oracle.judge(cases, output) == [], f"{check}, seed {seed}"


def test_the_reference_is_clean_under_the_sanitizers(workshop: Workshop) -> None:
    assert workshop.failing(MODULE, "gcc", SANITIZE) == set()


# --- What is wrong fails, and where it should -------------------------------------------------


def _header(patch: Path) -> dict[str, str]:
    text = patch.read_text().split("\n\n")[0]
    return dict(line.split(": ", 1) for line in text.splitlines())


def _mistaken(patch: Path, folder: Path) -> Path:
    """The module with the mistake in it; a patch that does not apply to the letter is an error."""
    module = folder / "src" / "shapes" / "triangle.c"
    module.parent.mkdir(parents=True)
    module.write_bytes(MODULE.read_bytes())
    _run("patch", "-p1", "--batch", "--forward", "--fuzz=0", "-d", str(folder), "-i", str(patch))
    return module


@pytest.mark.parametrize("patch", MISTAKES, ids=lambda file: file.stem)
def test_mistakes_fail_what_they_announce(workshop: Workshop, patch: Path, tmp_path: Path) -> None:
    header = _header(patch)
    assert list(header) == ["What", "Seen", "Expect", "Hint"]
    expected = set(header["Expect"].split("; "))
    assert expected <= {check["name"] for check in CHECKS}
    module = _mistaken(patch, tmp_path)
    assert workshop.failing(module) == expected & {UNIT, *PROBES}


def test_a_patch_that_no_longer_applies_is_an_error(tmp_path: Path) -> None:
    patch = tmp_path / "old.patch"
    patch.write_text(MISTAKES[0].read_text().replace(" double ", " triple "))
    with pytest.raises(AssertionError, match="FAILED"):
        _mistaken(patch, tmp_path)


MUTANTS = {
    "b1 open": ("b1 >= -slack", "b1 > 0.0", EDGES),
    "b2 open": ("b2 >= -slack", "b2 > 0.0", EDGES),
    "sum open": ("b1 + b2 <= 1.0 + slack", "b1 + b2 < 1.0", EDGES),
    "t_min open": ("t >= (double)r->t_min", "t > (double)r->t_min", EDGES),
    "t_max open": ("t <= (double)r->t_max", "t < (double)r->t_max", EDGES),
    "no t_max": (" && t <= (double)r->t_max", "", RANDOM),
    "0 for t_min": ("t >= (double)r->t_min", "t >= 0.0", RANDOM),
    "an epsilon for t_min": ("t >= (double)r->t_min", "t > 1e-3", RANDOM),
    "square": ("b1 + b2 <= 1.0 + slack", "b1 <= 1.0 && b2 <= 1.0", RANDOM),
    "slack": ("b1 >= -slack", "b1 >= -1e-3", RANDOM),
    "less slack": ("b1 >= -slack", "b1 >= -4.9e-4", EDGES),
    "weights exchanged": ("hit->b1 = (float)b1", "hit->b1 = (float)b2", RANDOM),
    "weight of p0": ("hit->b1 = (float)b1", "hit->b1 = (float)(1.0 - b1 - b2)", RANDOM),
    "distance for t": (
        "hit->t = (float)t",
        "hit->t = (float)t * vec3_length(r->direction)",
        RANDOM,
    ),
    "t off by 0.1 %": ("hit->t = (float)t", "hit->t = (float)(t * 1.001)", RANDOM),
    "writes first": ("    bool inside", "    hit->t = (float)t;\n    bool inside", RANDOM),
    "changes the ray": (
        "    bool inside",
        "    ((ray *)r)->t_max = (float)t;\n    bool inside",
        RANDOM,
    ),
    "smaller epsilon": ("inverse != 0.0", "fabs(determinant) > 1e-8", RANDOM),
    "grazing": (
        "inverse != 0.0",
        "fabs(determinant) > 0.02 * sqrt(dot(normal, normal) * dot(direction, direction))",
        RANDOM,
    ),
    "back only": ("inverse != 0.0", "determinant > 0.0", EDGES),
    "sum of products": ("du1 * dv2 - du2 * dv1", "du1 * dv2 + du2 * dv1", DIFFERENTIALS),
    "no division": ("float k = 1.0f / determinant", "float k = 1.0f", DIFFERENTIALS),
    "uv epsilon": ("determinant == 0.0f", "fabsf(determinant) < 1e-6f", DIFFERENTIALS),
    "vectors exchanged": ("*dp_du = u_axis", "*dp_du = v_axis", DIFFERENTIALS),
    "lost sign": ("*dp_dv = v_axis", "*dp_dv = vec3_negate(v_axis)", DIFFERENTIALS),
    "unit length": ("*dp_du = u_axis", "*dp_du = vec3_normalize(u_axis)", DIFFERENTIALS),
    "dp_du not finite": ("!vec3_is_finite(u_axis) ||", "", DIFFERENTIALS),
    "dp_dv not finite": ("|| !vec3_is_finite(v_axis)", "", DIFFERENTIALS),
    "writes first too": ("    float k =", "    dp_du->x = 0.0f;\n    float k =", DIFFERENTIALS),
}


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(workshop: Workshop, mutant: str, tmp_path: Path) -> None:
    old, new, check = MUTANTS[mutant]
    text = MODULE.read_text()
    assert old in text, f"{MODULE.name} no longer says {old!r}"
    module = tmp_path / "triangle.c"
    module.write_text(text.replace(old, new))
    assert workshop.failures(module, check, "gcc", ("-O1",))


def test_the_stub_fails_its_tests(workshop: Workshop) -> None:
    flags = ["-O2", *(f"-DTODO_{todo}" for todo in TODOS)]
    assert workshop.failing(MODULE, "gcc", flags) == {UNIT, *PROBES}


@pytest.mark.parametrize(
    "todo, expected",
    [(TODOS[0], {UNIT, EDGES, RANDOM}), (TODOS[1], {UNIT, DIFFERENTIALS})],
)
def test_half_a_solution_earns_its_half(workshop: Workshop, todo: str, expected: set[str]) -> None:
    assert workshop.failing(MODULE, "gcc", ["-O2", f"-DTODO_{todo}"]) == expected


# --- The cases --------------------------------------------------------------------------------


@pytest.mark.parametrize("check", PROBES)
def test_cases_are_the_same_for_the_same_seed(check: str) -> None:
    oracle, group = load_oracle(FOLDER / PROBES[check]["oracle"]), PROBES[check]["group"]
    seven, again, eight = (oracle.make_cases(group, seed).payload for seed in (7, 7, 8))
    assert seven == again
    assert (seven == eight) == (check == EDGES)


def test_there_are_enough_cases() -> None:
    assert len(_table("edges_triangle.txt")) >= 60
    assert _cases(EDGES).count == 3 * len(_table("edges_triangle.txt"))
    assert _cases(RANDOM).count >= 5000
    assert _cases(DIFFERENTIALS).count >= 1000 + 3 * len(_table("edges_differentials.txt"))


@pytest.mark.parametrize("seed", range(1, 4))
def test_most_random_cases_have_one_right_answer(seed: int) -> None:
    context = _cases(RANDOM, seed).context
    decided = context.must_hit | ~context.may_hit
    assert np.mean(decided) > 0.8
    assert np.mean(context.must_hit) > 0.3
    assert np.mean(~context.may_hit) > 0.3
    # The weights' tolerance is near what the contract names for a good half of them.
    assert np.median(context.b_error[context.must_hit, 1:]) < 3e-4


@pytest.mark.parametrize(
    "check, table, words, positive",
    [
        (EDGES, "edges_triangle.txt", 5, "hit"),
        (DIFFERENTIALS, "edges_differentials.txt", 8, "answer"),
    ],
)
def test_exact_arithmetic_agrees_with_the_author(
    check: str, table: str, words: int, positive: str
) -> None:
    """A module that always says false is wrong exactly where the table's first column says so."""
    cases = _cases(check)
    rows = _table(table) * 3
    failures = load_oracle(FOLDER / PROBES[check]["oracle"]).judge(
        cases, bytes(4 * words * cases.count)
    )
    wrong = {failure.case for failure in failures if failure.case < len(rows)}
    assert wrong == {case for case, row in enumerate(rows) if row[0] == positive}


# --- Words ------------------------------------------------------------------------------------


def test_a_failure_is_told_in_words(workshop: Workshop, tmp_path: Path) -> None:
    module = tmp_path / "triangle.c"
    module.write_text(MODULE.read_text().replace("b2 >= -slack", "b2 > 0.0"))
    failures = workshop.failures(module, EDGES)
    simplest = max(failures, key=lambda failure: failure.simplicity)
    assert simplest.message == (
        "edge: the middle of p0 p1 (b2 = 0): ray from (1, 0, 5) along (0, 0, -1), t in [0, inf], "
        "triangle (0, 0, 0) (2, 0, 0) (0, 2, 0): "
        "expected a hit at t = 5, b1 = 0.5, b2 = 0, got none"
    )
    assert simplest.fingerprint == "missed: edge"


@pytest.mark.parametrize("check", PROBES)
@pytest.mark.parametrize("size", [0, 1, 4321])
def test_an_output_of_a_wrong_length_is_one_failure(check: str, size: int) -> None:
    failures = load_oracle(FOLDER / PROBES[check]["oracle"]).judge(_cases(check), bytes(size))
    assert [failure.fingerprint for failure in failures] == ["output of a wrong length"]
    assert f"wrote {size} bytes" in failures[0].message


@pytest.mark.parametrize("byte", [0x7F, 0xFF])
@pytest.mark.parametrize("check", PROBES)
def test_any_bytes_are_judged(check: str, byte: int) -> None:
    words = 8 if check == DIFFERENTIALS else 5
    cases = _cases(check)
    output = bytes([byte]) * (4 * words * cases.count)
    assert load_oracle(FOLDER / PROBES[check]["oracle"]).judge(cases, output)


def test_the_driver_refuses_bad_files(workshop: Workshop, tmp_path: Path) -> None:
    driver = workshop.program(FOLDER / "hidden/probe_triangle.c", MODULE, "gcc", ("-O2",))
    short = tmp_path / "short.bin"
    short.write_bytes(bytes(100))
    out = str(tmp_path / "out.bin")
    for arguments, message in [
        ([], "usage: "),
        ([str(tmp_path / "none.bin"), out, "edges"], "none.bin: cannot be opened"),
        ([str(short), out, "edges"], "short.bin: ends inside a record"),
        ([str(short), str(tmp_path / "no" / "out.bin"), "edges"], "out.bin: cannot be opened"),
    ]:
        done = subprocess.run([driver, *arguments], capture_output=True, text=True)
        assert done.returncode == 2
        assert message in done.stderr
