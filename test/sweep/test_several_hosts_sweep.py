"""A sweep on the workers of another host, which has neither our files nor our folders."""

import shutil
import subprocess
import sys
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest
import samples
from command import fpt_json
from two_hosts import two_hosts

from fpt_ros.experiments.locate import config_directory
from fpt_ros.sweep import point_experiments
from fpt_ros.sweep.definition import define
from fpt_ros.sweep.run_one import run_chunk

DASK = Path(sys.executable).with_name("dask")
PORT = 8786


@pytest.fixture
def own(tmp_path):
    """An experiment of somebody's own, with a variant and an overlay of any name."""
    folder = tmp_path / "own"
    folder.mkdir()
    shutil.copy(config_directory() / "tora.yaml", folder / "mine.yaml")
    shutil.copy(config_directory() / "tora.strong.yaml", folder / "mine.strong.yaml")
    (folder / "tuned.yaml").write_text("/**/fpt_deformer: {ros__parameters: {K: 0.55}}\n")
    return folder


@pytest.mark.parametrize("variant", ["adaptive", "strong", "tuned.yaml"])
def test_parameter_files_go_along(own, variant, monkeypatch):
    variant = str(own / variant) if variant.endswith("yaml") else variant
    sweep = define(
        str(own / "mine.yaml"), variant, (), 0.05, ["fpt_deformer.A=-0.1:-4:3"], None, 0, ()
    )
    monkeypatch.setattr(point_experiments, "_known", {})
    here = run_chunk(sweep.job, [0, 1, 2])[1]
    assert all("complete" in row for row in here)
    shutil.rmtree(own)
    point_experiments._known.clear()
    assert run_chunk(sweep.job, [0, 1, 2])[1] == here


@contextmanager
def started(*words, until):
    """A process of dask's, as soon as it has said so."""
    process = subprocess.Popen(words, stderr=subprocess.PIPE, text=True)
    try:
        for line in process.stderr:
            if until in line:
                break
        else:
            pytest.fail(f"{words} has ended")
        yield process
    finally:
        process.terminate()
        process.communicate(timeout=60)


def test_workers_of_another_host(own, tmp_path):
    if not samples.whole:
        pytest.skip("ten seconds: with --all")
    sweep = ("sweep", own / "mine.yaml", "--grid", "fpt_deformer.A=-0.1:-4:24", "--duration", 0.2)
    with two_hosts() as hosts, ExitStack() as running:
        address = hosts.addresses[0]
        worker = f"mount -t tmpfs none {tmp_path} && cd / && exec {DASK} worker {address}:{PORT}"
        with hosts.on(0):
            scheduler = started(
                DASK, "scheduler", "--host", address, "--port", str(PORT), "--no-dashboard",
                until="Scheduler at",
            )  # fmt: skip
            running.enter_context(scheduler)
        with hosts.on(1):
            workers = started(
                "unshare", "-m", "sh", "-c", worker + " --nworkers 1 --nthreads 1 --no-dashboard",
                until="Registered to",
            )  # fmt: skip
            running.enter_context(workers)
        with hosts.on(0):
            there = fpt_json(
                *sweep, "--scheduler", f"tcp://{address}:{PORT}", "--out", tmp_path / "there"
            )
    here = fpt_json(*sweep, "--out", tmp_path / "here", "--workers", 1)
    assert there["runs"] == there["made"] == 24
    assert Path(there["table"]).read_text() == Path(here["table"]).read_text()
