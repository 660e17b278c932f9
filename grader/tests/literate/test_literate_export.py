"""The student's text of a file: what it is, and that other tools agree."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest
from literate_project import DISC_C, DISC_C_REVEALED, DISC_C_STUDENT, write_project

from raybook_grader.literate.equivalence import preprocessor_differences, unifdef_difference
from raybook_grader.literate.export import ExportedFile, ExportedLine, export
from raybook_grader.literate.markers import parse
from raybook_grader.literate.tree import UnsoundSourceError, build_tree, load_tree


def student(text: str) -> str:
    return export(parse("src/a.c", text)).text


def test_golden() -> None:
    assert student(DISC_C) == DISC_C_STUDENT


def test_golden_with_the_solution_revealed() -> None:
    assert export(parse("src/a.c", DISC_C), {"disc_hit"}).text == DISC_C_REVEALED


def test_other_exercises_reveal_nothing() -> None:
    assert export(parse("src/a.c", DISC_C), {"mean_pair"}).text == DISC_C_STUDENT


def test_lines_know_their_origin() -> None:
    exported = export(parse("src/a.c", DISC_C))
    original = DISC_C.split("\n")
    for number, line in enumerate(exported.lines, 1):
        assert exported.origin(number) == line.origin
        if line.is_title:
            assert original[line.origin - 1].lstrip().startswith("//> ")
        else:
            assert original[line.origin - 1] == line.text


def test_span_of_a_piece() -> None:
    source = parse("src/a.c", DISC_C)
    exported = export(source)
    spans = {piece.slug: exported.span(piece) for piece in source.pieces()}
    lines = DISC_C_STUDENT.split("\n")
    assert spans["disc.helper"] is None and spans["disc.hit.point"] is None
    first, last = spans["disc.hit"] or (0, 0)
    assert lines[first - 1].startswith("bool disc_hit(") and lines[last - 1] == "}"


def test_lines_are_kept_to_the_byte() -> None:
    text = "a  \n  /* \u00e9 */\fb\n\n//> x: X\n c\\\n  d\n//< x\n"
    assert student(text) == "a  \n  /* \u00e9 */\fb\n\n c\\\n  d\n"


@pytest.mark.parametrize("title, comment", [("X", "X."), ("X.", "X."), ("X?", "X?")])
def test_nested_title_becomes_a_sentence(title: str, comment: str) -> None:
    text = f"//> x: Out\n  //> x.y: {title}\n  a\n  //< x.y\n//< x\n"
    assert student(text) == f"  /* {comment} */\n  a\n"


def test_title_over_nothing_vanishes() -> None:
    text = (
        "//> x: Out\na\n//> x.y: In\n#ifndef TODO_b\nh();\n#endif\n//< x.y\n"
        "#ifndef TODO_b\ns();\n#else\nt();\n#endif\n//< x\n"
    )
    assert student(text) == "a\nt();\n"


def test_blank_lines() -> None:
    text = "\n\n//> x: X\n\na\n\n//< x\n\n\n//> y: Y\n\n   \nb\n//< y\n\n"
    assert student(text) == "a\n\nb\n"


def test_other_conditionals_stay() -> None:
    text = "#if A\na\n#else\n#ifndef TODO_b\ns();\n#else\n#if C\nt();\n#endif\n#endif\n#endif\n"
    assert student(text) == "#if A\na\n#else\n#if C\nt();\n#endif\n#endif\n"


def test_unsound_source_is_refused() -> None:
    with pytest.raises(UnsoundSourceError, match=r"src/a\.c:1: fragment x"):
        student("//> x: X\n")


# What unifdef and gcc say.


def test_tools_agree_on_the_miniature_checkout(tmp_path: Path) -> None:
    tree = load_tree(write_project(tmp_path)).require_sound()
    assert tree.todos
    for source in tree.files.values():
        assert unifdef_difference(source, export(source)) is None
    assert preprocessor_differences(tree) == []


def change(exported: ExportedFile, old: str, new: str) -> ExportedFile:
    lines = tuple(
        ExportedLine(line.text.replace(old, new), line.origin, line.is_title)
        for line in exported.lines
    )
    assert lines != exported.lines
    return dataclasses.replace(exported, lines=lines)


def test_unifdef_finds_a_changed_line() -> None:
    source = parse("src/a.c", DISC_C)
    wrong = change(export(source), "return false;", "return true;")
    assert "unifdef gives '    return false;'" in (unifdef_difference(source, wrong) or "")


def test_unifdef_finds_a_solution_that_stayed() -> None:
    source = parse("src/a.c", DISC_C)
    assert unifdef_difference(source, export(source, {"disc_hit"})) is not None


def test_unifdef_finds_a_directive_that_only_looks_like_one() -> None:
    # A compiler sees no directive inside a comment; the parser, which knows no comments, does.
    text = "/*\n#ifndef TODO_a\ns();\n#else\nt();\n#endif\n*/\n"
    source = parse("src/a.c", text)
    assert unifdef_difference(source, export(source)) is not None


def test_preprocessor_finds_a_directive_that_only_looks_like_one() -> None:
    text = 'const char *s = "\\\n\\\n";\n/*\n#ifndef TODO_a\n*/s();\n#else\nt();\n#endif\n'
    differences = preprocessor_differences(build_tree(Path("."), {"src/a.c": text.encode()}))
    assert len(differences) == 1 and differences[0].startswith("src/a.c: gcc -E gives")


def test_preprocessor_ignores_that_lines_move() -> None:
    text = b"//> x: X\n//< x\nint a = __LINE__;\nconst char *b = __FILE__;\n"
    assert preprocessor_differences(build_tree(Path("."), {"src/a.c": text})) == []
