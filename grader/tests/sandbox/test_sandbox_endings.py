"""Every way in which a command can end is told apart."""

from __future__ import annotations

from dataclasses import replace

import pytest
from tiny_programs import QUICK, RunC

from raybook_grader.sandbox import Box, Limits

HALF_SECOND = replace(QUICK, wall_seconds=0.5)
ONE_SECOND_OF_WORK = replace(QUICK, cpu_seconds=1, wall_seconds=120)  # on a busy machine, too


@pytest.mark.parametrize("code", [0, 3, 137, 255])
def test_exit_codes(run_c: RunC, code: int) -> None:
    result = run_c(f"return {code};")
    assert (result.outcome, result.exit_code, result.signal) == ("exited", code, None)
    assert result.ok == (code == 0)


def test_exit_137_is_not_a_kill(run_c: RunC) -> None:
    result = run_c("kill(getpid(), SIGKILL); pause();")
    assert (result.outcome, result.exit_code, result.signal) == ("signaled", None, 9)


def test_segmentation_fault_in_words(run_c: RunC) -> None:
    result = run_c("return *(volatile int *)0;")
    assert (result.outcome, result.signal) == ("signaled", 11)
    assert result.describe() == "killed by signal 11 (segmentation fault)"


def test_endless_loop(run_c: RunC) -> None:
    result = run_c('puts("so far"); fflush(stdout); for (;;) ;', limits=HALF_SECOND)
    assert result.outcome == "timeout"
    assert result.describe() == "no answer after 0.5 s"
    assert result.stdout == b"so far\n"
    assert 0 < result.cpu_seconds < 5


def test_ignored_signals_and_stops_do_not_outlast_the_limit(run_c: RunC) -> None:
    ignore = "for (int i = 1; i < 65; i++) signal(i, SIG_IGN);"
    for body in (ignore + "for (;;) pause();", "raise(SIGSTOP);"):
        assert run_c(body, limits=HALF_SECOND).outcome == "timeout"


def test_processor_time(run_c: RunC) -> None:
    result = run_c("for (;;) ;", limits=ONE_SECOND_OF_WORK)
    assert (result.outcome, result.signal) == ("timeout", 24)
    assert result.describe() == "used more than 1 s of processor time"


def test_processor_time_with_the_warning_ignored(run_c: RunC) -> None:
    body = "signal(SIGXCPU, SIG_IGN); for (;;) ;"
    result = run_c(body, limits=ONE_SECOND_OF_WORK)
    assert (result.outcome, result.signal) == ("timeout", 9)


def test_output_flood_keeps_the_beginning(run_c: RunC) -> None:
    body = 'signal(SIGPIPE, SIG_IGN); for (;;) write(1, "flood ", 6);'
    result = run_c(body, limits=replace(QUICK, output_bytes=10_000))
    assert result.outcome == "output-flood"
    assert result.describe() == "printed more than 9.77 KiB"
    assert result.stdout == (b"flood " * 2000)[:10_000]
    assert result.stdout_cut and not result.stderr_cut
    assert result.wall_seconds < QUICK.wall_seconds  # ended for it, not by the other limit


def test_output_of_exactly_the_limit_is_whole(run_c: RunC) -> None:
    body = "char *text = calloc(1, 10001); write(2, text, 10000 + argc - 1);"
    limits = replace(QUICK, output_bytes=10_000)
    fits = run_c(body, limits=limits)
    assert (fits.outcome, len(fits.stderr), fits.output_cut) == ("exited", 10_000, False)
    over = run_c(body, limits=limits, arguments=["more"])
    assert (over.outcome, len(over.stderr), over.stderr_cut) == ("output-flood", 10_000, True)


def test_closed_output_changes_nothing(run_c: RunC) -> None:
    result = run_c("close(0); close(1); close(2); usleep(50000); return 5;")
    assert (result.outcome, result.exit_code) == ("exited", 5)


def test_unknown_program_is_the_harness_s_failure(box: Box) -> None:
    result = box.run(["/no/such/program"])
    assert result.outcome == "lost"
    assert "No such file" in result.describe()


def test_supervisor_cannot_be_killed_from_inside(run_c: RunC) -> None:
    body = "for (int i = 1; i < 65; i++) kill(1, i); kill(getppid(), SIGKILL); return 6;"
    result = run_c(body)
    assert (result.outcome, result.exit_code) == ("exited", 6)


def test_supervisor_cannot_be_slowed_or_limited(run_c: RunC) -> None:
    before = "#include <sched.h>\n#include <sys/resource.h>\n#include <sys/time.h>"
    body = """
    struct rlimit none = {0, 0}; struct sched_param idle = {0}; cpu_set_t set;
    CPU_ZERO(&set); CPU_SET(0, &set);
    #define REFUSED(call) (errno = 0, (call) == -1 && errno == EPERM)
    printf("%d ", REFUSED(prlimit(1, RLIMIT_CPU, &none, 0)));
    printf("%d ", REFUSED(sched_setscheduler(1, SCHED_IDLE, &idle)));
    printf("%d ", REFUSED(sched_setaffinity(1, sizeof set, &set)));
    printf("%d ", REFUSED(setpriority(PRIO_PROCESS, 1, 19)));
    printf("%d", setrlimit(RLIMIT_CORE, &none));
    """
    assert run_c(body, before=before).stdout == b"1 1 1 1 0"


def test_standard_input(run_c: RunC) -> None:
    copy = "char b[9]; int n; while ((n = read(0, b, 9)) > 0) write(1, b, n);"
    assert run_c(copy, stdin=b"one\0two").stdout == b"one\0two"
    assert run_c(copy).stdout == b""


def test_usage_counts_the_whole_box(run_c: RunC) -> None:
    body = """
    int lives[2]; char end;
    if (pipe(lives)) return 1;
    if (fork() == 0) {
        if (fork() == 0) { memset(malloc(64 << 20), 1, 64 << 20); }
        _exit(0);
    }
    close(lives[1]);
    if (read(lives[0], &end, 1)) return 2;  /* until the orphan has ended */
    usleep(200000);
    """
    result = run_c(body, before="#pragma GCC optimize 0")
    assert result.ok
    assert result.max_rss_bytes > 64 << 20
    assert result.wall_seconds >= 0.2


def test_limits_must_be_positive() -> None:
    with pytest.raises(ValueError, match="memory_bytes is 0"):
        Limits(memory_bytes=0)
