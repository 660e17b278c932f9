"""Collecting files that the command may have replaced by anything."""

from __future__ import annotations

from dataclasses import replace

from tiny_programs import QUICK, RunC

from raybook_grader.sandbox import BoxResult
from raybook_grader.sandbox.report import parse_report


def test_files_come_back_whole(run_c: RunC) -> None:
    body = """
    mkdir("out", 0700); mkdir("out/deep", 0700);
    FILE *f = fopen("out/deep/image", "wb");
    for (int i = 0; i < 1000000; i++) fputc(i % 251, f);
    fclose(f);
    fclose(fopen("empty", "wb"));
    """
    result = run_c(body, collect=["out/deep/image", "empty"])
    expected = bytes(i % 251 for i in range(1_000_000))
    assert result.files == {"out/deep/image": expected, "empty": b""}


def test_files_come_back_after_a_crash_and_a_timeout(run_c: RunC) -> None:
    body = 'int fd = open("a", O_CREAT | O_WRONLY, 0600); write(fd, "half", 4);'
    assert run_c(body + "abort();", collect=["a"]).files == {"a": b"half"}
    limits = replace(QUICK, wall_seconds=0.3)
    assert run_c(body + "pause();", collect=["a"], limits=limits).files == {"a": b"half"}


def test_imposters_are_refused(run_c: RunC) -> None:
    body = """
    symlink("/etc/passwd", "link"); symlink("/dev/zero", "zero"); symlink("real", "inner");
    mkfifo("fifo", 0600); mkdir("folder", 0700);
    symlink("/usr", "usr"); symlink("folder", "alias");
    close(open("real", O_CREAT | O_WRONLY, 0600));
    close(open("folder/file", O_CREAT | O_WRONLY, 0600));
    close(open("locked", O_CREAT | O_WRONLY, 0));
    """
    bad = ["link", "zero", "inner", "fifo", "folder", "usr/bin/gcc", "alias/file", "real/x"]
    result = run_c(body, collect=[*bad, "locked", "absent", "absent/x", "real", "folder/file"])
    expected = dict.fromkeys(bad, "not a regular file")
    expected |= {"locked": "unreadable", "absent": "missing", "absent/x": "missing"}
    assert result.file_errors == expected
    assert result.files == {"real": b"", "folder/file": b""}


def test_too_large_a_file(run_c: RunC) -> None:
    body = """
    close(open("fits", O_CREAT | O_WRONLY, 0600)); truncate("fits", 1 << 20);
    for (int i = 0; i < 2; i++) {
        int fd = open("grown", O_CREAT | O_WRONLY, 0600);
        printf("%d", ftruncate(fd, (1 << 20) + 1));
    }
    """
    limits = replace(QUICK, file_bytes=1 << 20)
    result = run_c("signal(SIGXFSZ, SIG_IGN);" + body, collect=["fits", "grown"], limits=limits)
    assert result.stdout == b"-1-1"
    assert result.files == {"fits": bytes(1 << 20), "grown": b""}


def test_a_long_name_does_no_harm(run_c: RunC) -> None:
    name = "x" * 300
    assert run_c("return 0;", collect=[f"{name}/a", name]).file_errors == {
        f"{name}/a": "unreadable",
        name: "unreadable",
    }


def frame(data: bytes) -> bytes:
    return len(data).to_bytes(8, "little") + data


WHOLE = b"".join(map(frame, (b"exited 0 1 2 3", b"ok", b"data", b"missing", b"end")))


def test_a_whole_report() -> None:
    report = parse_report(WHOLE, ["a", "b"])
    assert report is not None
    assert (report.files, report.file_errors) == ({"a": b"data"}, {"b": "missing"})


def test_every_cut_of_a_report_is_worthless() -> None:
    for size in range(len(WHOLE)):
        assert parse_report(WHOLE[:size], ["a", "b"]) is None
    assert parse_report(WHOLE, ["a"]) is None
    assert parse_report(WHOLE, ["a", "b", "c"]) is None


def test_description_holds_no_text_of_the_command() -> None:
    result = BoxResult("exited", exit_code=1, stdout=b"PASS", stderr=b"PASS")
    assert result.describe() == "ended with exit code 1"
