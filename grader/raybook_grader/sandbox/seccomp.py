"""The box's seccomp filter, assembled here in classic BPF (no compiler, no library).

A program is a row of `struct sock_filter`: 16-bit code, two 8-bit jump distances (if true, if
false), 32-bit constant. It looks at `struct seccomp_data`: call number at 0, machine at 4,
arguments of 64 bits from 16 on (seccomp(2), linux/filter.h). Refused calls fail with EPERM, so
that a program can tell; calls newer than `LAST_KNOWN` and clone3, whose flags lie in memory that
a filter cannot see, fail with ENOSYS, which makes C libraries use the older call.
"""

from __future__ import annotations

import errno
import functools
import platform
import struct
from collections.abc import Iterable

from .errors import SandboxUnavailable
from .syscalls import CLONE, CLONE3, IOCTL, LAST_KNOWN, PRLIMIT64, REFUSED, SCHED_SETAFFINITY

# linux/audit.h; the column of the machine's numbers in `syscalls`
_MACHINES = {"x86_64": (0xC000003E, 0), "aarch64": (0xC00000B7, 1)}

_LOAD = 0x20  # BPF_LD | BPF_W | BPF_ABS
_IF_EQUAL, _IF_GREATER, _IF_ANY_BIT = 0x15, 0x25, 0x45  # BPF_JMP | BPF_K | ...
_RETURN = 0x06

_ALLOW, _KILL_PROCESS, _FAIL = 0x7FFF0000, 0x80000000, 0x00050000

_NUMBER, _ARCHITECTURE = 0, 4
_NEW_NAMESPACES = 0x7E020000  # CLONE_NEWNS, CGROUP, UTS, IPC, USER, PID, NET
_TERMINAL_INPUT = (0x5412, 0x541C)  # TIOCSTI, TIOCLINUX: type into another's terminal
_ANOTHER_PROCESS = 0xFFFFFFFF  # any bit of the process id: only 0, oneself, may be limited
_SUPERVISOR = 1

_Step = tuple[int, int, int, int]


@functools.cache
def filter_program(machine: str | None = None) -> bytes:
    """The filter for a machine as `platform.machine()` names it (default: this one)."""
    machine = machine or platform.machine()
    if machine not in _MACHINES:
        raise SandboxUnavailable(
            f"no system call filter for this machine ({machine}); expected {' or '.join(_MACHINES)}"
        )
    audit_number, column = _MACHINES[machine]
    numbers = [row[column] for row in REFUSED.values()]
    steps: list[_Step] = [
        _load(_ARCHITECTURE),
        (_IF_EQUAL, 1, 0, audit_number),
        _answer(_KILL_PROCESS),  # 32-bit calls would have other numbers
        _load(_NUMBER),
        *_unless(_IF_GREATER, LAST_KNOWN, _FAIL | errno.ENOSYS),  # includes x32 (bit 30)
        *_unless(_IF_EQUAL, CLONE3[column], _FAIL | errno.ENOSYS),
        *_refuse(number for number in numbers if number is not None),
        *_argument_rules(CLONE[column], 0, _IF_ANY_BIT, (_NEW_NAMESPACES,)),
        *_argument_rules(IOCTL[column], 1, _IF_EQUAL, _TERMINAL_INPUT),
        *_argument_rules(PRLIMIT64[column], 0, _IF_ANY_BIT, (_ANOTHER_PROCESS,)),
        *_argument_rules(SCHED_SETAFFINITY[column], 0, _IF_EQUAL, (_SUPERVISOR,)),
        _answer(_ALLOW),
    ]
    return b"".join(struct.pack("<HBBI", *step) for step in steps)


def _load(offset: int) -> _Step:
    return (_LOAD, 0, 0, offset)


def _answer(action: int) -> _Step:
    return (_RETURN, 0, 0, action)


def _unless(test: int, constant: int, action: int) -> list[_Step]:
    """Answers with the action if the test holds, goes on otherwise."""
    return [(test, 0, 1, constant), _answer(action)]


def _refuse(numbers: Iterable[int]) -> list[_Step]:
    steps: list[_Step] = []
    for number in numbers:
        steps += _unless(_IF_EQUAL, number, _FAIL | errno.EPERM)
    return steps


def _argument_rules(
    number: int, argument: int, test: int, constants: tuple[int, ...]
) -> list[_Step]:
    """Refuses call `number` if the low half of its argument passes any of the tests.

    Ends with the call number loaded again, for the rules that follow.
    """
    rules: list[_Step] = [_load(16 + 8 * argument)]
    for constant in constants:
        rules += _unless(test, constant, _FAIL | errno.EPERM)
    return [(_IF_EQUAL, 0, len(rules), number), *rules, _load(_NUMBER)]
