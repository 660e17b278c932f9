"""This machine as one that cannot make a box: without bubblewrap."""

from __future__ import annotations

import os
import shutil
from collections.abc import Sequence

_HIDE = 'mount --bind /dev/null "$0" && exec "$@"'


def without_bubblewrap(command: Sequence[str]) -> list[str]:
    """The command in a mount namespace of its own, in which bwrap is no program."""
    bwrap = shutil.which("bwrap")
    assert bwrap is not None
    own = ["unshare", "--mount"] if os.geteuid() == 0 else ["unshare", "--mount", "--map-root-user"]
    return [*own, "sh", "-c", _HIDE, os.path.realpath(bwrap), *command]
