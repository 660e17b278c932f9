"""What the inside can see and touch."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from tiny_programs import Compile, RunC

from raybook_grader.sandbox import Box, BoxError

OPEN_ALL = """
for (int i = 1; i < argc; i++)
    printf("%s\\n", open(argv[i], O_RDONLY) < 0 ? strerror(errno) : "opened");
"""
WRITE_ALL = """
for (int i = 1; i < argc; i++)
    printf("%s\\n", open(argv[i], O_WRONLY | O_CREAT, 0600) < 0 ? strerror(errno) : "opened");
"""


@pytest.fixture
def host_tmp() -> Iterator[Path]:
    """A world-readable folder in the host's /tmp: only the box's walls can hide it."""
    folder = Path(tempfile.mkdtemp(dir="/tmp", prefix="sandbox-test-"))
    folder.chmod(0o755)
    yield folder
    shutil.rmtree(folder)


def test_host_files_are_out_of_sight(run_c: RunC, host_tmp: Path) -> None:
    secret = host_tmp / "secret"
    secret.write_text("42")
    places = ["/root", "/home", "/etc/shadow", "/etc/passwd", str(secret), __file__, "/var", "/sys"]
    result = run_c(OPEN_ALL, arguments=places)
    assert result.stdout.decode().splitlines() == ["No such file or directory"] * len(places)


def test_only_the_binds_asked_for(run_c: RunC, host_tmp: Path) -> None:
    (host_tmp / "given").mkdir()
    (host_tmp / "given" / "a.txt").write_text("a")
    (host_tmp / "kept").mkdir()
    result = run_c(
        OPEN_ALL,
        binds={"/work/given": host_tmp / "given"},
        arguments=["given/a.txt", "given/../kept", "/work/kept"],
    )
    missing = "No such file or directory"
    assert result.stdout.decode().splitlines() == ["opened", missing, missing]


def test_nothing_but_scratch_can_be_written(run_c: RunC, host_tmp: Path) -> None:
    host_tmp.chmod(0o777)
    (host_tmp / "open.txt").write_text("before")
    (host_tmp / "open.txt").chmod(0o666)
    places = ["/x", "/dev/x", "/usr/x", "/etc/x", "/supervisor", "/bound/open.txt", "/bound/new"]
    places += ["input.txt", "/proc/sys/kernel/hostname"]
    result = run_c(
        WRITE_ALL,
        arguments=[*places, "/work/x", "/tmp/x"],
        binds={"/bound": host_tmp},
        inputs={"input.txt": b"before"},
    )
    answers = result.stdout.decode().splitlines()
    assert answers[-2:] == ["opened", "opened"]
    refusals = {"Read-only file system", "Permission denied", "Text file busy"}
    assert set(answers[:-2]) <= refusals, answers
    assert (host_tmp / "open.txt").read_text() == "before"


def test_inputs_cannot_be_replaced(run_c: RunC) -> None:
    body = """
    printf("%d %d %d", unlink("scene.txt"), rename("scene.txt", "x"), unlink("in/b"));
    """
    result = run_c(
        body, inputs={"scene.txt": b"scene", "in/b": b"b"}, collect=["scene.txt", "in/b"]
    )
    assert result.stdout == b"-1 -1 -1"
    assert result.files == {"scene.txt": b"scene", "in/b": b"b"}


def test_no_network(run_c: RunC) -> None:
    body = """
    int families[] = {AF_INET, AF_INET6, AF_UNIX, AF_NETLINK};
    for (int i = 0; i < 4; i++)
        printf("%d ", socket(families[i], SOCK_STREAM, 0) == -1 && errno == EPERM);
    """
    assert run_c(body).stdout == b"1 1 1 1 "


def test_only_three_descriptors(run_c: RunC) -> None:
    leak = os.open("/etc/passwd", os.O_RDONLY)
    os.set_inheritable(leak, True)
    try:
        body = 'for (int i = 0; i < 4096; i++) if (fcntl(i, F_GETFD) >= 0) printf("%d ", i);'
        assert run_c(body).stdout == b"0 1 2 "
    finally:
        os.close(leak)


FORGE = """
struct iovec here = {"forged", 6}, there = {(void *)0x400000, 6};
char path[64]; int opened = 0;
for (int i = 3; i < 4096; i++) write(i, "forged", 6);
for (int pid = 1; pid < 64; pid++) for (int fd = 0; fd < 64; fd++) {
    if (pid == getpid()) continue;
    sprintf(path, "/proc/%d/fd/%d", pid, fd);
    int got = open(path, O_WRONLY);
    if (got >= 0) { opened++; write(got, "forged", 6); }
}
int got = open("/proc/1/mem", O_RDWR);
int vm = process_vm_writev(1, &here, 1, &there, 1, 0);
int attach = syscall(SYS_ptrace, 16, 1, 0, 0);
int pidfd = syscall(SYS_pidfd_open, 1, 0);
printf("%d %d %d %d %d", opened, got, vm, attach, pidfd);
return 7;
"""


def test_report_cannot_be_written(run_c: RunC) -> None:
    result = run_c(FORGE, collect=["out"])
    assert result.stdout == b"0 -1 -1 -1 -1"
    assert (result.outcome, result.exit_code) == ("exited", 7)
    assert result.file_errors == {"out": "missing"}


def test_environment_is_clean(run_c: RunC, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SECRET_TOKEN", "hush")
    body = "extern char **environ; for (char **e = environ; *e; e++) puts(*e);"
    body += 'system("cat /proc/1/environ");'
    result = run_c(body, env={"SEED": "5"})
    assert b"SEED=5" in result.stdout and b"PATH=/usr/bin:/bin" in result.stdout
    assert b"hush" not in result.stdout


def test_boxes_do_not_see_each_other(run_c: RunC, compile_c: Compile, box: Box) -> None:
    program = compile_c("""
    int main(int argc, char **argv) {
        int mine = open(argv[1], O_CREAT | O_EXCL, 0600);
        close(open("/tmp/everyone", O_CREAT | O_EXCL, 0600));
        close(open("/dev/shm/everyone", O_CREAT | O_EXCL, 0600));
        usleep(300000);
        execl("/bin/sh", "sh", "-c", "echo /proc/[0-9]* /work/* /tmp/*", NULL);
    }""")

    def run(name: str) -> list[str]:
        result = box.run(["/program", name], inputs={"/program": program})
        return result.stdout.decode().split()

    with ThreadPoolExecutor(4) as pool:
        seen = list(pool.map(run, "abcd"))
    for name, words in zip("abcd", seen, strict=True):
        assert words == ["/proc/1", "/proc/2", f"/work/{name}", "/tmp/everyone"]


def test_requests_that_make_no_sense(box: Box, host_tmp: Path) -> None:
    (host_tmp / "link").symlink_to("/etc")
    with pytest.raises(BoxError, match="empty"):
        box.run([])
    for place in ("relative", "/work/../x", "/proc/x", "/usr", "/dev/null", "/work"):
        with pytest.raises(BoxError, match="bad box path"):
            box.run(["/bin/true"], binds={place: host_tmp})
    for name in ("../x", "/etc/passwd", "a//b", ""):
        with pytest.raises(BoxError, match="cannot collect"):
            box.run(["/bin/true"], collect=[name])
    for host in (host_tmp / "link", host_tmp / "absent", Path("/dev/null")):
        with pytest.raises(BoxError, match="cannot bind"):
            box.run(["/bin/true"], binds={"/x": host})
