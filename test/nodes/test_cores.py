"""Which core the loop is put on, and that it stays there."""

import os
import subprocess
import sys

import pytest

from fpt_ros.nodes import cores


@pytest.mark.parametrize(
    ("before", "after", "chosen"),
    [
        ({0: 100, 1: 100}, {0: 101, 1: 105}, 1),
        ({0: 100, 1: 100}, {0: 105, 1: 101}, 0),
        ({0: 100, 1: 100}, {0: 100, 1: 100}, 1),
        ({}, {}, None),
    ],
)
def test_the_idlest_of_the_allowed_cores(monkeypatch, before, after, chosen):
    readings = iter([before, after])
    monkeypatch.setattr(cores, "_idle_time", lambda: next(readings))
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1})
    monkeypatch.setattr(cores, "LOOK", 0.0)
    assert cores.idlest() == chosen


def test_a_core_that_is_not_allowed_is_not_chosen(monkeypatch):
    readings = iter([{0: 0, 1: 0}, {0: 1, 1: 9}])
    monkeypatch.setattr(cores, "_idle_time", lambda: next(readings))
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0})
    assert cores.idlest() == 0


def test_idle_times_are_read(monkeypatch, tmp_path):
    stat = tmp_path / "stat"
    stat.write_text("cpu  9 9 9 9 9 9\ncpu0 1 2 3 40 5 6\ncpu11 1 2 3 70 8 6\nintr 5\n")
    monkeypatch.setattr(cores, "STAT", stat)
    assert cores._idle_time() == {0: 45, 11: 78}
    monkeypatch.setattr(cores, "STAT", tmp_path / "none")
    assert cores._idle_time() == {}


def test_all_threads_of_a_process_are_kept_on_a_core():
    script = (
        "import threading; t = threading.Thread(target=input); t.start(); "
        "print(t.native_id, flush=True); t.join()"
    )
    child = subprocess.Popen(
        [sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    try:
        thread = int(child.stdout.readline())
        core = min(os.sched_getaffinity(0))
        cores.keep_on(core, child.pid)
        assert os.sched_getaffinity(child.pid) == os.sched_getaffinity(thread) == {core}
    finally:
        child.communicate("\n", timeout=30)
    cores.keep_on(core, child.pid)  # it is gone: nothing happens
