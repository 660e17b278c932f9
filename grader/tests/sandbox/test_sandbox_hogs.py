"""Memory, processes and files have an end, and only the box pays."""

from __future__ import annotations

from dataclasses import replace

from tiny_programs import QUICK, RunC

UNOPTIMISED = "#pragma GCC optimize 0"


def test_address_space_ends_in_a_failed_malloc(run_c: RunC) -> None:
    body = 'void *p = malloc(300 << 20); puts(p ? "got it" : "refused");'
    assert run_c(body, before=UNOPTIMISED).stdout == b"refused\n"
    assert run_c(body, before=UNOPTIMISED, limits=replace(QUICK, memory_bytes=1 << 30)).stdout == (
        b"got it\n"
    )


def test_too_large_an_executable_is_its_own_fault(run_c: RunC) -> None:
    result = run_c("return giant[5];", before="char giant[1 << 30];")
    assert result.outcome in ("signaled", "memory")


def test_memory_over_many_processes(run_c: RunC) -> None:
    body = """
    for (int i = 0; i < 8; i++)
        if (fork() == 0) { memset(malloc(100 << 20), 1, 100 << 20); pause(); }
    pause();
    """
    result = run_c(body, before=UNOPTIMISED)
    assert result.outcome == "memory"
    assert result.describe() == "used more than 256 MiB of memory"


def test_memory_behind_a_dead_main_thread(run_c: RunC) -> None:
    before = """#include <pthread.h>
    static void *hog(void *p) { memset(malloc(400 << 20), 1, 400 << 20); pause(); return p; }"""
    body = "pthread_t t; pthread_create(&t, 0, hog, 0); pthread_exit(0);"
    limits = replace(QUICK, address_space=False)
    assert run_c(body, before=before, flags=["-O0"], limits=limits).outcome == "memory"


def test_memory_in_page_tables(run_c: RunC) -> None:
    body = """
    size_t size = 1UL << 40;
    volatile char *p = mmap(0, size, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    madvise((void *)p, size, MADV_NOHUGEPAGE);
    for (size_t at = 0; at < size; at += 2 << 20) p[at];
    pause();
    """
    limits = replace(QUICK, address_space=False)
    assert run_c(body, limits=limits).outcome == "memory"


def test_fork_bomb(run_c: RunC) -> None:
    body = "for (;;) if (fork() < 0 && errno != EAGAIN) return 1;"
    assert run_c(body, limits=replace(QUICK, wall_seconds=0.5)).outcome == "timeout"


def test_number_of_processes(run_c: RunC) -> None:
    body = """
    int made = 1, child;
    while ((child = fork()) > 0) made++;
    if (child == 0) pause();
    printf("%d %d", made, errno == EAGAIN);
    """
    assert run_c(body).stdout == b"16 1"


def test_a_program_that_leaves_daemons_ends(run_c: RunC) -> None:
    body = """
    for (int i = 0; i < 4; i++)
        if (fork() == 0) { setsid(); signal(SIGTERM, SIG_IGN); if (fork()) _exit(0); sleep(600); }
    return 4;
    """
    result = run_c(body)
    assert (result.outcome, result.exit_code) == ("exited", 4)


def test_a_daemon_cannot_write_after_the_end(run_c: RunC) -> None:
    body = """
    int fd = open("log", O_CREAT | O_RDWR, 0600);
    write(fd, "start", 5);
    if (fork() == 0) {
        setsid();
        while (kill(getppid(), 0) == 0 && getppid() != 1) ;
        for (;;) { lseek(fd, 0, SEEK_SET); ftruncate(fd, 5); write(fd, "later", 5); }
    }
    """
    for _ in range(5):
        # Whichever came first, the file is of one moment: nothing writes while it is read.
        assert run_c(body, collect=["log"]).files["log"] in (b"start", b"later")


def test_scratch_space_is_sized(run_c: RunC) -> None:
    body = """
    char block[4096] = {0}; long n = 0; char *names[] = {"/work/a", "/tmp/a", "/dev/shm/a"};
    for (int i = 0; i < 3; i++) {
        int fd = open(names[i], O_CREAT | O_WRONLY, 0600);
        for (n = 0; write(fd, block, 4096) == 4096; n++) ;
        printf("%ld ", n);
    }
    """
    result = run_c(body, limits=replace(QUICK, scratch_bytes=2 << 20))
    assert result.stdout == b"512 512 256 "


def test_file_size(run_c: RunC) -> None:
    body = 'int fd = open("a", O_CREAT | O_WRONLY, 0600); lseek(fd, 1 << 20, 0); write(fd, "x", 1);'
    result = run_c(body, limits=replace(QUICK, file_bytes=1 << 20))
    assert (result.outcome, result.signal) == ("signaled", 25)
    assert result.describe() == "killed by signal 25 (file too large)"


def test_a_flood_of_empty_files(run_c: RunC) -> None:
    body = """
    char name[32];
    for (int i = 0;; i++) { sprintf(name, "/tmp/%d", i); close(open(name, O_CREAT, 0600)); }
    """
    result = run_c(body, limits=replace(QUICK, scratch_files=500))
    assert result.outcome == "output-flood"
    assert result.describe() == "made more than 500 files"
