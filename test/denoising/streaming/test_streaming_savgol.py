"""Savitzky-Golay filters at the newest sample: exact on polynomials, figures with noise."""

import math

import numpy as np
import pytest
from filter_runs import DT, bang_bang, constants_of, noise, rms, run, two_sines
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising.streaming.adaptive_savgol import ADAPTIVE_SAVGOL
from fpt_ros.denoising.streaming.savgol import SAVGOL
from fpt_ros.errors import BadInput

coefficients = st.lists(st.floats(-10.0, 10.0), min_size=3, max_size=6)


def polynomial(coefficients, samples, dt):
    """Value and first two derivatives of the sum of c_i (t/T)^i, T the length of the record."""
    span = samples * dt
    c = np.polynomial.Polynomial(np.array(coefficients))
    u = np.arange(samples) / samples
    return c(u), c.deriv(1)(u) / span, c.deriv(2)(u) / span**2


@settings(deadline=None, max_examples=30)
@given(coefficients, st.sampled_from([7, 15, 41]), st.sampled_from([1e-3, 0.2]))
def test_polynomials_are_reproduced_with_their_derivatives(coefficients, window, dt):
    degree = len(coefficients) - 1
    exact = polynomial(coefficients, 2 * window, dt)
    out = run(SAVGOL, exact[0], dt, window=window, degree=degree)[window - 1 :, :, 0]
    size = max(1.0, *map(abs, coefficients))
    for i in range(3):
        unit = size / dt**i  # of the roundings of q in a difference quotient
        assert np.max(np.abs(out[:, i] - exact[i][window - 1 :])) < 1e-10 * unit


@settings(deadline=None, max_examples=20)
@given(st.lists(st.floats(-10.0, 10.0), min_size=2, max_size=3))
def test_a_bank_reproduces_what_all_its_members_do(coefficients):
    windows, degrees = [9.0, 15.0, 31.0], [2.0, 3.0, 4.0]
    exact = polynomial(coefficients, 80, DT)
    out = run(ADAPTIVE_SAVGOL, exact[0], windows=windows, degrees=degrees)[31:, :, 0]
    for i in range(3):
        assert np.max(np.abs(out[:, i] - exact[i][31:])) < 1e-10 * 10.0 / DT**i


def test_it_is_the_least_squares_fit_of_the_last_samples():
    q = noise(100, sigma=1.0)
    out = run(SAVGOL, q, dt=0.1, window=21, degree=4)[:, :, 0]
    t = 0.1 * np.arange(-20, 1)
    for k in (20, 57, 99):
        fit = np.polynomial.Polynomial.fit(t, q[k - 20 : k + 1], 4)
        expected = [fit(0.0), fit.deriv(1)(0.0), fit.deriv(2)(0.0)]
        assert out[k] == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_one_member_is_the_plain_filter():
    q = two_sines(300)[0] + noise(300)
    bank = run(ADAPTIVE_SAVGOL, q, windows=[41.0], degrees=[3.0])[1:]
    plain = run(SAVGOL, q, window=41, degree=3)[1:]
    for i, unit in enumerate((1.0, 1e3, 1e6)):
        assert bank[:, i] == pytest.approx(plain[:, i], abs=1e-13 * unit)


def test_the_bank_is_better_than_any_member_when_the_motion_is_of_two_kinds():
    motions = [(signal(2500), noise(2500, seed=3)) for signal in (two_sines, bang_bang)]

    def errors(law, **given):
        out = [run(law, clean[0] + e, **given)[:, :, 0] for clean, e in motions]
        return [
            rms([x[1000:, i] - clean[i][1000:] for x, (clean, _) in zip(out, motions, strict=True)])
            for i in (1, 2)
        ]

    bank = errors(ADAPTIVE_SAVGOL)
    for window, degree in ((51, 2), (101, 3), (141, 3), (251, 4), (361, 5)):
        member = errors(SAVGOL, window=window, degree=degree)
        assert bank[0] < member[0]
        assert bank[1] < member[1]


def test_the_longer_window_of_the_higher_degree_differentiates_better():
    """Section 3: degree 3 with 35 samples is 18 times worse in q'' than with 141."""
    clean = two_sines(3000)
    q = clean[0] + noise(3000)
    error = {
        (w, d): rms(run(SAVGOL, q, window=w, degree=d)[1000:, 2, 0] - clean[2][1000:])
        for w, d in ((35, 3), (141, 3), (251, 4), (361, 5))
    }
    assert 14 < error[35, 3] / error[141, 3] < 22
    assert error[141, 3] > error[251, 4] > error[361, 5]


@pytest.mark.parametrize("law", [SAVGOL, ADAPTIVE_SAVGOL])
def test_a_missing_sample_is_replaced_by_what_was_expected(law):
    clean = two_sines(1500)
    q = clean[0] + noise(1500, seed=6)
    whole = run(law, q)
    q[[900, 901, 1100]] = math.nan
    out = run(law, q)
    assert np.all(np.isfinite(out[1:]))
    assert np.max(np.abs(out[900:, 0] - whole[900:, 0])) < 1e-3


@pytest.mark.parametrize("law", [SAVGOL, ADAPTIVE_SAVGOL])
def test_rest_is_exact(law):
    out = run(law, np.full(900, 0.1))[1:, :, 0]
    assert np.all(out == [0.1, 0.0, 0.0])


@pytest.mark.parametrize("law", [SAVGOL, ADAPTIVE_SAVGOL])
@pytest.mark.parametrize("order", [0, 1])
def test_response_of_plants_of_lower_order(law, order):
    out = run(law, two_sines(200)[0], order=order)
    assert np.array_equal(out[1:, 2], out[1:, order])


@pytest.mark.parametrize(
    ("law", "given", "reason"),
    [
        (SAVGOL, {"window": 140}, "an odd number"),
        (SAVGOL, {"window": 5, "degree": 5}, "less than the window"),
        (SAVGOL, {"degree": 1}, "at least 2"),
        (SAVGOL, {"window": 1}, "window"),
        (ADAPTIVE_SAVGOL, {"windows": [51.0]}, "each member of the bank takes one of both"),
        (ADAPTIVE_SAVGOL, {"windows": [50.0], "degrees": [3.0]}, "an odd number"),
        (ADAPTIVE_SAVGOL, {"windows": [51.5], "degrees": [3.0]}, "whole numbers"),
        (ADAPTIVE_SAVGOL, {"windows": [5.0], "degrees": [7.0]}, "less than the window"),
    ],
)
def test_windows_that_cannot_be(law, given, reason):
    with pytest.raises(BadInput, match=reason):
        constants_of(law, **given)
