import os
import signal
import threading

import distributed
import pytest

from fpt_ros.errors import BadInput
from fpt_ros.sweep.definition import define
from fpt_ros.sweep.directory import open_directory
from fpt_ros.sweep.executor import ClusterPool, LocalPool
from fpt_ros.sweep.run_one import run_chunk
from fpt_ros.sweep.sweep import run


def sweep_of(count):
    return define("tora", "adaptive", (), 1.0, [f"fpt_deformer.A=-0.1:-4:{count}"], None, 0, ())


def swept(sweep, directory, pool, progress):
    open_directory(sweep.definition, directory)
    with run(sweep, directory, pool, progress) as journal:
        return list(journal.rows())


def test_a_dask_cluster_that_loses_a_worker(tmp_path):
    sweep = sweep_of(120)
    killed = threading.Event()
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with distributed.LocalCluster(processes=True, **options) as cluster:
        victim = next(iter(cluster.workers.values())).pid

        def kill_one(done, lost):
            if done >= 10 and not killed.is_set():
                killed.set()
                os.kill(victim, signal.SIGKILL)

        with ClusterPool(cluster.scheduler_address) as pool:
            rows = swept(sweep, tmp_path / "s", pool, kill_one)
    assert killed.is_set()
    assert [row[0] for row in rows] == list(range(120))
    assert all("complete" in row for row in rows)
    assert [rows[70]] == run_chunk(sweep.job, [70])[1]


def test_a_local_worker_that_is_killed_is_replaced(tmp_path):
    sweep = sweep_of(60)
    with LocalPool(2) as pool:
        killed = []

        def kill_one(done, lost):
            if done >= 5 and not killed:
                killed.append(next(iter(pool.executor._processes)))
                os.kill(killed[0], signal.SIGKILL)

        rows = swept(sweep, tmp_path / "s", pool, kill_one)
    assert killed
    assert [row[0] for row in rows] == list(range(60))


def test_no_scheduler(monkeypatch):
    monkeypatch.setattr("fpt_ros.sweep.executor.CONNECT", 1.0)
    for address in ("tcp://127.0.0.1:1", "nonsense://x"):
        with pytest.raises(BadInput, match="no dask scheduler answers there"):
            ClusterPool(address)
