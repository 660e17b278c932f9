"""What holds for every probe of every assignment: its cases, its oracle, its driver, its margins.

What the probes of one assignment are there to see is tested in that assignment's own file.
"""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from itertools import product
from pathlib import Path

import pytest
from probe_bench import COMPILERS, ROOT, Bench, name_of, right_modules

from raybook_grader.checks.oracles import load_oracle
from raybook_grader.course import ProbeCheck, load_course

ASSIGNMENTS = {a.number: a for a in load_course(ROOT).assignments if a.owned}
PROBES = [
    (number, check.name)
    for number, assignment in ASSIGNMENTS.items()
    for check in assignment.checks
    if isinstance(check, ProbeCheck)
]
RIGHT = [
    pytest.param(number, module, cc, level, id=f"{number}-{name_of(module)}-{cc}-{level}")
    for number, assignment in ASSIGNMENTS.items()
    for module, (cc, level) in product(right_modules(assignment), COMPILERS)
    # Long ones: the museum judges them as the kit's compiler builds them.
    if number not in ("09", "10") or (cc, level) != COMPILERS[0]
]

Benches = Callable[[str], Bench]


@pytest.fixture(scope="module")
def benches(tmp_path_factory: pytest.TempPathFactory) -> Benches:
    made: dict[str, Bench] = {}

    def bench_of(number: str) -> Bench:
        if number not in made:
            made[number] = Bench(tmp_path_factory.mktemp(number), ASSIGNMENTS[number])
        return made[number]

    return bench_of


@pytest.mark.parametrize("number, module, cc, level", RIGHT)
def test_right_modules_pass(
    benches: Benches, number: str, module: Path, cc: str, level: str
) -> None:
    assert benches(number).failing(module, cc, (level,)) == set()


# --- Cases ------------------------------------------------------------------------------------


@pytest.mark.parametrize("number, check", PROBES)
def test_cases_are_the_same_for_the_same_seed(number: str, check: str, benches: Benches) -> None:
    probe = benches(number).probes[check]
    oracle = load_oracle(ASSIGNMENTS[number].folder / probe.oracle)
    seven, again, eight = (oracle.make_cases(probe.group, seed).payload for seed in (7, 7, 8))
    assert seven == again
    assert (seven == eight) == probe.group.endswith("edges"), "only hand-picked cases need no seed"


# --- Oracles ----------------------------------------------------------------------------------


@pytest.mark.parametrize("number, check", PROBES)
def test_an_output_of_a_wrong_length_is_a_failure(
    benches: Benches, number: str, check: str
) -> None:
    bench = benches(number)
    for size in (0, 1, 4321, 5_000_000):
        failures = bench.judge(check, bench.cases(check), bytes(size))
        assert failures[-1].fingerprint == "output of a wrong length", size
        assert len(failures) == 1 or number == "03", "records of 03 have lengths of their own"
        assert number != "01" or f"wrote {size} bytes" in failures[0].message


NOTHING_IS_RIGHT = [("01", "triangles without area")]
"""Probes of which an output of zeros is right."""


@pytest.mark.parametrize("number, check", PROBES)
def test_any_bytes_are_judged(benches: Benches, number: str, check: str) -> None:
    bench, cases = benches(number), benches(number).cases(check)
    size = len(bench.answers(bench.probes[check], cases, bench.module))
    for byte in (0x00, 0x01, 0x7F, 0xFF):
        failures = bench.judge(check, cases, bytes([byte]) * size)
        assert bool(failures) == (byte != 0 or (number, check) not in NOTHING_IS_RIGHT), byte


# --- Drivers ----------------------------------------------------------------------------------


@pytest.mark.parametrize("number, check", PROBES)
def test_drivers_refuse_bad_files(
    benches: Benches, number: str, check: str, tmp_path: Path
) -> None:
    bench, probe = benches(number), benches(number).probes[check]
    driver = bench.driver(probe, bench.module)
    inside_word, inside_record = tmp_path / "word.bin", tmp_path / "record.bin"
    inside_word.write_bytes(bench.cases(check).payload[:101])
    inside_record.write_bytes(bytes([1, 0, 0, 0]))  # "one": of what is to follow, in many
    out = tmp_path / "out.bin"
    for files, message in [
        ([], "usage: "),
        ([tmp_path / "none.bin", out], "none.bin: cannot be opened"),
        ([tmp_path, out], "cannot be read"),
        ([inside_word, out], "word.bin: ends inside a record"),
        ([inside_record, out], "record.bin: ends inside a record"),
        ([inside_word, tmp_path / "no" / "out.bin"], "out.bin: cannot be opened"),
    ]:
        arguments = [*map(str, files), probe.group] if files else []
        done = subprocess.run([driver, *arguments], capture_output=True, text=True)
        assert (done.returncode, message in done.stderr) == (2, True), done.stderr
        assert Path(probe.driver).stem in done.stderr
