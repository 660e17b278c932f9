"""Assignment 10's probes, the public tests aside: are their oracles right, and what do they see?

What alternatives and mistakes do is in test_museum.py. Here C files are compiled straight from the
checkout, without the box and without the kit.
"""

from __future__ import annotations

import subprocess
import sys
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from raybook_grader.checks.oracles import cases_of, load_oracle
from raybook_grader.probes import Cases, Failure

ROOT = Path(__file__).resolve().parents[3]
FOLDER = ROOT / "assignments" / "10-mipmap"
MODULE = ROOT / "src" / "textures" / "mipmap.c"
GIVEN = ["textures/levels", "textures/ellipse", "base/todo", "base/memory", "image/image"]
FLAGS = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-ffp-contract=off"]
TABLE: dict[str, Any] = tomllib.loads((FOLDER / "assignment.toml").read_text())
PROBES = {c["group"]: c for c in TABLE["check"] if c["kind"] == "probe"}
RIGHT = [MODULE, *sorted((FOLDER / "alternatives").glob("*.c"))]
WORDS = {"level": 1, "trilinear": 3, "ewa": 3}


@dataclass
class Workshop:
    """Compiles modules with the driver; keeps what does not change."""

    folder: Path
    objects: list[str] = field(default_factory=list)

    def program(self, module: Path, flags: Sequence[str] = ()) -> Path:
        sources = [FOLDER / "hidden" / "probe_mipmap.c"]
        sources += [ROOT / "src" / f"{name}.c" for name in GIVEN]
        for i in range(len(self.objects), len(sources)):
            out = self.folder / f"{i}.o"
            _run("gcc", *FLAGS, "-O1", f"-I{ROOT / 'src'}", "-c", sources[i], "-o", out)
            self.objects.append(str(out))
        program = self.folder / f"probe-{len(list(self.folder.glob('probe-*')))}"
        include = f"-I{ROOT / 'src'}"
        _run("gcc", *FLAGS, "-O1", *flags, include, module, *self.objects, "-lm", "-o", program)
        return program

    def failures(self, program: Path, group: str, seed: int | None = None) -> list[Failure]:
        cases = _cases(group, seed)
        given, results = self.folder / "cases.bin", self.folder / "results.bin"
        given.write_bytes(cases.payload)
        _run(program, given, results, group)
        failures: list[Failure] = _oracle(group).judge(cases, results.read_bytes())
        return failures

    def failing(self, module: Path, flags: Sequence[str] = ()) -> set[str]:
        program = self.program(module, flags)
        return {group for group in PROBES if self.failures(program, group)}


def _run(*command: str | Path) -> None:
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"


def _oracle(group: str) -> Any:
    return load_oracle(FOLDER / PROBES[group]["oracle"])


def _cases(group: str, seed: int | None = None) -> Cases:
    return cases_of(FOLDER / PROBES[group]["oracle"], group, seed or PROBES[group]["seed"])


def _hidden(name: str) -> ModuleType:
    """A neighbour of the oracles, as they imported it."""
    for group in PROBES:
        _oracle(group)
    return sys.modules[name]


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    return Workshop(tmp_path_factory.mktemp("mipmap"))


# --- What is right passes, what is half done fails by half ------------------------------------


@pytest.mark.parametrize("module", RIGHT, ids=lambda file: file.stem)
def test_right_modules_pass_with_other_seeds(workshop: Workshop, module: Path) -> None:
    program = workshop.program(module)
    for group in PROBES:
        assert workshop.failures(program, group, 101) == [], group


@pytest.mark.parametrize(
    "todos, expected",
    [
        (["mipmap_pyramid"], {"pyramid"}),
        (["mipmap_level"], {"level", "trilinear"}),
        (["mipmap_trilinear"], {"trilinear"}),
        (["mipmap_ewa"], {"ewa"}),
        (TABLE["todos"], set(PROBES)),
    ],
)
def test_a_stub_fails_its_own_probes(
    workshop: Workshop, todos: list[str], expected: set[str]
) -> None:
    assert workshop.failing(MODULE, [f"-DTODO_{todo}" for todo in todos]) == expected


