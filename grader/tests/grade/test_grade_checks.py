"""The small parts of the checks that need no box."""

from __future__ import annotations

import json
import time
from pathlib import Path

import pytest
from make_class import CHECKOUT, OWNED, solution

from raybook_grader.checks.program import HarnessFault
from raybook_grader.checks.result import Status
from raybook_grader.checks.scene import scene_files, scene_fingerprint
from raybook_grader.checks.stub import is_stub, stub_text
from raybook_grader.checks.trouble import trouble
from raybook_grader.checks.words import clean
from raybook_grader.sandbox import BoxResult


def test_a_stub_is_known_by_what_it_says() -> None:
    stub = stub_text(CHECKOUT, OWNED)
    reworded = stub.replace("    ", "\t").replace("\n", "\r\n") + "// my name\n"
    assert is_stub(stub.encode(), stub)
    assert is_stub(reworded.encode(), stub)
    assert not is_stub(solution().encode(), stub), "both branches are there; the first one counts"
    assert not is_stub(stub.replace("return false", "return true", 1).encode(), stub)
    assert not is_stub(b"", stub)


def test_comments_in_strings_are_none() -> None:
    assert not is_stub(b'char *s = "/* a */";', 'char *s = "/* b */";')
    assert is_stub(b'char *s = "//"; /* a */', 'char *s = "//";')


@pytest.mark.parametrize("text", [b"/*", b'"\\', b'"\\"', b"'", b"/*/", b"//\\\n"])
def test_no_text_makes_the_comparison_slow(text: bytes) -> None:
    begin = time.process_time()
    is_stub(text * (1_000_000 // len(text)), "int a;")
    # Quadratic time would be many minutes.
    assert time.process_time() - begin < 20


def test_words_are_cleaned() -> None:
    hostile = b"\x1b[31mred\x1b[0m \x1b]0;title\x07a\x00b\xff\xe2\x80\xaec\r\nnext\ttab"
    assert clean(hostile) == "red a\ufffdb\ufffd\ufffdc\nnext    tab"
    assert len(clean(b"x" * 10_000_000)) < 1000
    assert clean(b"line\n" * 1000).count("\n") <= 60


@pytest.mark.parametrize(
    ("result", "status"),
    [
        (BoxResult("exited", exit_code=1), None),
        (BoxResult("signaled", signal=11), Status.CRASH),
        (BoxResult("signaled", signal=11, max_rss_bytes=950), Status.MEMORY),
        (BoxResult("exited", exit_code=1, max_rss_bytes=950), Status.MEMORY),
        (BoxResult("exited", exit_code=0, max_rss_bytes=950), None),
        (BoxResult("signaled", signal=31), Status.FORBIDDEN),
        (BoxResult("timeout", "no answer after 2 s"), Status.TIMEOUT),
        (BoxResult("memory", "used more than 1 GiB of memory"), Status.MEMORY),
        (BoxResult("output-flood", "printed more than 1 MiB"), Status.FORBIDDEN),
    ],
)
def test_ends_of_programs(result: BoxResult, status: Status | None) -> None:
    found = trouble(result, 1000)
    assert (found and found.status) is status


def test_a_lost_box_is_the_harness_s_fault() -> None:
    with pytest.raises(HarnessFault):
        trouble(BoxResult("lost", "?"), 1000)


def test_a_scene_is_all_its_files(tmp_path: Path) -> None:
    (tmp_path / "scenes").mkdir()
    (tmp_path / "build").mkdir()
    scene = {"objects": [{"path": "../build/a.obj"}, {"path": "../../../etc/passwd"}], "n": "x"}
    (tmp_path / "scenes" / "a.json").write_text(json.dumps(scene))
    (tmp_path / "build" / "a.obj").write_text("v 0 0 0")
    assert scene_files(tmp_path, "scenes/a.json") == ("build/a.obj", "scenes/a.json")
    before = scene_fingerprint(tmp_path, "scenes/a.json")
    (tmp_path / "build" / "a.obj").write_text("v 0 0 1")
    scene_fingerprint.cache_clear()
    assert scene_fingerprint(tmp_path, "scenes/a.json") != before
