"""Runs that pass through all that a loop can do, and what it means that two of them are equal."""

import numpy as np
from engine_runs import stage_by_stage
from frames_collected import Collector

from fpt_ros.engine.engine import Engine
from fpt_ros.errors import Diverged
from fpt_ros.experiments import experiment

CYCLES = 400

SHORTENED = {
    "coupled_masses": {
        "fpt_deformer": {"adaptive_from": 0.1},
        "parameter_tuner": {"tune_from": 0.15},
    },
    "swing": {"trajectory_generator": {"time_sharing": [0.01, 0.0055]}},
}
"""What makes a short run pass through all that a long one does."""


def load(name, variant, settings=(), cycles=CYCLES, seed=3):
    """An experiment of at most ``cycles`` cycles that passes through everything."""
    loaded = experiment.load(name, variant, settings, seed=seed)
    for node, values in SHORTENED.get(name, {}).items():
        known = {key: value for key, value in values.items() if key in loaded.nodes[node]}
        loaded = loaded.with_values(node, **known)
    plant = loaded.nodes["plant_simulator"]
    duration = min(plant["duration"], cycles * plant["dt"])
    return loaded.with_values("plant_simulator", duration=duration)


def finished(loop, compile_laws=True):
    """Topics of an engine's run, and what ended it."""
    engine = Engine(loop, compile_laws)
    error = None
    try:
        engine.run()
    except Diverged as caught:
        error = str(caught)
    return engine, error


def bits(matrix):
    return np.ascontiguousarray(matrix).view(np.uint64)


def assert_identical(found, expected):
    """NaN is NaN whatever its payload; of all other numbers every bit counts."""
    assert list(found) == list(expected)
    for topic, series in expected.items():
        ours = found[topic]
        assert ours.names == series.names, topic
        assert np.array_equal(ours.stamps, series.stamps), topic
        assert list(ours.vectors) == list(series.vectors), topic
        for vector, numbers in series.vectors.items():
            same = bits(ours.vectors[vector]) == bits(numbers)
            both_nan = np.isnan(ours.vectors[vector]) & np.isnan(numbers)
            wrong = np.argwhere(~(same | both_nan))
            assert wrong.size == 0, (topic, vector, wrong[0], len(wrong))


def assert_engine_equals_stages(loaded):
    engine, ended = finished(loaded.loop())
    collector, error = Collector(), None
    try:
        stage_by_stage(loaded.loop(), collector)
    except Diverged as caught:
        error = str(caught)
    assert ended == error
    assert_identical(engine.topics(), collector.topics())
    return engine
