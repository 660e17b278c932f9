"""The rules of the house for the C code: layers, sizes, guards. Each is read from the sources."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from renderer_runs import ROOT, SOURCE

# A folder includes from lower layers and from itself, not sideways.
LAYERS = {
    "base": 0,
    "image": 1,
    "sampling": 1,
    "shapes": 2,
    "textures": 2,
    "accel": 3,
    "materials": 3,
    "lights": 3,
    "scene": 4,
    "camera": 5,
    "integrators": 6,
    "program": 7,
}
MAIN = 8  # main.c stands above all folders

LONGEST_FILE = 400
LONGEST_OF = {"scene/obj_reader.c": 520}
LONGEST_TEST = 650
LONGEST_FUNCTION = 60
COLUMNS = 80

HEADERS = sorted(SOURCE.rglob("*.h"))
MODULES = sorted(path for path in SOURCE.rglob("*.c") if not path.name.startswith("test_"))
TESTS = sorted(SOURCE.rglob("test_*.c"))
C_FILES = sorted([*HEADERS, *MODULES, *TESTS])


def short(path: Path) -> str:
    return path.relative_to(SOURCE).as_posix()


def layer(path: str) -> int:
    folder = path.rpartition("/")[0]
    return LAYERS[folder] if folder else MAIN


def includes(path: Path) -> Iterator[tuple[int, str]]:
    """Line number and target of every include of a file of ours."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if found := re.match(r'\s*#\s*include\s*"([^"]*)"', line):
            yield number, found[1]


def test_every_folder_has_its_layer() -> None:
    folders = {short(path).rpartition("/")[0] for path in C_FILES}
    assert folders - {""} <= LAYERS.keys(), "a new folder: give it a layer, here and in the book"
    assert {short(path) for path in C_FILES if "/" not in short(path)} == {"main.c"}


def test_includes_point_down() -> None:
    wrong = []
    for path in C_FILES:
        own, folder = layer(short(path)), short(path).rpartition("/")[0]
        for number, target in includes(path):
            if target == "unity.h" and path in TESTS:
                continue
            if target.rpartition("/")[0] != folder and layer(target) >= own:
                wrong.append(f"src/{short(path)}:{number}: {target} is not in a lower layer")
    assert not wrong, "\n".join(wrong)


def test_includes_name_the_path_from_src() -> None:
    wrong = [
        f"src/{short(path)}:{number}: {target}"
        for path in C_FILES
        for number, target in includes(path)
        if target != "unity.h" and not (SOURCE / target).is_file()
    ]
    assert not wrong, "\n".join(wrong)


def test_a_module_includes_its_own_header_first() -> None:
    """So that each header is proven to need nothing before it."""
    for path in MODULES:
        if path.with_suffix(".h").is_file():
            first = next(includes(path), (0, ""))
            assert first[1] == short(path.with_suffix(".h")), short(path)


def test_headers_are_guarded_by_their_path() -> None:
    for path in HEADERS:
        guard = "RAYBOOK_" + re.sub(r"[/.]", "_", short(path)).upper()
        text = path.read_text()
        assert f"#ifndef {guard}\n#define {guard}\n" in text, short(path)
        assert text.endswith("\n#endif\n"), short(path)


def test_every_file_says_what_it_is() -> None:
    for path in C_FILES:
        assert path.read_text().startswith(f"/* {path.name} - "), short(path)


def test_no_file_is_long() -> None:
    lengths = {short(path): len(path.read_text().splitlines()) for path in [*HEADERS, *MODULES]}
    limits = {
        name: LONGEST_TEST if "/test_" in name else LONGEST_OF.get(name, LONGEST_FILE)
        for name in lengths
    }
    long = {name: lines for name, lines in lengths.items() if lines > limits[name]}
    assert not long, f"a file is one concept: {long}"


def test_no_line_is_wide() -> None:
    wide = [
        f"{path.relative_to(ROOT)}:{number}"
        for path in [*C_FILES, *sorted((ROOT / "assignments").rglob("test_*.c"))]
        for number, line in enumerate(path.read_text().splitlines(), 1)
        if len(line) > COLUMNS
    ]
    assert not wide, wide


def functions(path: Path) -> Iterator[tuple[str, int]]:
    """Name and number of lines of every function that the file defines: in the house style it
    begins with a brace in column 1 and ends with one."""
    lines = path.read_text().splitlines()
    start = None
    for number, line in enumerate(lines):
        if line == "{":
            start = number
        elif line == "}" and start is not None:
            head = " ".join(lines[max(0, start - 4) : start])
            name = re.findall(r"(\w+)\s*\(", head)
            yield (name[-1] if name else "?"), number - start + 1
            start = None


def test_no_function_is_long() -> None:
    found = [(name, short(path), size) for path in MODULES for name, size in functions(path)]
    assert len(found) > 200, "the scan finds the functions"
    long = [one for one in found if one[2] > LONGEST_FUNCTION]
    assert not long, long
    sizes = sorted(size for _, _, size in found)
    assert sizes[len(sizes) // 2] <= 12, "most functions are about ten lines"
    assert sizes[len(sizes) * 9 // 10] <= 30


def test_no_tabs_and_no_blanks_at_the_end_of_a_line() -> None:
    for path in C_FILES:
        assert not re.search(r"\t|[ \t]$", path.read_text(), re.MULTILINE), short(path)


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_every_header_compiles_alone(compiler: str) -> None:
    """In C99, included twice, without anything before it."""
    text = "".join(f'#include "{short(path)}"\n' * 2 for path in HEADERS)
    options = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-Isrc", "-fsyntax-only"]
    for order in (text, "".join(reversed(text.splitlines(keepends=True)))):
        subprocess.run(
            [compiler, *options, "-xc", "-"], cwd=ROOT, input=order, text=True, check=True
        )
