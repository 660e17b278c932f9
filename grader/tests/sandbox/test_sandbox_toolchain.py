"""Ordinary work goes on as if there were no box."""

from __future__ import annotations

import platform
import re
import struct
import subprocess
from dataclasses import replace

import pytest
from tiny_programs import QUICK, RunC

from raybook_grader.sandbox import Box, Limits, SandboxUnavailable
from raybook_grader.sandbox.seccomp import filter_program
from raybook_grader.sandbox.syscalls import (
    CLONE,
    CLONE3,
    IOCTL,
    PRLIMIT64,
    REFUSED,
    SCHED_SETAFFINITY,
)

SOURCE = b"#include <math.h>\n#include <stdio.h>\n" + (
    b'int main(void) { printf("%.3f", sqrt(2.0)); return 0; }\n'
)


def test_compile_link_and_run(box: Box) -> None:
    limits = Limits(wall_seconds=30)
    flags = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
    compiled = box.run(
        ["gcc", *flags, "-c", "./a.c", "-o", "a.o"],
        inputs={"a.c": SOURCE},
        collect=["a.o"],
        limits=limits,
    )
    assert compiled.ok, compiled.stderr
    linked = box.run(
        ["gcc", "./a.o", "-lm", "-o", "a"],
        inputs={"a.o": compiled.files["a.o"]},
        collect=["a"],
        limits=limits,
    )
    assert linked.ok, linked.stderr
    assert box.run(["/work/a"], inputs={"a": linked.files["a"]}).stdout == b"1.414"


def test_compile_errors_are_quoted(box: Box) -> None:
    result = box.run(
        ["gcc", "-c", "./a.c"],
        inputs={"a.c": b"int f(void) { return x; }"},
        collect=["a.o"],
    )
    assert (result.outcome, result.exit_code) == ("exited", 1)
    assert b"./a.c:1:" in result.stderr
    assert result.file_errors == {"a.o": "missing"}


@pytest.mark.parametrize("path", ["/etc/shadow", "/root/.profile", "/dev/stdin"])
def test_the_compiler_sees_no_more(box: Box, path: str) -> None:
    result = box.run(["gcc", "-E", "./a.c"], inputs={"a.c": f'#include "{path}"\n'.encode()})
    text = result.stdout.replace(b"./a.c", b"")
    assert b"root:" not in text
    assert result.exit_code == 1 or path == "/dev/stdin"


def test_an_endless_header_is_contained(box: Box) -> None:
    limits = replace(QUICK, wall_seconds=3)
    result = box.run(["gcc", "-c", "./a.c"], inputs={"a.c": b'#include "/dev/zero"'}, limits=limits)
    assert not result.ok
    assert result.outcome != "lost"


def test_threads(run_c: RunC) -> None:
    before = "#include <omp.h>"
    body = """
    int sum = 0, most = 0;
    #pragma omp parallel for reduction(+ : sum) reduction(max : most)
    for (int i = 0; i < 1000; i++) { sum += i; most = omp_get_num_threads(); }
    printf("%d %d", sum, most);
    """
    result = run_c(body, before=before, flags=["-fopenmp"], env={"OMP_NUM_THREADS": "4"})
    assert result.stdout == b"499500 4", result


def test_address_sanitizer(run_c: RunC) -> None:
    body = "char *p = malloc(4); return p[argc + 3];"
    env = {"ASAN_OPTIONS": "detect_leaks=0"}  # the leak checker needs ptrace
    limits = replace(QUICK, address_space=False)
    result = run_c(body, flags=["-fsanitize=address,undefined"], env=env, limits=limits)
    assert b"heap-buffer-overflow" in result.stderr, result


def test_refused_calls_fail_with_eperm(run_c: RunC) -> None:
    numbers = ", ".join(str(row[0]) for row in REFUSED.values())
    body = f"""
    int numbers[] = {{{numbers}}};
    for (unsigned i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (syscall(numbers[i], 0, 0, 0, 0, 0, 0) != -1 || errno != EPERM)
            printf("%d ", numbers[i]);
    #define FAILS(call, why) (errno = 0, (call) == -1 && errno == why)
    printf("clone3 %d ", FAILS(syscall(SYS_clone3, 0, 0), ENOSYS));
    printf("new %d ", FAILS(syscall(1000, 0), ENOSYS));
    printf("clone %d ", FAILS(syscall(SYS_clone, 0x10000000 | SIGCHLD, 0, 0, 0, 0), EPERM));
    printf("tty %d ", FAILS(syscall(SYS_ioctl, 0, 0x5412, "x"), EPERM));
    """
    if platform.machine() != "x86_64":
        pytest.skip("the numbers are of x86_64")
    assert run_c(body).stdout == b"clone3 1 new 1 clone 1 tty 1 "


def test_calls_of_32_bits_are_fatal(run_c: RunC) -> None:
    if platform.machine() != "x86_64":
        pytest.skip("x86_64 only")
    result = run_c('int r; __asm__ volatile("int $0x80" : "=a"(r) : "a"(20)); return 0;')
    # SIGSYS from the filter; SIGSEGV from a kernel without these calls
    assert result.outcome == "signaled" and result.signal in (31, 11)


@pytest.mark.parametrize(("header", "column"), [("asm/unistd.h", 0), ("asm-generic/unistd.h", 1)])
def test_call_numbers_agree_with_the_system_headers(header: str, column: int) -> None:
    if column == 0 and platform.machine() != "x86_64":
        pytest.skip("asm/unistd.h is of another machine")
    wanted = [f"-D__ARCH_WANT_{name}" for name in ("MEMFD_SECRET", "SYS_CLONE3")]
    command = ["gcc", "-E", "-dM", *wanted, "-include", header, "-xc", "-"]
    text = subprocess.run(command, input="", capture_output=True, text=True, check=True).stdout
    found = {m[1]: int(m[2]) for m in re.finditer(r"#define __NR_(\w+) (\d+)$", text, re.M)}
    found |= {"ioctl": 29} if column else {}
    ours = {name: row[column] for name, row in REFUSED.items()}
    ours |= {"clone": CLONE[column], "clone3": CLONE3[column], "ioctl": IOCTL[column]}
    ours |= {"prlimit64": PRLIMIT64[column], "sched_setaffinity": SCHED_SETAFFINITY[column]}
    newer = {name for name in ours if name not in found and (ours[name] or 0) > 440}
    for name in ours.keys() - newer:
        assert found.get(name) == ours[name], name


@pytest.mark.parametrize("machine", ["x86_64", "aarch64"])
def test_filter_jumps_stay_inside(machine: str) -> None:
    program = filter_program(machine)
    steps = [struct.unpack_from("<HBBI", program, at) for at in range(0, len(program), 8)]
    assert len(steps) < 4096
    for index, (code, if_true, if_false, _) in enumerate(steps):
        assert code in (0x20, 0x06) or index + 1 + max(if_true, if_false) < len(steps)
    assert steps[-1] == (0x06, 0, 0, 0x7FFF0000)


def test_unknown_machine() -> None:
    with pytest.raises(SandboxUnavailable, match="vax"):
        filter_program("vax")
