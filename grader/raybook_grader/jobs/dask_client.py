"""Reaching a Dask scheduler, with clear words when that is not possible."""

from __future__ import annotations

import logging
import socket
from collections.abc import Mapping
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Self
from urllib.parse import urlsplit

from ..errors import BadInput

if TYPE_CHECKING:
    from distributed import Client

_CONNECT_SECONDS = 10


class ClusterLost(Exception):
    """The scheduler, or every worker that could have gone on, has gone. What is done is done."""

    @classmethod
    def gone(cls) -> Self:
        return cls("the connection to the scheduler is lost")


def connect(address: str) -> Client:
    """A client of the scheduler at an address; raises `BadInput`."""
    if find_spec("distributed") is None:
        raise BadInput(
            "--scheduler needs the Python package 'distributed', which is not installed; "
            "`build/venv/bin/pip install distributed` installs it"
        )
    _knock(address)
    from distributed import Client

    # Our own words say what happens to the connection.
    for name in ("distributed", "distributed.client", "distributed.core"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    try:
        # TLS and the like are taken from Dask's own configuration.
        return Client(address, timeout=_CONNECT_SECONDS, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise _nobody(address, str(error)) from error


def _knock(address: str) -> None:
    """Fault of an address where nobody listens: at once, where Dask would try for long."""
    try:
        parts = urlsplit(address)
        host, port = parts.hostname, parts.port
    except ValueError as error:
        raise _nobody(address, str(error)) from error
    if parts.scheme not in ("tcp", "tls") or not host or not port:
        raise _nobody(address, "this is no address")
    try:
        socket.create_connection((host, port), timeout=_CONNECT_SECONDS).close()
    except OSError as error:
        raise _nobody(address, str(error)) from error


def _nobody(address: str, reason: str) -> BadInput:
    return BadInput(
        f"--scheduler {address!r}: no scheduler answers there ({reason}), expected the address "
        "that `dask scheduler` prints, such as tcp://10.0.0.1:8786"
    )


def worker_addresses(client: Client) -> set[str]:
    """The workers that are there now; raises `ClusterLost`."""
    if client.status != "running":
        raise ClusterLost.gone()
    try:
        return set(client.run_on_scheduler(_addresses))
    except OSError as error:
        raise ClusterLost.gone() from error


def _addresses(dask_scheduler: Any) -> list[str]:
    workers: Mapping[str, object] = dask_scheduler.workers
    return list(workers)
