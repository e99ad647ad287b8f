"""A run as arrays."""

import math

import numpy as np
import pytest
from engine_runs import stage_by_stage, topics_of
from frames_collected import Collector

from fpt_ros.engine.engine import Engine
from fpt_ros.experiments import experiment
from fpt_ros.messages.frames import Desired, Tuning
from fpt_ros.messages.topics import DESIRED, LOOP_TOPICS, TUNING
from fpt_ros.runs.chunks import frames
from fpt_ros.runs.run import Run, describe

NAN = math.nan


def desired(stamp, names, numbers):
    return Desired(stamp, names, numbers, *([f * x for x in numbers] for f in (10.0, -1.0, 2.0)))


def test_a_collected_run_has_every_frame_of_every_topic():
    loaded = experiment.load("vdp_rfpt", duration=0.02)
    collector, frames = Collector(), []

    def observe(topic, frame):
        collector(topic, frame)
        frames.append((topic, frame))

    stage_by_stage(loaded.loop(), observe)
    run = Run(describe(loaded, "in_process", ""), loaded.nodes, collector.topics())
    check(run, frames)


def test_a_run_of_the_engine_has_every_frame_of_every_topic():
    loaded = experiment.load("vdp_rfpt", duration=0.02)
    engine = Engine(loaded.loop())
    engine.run()
    check(
        Run(describe(loaded, "in_process", ""), loaded.nodes, engine.topics()),
        list(frames(engine.topics())),
    )


def check(run, frames):
    assert list(run.topics) == [topic.name for topic in LOOP_TOPICS]
    for topic in LOOP_TOPICS:
        series = run.topics[topic.name]
        own = [frame for each, frame in frames if each is topic]
        assert (
            series.stamps.tolist()
            == [frame.stamp for frame in own]
            == [k * 1_000_000 for k in range(20)]
        )
        assert series.time == pytest.approx(np.arange(20) * 1e-3, abs=1e-15)
        assert tuple(series.vectors) == topic.vectors
        for i, vector in enumerate(topic.vectors):
            expected = np.array([frame[2 + i] for frame in own])
            assert series.vectors[vector].shape == (20, len(series.names))
            assert np.array_equal(series.vectors[vector], expected, equal_nan=True)
    assert run.info["experiment"] == "vdp_rfpt"
    assert (run.info["complete"], run.info["reason"]) == ("true", "")


def test_a_run_with_a_reason_is_not_complete():
    loaded = experiment.load("vdp_rfpt", duration=0.02)
    assert describe(loaded, "graph", "diverged")["complete"] == "false"


def test_names_that_change_from_cycle_to_cycle():
    """Time sharing: NaN where a frame lacks the column; new columns at the end."""
    collector = Collector()
    collector(DESIRED, desired(0, ("q1",), [1.0]))
    collector(DESIRED, desired(1, ("q2",), [2.0]))
    collector(DESIRED, desired(2, ("q2", "q1"), [3.0, 4.0]))
    collector(DESIRED, desired(3, ("q1",), [5.0]))
    collector(DESIRED, desired(4, ("q3", "q1"), [6.0, 7.0]))
    series = collector.topics()["desired"]
    assert series.names == ("q1", "q2", "q3")
    expected = np.array(
        [[1.0, NAN, NAN], [NAN, 2.0, NAN], [4.0, 3.0, NAN], [5.0, NAN, NAN], [7.0, NAN, 6.0]]
    )
    assert np.array_equal(series.vectors["positions"], expected, equal_nan=True)
    assert np.array_equal(series.vectors["velocities"], 10.0 * expected, equal_nan=True)
    assert np.array_equal(series.vectors["accelerations"], -expected, equal_nan=True)
    assert series.stamps.tolist() == [0, 1, 2, 3, 4]
    assert np.array_equal(series.column("positions", "q2"), expected[:, 1], equal_nan=True)


def test_what_was_collected_so_far_does_not_stop_the_collecting():
    collector = Collector()
    collector(TUNING, Tuning(0, ("A",), [1.0]))
    early = collector.topics()["tuning"]
    collector(TUNING, Tuning(1, ("A",), [2.0]))
    collector(TUNING, Tuning(2, ("B",), [3.0]))
    assert early.vectors["values"].tolist() == [[1.0]]
    late = collector.topics()["tuning"]
    assert late.column("values", "A").tolist()[:2] == [1.0, 2.0]
    assert late.stamps.tolist() == [0, 1, 2]


def test_a_topic_that_nobody_published_is_absent():
    assert Collector().topics() == {}
    assert "tuning" not in topics_of("tora", duration=0.002)
    collector = Collector()
    stage_by_stage(experiment.load("tora", duration=0.002).loop(), collector)
    assert "tuning" not in collector.topics()


def test_columns_are_found_by_name():
    series = topics_of("tora", duration=0.005)["desired"]
    assert series.names == ("q3", "q2")
    first = series.vectors["velocities"][0]
    assert series.column("velocities", "q3")[0] == first[0] == pytest.approx(0.462857, abs=5e-7)
    assert series.column("velocities", "q2")[0] == first[1] == pytest.approx(0.771429, abs=5e-7)
    with pytest.raises(ValueError, match="not in tuple"):
        series.column("velocities", "q9")
