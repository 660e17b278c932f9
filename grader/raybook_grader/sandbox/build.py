"""Compiling the supervisor: once, by trusted code, outside any box."""

from __future__ import annotations

import functools
import hashlib
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

from .errors import SandboxUnavailable

_SOURCES = Path(__file__).parent / "supervisor"
_FLAGS = ("-std=c99", "-O2", "-Wall", "-Wextra", "-D_FORTIFY_SOURCE=2", "-fstack-protector-strong")


@functools.cache
def supervisor_path() -> Path:
    """The supervisor's executable, compiled if its sources or the compiler are new.

    Many processes may call this at once: each writes aside and renames. Raises
    SandboxUnavailable when there is no compiler, no place to write, or the compile fails.
    """
    compiler = find_compiler()
    folder = _cache_folder()
    path = folder / f"supervisor-{_key(compiler)}"
    if not path.exists():
        _compile(compiler, path)
    return path


def find_compiler() -> str:
    """A C compiler's absolute path; raises SandboxUnavailable if there is none."""
    for name in ("gcc", "cc", "clang"):
        found = shutil.which(name)
        if found:
            return found
    raise SandboxUnavailable("no C compiler (gcc, cc or clang) is in PATH; install gcc")


def _key(compiler: str) -> str:
    digest = hashlib.sha256(" ".join(_FLAGS).encode())
    real = os.stat(compiler)
    digest.update(f"{os.path.realpath(compiler)} {real.st_size} {real.st_mtime_ns}".encode())
    for source in sorted(_SOURCES.glob("*.[ch]")):
        digest.update(source.name.encode() + b"\0" + source.read_bytes() + b"\0")
    return digest.hexdigest()[:24]


def _cache_folder() -> Path:
    """The checkout's build folder, else the user's cache; never a folder others can write."""
    tried = []
    for folder in (_checkout_build(), _user_cache()):
        if folder is None:
            continue
        try:
            folder.mkdir(mode=0o755, parents=True, exist_ok=True)
        except OSError as error:
            tried.append(f"{folder} ({error.strerror})")
            continue
        about = folder.stat()
        if about.st_uid == os.geteuid() and not about.st_mode & 0o022:
            return folder
        tried.append(f"{folder} (belongs to, or is writable by, others)")
    raise SandboxUnavailable("no place for the compiled supervisor: tried " + "; ".join(tried))


def _checkout_build() -> Path | None:
    top = Path(__file__).resolve().parents[3]
    is_checkout = (top / "Makefile").is_file() and (top / "grader" / "raybook_grader").is_dir()
    return top / "build" / "sandbox" if is_checkout else None


def _user_cache() -> Path:
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "raybook" / "sandbox"


def _compile(compiler: str, path: Path) -> None:
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=".supervisor-")
    os.close(handle)
    try:
        sources = [str(source) for source in sorted(_SOURCES.glob("*.c"))]
        for linking in (["-static"], []):  # not every system has a static C library
            done = subprocess.run(
                [compiler, *_FLAGS, *linking, "-o", name, *sources],
                capture_output=True,
                text=True,
                check=False,
            )
            if done.returncode == 0:
                os.chmod(name, 0o755)
                os.replace(name, path)
                return
        raise SandboxUnavailable(
            f"the sandbox's supervisor does not compile with {compiler}:\n{done.stderr}"
        )
    finally:
        Path(name).unlink(missing_ok=True)