MUTANTS = {
    "one texel for three": ("* from + to - 1) / to);", "* from) / to);", "pyramid"),
    "rows for columns": ("overlapped(y, from->height, to->height)",
                         "overlapped(y, from->width, to->width)", "pyramid"),
    "rounded up": ("size > 1 ? size / 2 : 1", "size > 1 ? (size + 1) / 2 : 1", "pyramid"),
    "not the last level": ("return count;", "return count > 1 ? count - 1 : 1;", "pyramid"),
    "level a tenth higher": ("log2(fmax(longer, 1.0))", "log2(fmax(1.02 * longer, 1.0))", "level"),
    "only uv_dx": ("fmax(length_in_texels(m, uv_dx), length_in_texels(m, uv_dy))",
                   "fmax(length_in_texels(m, uv_dx), 0.0 * uv_dy.x)", "level"),
    "the sum of both": ("fmax(length_in_texels(m, uv_dx), length_in_texels(m, uv_dy))",
                        "length_in_texels(m, uv_dx) + length_in_texels(m, uv_dy)", "level"),
    "the finer level alone": ("return rgb_mix(color, mipmap_bilinear(m, fine + 1, uv),",
                              "return rgb_mix(color, mipmap_bilinear(m, fine, uv),", "trilinear"),
    "nearest": ("return rgb_mix(color, mipmap_bilinear(m, fine + 1, uv),",
                "return rgb_mix(color, mipmap_nearest(m, fine + 1, uv),", "trilinear"),
    "a square for a bell": ("return fmaxf(expf(-2.0f * (float)distance2) - lowest, 0.0f);",
                            "return distance2 + lowest > 0.0 ? 1.0 : 0.0;", "ewa"),
    "a narrow bell": ("expf(-2.0f *", "expf(-6.0f *", "ewa"),
    "the mirrored ellipse": ("double slope = e.xy / e.yy", "double slope = -e.xy / e.yy", "ewa"),
    "beside the middle": ("uv.x, image->width) - 0.5;\n    double center_y",
                          "uv.x, image->width);\n    double center_y", "ewa"),
    "two levels too high": ("shortest / fewest_texels, 1.0",
                            "4.0 * shortest / fewest_texels, 1.0", "ewa"),
    "without a mix": ("return rgb_mix(color, ewa_on_level(m, fine + 1, uv, &e),",
                      "return rgb_mix(rgb_grey(0.5f), color,", "ewa"),
}  # fmt: skip


@pytest.mark.parametrize("mutant", MUTANTS)
def test_small_faults_are_found(workshop: Workshop, mutant: str, tmp_path: Path) -> None:
    old, new, group = MUTANTS[mutant]
    text = MODULE.read_text()
    assert text.count(old) == 1, f"{MODULE.name} no longer says {old!r} once"
    module = tmp_path / "mipmap.c"
    module.write_text(text.replace(old, new))
    assert workshop.failures(workshop.program(module), group)


# --- The oracles ------------------------------------------------------------------------------


@pytest.mark.parametrize("size, parts", [(1, 1), (2, 1), (5, 2), (7, 3), (257, 128), (6, 3)])
def test_shares_are_exact_lengths(size: int, parts: int) -> None:
    shares = _hidden("mipmap_cases").shares(size, parts)
    for k in range(parts):
        begin, end = Fraction(k * size, parts), Fraction((k + 1) * size, parts)
        for i in range(size):
            inside = max(Fraction(0), min(end, Fraction(i + 1)) - max(begin, Fraction(i)))
            assert shares[k, i] == pytest.approx(float(inside * parts / size), abs=1e-13)


def test_means_of_steps_keep_the_mean_of_the_image() -> None:
    cases = _hidden("mipmap_cases")
    image = np.random.default_rng(3).random((31, 50, 3))
    for level in cases.pyramid(image):
        assert level.mean(axis=(0, 1)) == pytest.approx(image.mean(axis=(0, 1)))


def test_levels_by_hand() -> None:
    oracle, cases = _oracle("level"), _hidden("mipmap_cases")
    m = cases.Mipmap("m", 0, cases.pyramid(np.zeros((8, 128, 3))))
    nan = np.array([np.nan, 0.0])
    for dx, dy, level in [
        ((0, 0), (0, 0), 0),
        ((1 / 128, 0), (0, 1 / 8), 0),
        ((4 / 128, 0), (0, 1 / 8), 2),
        ((0, 4 / 8), (1 / 128, 0), 2),
        ((3 / 128, 4 / 8), (0, 0), np.log2(5)),
        ((100, 0), (0, 0), 7),
    ]:
        assert oracle.level_of(m, np.array(dx), np.array(dy)) == pytest.approx(level)
    assert oracle.level_of(m, nan, np.array([2 / 128, 0])) == pytest.approx(1)


@pytest.mark.parametrize("wrap", range(4))
def test_bilinear_by_hand(wrap: int) -> None:
    cases = _hidden("mipmap_cases")
    row = np.repeat(np.array([[[1.0], [5.0]]]), 3, axis=2)
    m = cases.Mipmap("m", wrap, (row,))
    at = [cases.bilinear(m, 0, np.array([u, 0.5]))[0] for u in (0.25, 0.5, 1.25, -0.25)]
    assert at == pytest.approx([[1, 3, 1, 5], [1, 3, 5, 1], [1, 3, 5, 1], [1, 3, 0, 0]][wrap])


