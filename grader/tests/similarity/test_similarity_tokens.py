"""What a copy is made different by, and what it is not."""

from __future__ import annotations

import pytest

from raybook_grader.similarity.document import readable
from raybook_grader.similarity.tokens import tokenize

CODE = """\
/* The area. */
#include "base/vec3.h"
static float area(const struct mesh *m, int i) {
    float sum = 0.5f * length(m->edge[i]); // half
    return sum < 1e-3f ? 0 : sum;
}
"""

SAME = [
    CODE.replace("sum", "total").replace("area", "a2"),
    CODE.replace("/* The area. */", "// nothing\n\n/* else */"),
    CODE.replace("    ", "\t").replace(" {\n", "\n{\n"),
    CODE.replace("static ", "").replace("const ", ""),
    CODE.replace("float", "double"),
    CODE.replace("0.5f", "0x1.0p-1f"),
    CODE.replace("m->edge", "(*m).edge").replace("(*m)", "m"),
    CODE.replace('#include "base/vec3.h"\n', ""),
]


@pytest.mark.parametrize("text", SAME)
def test_names_comments_layout_and_types_do_not_count(text: str) -> None:
    assert text != CODE
    assert tokenize(text).symbols == tokenize(CODE).symbols


@pytest.mark.parametrize(
    "old, new", [("<", ">"), ("return", "break"), ("0.5f *", ""), ("? 0 : sum", ""), ("(", "[")]
)
def test_what_the_code_does_counts(old: str, new: str) -> None:
    assert tokenize(CODE.replace(old, new, 1)).symbols != tokenize(CODE).symbols


def test_each_symbol_knows_its_place() -> None:
    tokens = tokenize(CODE)
    words = [CODE[start:end] for start, end in tokens.spans]
    assert len(tokens.symbols) == len(words)
    assert words[:5] == ["float", "area", "(", "struct", "mesh"]
    assert "->" in words and "half" not in words


def test_macros_are_code_and_other_directives_are_not() -> None:
    assert tokenize("#define F(x) (x + 1)\n").symbols == "#vv(v)(v+n)"
    assert tokenize("#  ifdef A\n#else \\\n more\n#endif\n#pragma omp x").symbols == ""


@pytest.mark.parametrize("unit", ["/*", '"', "'", "#", "//", "\\", "->", "1e+", "_", "\u0660"])
def test_no_text_is_slow(unit: str) -> None:
    """Were it quadratic, this would take minutes."""
    text = unit * (200_000 // len(unit))
    tokens = tokenize(text)
    assert all(0 <= start < end <= len(text) for start, end in tokens.spans)


def test_nothing_hides_in_the_report() -> None:
    assert readable(b"a\xff\x00\x1b[2Jb\r\nc\td\re") == "a\ufffd\ufffd\ufffd[2Jb\nc\td\ne"
    assert readable("int \u202e x\u200b;".encode()) == "int \ufffd x\ufffd;"
