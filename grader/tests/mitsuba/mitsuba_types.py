"""Mitsuba, loaded in the variant that the comparison uses.

`llvm_ad_rgb` where LLVM 17 or newer is found (DRJIT_LIBLLVM_PATH, or where Debian puts it), else
`scalar_rgb`, which is several times slower and hangs with one thread. Mitsuba ships no types that
mypy can use, so it is an Any.
"""

import glob
import os
from importlib import import_module
from typing import Any

Plugin = dict[str, Any]
"""What `mitsuba.load_dict` reads."""


def find_llvm() -> bool:
    """Where Mitsuba's llvm variants find LLVM, unless the environment says so already."""
    found = sorted(glob.glob("/usr/lib/*/libLLVM.so.*"))
    if found:
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", found[-1])
    return "DRJIT_LIBLLVM_PATH" in os.environ


def load_mitsuba() -> Any:
    """The module, its variant set."""
    llvm = find_llvm()
    mi = import_module("mitsuba")
    if mi.variant() is None:
        mi.set_variant("llvm_ad_rgb" if llvm else "scalar_rgb")
    return mi


def rgb(value: Any) -> Plugin:
    """A linear colour."""
    return {"type": "rgb", "value": [float(v) for v in value]}
