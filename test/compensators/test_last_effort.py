"""Time delay control and INDI: what was exerted, and what the response lacks."""

import math
from itertools import pairwise

import numpy as np
import pytest
from engine_runs import settled_rms, topics_of

from fpt_ros.compensators import COMPENSATORS, Observed
from fpt_ros.errors import BadInput
from fpt_ros.parameters import prefixed, resolve

NONE = [0.0]


def values(name, **given):
    own = prefixed("compensator", COMPENSATORS[name].parameters)
    return resolve(own, {f"compensator.{key}": value for key, value in given.items()}, "test")


def test_time_delay_control_finds_an_unknown_force():
    """A mass of 2 kg under 7 N, m = 0.5 kg: each cycle keeps 1 - 0.5 / 2 of what is missing."""
    law = COMPENSATORS["time_delay"]
    constants = law.prepare(values("time_delay", inertia=[1.0], factor=0.5), 1, 1e-3)
    effort, missing, memory = 0.0, [], [0.0]
    for _ in range(20):
        response = (effort + 7.0) / 2.0
        missing.append(3.0 - response)
        out = [99.0]
        law.compensate(
            constants,
            memory,
            1e-3,
            Observed(NONE, NONE, [response], NONE, [effort], [3.0], NONE, NONE),
            out,
        )
        effort = out[0]
    for before, after in pairwise(missing):
        assert after == pytest.approx(0.75 * before)


def test_indi_adds_what_the_model_says():
    law, out = COMPENSATORS["incremental"], [10.0]
    seen = Observed(NONE, NONE, NONE, [4.0], [1.0], NONE, NONE, NONE)
    law.compensate((), [0.0], 1e-3, seen, out)
    assert out == [7.0]


@pytest.mark.parametrize("name", ["time_delay", "incremental"])
def test_the_models_effort_stays_until_a_response_is_known(name):
    out, nan = [10.0], [math.nan]
    COMPENSATORS[name].compensate(
        (1.0,), [0.0], 1e-3, Observed(NONE, NONE, nan, nan, [1.0], [3.0], NONE, NONE), out
    )
    assert out == [10.0]


@pytest.mark.parametrize("name", ["time_delay", "incremental"])
def test_a_response_that_is_lost_later_leaves_the_effort(name):
    law, memory, nan = COMPENSATORS[name], [0.0], [math.nan]
    for response in ([4.0], nan):
        out = [10.0]
        seen = Observed(NONE, NONE, response, response, [1.0], [3.0], NONE, NONE)
        law.compensate((1.0,), memory, 1e-3, seen, out)
    assert out == [1.0]


LOST = (
    "plant_simulator.sensors.kinds=[lost]",
    "plant_simulator.sensors.lost.probability=0.01",
    "plant_simulator.sensors.lost.together=true",
)


@pytest.mark.parametrize("variant", ["time_delay", "indi", "momentum_observer"])
def test_lost_samples_cost_little(variant):
    """1 % of them, in an arm whose model knows half of its weight: no effort falls back to it."""
    pytest.importorskip("mujoco")
    runs = [topics_of("panda", variant, settings, 3.5) for settings in ((), LOST)]
    whole, holes = (settled_rms(topics, 2.5) for topics in runs)
    for joint, error in whole.items():
        assert holes[joint] < 1.5 * error
    steps = [np.abs(np.diff(topics["command"].vectors["effort"], axis=0)).max() for topics in runs]
    assert steps[1] < 2.0 * steps[0]


def test_an_inertia_for_each_coordinate():
    with pytest.raises(BadInput, match="inertia: 1 given, 2 needed"):
        COMPENSATORS["time_delay"].prepare(values("time_delay", inertia=[1.0]), 2, 1e-3)
