"""Filters that users expect, against scipy.signal and closed forms."""

import math

import numpy as np
import pytest
from filter_runs import DT, noise, run, two_sines
from scipy import signal

from fpt_ros.denoising.streaming import FILTERS
from fpt_ros.denoising.streaming.alpha_beta_gamma import ALPHA_BETA_GAMMA
from fpt_ros.denoising.streaming.butterworth import BUTTERWORTH
from fpt_ros.denoising.streaming.high_gain import HIGH_GAIN
from fpt_ros.denoising.streaming.levant import LEVANT
from fpt_ros.denoising.streaming.one_euro import ONE_EURO
from fpt_ros.engine.over_record import over_record
from fpt_ros.errors import BadInput

PEERS = (ALPHA_BETA_GAMMA, BUTTERWORTH, HIGH_GAIN, LEVANT, ONE_EURO)


def parabola(samples):
    t = np.arange(samples) * DT
    return 0.5 * 3.0 * t * t + 2.0 * t + 1.0, 3.0 * t + 2.0


def test_butterworth_is_that_of_scipy():
    q = 5.0 + two_sines(500)[0] + noise(500)
    b, a = signal.butter(2, 20.0, fs=1.0 / DT)
    expected = signal.lfilter(b, a, q, zi=signal.lfilter_zi(b, a) * q[0])[0]
    found = run(BUTTERWORTH, q)[:, 0, 0]
    # the first sample is the initial condition itself
    assert found[1:] == pytest.approx(expected[1:], abs=1e-12)


def test_high_gain_observer_has_its_three_poles_where_it_says():
    q = two_sines(300)[0] + noise(300)
    pole = math.exp(-DT / 0.02)
    # innovations form: from y to the prediction of y, the denominator is (z - p)^3
    found = run(HIGH_GAIN, q, eps=0.02)[1:, 0, 0]
    A = np.array([[1, DT, DT * DT / 2], [0, 1, DT], [0, 0, 1]])
    C = np.array([[1.0, 0, 0]])
    L = signal.place_poles(A.T, C.T, [pole, pole * (1 - 1e-3), pole * (1 + 1e-3)]).gain_matrix.T
    x, expected = np.array([q[0], 0.0, 0.0]), []
    for y in q[1:]:
        expected.append(x[0])
        x = A @ x + L[:, 0] * (y - x[0])
    assert found == pytest.approx(expected, abs=1e-4)


@pytest.mark.parametrize("law", [ALPHA_BETA_GAMMA, HIGH_GAIN])
def test_constant_acceleration_is_followed_exactly(law):
    q, v = parabola(2000)
    out = run(law, q)[-1, :, 0]
    assert out == pytest.approx([q[-1], v[-1], 3.0], rel=1e-6)


def test_levant_is_exact_without_noise():
    q, v, a = two_sines(6000)
    out = run(LEVANT, q, jerk=300.0)[3000:, :, 0]
    assert np.max(np.abs(out[:, 0] - q[3000:])) < 1e-5
    assert np.max(np.abs(out[:, 1] - v[3000:])) < 0.02
    assert np.max(np.abs(out[:, 2] - a[3000:])) < 1.5


def test_one_euro_without_beta_is_an_exponential_filter():
    q = two_sines(400)[0]
    a = 2 * math.pi * 5.0 * DT / (1 + 2 * math.pi * 5.0 * DT)
    expected = signal.lfilter([a], [1, a - 1], q, zi=[(1 - a) * q[0]])[0]
    found = run(ONE_EURO, q, cutoff=5.0, beta=0.0)[:, 0, 0]
    assert found[1:] == pytest.approx(expected[1:], abs=1e-12)


@pytest.mark.parametrize("law", PEERS)
def test_missing_samples_leave_finite_estimates(law):
    q = two_sines(300)[0]
    q[[100, 101, 200]] = math.nan
    assert np.all(np.isfinite(run(law, q)[1:]))


@pytest.mark.parametrize("name", ["kalman_bank", "butterworth", "savgol"])
def test_over_a_record_it_is_the_filter_itself(name):
    q = two_sines(400)[0] + noise(400)
    found = over_record(name, q, DT)
    expected = run(FILTERS[name], q)[:, :, 0]
    for i, each in enumerate((found.value, found.velocity, found.acceleration)):
        assert np.array_equal(each, expected[:, i], equal_nan=True)


def test_delay_of_a_low_pass_is_that_of_its_phase():
    t = np.arange(4000) * DT
    found = over_record("butterworth", np.sin(2 * np.pi * t), DT, cutoff=20.0)
    assert found.delay == pytest.approx(math.sqrt(2) / (2 * math.pi * 20.0), abs=DT)


def test_bad_records_are_refused():
    with pytest.raises(BadInput, match="dt"):
        over_record("savgol", np.zeros(10), 0.0)
    with pytest.raises(BadInput, match="two samples"):
        over_record("savgol", np.array([math.nan, 1.0]), 0.1)