@pytest.mark.parametrize("rho", [0.05, 0.2, 0.4, 0.7, 1.0])
def test_the_bounds_hold_the_gaussian(rho: float) -> None:
    """exp(-2 q) without an end has the transform exp(-pi^2 rho^2 / 2)."""
    bell = _hidden("mipmap_bell")
    least, largest = bell.damping(rho, rho, 1e-6, 1.0)
    gaussian = np.exp(-(np.pi**2) * rho**2 / 2)
    assert least - 0.002 < gaussian < largest
    assert largest - least < 0.35


def test_the_exact_integral_is_accepted() -> None:
    """Not sums of texels but waves under the untruncated bell, by the closed form."""
    oracle, cases = _oracle("ewa"), _cases("ewa")
    output = np.zeros((cases.count, 3), "<f4")
    waves = []
    for i, lookup in enumerate(cases.context.lookups):
        m = cases.context.mipmaps[lookup.mipmap]
        if not m.name.endswith("waves"):
            continue
        waves.append(i)
        across, down = (float(word) for word in m.name.split()[0:3:2])
        steps = np.stack([lookup.uv_dx, lookup.uv_dy], axis=1) * m.size[:, None]
        axes, lengths, _ = np.linalg.svd(steps)
        lengths[1] = max(lengths[1], lengths[0] / lookup.max_anisotropy)
        k = np.array([across, down]) / m.size
        rho2 = float(np.sum((lengths * (axes.T @ k)) ** 2))
        wave = np.exp(2j * np.pi * (k @ (lookup.uv * m.size)) - np.pi**2 * rho2 / 2)
        output[i] = 0.5 + 0.5 * wave.real, 0.5 + 0.5 * wave.imag, 0.5
    wrong = {failure.case for failure in oracle.judge(cases, output.tobytes())}
    assert len(waves) > 2000 and not wrong & set(waves)


@pytest.mark.parametrize("group", PROBES)
def test_cases_depend_on_the_seed_alone(group: str) -> None:
    seven, again, eight = (_oracle(group).make_cases(group, s).payload for s in (7, 7, 8))
    assert seven == again != eight
    assert _cases(group).count >= (90 if group == "pyramid" else 3000)


# --- Words ------------------------------------------------------------------------------------


def test_failures_are_told_in_words(workshop: Workshop, tmp_path: Path) -> None:
    module = tmp_path / "mipmap.c"
    text = MODULE.read_text()
    module.write_text(text.replace("log2(fmax(longer, 1.0))", "floor(log2(fmax(longer, 1.0)))"))
    failures = workshop.failures(workshop.program(module), "trilinear")
    simplest = max(failures, key=lambda failure: failure.simplicity)
    assert "mipmap of " in simplest.message and "expected" in simplest.message
    module.write_text(text.replace("last->width > 1 ||", "last->width > 1 &&"))
    failures = workshop.failures(workshop.program(module), "pyramid")
    simplest = max(failures, key=lambda failure: failure.simplicity)
    assert simplest.message == (
        "pyramid over a ramp of 2 x 1 texels: expected 2 levels (the last one is 1 x 1), got 1"
    )
    assert simplest.fingerprint == "number of levels"


@pytest.mark.parametrize("group", PROBES)
@pytest.mark.parametrize("size", [0, 1, 4321])
def test_an_output_of_a_wrong_length_is_one_failure(group: str, size: int) -> None:
    failures = _oracle(group).judge(_cases(group), bytes(size))
    assert [failure.fingerprint for failure in failures] == ["output of a wrong length"]


@pytest.mark.parametrize("byte", [0x00, 0x7F, 0xFF])
@pytest.mark.parametrize("group", WORDS)
def test_any_bytes_are_judged(group: str, byte: int) -> None:
    cases = _cases(group)
    assert _oracle(group).judge(cases, bytes([byte]) * (4 * WORDS[group] * cases.count))


def test_the_driver_refuses_bad_files(workshop: Workshop, tmp_path: Path) -> None:
    driver = workshop.program(MODULE)
    short = tmp_path / "short.bin"
    short.write_bytes(bytes([1]) + bytes(9))
    out = str(tmp_path / "out.bin")
    for arguments, message in [
        ([], "usage: "),
        ([str(tmp_path / "none.bin"), out, "level"], "none.bin: cannot be opened"),
        ([str(short), out, "level"], "short.bin: ends inside a word"),
        ([str(short), str(tmp_path / "no" / "out.bin"), "level"], "out.bin: cannot be opened"),
    ]:
        done = subprocess.run([driver, *arguments], capture_output=True, text=True)
        assert done.returncode == 2
        assert message in done.stderr
