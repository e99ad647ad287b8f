"""The observer of the disturbance: in the loop, and as a low pass written in another way."""

import math

import numpy as np
import pytest
from engine_runs import settled_rms, topics_of
from scipy.signal import lfilter

from fpt_ros.compensators import COMPENSATORS, Observed
from fpt_ros.parameters import prefixed, resolve

LAW = COMPENSATORS["disturbance_observer"]
ON = "fpt_deformer.compensator.kind=disturbance_observer"


def test_it_takes_away_the_low_pass_of_what_the_effort_does_not_explain():
    rng, g, dt = np.random.default_rng(3), 50.0, 1e-3
    values = resolve(prefixed("compensator", LAW.parameters), {"compensator.cutoff": g}, "test")
    constants = LAW.prepare(values, 1, dt)
    memory = [0.0] * LAW.memory(constants, 1)
    gap, out = rng.standard_normal(400), []
    for x in gap:
        effort, none = [1.0], [0.0]
        seen = Observed(none, none, none, [x + 2.0], [2.0], none, none, none)
        LAW.compensate(constants, memory, dt, seen, effort)
        out.append(effort[0])
    pole = math.exp(-g * dt)  # of a first order low pass, exactly in discrete time
    assert out == pytest.approx(1.0 - lfilter([1.0 - pole], [1.0, -pole], gap), abs=1e-12)


def test_a_response_that_is_not_known_changes_nothing():
    memory, effort, none = [3.0], [1.0], [0.0]
    seen = Observed(none, none, none, [math.nan], [2.0], none, none, none)
    LAW.compensate((0.5,), memory, 1e-3, seen, effort)
    assert (memory, effort) == ([3.0], [-2.0])


def test_it_makes_up_for_a_wrong_model_without_a_transformation():
    """The same computed torque with the same wrong model, with the observer and without."""
    settings = ("trajectory_generator.amplitude=[1.0]",)
    alone = topics_of("vdp_rfpt", "fixed_model_no_rfpt", settings, duration=20.0)
    observed = topics_of("vdp_rfpt", "fixed_model_no_rfpt", (*settings, ON), duration=20.0)
    before, after = settled_rms(alone, 10.0)["q1"], settled_rms(observed, 10.0)["q1"]
    assert after < before / 10.0
