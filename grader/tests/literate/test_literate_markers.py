"""The grammar of the markers: each rule has a text that breaks it, with the line to blame."""

from __future__ import annotations

import dataclasses

import pytest
from literate_project import DISC_C

from raybook_grader.literate.markers import parse
from raybook_grader.literate.pieces import Line, Role

STUB = "#else\n    stub();\n#endif\n"

# name of the rule: (text, the violations as "line: start of the message")
BROKEN = {
    "never closed": ("a\n//> x: X\nb\n", ["2: fragment x (opened at line 2) is never closed"]),
    "closes nothing": ("a\n//< x\n", ["2: //< x closes nothing"]),
    "closed out of order": (
        "//> x: X\n//> y: Y\na\n//< x\n//< y\n",
        ["4: //< x closes it while fragment y (opened at line 2) is open"],
    ),
    "nested in itself": (
        "//> x: X\n//>+ x\na\n//< x\n//< x\n",
        ["2: fragment x is nested in itself"],
    ),
    "no title": ("//> x\na\n//< x\n", ["1: fragment x has no title"]),
    "empty title": ("//> x:  \na\n//< x\n", ["1: fragment x has no title"]),
    "title ends a comment": ("//> x: a */ b\n//< x\n", ["1: the title of x holds a comment"]),
    "capital in a slug": ("\n//> X: a\n", ["2: malformed marker: expected '//> slug: Title'"]),
    "space in a slug": ("//> x y: a\n", ["1: malformed marker"]),
    "empty part of a slug": ("//> x..y: a\n", ["1: malformed marker"]),
    "no space": ("//>x: a\n", ["1: malformed marker"]),
    "space inside the marker": ("// > x: a\n", ["1: malformed marker"]),
    "continuation with a title": ("//>+ x: a\n", ["1: malformed marker"]),
    "close with a title": ("//> x: a\n//< x: a\n//< x\n", ["2: malformed marker"]),
    "after code": ("a; //> x: X\n", ["1: a marker must stand alone on its line"]),
    "after code, close": ("//> x: X\na; //< x\n//< x\n", ["2: a marker must stand alone"]),
    "in a macro": (
        "#define A \\\n//> x: X\n    b\n//< x\n",
        ["2: marker inside a line continued with a backslash"],
    ),
    "fragment ends in a solution": (
        "//> x: X\n#ifndef TODO_a\ns();\n//< x\n" + STUB,
        ["4: fragment x straddles #ifndef TODO_a (opened at line 2)"],
    ),
    "fragment starts in a solution": (
        "#ifndef TODO_a\n//> x: X\ns();\n" + STUB + "//< x\n",
        [
            "4: fragment x (opened at line 2) straddles an #else",
            "6: fragment x (opened at line 2) straddles an #endif",
        ],
    ),
    "fragment starts in a stub": (
        "#ifndef TODO_a\ns();\n#else\n//> x: X\nt();\n#endif\n//< x\n",
        ["6: fragment x (opened at line 4) straddles an #endif"],
    ),
    "fragment straddles another #else": (
        "#if A\n//> x: X\n#else\n//< x\n#endif\n",
        ["3: fragment x (opened at line 2) straddles an #else"],
    ),
    "fragment ends in another #if": (
        "//> x: X\n#if A\n//< x\n#endif\n",
        ["3: fragment x straddles #if (opened at line 2)"],
    ),
    "nested TODO": (
        "#ifndef TODO_a\n#ifndef TODO_b\ns();\n" + STUB + STUB,
        ["2: TODO_b is nested in TODO_a"],
    ),
    "nested TODO in an #if": (
        "#ifndef TODO_a\ns();\n#else\n#if A\n#ifndef TODO_b\nt();\n" + STUB + "#endif\n#endif\n",
        ["5: TODO_b is nested in TODO_a"],
    ),
    "two stubs": (
        "#ifndef TODO_a\ns();\n" + STUB + "#ifndef TODO_a\nt();\n" + STUB,
        ["6: TODO_a already has its stub at line 3"],
    ),
    "no stub": ("#ifndef TODO_a\ns();\n#endif\n", ["3: TODO_a has no stub"]),
    "empty stub": ("#ifndef TODO_a\ns();\n#else\n\n#endif\n", ["5: TODO_a has an empty stub"]),
    "second #else": ("#ifndef TODO_a\ns();\n#else\nt();\n" + STUB, ["5: second #else"]),
    "#elif": (
        "#ifndef TODO_a\ns();\n#elif B\nt();\n" + STUB,
        ["3: #elif in TODO_a: it has #else and nothing more"],
    ),
    "TODO never closed": (
        "#ifndef TODO_a\ns();\n#else\nt();\n",
        ["1: #ifndef TODO_a (opened at line 1) is never closed"],
    ),
    "TODO in an #ifdef": ("#ifdef TODO_a\n#endif\n", ["1: TODO_a stands only alone in an"]),
    "TODO in an #if": ("#if !defined(TODO_a)\n#endif\n", ["1: TODO_a stands only alone in an"]),
    "TODO defined": ("#define TODO_a 1\n", ["1: TODO_a stands only alone in an"]),
    "TODO with a comment": ("#ifndef TODO_a // b\n#endif\n", ["1: TODO_a stands only alone in"]),
    "#endif without #if": ("a\n#endif\n", ["2: #endif without an #if"]),
    "#if never closed": ("#if A\n", ["1: #if (opened at line 1) is never closed"]),
    "tab": ("a\n\tb\n", ["2: tab character"]),
    "tab in a marker": ("//> x:\tX\n//< x\n", ["1: tab character"]),
    "carriage return": ("a\nb\r\n", ["2: carriage return"]),
    "every one": (
        "\ta\n//> x\n//< y\n",
        ["1: tab", "2: fragment x has", "2: fragment x (op", "3:"],
    ),
}


