"""fpt sweep and fpt tune as their users see them."""

import json
import os
import shlex
import signal
import subprocess
import time

import numpy as np
import pandas
import psutil
import pytest
from command import BIN, forked_fpt, forked_fpt_json

GRID = ("--grid", "fpt_deformer.A=-0.1:-4:{}")


def journal(directory):
    path = directory / "journal.jsonl"
    return path.read_bytes().split(b"\n")[:-1] if path.exists() else []


def begin(directory, count):
    """Start a sweep in a session of its own, and wait until some rows are there."""
    grid = [part.format(count) for part in GRID]
    process = subprocess.Popen(
        [
            BIN / "fpt",
            "sweep",
            "tora",
            *grid,
            "--duration",
            "4",
            "--workers",
            "2",
            "--out",
            directory,
        ],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    end = time.monotonic() + 60.0
    while len(journal(directory)) < 5:
        assert process.poll() is None, process.stderr.read()
        assert time.monotonic() < end
        time.sleep(0.01)
    return process, psutil.Process(process.pid).children(recursive=True)


def go_on(directory, count):
    grid = [part.format(count) for part in GRID]
    return forked_fpt_json("sweep", "tora", *grid, "--duration", 4, "--out", directory)


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_goes_on_where_it_was_ended(tmp_path, how):
    directory, count = tmp_path / "s", 300
    process, workers = begin(directory, count)
    os.kill(process.pid, how)
    _, complaint = process.communicate(timeout=60)
    psutil.wait_procs(workers, timeout=30)
    assert not [worker for worker in workers if worker.is_running()]
    if how == signal.SIGINT:
        assert process.returncode == 130
        assert "the same command goes on" in complaint
    before = journal(directory)
    assert 5 <= len(before) < count
    with (directory / "journal.jsonl").open("ab") as file:
        file.write(b'[299,-4.0,"comp')  # as if killed within a write
    result = go_on(directory, count)
    after = journal(directory)
    assert after[: len(before)] == before
    assert sorted(json.loads(line)[0] for line in after) == list(range(count))
    assert (result["resumed"], result["made"]) == (True, count - len(before))
    assert go_on(directory, count)["made"] == 0


def test_tables_and_maps_and_the_same_bits_as_simulate(tmp_path):
    directory = tmp_path / "s"
    result = forked_fpt_json(
        *("sweep", "tora", "--grid", "fpt_deformer.A=-0.7,-3.3,1", "--duration", 6, "--workers", 1),
        *("--grid", "trajectory_generator.lambda=5:6:2", "--out", directory),
    )
    assert (result["runs"], result["made"], result["not_complete"]) == (6, 6, 2)
    table = pandas.read_parquet(directory / "runs.parquet")
    text = pandas.read_csv(directory / "runs.csv")
    assert list(text.columns) == list(table.columns)
    for name in table.columns:
        if table[name].dtype == np.float64:
            np.testing.assert_array_equal(table[name], text[name])
    for name in ("map.png", "map.svg"):
        assert (directory / name).stat().st_size > 1000
    for number in (1, 4):
        row = table.iloc[number]
        own = [f"{name}={float(row[name])!r}" for name in table.columns[1:3]]
        done = forked_fpt(
            "simulate", "tora", "--duration", 6, "--json", "--set", own[0], "--set", own[1]
        )
        assert done.returncode == (1 if row["outcome"] == "diverged" else 0)
        one = json.loads(done.stdout)
        assert row["reason"] == one["reason"]
        assert row["cycles"] == one["cycles"]
        assert row["chatter"] == one["chatter"]
        for coordinate, numbers in one["tracking"].items():
            for kind, value in numbers.items():
                there = row[f"{kind}.{coordinate}"]
                assert there == value or (value is None and np.isnan(there))
        for coordinate, numbers in one["effort"].items():
            assert row[f"effort.{coordinate}"] == numbers["rms"]


def test_onset_and_basin(tmp_path):
    """The onset lies where the thesis has it: -3.125 is quiet, -4.2 chatters (config/tora.*)."""
    result = forked_fpt_json(
        "sweep", "tora", "--grid", "fpt_deformer.A=-3:-4.2:5", "--out", tmp_path / "a"
    )
    quiet, loud = result["onset_of_chattering"]
    assert -3.125 >= quiet > loud >= -4.2
    axes = [f"plant_simulator.initial_position[{i}]=-1.6:1.6:3" for i in (0, 1)]
    result = forked_fpt_json(
        *("sweep", "tora", "--grid", axes[0], "--grid", axes[1], "--duration", 1, "--workers", 1),
        *("--out", tmp_path / "b"),
    )
    table = pandas.read_parquet(tmp_path / "b" / "runs.parquet")
    beyond = table["plant_simulator.initial_position[0]"].abs() > 1.5
    assert (table["outcome"][beyond] != "complete").all()


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["sweep", "tora"], "at least one --grid"),
        (["sweep", "tora", "--grid", "fpt_deformer.Q=1:2:3"], "has no parameter 'Q'"),
        (["sweep", "tora", "--grid", "fpt_deformer.A=1:2:0"], "the count is 0"),
        (["sweep", "tora", "--grid", "fpt_deformer.A=-1:-2:3", "--metric", "x"], "no metric 'x'"),
        (["sweep", "tora", "--grid", "fpt_deformer.A=-1:-2:3", "--workers", "0"], "--workers 0"),
        (["sweep", "tora", "--grid", "fpt_deformer.A=-1:-2:3", "--out", "/proc/x"], "/proc/x"),
        (
            ["sweep", "tora", "--grid", "fpt_deformer.A=-1:-2:3", "--scheduler", "x://y"],
            "no dask scheduler answers",
        ),
        (["tune", "tora", "--over", "fpt_deformer.Q"], "has no parameter 'Q'"),
        (["tune", "tora", "--over", "fpt_deformer.A", "--out", "no/such.yaml"], "no/such.yaml"),
    ],
    ids=lambda c: " ".join(c)[10:60] if isinstance(c, list) else "",
)
def test_bad_input_is_one_line(tmp_path, arguments, complaint):
    done = forked_fpt(*arguments, cwd=tmp_path)
    assert done.returncode == 2, done.stderr
    assert complaint in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_folders_of_others(tmp_path):
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "notes").write_text("mine")
    grid = ["--grid", "fpt_deformer.A=-1:-2:2", "--duration", 0.1, "--workers", 1]
    done = forked_fpt("sweep", "tora", *grid, "--out", tmp_path / "full")
    assert (done.returncode, "holds other files" in done.stderr) == (2, True)
    forked_fpt_json("sweep", "tora", *grid, "--out", tmp_path / "s")
    done = forked_fpt("sweep", "tora", "--variant", "strong", *grid, "--out", tmp_path / "s")
    assert done.returncode == 2
    assert "is of another sweep: its variant is adaptive, not strong" in done.stderr


