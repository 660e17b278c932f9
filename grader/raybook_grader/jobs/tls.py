"""Who may join a cluster: those who hold its key. Without one, anybody who reaches the scheduler's
port can run programs as us.

    python -m raybook_grader.jobs.tls FOLDER

makes a key in a folder and prints what a shell must be told before it starts a part of the cluster.
"""

from __future__ import annotations

import shlex
import subprocess
import sys
from pathlib import Path

from ..errors import BadInput

_NAME = "cluster.pem"
_DAYS = 30


def tls_environment(folder: Path) -> dict[str, str]:
    """A new key and certificate in ``folder``, which only we may read; the variables by which
    schedulers, workers and clients of Dask use them, and refuse everybody else."""
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    folder.chmod(0o700)
    file = folder / _NAME
    file.unlink(missing_ok=True)
    file.touch(mode=0o600)
    command = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", str(_DAYS),
               "-subj", "/CN=raybook", "-keyout", "-", "-out", "-"]  # fmt: skip
    try:
        made = subprocess.run(command, capture_output=True, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise BadInput(f"openssl makes no key ({error}), expected the program openssl") from error
    file.write_bytes(made.stdout)
    comm = "DASK_DISTRIBUTED__COMM__"
    roles = [f"TLS__{role}__{part}" for role in ("SCHEDULER", "WORKER", "CLIENT")
             for part in ("CERT", "KEY")]  # fmt: skip
    files = {comm + name: str(file) for name in ("TLS__CA_FILE", *roles)}
    return {**files, comm + "REQUIRE_ENCRYPTION": "True"}


def main() -> int:
    """The command line."""
    if len(sys.argv) != 2:
        print("usage: python -m raybook_grader.jobs.tls FOLDER", file=sys.stderr)
        return 2
    for name, value in tls_environment(Path(sys.argv[1]).absolute()).items():
        print(f"export {name}={shlex.quote(value)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