@pytest.mark.parametrize("rule", BROKEN)
def test_violation_names_the_line(rule: str) -> None:
    text, expected = BROKEN[rule]
    found = [str(violation) for violation in parse("src/f.c", text).violations]
    assert len(found) == len(expected), found
    for message, start in zip(sorted(found), sorted(expected), strict=True):
        assert message.startswith(f"src/f.c:{start}"), found


SOUND = {
    "macros that begin with TODO": "#define TODO_WARN(x) x\n#ifndef TODO_H\n#endif\n",
    "comparison in a comment": "a; // >= 0\nb; // < 0\n",
    "conditionals in both branches": (
        "#ifndef TODO_a\n#if A\n#elif B\n#else\n#endif\ns();\n"
        "#else\n#ifdef C\nt();\n#endif\n#endif\n"
    ),
    "directive with a comment": "#ifndef TODO_a\ns();\n#else  /* stub */\nt();\n#endif // a\n",
    "deep indentation": "        //> x: X\n  #  ifndef TODO_a\ns();\n" + STUB + "   //< x\n",
    "helpers without a stub": "#ifndef TODO_a\nh();\n#endif\n#ifndef TODO_a\ns();\n" + STUB,
    "#else as a continued line": "#define A \\\n#else\n",
    "empty file": "",
}


@pytest.mark.parametrize("case", SOUND)
def test_sound(case: str) -> None:
    assert parse("src/f.c", SOUND[case]).violations == ()


def test_pieces() -> None:
    source = parse("src/shapes/disc.c", DISC_C)
    pieces = {piece.slug: piece for piece in source.pieces()}
    assert list(pieces) == [
        "disc.helper", "disc.hit", "disc.hit.plane", "disc.hit.point", "disc.hit.stub", "disc.area",
    ]  # fmt: skip
    point = pieces["disc.hit.point"]
    lines = DISC_C.split("\n")
    assert lines[point.first - 1].strip() == "//> disc.hit.point: Is the point inside?"
    assert lines[point.last - 1].strip() == "//< disc.hit.point"
    assert (point.file, point.title) == ("src/shapes/disc.c", "Is the point inside?")
    assert (point.role, point.todo) == (Role.SOLUTION, "disc_hit")
    assert point.parent is pieces["disc.hit.plane"]
    assert pieces["disc.hit.stub"].role is Role.STUB
    assert pieces["disc.hit"].is_top_level and not point.is_top_level
    assert pieces["disc.hit"].parent is source.root


def test_every_line_of_code_is_in_one_piece() -> None:
    source = parse("src/shapes/disc.c", DISC_C)
    numbers = [line.number for line in source.lines()]
    assert numbers == sorted(set(numbers))
    dropped = {n for n in range(1, len(source.text) + 1)} - set(numbers)
    for number in dropped:
        text = source.text[number - 1].strip()
        assert text.startswith(("//>", "//<", "#ifndef TODO_", "#else", "#endif"))
    for line in source.lines():
        assert source.text[line.number - 1] == line.text


def test_roles_of_lines() -> None:
    source = parse("src/shapes/disc.c", DISC_C)
    roles = {line.text.strip(): (line.role, line.todo) for line in source.lines()}
    assert roles["return x * x + y * y <= radius * radius;"] == (Role.SOLUTION, "disc_hit")
    assert roles["(void)d, (void)r, (void)t;"] == (Role.STUB, "disc_hit")
    assert roles["assert(d->radius > 0.0f);"] == (Role.CODE, None)


def test_regions() -> None:
    helper, place = parse("src/shapes/disc.c", DISC_C).regions
    lines = DISC_C.split("\n")
    assert helper.middle is None and place.middle is not None
    assert lines[place.ifndef - 1] == "#ifndef TODO_disc_hit"
    assert lines[place.middle - 1] == "#else"
    assert lines[place.endif - 1] == "#endif"
    assert place.piece.slug == "disc.hit.plane"


def test_form_feed_ends_no_line() -> None:
    assert [line.text for line in parse("f.c", "a\fb\nc\n").lines()] == ["a\fb", "c"]


def test_pieces_are_immutable() -> None:
    source = parse("f.c", "//> x: X\na\n//< x\n")
    (piece,) = source.pieces()
    with pytest.raises(dataclasses.FrozenInstanceError):
        piece.slug = "y"  # type: ignore[misc]
    assert source.items(piece) == (Line(2, "a"),)
