"""What must be the same wherever one class is graded, so that a result depends on its job alone."""

from __future__ import annotations

import hashlib
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass

from ..course import Assignment
from ..errors import BadInput
from ..kit import Kit
from .key import Keys

_NATIVE = "-march=native"


@dataclass(frozen=True)
class Stamp:
    """Hashes; ``processor`` is what the kit's ``-march=native`` means, "" if it names another."""

    grader: str
    kit: str
    processor: str
    assignments: tuple[tuple[str, str], ...]

    def difference(self, other: Stamp) -> str:
        """What differs, with the remedy; "" if nothing does. Another grader changes all the rest,
        so the first difference is the one to tell."""
        if self.grader != other.grader:
            return "another version of the grader; use the same checkout everywhere"
        if self.kit != other.kit:
            return "another kit or compiler; copy build/kit, or use one checkout for all"
        if self.processor != other.processor:
            return (
                "another kind of processor, and the kit is made for this one's; make a kit for "
                "all of them, such as `make kit ARCH=x86-64-v3`"
            )
        theirs = dict(other.assignments)
        differing = [number for number, key in self.assignments if theirs.get(number) != key]
        return f"another text of assignment {', '.join(differing)}" if differing else ""


def stamp(keys: Keys, kit: Kit, assignments: Iterable[Assignment]) -> Stamp:
    """The stamp of this machine's checkout."""
    return Stamp(
        grader=keys.grader,
        kit=kit.fingerprint,
        processor=_processor(kit) if _NATIVE in kit.cflags else "",
        assignments=tuple((a.number, keys.of_assignment(a)) for a in assignments),
    )


def _processor(kit: Kit) -> str:
    """A hash of the instruction sets that the compiler finds here, as its macros name them."""
    command = [kit.cc, _NATIVE, "-dM", "-E", "-x", "c", "/dev/null"]
    try:
        macros = subprocess.run(command, capture_output=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        raise BadInput(f"the kit's compiler {kit.cc!r} does not run: {error}") from error
    return hashlib.sha256(b"\n".join(sorted(macros.splitlines()))).hexdigest()
