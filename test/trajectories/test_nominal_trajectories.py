"""Nominal trajectories: each derivative is that of what stands before it."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from fpt_ros.errors import BadInput
from fpt_ros.trajectories import TRAJECTORIES, spline

TIMES = st.floats(0.0, 50.0)


def nominal(name, amplitude, frequency, t, **own):
    trajectory, n = TRAJECTORIES[name], len(amplitude)
    values = {parameter.name: parameter.default for parameter in trajectory.parameters}
    values |= {"amplitude": amplitude, "frequency": frequency, **own}
    q, v, a = [math.nan] * n, [math.nan] * n, [math.nan] * n
    constants = trajectory.prepare(values, n)
    trajectory.nominal(constants, list(trajectory.state), t, 0.0, q, v, a)
    return np.array([q, v, a])


def test_all_registered_trajectories_are_tested_here():
    here = {"constant", "cosines", "sine", "spline"}
    integrated = {"fitzhugh_nagumo", "duffing", "lorenz", "stimulated_neuron"}
    of_use = {"chirp", "minimum_jerk", "recorded", "step", "waypoints"}
    of_tips = {"cartesian_path", "inverse_kinematics"}
    files_of_their_own = {"blended_sines", "live", "receding_horizon"} | of_tips
    elsewhere = integrated | of_use | files_of_their_own
    assert set(TRAJECTORIES.names()) == here | elsewhere


@settings(deadline=None)
@given(st.sampled_from(["sine", "spline"]), TIMES, st.floats(0.2, 3.0))
def test_rate_and_acceleration_are_the_derivatives(name, t, frequency):
    amplitude, frequencies, step = (0.3, 0.5), (frequency, 1.0), 1e-5
    _, v, a = nominal(name, amplitude, frequencies, t)
    before = nominal(name, amplitude, frequencies, t - step)
    after = nominal(name, amplitude, frequencies, t + step)
    difference = (after - before) / (2.0 * step)
    # the spline's third derivative jumps at a knot by at most 5 w^3: order one there, two elsewhere
    assert difference[0] == pytest.approx(v, abs=1e-8)
    assert difference[1] == pytest.approx(a, abs=1e-3)


@settings(deadline=None)
@given(st.sampled_from(["sine", "spline"]), TIMES, st.floats(-3.0, 3.0), st.floats(0.1, 3.0))
def test_amplitude_scales_and_frequency_stretches_time(name, t, amplitude, frequency):
    scaled = nominal(name, (amplitude,), (frequency,), t)[:, 0]
    unit = nominal(name, (1.0,), (1.0,), frequency * t)[:, 0]
    factors = amplitude * frequency ** np.arange(3)
    assert scaled == pytest.approx(factors * unit, rel=1e-9, abs=1e-9)


OWN = {
    "sine": {"offset": [0.5, -1.0]},
    "cosines": {
        "offset": [0.5, 1.5],
        "second_amplitude": [0.1, 0.2],
        "second_frequency": [5.0, 6.0],
    },
}


@settings(deadline=None)
@given(st.sampled_from(sorted(OWN)), TIMES)
def test_rate_and_acceleration_are_the_derivatives_with_offset_and_second_tone(name, t):
    amplitude, frequency, step = (0.2, 0.3), (2.0, 3.0), 1e-5
    _, v, a = nominal(name, amplitude, frequency, t, **OWN[name])
    before, after = (
        nominal(name, amplitude, frequency, x, **OWN[name]) for x in (t - step, t + step)
    )
    difference = (after - before) / (2.0 * step)
    assert difference[0] == pytest.approx(v, abs=1e-8)
    assert difference[1] == pytest.approx(a, abs=1e-7)


def test_cosines_begin_at_their_offset_at_rest():
    q, v, a = nominal("cosines", (0.2, 0.2), (2.0, 3.0), 0.0, **OWN["cosines"])
    assert q.tolist() == [0.5, 1.5]
    assert v.tolist() == [0.0, 0.0]
    assert a == pytest.approx([0.2 * 4.0 + 0.1 * 25.0, 0.2 * 9.0 + 0.2 * 36.0])


def test_cosines_of_the_coupled_masses():
    """q1 = 0.5 + 0.2 (1 - cos 2t) + 0.1 (1 - cos 5t) (section 2.5)."""
    t = 0.83
    q, _, _ = nominal("cosines", (0.2, 0.2), (2.0, 3.0), t, **OWN["cosines"])
    assert q[0] == pytest.approx(
        0.5 + 0.2 * (1 - math.cos(2 * t)) + 0.1 * (1 - math.cos(5 * t)), rel=1e-15
    )


def test_an_offset_only_moves_the_sine():
    here, there = (nominal("sine", (0.3,), (2.0,), 0.7, offset=x) for x in ([], [1.5]))
    assert (there - here)[:, 0] == pytest.approx([1.5, 0.0, 0.0], abs=1e-15)


def test_a_list_of_another_length_is_refused():
    with pytest.raises(BadInput, match=r"trajectory_generator.offset: 1 numbers given, 2 needed"):
        nominal("sine", (0.3, 0.3), (2.0, 2.0), 0.7, offset=[1.5])


def test_a_constant_is_its_amplitude_at_rest():
    for t in (0.0, 7.0):
        q, v, a = nominal("constant", (-2.0, 3.0), (1.0, 1.0), t)
        assert q.tolist() == [-2.0, 3.0]
        assert v.tolist() == a.tolist() == [0.0, 0.0]


def test_sine():
    q, v, a = nominal("sine", (1.5,), (2.0,), 0.7)[:, 0]
    assert q == pytest.approx(1.5 * math.sin(1.4), rel=1e-15)
    assert v == pytest.approx(3.0 * math.cos(1.4), rel=1e-15)
    assert a == pytest.approx(-6.0 * math.sin(1.4), rel=1e-15)


def test_spline_starts_with_the_known_rates():
    q, v, a = nominal("spline", (0.3, 0.5), (1.0, 1.0), 0.0)
    assert q == pytest.approx([0.0, 0.0], abs=1e-15)
    assert v == pytest.approx([0.462857, 0.771429], abs=5e-7)
    assert a == pytest.approx([0.0, 0.0], abs=1e-14)


def test_spline_goes_through_its_knots_and_is_periodic():
    shape = [0, 0.7, 1, 0.7, 0, -0.7, -1, -0.7]
    for i in range(20):
        q, _, _ = nominal("spline", (1.0,), (1.0,), 0.5 * i)
        assert q[0] == pytest.approx(shape[i % 8], abs=1e-15)
    for t in np.linspace(0.01, 3.99, 37):
        here, later = (nominal("spline", (1.0,), (1.0,), x) for x in (t, t + 12.0))
        assert later == pytest.approx(here, abs=1e-12)


@pytest.mark.parametrize("knot", range(9))
def test_spline_is_c2_at_its_knots(knot):
    """Left and right limits agree within the third derivative's share, which jumps."""
    step = 1e-9
    left = nominal("spline", (1.0,), (1.0,), 0.5 * knot + 4.0 - step)
    right = nominal("spline", (1.0,), (1.0,), 0.5 * knot + 4.0 + step)
    assert left == pytest.approx(right, abs=1e-7)


def test_spline_agrees_with_scipy():
    knots = np.arange(9) * 0.5
    values = [0, 0.7, 1, 0.7, 0, -0.7, -1, -0.7, 0]
    reference = CubicSpline(knots, values, bc_type="periodic")
    for t in np.linspace(0.0, 11.9, 241):
        expected = [0.3 * reference(t % 4.0, order) for order in range(3)]
        assert nominal("spline", (0.3,), (1.0,), t)[:, 0] == pytest.approx(expected, abs=1e-12)


def test_spline_is_defined_right_before_its_period_ends():
    """t % PERIOD can round up to the last knot."""
    q, v, _ = nominal("spline", (1.0,), (1.0,), -1e-18)
    assert q[0] == pytest.approx(0.0, abs=1e-12)
    assert v[0] == pytest.approx(0.462857 / 0.3, abs=2e-6)
    assert spline.PERIOD == 4.0
