"""The external force of the van der Pol experiments."""

import numpy as np
import pytest
from scipy.interpolate import BSpline

from fpt_ros.disturbances import DISTURBANCES

FORCE = DISTURBANCES["bspline"].force
POINTS = np.array([0, 30, 60, 20, -40, -70, -30, 10, 50, 40, -20, -50]) / 70.0


def curve(t, amplitude=1.0, frequency=1.0):
    return np.array([FORCE((amplitude, frequency), [], x, 1e-3, 0.3, -0.4) for x in t])


def test_peak_and_rms():
    values = curve(np.arange(0.0, 12.0, 1e-3), amplitude=100.0)
    assert np.abs(values).max() == pytest.approx(83.592, abs=1e-3)
    assert np.sqrt(np.mean(values**2)) == pytest.approx(47.716, abs=1e-3)


def test_period_of_twelve_knots():
    t = np.linspace(0.0, 12.0, 97)
    assert curve(t + 24.0) == pytest.approx(curve(t), abs=1e-13)
    for shorter in (2.0, 3.0, 4.0, 6.0):
        assert np.abs(curve(t + shorter) - curve(t)).max() > 0.3


def test_frequency_scales_time():
    t = np.linspace(0.0, 12.0, 97)
    assert curve(t / 2.0, frequency=2.0) == pytest.approx(curve(t), abs=1e-14)


def test_it_is_the_uniform_cubic_b_spline_of_its_control_points():
    knots = np.arange(-3.0, 16.0)
    reference = BSpline(knots, np.r_[POINTS, POINTS[:3]], 3)
    t = np.linspace(0.0, 11.999, 500)
    assert curve(t) == pytest.approx(reference(t), abs=1e-14)


@pytest.mark.parametrize("knot", range(1, 13))
def test_value_slope_and_curvature_are_continuous_at_a_knot(knot):
    limits = []
    for side in (-1.0, 1.0):
        s = side * np.array([0.2, 0.4, 0.6, 0.8])
        piece = np.polynomial.Polynomial.fit(s, curve(knot + s), 3).convert()
        limits.append([piece(0.0), piece.deriv()(0.0), piece.deriv(2)(0.0)])
    assert limits[0] == pytest.approx(limits[1], abs=1e-10)


def test_none_is_no_force():
    assert DISTURBANCES["none"].force((100.0, 1.0), [], 3.3, 1e-3, 1.0, 1.0) == 0.0


def sine_noise(amplitude, frequency, noise, seed, cycles, dt=0.01):
    law = DISTURBANCES["sine_noise"]
    values = {
        "disturbance.amplitude": amplitude,
        "disturbance.frequency": frequency,
        "disturbance.noise": noise,
        "dt": dt,
    }
    constants = law.prepare(values, seed, cycles)
    return np.array([law.force(constants, [], k * dt, dt, 0.0, 0.0) for k in range(cycles)])


def test_sine_noise_is_a_sine_and_one_number_a_cycle():
    """As the experiment has it: drawn at once from numpy's generator with the seed of the run."""
    t = np.arange(20_000) * 0.01
    expected = 0.15 * np.sin(4.0 * t)
    expected += np.random.default_rng(12345).uniform(-0.15, 0.15, 20_000)
    found = sine_noise(0.15, 4.0, 0.15, 12345, 20_000)
    assert found == pytest.approx(expected, abs=1e-15)


def test_the_noise_of_a_shorter_run_is_the_beginning_of_that_of_a_longer_one():
    assert (sine_noise(1, 4, 0.1, 7, 50) == sine_noise(1, 4, 0.1, 7, 500)[:50]).all()
    assert not (sine_noise(1, 4, 0.1, 7, 50) == sine_noise(1, 4, 0.1, 8, 50)).any()
