"""The engine against second programs that share no line with it: whole trajectories."""

import independent_tora
import independent_vdp_rfpt
import numpy as np
import pytest

from fpt_ros.loop import engine, experiment
from fpt_ros.loop.run import Collector


def collect(name, variant, duration):
    collector = Collector()
    engine.run(experiment.load(name, variant, duration=duration).loop(), collector)
    return collector.topics()


def assert_same(found, expected, tolerance=1e-9):
    """Relative to the largest value of the column: a zero crossing has no relative error."""
    assert found.shape == expected.shape
    scale = np.abs(expected).max(axis=0)
    assert (scale > 0.0).all()
    assert (np.abs(found - expected).max(axis=0) / scale).max() < tolerance


def columns(series, vector, names):
    return np.column_stack([series.column(vector, name) for name in names])


@pytest.mark.parametrize(
    ("variant", "a", "duration"),
    [("adaptive", -0.1, 16.0), ("nonadaptive", None, 16.0), ("strong", -3.125, 4.0)],
)
def test_tora(variant, a, duration):
    topics = collect("tora", variant, duration)
    record = independent_tora.simulate(a, duration)
    estimate, desired, command = (topics[x] for x in ("state_estimate", "desired", "command"))
    assert_same(columns(estimate, "positions", ("q1", "q2", "q3")), record.q)
    assert_same(columns(command, "accelerations", ("q3", "q2")), record.r)
    assert_same(columns(command, "effort", ("q1", "q2")), record.force)
    error = columns(desired, "positions", ("q3", "q2")) - columns(
        estimate, "positions", ("q3", "q2")
    )
    assert_same(error, record.error)
    assert (command.column("effort", "q3") == 0.0).all()
    assert np.isnan(command.column("accelerations", "q1")).all()


@pytest.mark.parametrize(
    ("variant", "options", "duration"),
    [
        ("adaptive", {"rfpt": True, "alpha": 1.0, "amplitude": 100.0}, 20.0),
        ("fixed_model", {"rfpt": True, "alpha": None, "amplitude": 100.0}, 20.0),
        ("undisturbed", {"rfpt": True, "alpha": 1.0, "amplitude": 0.0}, 10.0),
        ("fixed_model_no_rfpt", {"rfpt": False, "alpha": None, "amplitude": 100.0}, 10.0),
        ("no_rfpt", {"rfpt": False, "alpha": 1.0, "amplitude": 100.0}, 2.0),
    ],
)
def test_vdp_rfpt(variant, options, duration):
    topics = collect("vdp_rfpt", variant, duration)
    record = independent_vdp_rfpt.simulate(duration=duration, **options)
    estimate, command = topics["state_estimate"], topics["command"]
    assert_same(columns(estimate, "positions", ("q1",)), record.q)
    assert_same(columns(command, "accelerations", ("q1",)), record.r)
    assert_same(columns(command, "effort", ("q1",)), record.force)
    assert ("tuning" in topics) is (options["alpha"] is not None)
    if "tuning" in topics:
        names = ("m", "mu", "mu_c", "k", "beta", "lambda")
        assert_same(columns(topics["tuning"], "values", names), record.theta)


def test_the_independent_programs_give_the_known_constants():
    """So that a mistake shared by both would need the figures of the thesis to be wrong too."""
    attractive, repulsive = independent_tora.fixed_points()
    assert attractive == pytest.approx(0.7130913716914226, abs=2e-15)
    assert repulsive == pytest.approx(-0.1130913716914226, abs=2e-15)
    shape = 0.3 * independent_tora.SHAPE
    rate = independent_tora.nominal(0.0, shape, independent_tora.second_derivatives(shape))[1]
    assert rate == pytest.approx(0.462857, abs=5e-7)
    peak = max(abs(independent_vdp_rfpt.disturbance(t)) for t in np.arange(0, 12, 1e-3))
    assert peak == pytest.approx(0.83592, abs=1e-5)
