"""Jobs on a cluster come back as those of the pool do, whatever happens to the workers."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from local_cluster import LocalCluster
from toy_jobs import Doubler

from raybook_grader.errors import BadInput
from raybook_grader.jobs import dask_client
from raybook_grader.jobs.cluster import ATTEMPTS, run_on_cluster
from raybook_grader.jobs.dask_client import ClusterLost, connect
from raybook_grader.jobs.pool import Died


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LocalCluster]:
    """Two workers that are started again when they die."""
    with LocalCluster(tmp_path_factory.mktemp("cluster") / "cluster") as cluster:
        cluster.add_worker(nanny=True)
        cluster.add_worker(nanny=True)
        yield cluster


def test_every_job_comes_back_once(cluster: LocalCluster) -> None:
    said: list[str] = []
    done = run_on_cluster(range(30), Doubler(), cluster.address, said.append)
    assert sorted(done) == [(i, 2 * i) for i in range(30)]
    assert said[-1].endswith("30 jobs done, 0 times a job was lost with its worker")


def test_no_jobs_need_no_cluster() -> None:
    assert list(run_on_cluster([], Doubler(), "tcp://127.0.0.1:1", print)) == []


def test_a_deadly_job_is_given_up_and_costs_no_other(cluster: LocalCluster) -> None:
    said: list[str] = []
    jobs = [1, -1, 2, 3, 4, 5]
    found = dict(run_on_cluster(jobs, Doubler(), cluster.address, said.append))
    died = found.pop(-1)
    assert isinstance(died, Died)
    assert f"lost, {ATTEMPTS} times" in died.message
    assert found == {1: 2, 2: 4, 3: 6, 4: 8, 5: 10}
    assert said[-1].endswith(f"5 jobs done, {ATTEMPTS} times a job was lost with its worker")


def test_a_worker_that_objects_gets_no_job(cluster: LocalCluster) -> None:
    said: list[str] = []
    with pytest.raises(ClusterLost, match=r"no worker can.*\nno compiler here"):
        list(run_on_cluster([1], Doubler("no compiler here"), cluster.address, said.append))
    assert any("gets no work: no compiler here" in line for line in said)


def test_a_lost_scheduler_ends_the_run_in_words(tmp_path: Path) -> None:
    with LocalCluster(tmp_path / "cluster") as cluster:
        cluster.add_worker()
        done = run_on_cluster(range(10_000), Doubler(), cluster.address, print)
        assert next(done) == (0, 0)
        cluster.kill_scheduler()
        with pytest.raises(ClusterLost, match="connection to the scheduler is lost"):
            list(done)


def test_no_scheduler_there() -> None:
    with pytest.raises(BadInput, match=r"tcp://127\.0\.0\.1:1.*no scheduler answers"):
        connect("tcp://127.0.0.1:1")


@pytest.mark.parametrize(
    "address",
    ["", "nonsense", "tcp://", "tcp://127.0.0.1", "tcp://127.0.0.1:70000", "http://127.0.0.1:1"],
)
def test_no_address(address: str) -> None:
    with pytest.raises(BadInput, match="--scheduler"):
        connect(address)


def test_without_the_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dask_client, "find_spec", lambda name: None)
    with pytest.raises(BadInput, match="pip install distributed"):
        connect("tcp://127.0.0.1:1")
