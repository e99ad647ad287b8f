"""Metrics taken chunk by chunk: plain numpy's numbers, and the same digits whatever the chunks."""

import math

import numpy as np
import pytest
from engine_runs import run

from fpt_ros.analysis.metrics import Metrics, summary
from fpt_ros.analysis.sizes import Size
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.experiments import experiment
from fpt_ros.runs.chunks import ordered, rows
from fpt_ros.runs.run import Run, Series, describe

INFO = {"experiment": "hand", "variant": "made", "complete": "true", "reason": ""}


def in_chunks(whole, size):
    """The summary of a run that comes so many cycles at a time."""
    metrics = Metrics(whole.parameters)
    count = max(len(series.stamps) for series in whole.topics.values())
    for first in range(0, count, size):
        metrics.take({name: rows(s, first, first + size) for name, s in whole.topics.items()})
    return metrics.result(whole.info, whole.latency)


@pytest.fixture(scope="module")
def late_and_noisy():
    settings = ["plant_simulator.measurement_delay=3", "plant_simulator.noise.position=1e-4"]
    loaded = experiment.load("tora", "nonadaptive", settings, 9.0)
    return Run(describe(loaded, "in_process", ""), loaded.nodes, run(loaded))


@pytest.fixture(scope="module")
def sharing():
    loaded = experiment.load("swing", duration=2.2)
    return Run(describe(loaded, "in_process", ""), loaded.nodes, run(loaded))


def test_numbers_of_a_run_are_those_of_plain_numpy(late_and_noisy):
    whole, found = late_and_noisy, summary(late_and_noisy)
    desired, measured = whole.topics["desired"], whole.topics["joint_states"]
    plant = PlantSimulator(whole.parameters["plant_simulator"])
    generator = np.random.default_rng(plant.values["seed"])
    noise = 1e-4 * generator.standard_normal((plant.cycles, 2 * len(plant.coordinates)))
    for name in ("q3", "q2"):
        at = plant.coordinates.index(name)
        position = measured.column("position", name) - noise[:, at]
        error = desired.column("positions", name)[:-3] - position[3:]
        late = error[4000:]
        expected = {
            "rms": np.sqrt(np.mean(error**2)),
            "max": np.abs(error).max(),
            "rms_settled": np.sqrt(np.mean(late**2)),
            "max_settled": np.abs(late).max(),
        }
        assert found["tracking"][name] == pytest.approx(expected, rel=1e-12, abs=0.0)
    command = whole.topics["command"]
    r = command.vectors["accelerations"][:, 1:]  # q1 is not controlled
    assert found["chatter"] == pytest.approx(
        np.mean(np.linalg.norm(np.diff(r, axis=0), axis=1)), rel=1e-12, abs=0.0
    )
    for name in command.names:
        effort = command.column("effort", name)
        assert found["effort"][name] == pytest.approx(
            {"rms": np.sqrt(np.mean(effort**2)), "max": np.abs(effort).max()}, rel=1e-12, abs=0.0
        )


@pytest.mark.parametrize("size", [1000, 4099, 8192])
def test_the_size_of_a_chunk_changes_no_digit(late_and_noisy, size):
    assert in_chunks(late_and_noisy, size) == summary(late_and_noisy)


def test_with_time_sharing_the_turns_of_others_count_in_chunks_too(sharing):
    assert sharing.topics["desired"].names == ("q1", "q2")
    found = summary(sharing)
    first = sharing.topics["desired"]
    # as the engine gives them: a chunk names the coordinates that had a turn in it
    metrics = Metrics(sharing.parameters)
    count = len(first.stamps)
    for start in range(0, count, 997):
        chunk = {name: rows(s, start, start + 997) for name, s in sharing.topics.items()}
        chunk["desired"] = without_absent(chunk["desired"])
        metrics.take(chunk)
    assert metrics.result(sharing.info) == found
    position = sharing.topics["joint_states"].column("position", "q2")
    nominal = first.column("positions", "q2")
    turn = ~np.isnan(nominal)
    assert 0 < turn.sum() < count
    assert found["tracking"]["q2"]["max"] >= np.abs(nominal[turn] - position[turn]).max()


def without_absent(series):
    had = ~np.isnan(series.vectors["accelerations"]).all(axis=0)
    names = tuple(series.names[i] for i in np.flatnonzero(had))
    return Series(series.stamps, names, {n: m[:, had] for n, m in series.vectors.items()})


def test_lost_messages_change_no_digit_between_chunks(make):
    whole = make("tora", duration=9.0)
    rng = np.random.default_rng(5)
    topics = {}
    for name, series in whole.topics.items():
        kept = rng.random(len(series.stamps)) > 0.1
        vectors = {key: matrix[kept] for key, matrix in series.vectors.items()}
        topics[name] = Series(series.stamps[kept], series.names, vectors)
    lossy = Run(whole.info, whole.parameters, topics)
    metrics = Metrics(lossy.parameters)
    for start in np.arange(0, 9_000_000_000, 700_000_000).tolist():
        chunk = {}
        for name, series in topics.items():
            first, end = np.searchsorted(series.stamps, (start, start + 700_000_000))
            chunk[name] = rows(series, first, end)
        metrics.take(chunk)
    assert metrics.result(lossy.info) == summary(lossy)


def test_a_topic_out_of_order_is_put_in_order(hand_made):
    command = {"accelerations": [[0], [3], [1]], "effort": [[1], [2], [3]]}
    mixed = hand_made({"command": ([0.0, 2.0, 1.0], ["q1"], command)})
    assert summary(mixed)["chatter"] == pytest.approx(1.5)
    assert ordered(mixed.topics)["command"].stamps.tolist() == [0, 10**9, 2 * 10**9]


def test_chatter_steps_over_the_border_of_chunks_and_over_turns(hand_made):
    nan = math.nan
    r = [[1, nan], [2, nan], [nan, 5], [nan, 9], [4, nan]]
    whole = hand_made({"command": ([0, 1, 2, 3, 4], ["q1", "q2"], {"accelerations": r})})
    assert summary(whole)["chatter"] == pytest.approx((1 + 0 + 4 + 0) / 4)
    for size in (1, 2, 3):
        assert in_chunks(whole, size) == summary(whole)


@pytest.mark.parametrize("scale", [1e-200, 1e-3, 1.0, 1e200])
def test_sizes_do_not_overflow_and_do_not_vanish(scale):
    values = np.random.default_rng(3).standard_normal(10_000)
    size = Size()
    for first in range(0, len(values), 999):
        size.add(scale * values[first : first + 999])
    assert size.rms == pytest.approx(scale * np.sqrt(np.mean(values**2)), rel=1e-12, abs=0.0)
    assert size.largest == pytest.approx(scale * np.abs(values).max(), rel=1e-15, abs=0.0)


def test_sizes_of_numbers_that_grow_beyond_all_bounds():
    size = Size()
    size.add(np.zeros(4))
    size.add(np.full(4, 1e-250))
    size.add(np.full(4, 1.0))
    size.add(np.array([math.nan, 1e250]))
    assert size.rms == pytest.approx(1e250 / math.sqrt(13), rel=1e-12)
    size.add(np.array([math.inf]))
    assert (size.rms, size.largest) == (None, None)
    other = Size()
    other.add(np.full(3, 2.0))
    assert other.merged(Size()).rms == 2.0
    assert other.merged(size).rms is None
