"""Loading the oracles of `hidden/`, and making each one's cases once a process."""

from __future__ import annotations

import hashlib
import importlib.util
import sys
from functools import cache
from pathlib import Path
from typing import cast

from ..probes import Cases, Oracle
from .program import HarnessFault


@cache
def load_oracle(file: Path) -> Oracle:
    """The oracle module at ``file``. It is trusted code of the course."""
    name = f"raybook_oracle_{hashlib.sha256(str(file).encode()).hexdigest()[:12]}"
    spec = importlib.util.spec_from_file_location(name, file)
    if spec is None or spec.loader is None:
        raise HarnessFault(f"{file}: cannot be loaded as a Python module")
    module = importlib.util.module_from_spec(spec)
    # Dataclasses look their module up by name; an oracle may import its neighbours.
    sys.modules[name] = module
    sys.path.insert(0, str(file.parent))
    try:
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(str(file.parent))
    for function in ("make_cases", "judge"):
        if not callable(getattr(module, function, None)):
            raise HarnessFault(f"{file}: defines no function {function}, expected an Oracle")
    return cast(Oracle, module)


@cache
def cases_of(file: Path, group: str, seed: int) -> Cases:
    """The cases of one probe; the same for every submission."""
    return load_oracle(file).make_cases(group, seed)