def test_tune_tells_how_its_overlay_is_used(tmp_path):
    """The command that it ends with gives the run that was found, and its recording says so."""
    arguments = ("tune", "tora", "--over", "fpt_deformer.A", "--limit", "chatter=0.02")
    result = forked_fpt_json(*arguments, "--trials", 15, "--duration", 6, cwd=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["tora.tuned.yaml"]
    assert result["metrics"]["chatter"]["after"] <= 0.02
    settled = result["metrics"]["rms_settled.q3"]
    assert settled["after"] < settled["before"]
    program, *words = shlex.split(result["use"])
    assert (program, words) == ("fpt", ["simulate", "tora", "--variant", "tora.tuned.yaml"])
    one = forked_fpt_json(*words, "--record", "bag", cwd=tmp_path)
    assert one["variant"] == "tora.tuned"
    assert one["tracking"]["q3"]["rms_settled"] == settled["after"]
    there = forked_fpt_json("info", "bag", cwd=tmp_path)
    assert (there["experiment"], there["variant"]) == ("tora", "tora.tuned")
    found = result["parameters"]["fpt_deformer.A"]["after"]
    assert there["parameters"]["fpt_deformer"]["A"] == found
    done = forked_fpt(*arguments, "--variant", "tora.tuned.yaml", "--trials", 1, cwd=tmp_path)
    assert done.stdout.splitlines()[-1].split(":")[1].strip() == result["use"]


def test_a_sweep_over_an_overlay_file(tmp_path):
    overlay = tmp_path / "soft.yaml"
    overlay.write_text("/**/trajectory_generator:\n  ros__parameters: {lambda: 4.0}\n")
    grid = ["--grid", "fpt_deformer.A=-1:-2:2", "--duration", 5, "--workers", 1]
    result = forked_fpt_json("sweep", "tora", "--variant", "soft.yaml", *grid, cwd=tmp_path)
    assert result["variant"] == "soft"
    table = pandas.read_csv(tmp_path / "tora-sweep" / "runs.csv")
    words = ["--set", "fpt_deformer.A=-2", "--duration", 5]
    one = forked_fpt_json("simulate", "tora", "--variant", overlay, *words)
    assert table["rms_settled.q3"][1] == one["tracking"]["q3"]["rms_settled"]
    plain = forked_fpt_json("simulate", "tora", *words)
    assert one["tracking"]["q3"]["rms_settled"] != plain["tracking"]["q3"]["rms_settled"]
