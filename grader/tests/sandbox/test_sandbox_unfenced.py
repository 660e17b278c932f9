"""What remains without a sandbox: the same results for the same ends, and limits."""

from __future__ import annotations

import pytest
from tiny_programs import QUICK, Compile

from raybook_grader.sandbox import BoxResult, make_box
from raybook_grader.sandbox.unfenced import UnfencedBox


@pytest.fixture(scope="module")
def unfenced() -> UnfencedBox:
    made = make_box(unsafe=True)
    assert isinstance(made, UnfencedBox)
    return made


def run(box: UnfencedBox, program: bytes, *arguments: str) -> BoxResult:
    return box.run(
        ["/program", *arguments],
        inputs={"/program": program, "in.txt": b"given"},
        collect=["out.txt", "link"],
        limits=QUICK,
        env={"MARK": "set"},
        stdin=b"typed",
    )


def test_inputs_outputs_and_words(unfenced: UnfencedBox, compile_c: Compile) -> None:
    body = """
    int main(int argc, char **argv) {
        char text[99] = "", typed[99] = "";
        fread(text, 1, 98, fopen("in.txt", "r"));
        fread(typed, 1, 98, stdin);
        FILE *out = fopen("out.txt", "w");
        fprintf(out, "%s %s %s %s", text, typed, argv[1], getenv("MARK"));
        symlink("/etc/passwd", "link");
        fputs("said", stderr);
        return 3;
    }"""
    result = run(unfenced, compile_c(body), "/elsewhere")
    assert (result.outcome, result.exit_code, result.stderr) == ("exited", 3, b"said")
    assert result.files == {"out.txt": b"given typed /elsewhere set"}
    assert result.file_errors == {"link": "not a regular file"}


@pytest.mark.parametrize(
    ("body", "outcome"),
    [
        ("abort();", "signaled"),
        ("for (;;) puts(\"flood\");", "output-flood"),
        ("return malloc(1L << 30) == NULL ? 0 : 1;", "exited"),
        ("int fd = open(\"big\", O_WRONLY | O_CREAT, 0644); return ftruncate(fd, 1L << 40);",
         "signaled"),
        ("return getuid() == 0;", "exited"),
    ],
)  # fmt: skip
def test_ends_and_limits(
    unfenced: UnfencedBox, compile_c: Compile, body: str, outcome: str
) -> None:
    result = run(unfenced, compile_c(f"int main(void) {{ {body} }}"))
    assert result.outcome == outcome
    assert result.exit_code == (0 if outcome == "exited" else None)


def test_what_never_ends_is_ended_with_its_children(
    unfenced: UnfencedBox, compile_c: Compile
) -> None:
    program = compile_c("int main(void) { fork(); for (;;) pause(); }")
    result = unfenced.run(
        ["/program"], inputs={"/program": program}, limits=type(QUICK)(wall_seconds=1)
    )
    assert result.outcome == "timeout"
