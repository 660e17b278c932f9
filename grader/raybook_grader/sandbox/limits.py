"""How far one run in a box may go."""

from __future__ import annotations

import math
from dataclasses import dataclass

_KIB = 1024
_MIB = 1024 * _KIB


@dataclass(frozen=True)
class Limits:
    """Limits of one run; every one is enforced inside the box. All must be positive.

    Memory is fenced twice: the address space of each process (so that `malloc` fails cleanly),
    and, looked at every 20 ms, the private resident memory of all processes together (so that
    forking does not multiply it).
    """

    wall_seconds: float = 10.0
    """Real time from the command's start to its end."""
    cpu_seconds: float = 20.0
    """Processor time of any one process, all its threads together; rounded up to seconds."""
    memory_bytes: int = 1024 * _MIB
    """See above; files in the box's scratch folders are counted by `scratch_bytes` instead."""
    file_bytes: int = 64 * _MIB
    """Largest file that the command may write, and that is collected afterwards."""
    processes: int = 64
    """Processes and threads at any moment."""
    output_bytes: int = 256 * _KIB
    """Kept from each of stdout and stderr; one byte more ends the run ("output-flood")."""
    scratch_bytes: int = 64 * _MIB
    """Size of /work, and of /tmp; both are in memory. /dev/shm always has 1 MiB."""
    scratch_files: int = 10_000
    """Files and folders in /work, /tmp and /dev/shm together."""
    address_space: bool = True
    """False drops the address-space fence, for AddressSanitizer, which reserves terabytes."""

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not isinstance(value, bool) and not (value > 0 and math.isfinite(value)):
                raise ValueError(f"Limits.{name} is {value!r}; expected a positive number")
