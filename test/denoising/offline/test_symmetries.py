"""Scale, sign, offset and the direction of time of a record change the result by just that."""

import numpy as np
import pytest

from fpt_ros.denoising import signals
from fpt_ros.denoising.offline import DENOISERS, denoise
from fpt_ros.errors import BadInput

SYMMETRIC = ("savgol", "savgol_bank")
METHODS = tuple(name for name in DENOISERS.names() if name != "auto")


def record(name="doppler", n=256):
    y = signals.clean(name, n) + signals.impulsive_noise(signals.clean(name, n), 0.3, 1)
    return np.round(y * 2**20) / 2**20  # so that powers of two and offsets round nothing


@pytest.mark.parametrize("method", [*METHODS, "auto"])
def test_powers_of_two_scale_exactly(method):
    y = record()
    expected = denoise(y, method).estimate
    np.testing.assert_array_equal(denoise(y * 2.0**-40, method).estimate * 2.0**40, expected)


@pytest.mark.parametrize("method", [*METHODS, "auto"])
def test_any_scale_and_sign(method):
    y = record()
    np.testing.assert_allclose(
        denoise(-3.7e3 * y, method).estimate / -3.7e3, denoise(y, method).estimate, atol=2e-2
    )


@pytest.mark.parametrize("method", [m for m in METHODS if m != "median_savgol"])
def test_offset(method):
    y = record()
    # median_savgol is scipy's medfilt, which takes 0 beyond the ends
    moved = denoise(y + 64.0, method).estimate - 64.0
    np.testing.assert_allclose(moved, denoise(y, method).estimate, atol=2e-2)


@pytest.mark.parametrize("method", SYMMETRIC)
def test_reversed_time(method):
    y = record()
    np.testing.assert_allclose(
        denoise(y[::-1], method).estimate[::-1], denoise(y, method).estimate, atol=1e-9
    )


def test_auto_is_nearly_the_same_with_an_offset():
    y = record()
    found = denoise(y)
    difference = denoise(y + 64.0).estimate - 64.0 - found.estimate
    assert np.sqrt(np.mean(difference**2)) < 0.1 * found.sigma


def test_auto_is_nearly_the_same_in_reversed_time():
    y = record("heavisine", 512)
    difference = denoise(y[::-1]).estimate[::-1] - denoise(y).estimate
    assert np.sqrt(np.mean(difference**2)) < 0.1 * denoise(y).sigma


# derivatives and unequal steps


@pytest.mark.parametrize("method", ["auto", "savgol"])
def test_derivatives_by_time(method):
    dt = 0.01
    t = dt * np.arange(600)
    y = np.sin(2 * t) + signals.white_noise(600, 0.01, 2)
    velocity = denoise(y, method, dt=dt, derivative=1).derivative
    acceleration = denoise(y, method, t=t, derivative=2).derivative
    inside = slice(60, -60)
    assert signals.rmse(2 * np.cos(2 * t)[inside], velocity[inside]) < 0.05
    assert signals.rmse(-4 * np.sin(2 * t)[inside], acceleration[inside]) < 0.6


def test_no_derivative_unless_asked_for():
    assert denoise(record()).derivative is None
    with pytest.raises(BadInput, match="derivative = 3 is not valid: it takes 0, 1 or 2"):
        denoise(record(), derivative=3)


def test_unequal_steps_are_used():
    rng = np.random.default_rng(3)
    t = np.sort(rng.uniform(0, 10, 400))
    f = np.sin(2 * t)
    y = f + 0.2 * rng.standard_normal(400)
    found = denoise(y, t=t, derivative=1)
    assert signals.rmse(f, found.estimate) < 0.06
    inside = (t > 1) & (t < 9)
    assert signals.rmse(2 * np.cos(2 * t)[inside], found.derivative[inside]) < 0.4


@pytest.mark.parametrize(
    ("t", "words"),
    [
        (np.arange(50.0), "there are 50 times for 256 samples"),
        (np.arange(256.0)[::-1], "times have to ascend: at index 1"),
        (np.where(np.arange(256) == 9, np.nan, np.arange(256.0)), r"1 times are missing.*index 9"),
    ],
)
def test_bad_times(t, words):
    with pytest.raises(BadInput, match=words):
        denoise(record(), t=t)


def test_methods_of_equal_steps_refuse_others():
    t = np.cumsum(np.random.default_rng(4).uniform(0.5, 2, 256))
    with pytest.raises(BadInput, match=r"savgol needs equal steps of time.*take auto, or resample"):
        denoise(record(), "savgol", t=t)


def test_jitter_of_a_clock_is_no_unequal_step():
    t = 0.01 * np.arange(256) + 1e-5 * np.random.default_rng(5).uniform(-1, 1, 256)
    assert np.isfinite(denoise(record(), "savgol", t=t).estimate).all()
