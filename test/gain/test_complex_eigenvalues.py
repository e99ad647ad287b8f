"""Complex eigenvalues turn the response error; a recommended gain is never worse than the given."""

import numpy as np
import pytest
from engine_runs import topics_of

from fpt_ros.experiments.experiment import load
from fpt_ros.gain.bands import CIRCLES, SPIRAL
from fpt_ros.gain.contraction import bounds
from fpt_ros.gain.trial import try_out

SPIRALLING = tuple(
    f"plant_simulator.exact.{name}={value}"
    for name, value in (("m11", 1.0), ("m12", -1.0), ("m21", 1.0), ("m22", 1.0))
)
"""J has the eigenvalues 1 +- i."""


def errors(A, cycles=4000):
    """Size of the response error of the bare iteration, cycle by cycle, from close by."""
    near = "trajectory_generator.amplitude=[1.001, -0.999]"  # f(r0) is (1, -1)
    settings = (*SPIRALLING, near, f"fpt_deformer.A={A}")
    topics = topics_of("mimo_affine", settings=settings, duration=float(cycles))
    wanted = topics["desired"].vectors["accelerations"]
    found = topics["state_estimate"].vectors["accelerations"]
    return np.linalg.norm((found - wanted)[1:], axis=1)


def test_the_bound_is_that_of_the_circle():
    found = bounds(load("mimo_affine", settings=SPIRALLING))
    # |1 + A slope (1 +- i)| < 1 where A slope > -2 Re / |1 + i|^2 = -1
    assert found.linear_limit == pytest.approx(1.0 / found.slope, rel=1e-9)
    assert found.linear_limit == pytest.approx(1.58045, rel=1e-5)
    assert found.turn == pytest.approx(np.pi / 4)
    assert [band.name for band in found.bands] == [SPIRAL, CIRCLES]


def test_just_inside_it_decays_and_just_outside_it_circles():
    limit = bounds(load("mimo_affine", settings=SPIRALLING)).linear_limit
    assert errors(-0.98 * limit)[-1] < 1e-9
    circling = errors(-1.02 * limit)[-200:]
    assert circling.min() > 1e-3
    assert circling.max() < 10.0


def test_the_fastest_gain_is_half_of_the_bound():
    limit = bounds(load("mimo_affine", settings=SPIRALLING)).linear_limit
    steps = {part: np.argmax(errors(-part * limit, 300) < 1e-9) for part in (0.3, 0.5, 0.7)}
    assert steps[0.5] < min(steps[0.3], steps[0.7])


def test_a_recommended_gain_is_never_worse_than_the_given_one():
    """Duffing: 0.8 of the monotone limit has 1.47e-3, the 1e-5 of the file 1.305e-3."""
    experiment = load("duffing")
    _, tried = try_out(experiment, bounds(experiment))
    assert tried["A"] == 1e-5
    assert tried["rejected"] == pytest.approx(7.9e-6)
    assert tried["given"]["ratio"] == pytest.approx(1.47e-3 / 1.305e-3, rel=2e-3)
    assert tried["tracking"]["q1"]["rms_settled"] == pytest.approx(1.305e-3, rel=1e-3)
