"""Savitzky-Golay filter of a whole record: Table 6.1, exactness, scipy."""

import numpy as np
import pytest
import scipy.signal
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising.offline.savgol import SAVGOL, gain, kernel, own_weights, smooth, weights
from fpt_ros.errors import BadInput
from fpt_ros.parameters import resolve

TABLE_6_1 = {
    (9, 2): [-0.0909, 0.0606, 0.1688, 0.2338, 0.2554, 0.2338, 0.1688, 0.0606, -0.0909],
    (9, 4): [0.0350, -0.1282, 0.0699, 0.3147, 0.4172, 0.3147, 0.0699, -0.1282, 0.0350],
    (11, 3): [
        *(-0.0839, 0.0210, 0.1026, 0.1608, 0.1958),
        0.2075,
        *(0.1958, 0.1608, 0.1026, 0.0210, -0.0839),
    ],
    (11, 5): [
        *(0.0420, -0.1049, -0.0233, 0.1399, 0.2797),
        0.3333,
        *(0.2797, 0.1399, -0.0233, -0.1049, 0.0420),
    ],
}


@pytest.mark.parametrize(("window", "degree"), TABLE_6_1)
def test_table_6_1_to_its_four_decimals(window, degree):
    found = kernel(window, degree)
    assert found == pytest.approx(TABLE_6_1[window, degree], abs=5.0001e-5, rel=0)


@pytest.mark.parametrize(
    ("window", "degree", "position"), [(9, 2, 4.0), (11, 5, 10.0), (7, 3, 9.5)]
)
def test_weights_are_those_of_the_normal_equations(window, degree, position):
    J = np.vander(np.arange(window) - position, degree + 1, increasing=True)
    expected = J @ np.linalg.inv(J.T @ J)
    assert weights(window, degree, position) == pytest.approx(expected, rel=1e-6, abs=1e-9)


def test_an_even_degree_has_the_smoother_of_the_next_odd_one():
    for degree in (2, 4):
        assert kernel(21, degree) == pytest.approx(kernel(21, degree + 1), abs=1e-15)


@settings(deadline=None, max_examples=40)
@given(
    st.lists(st.floats(-10.0, 10.0), min_size=1, max_size=7),
    st.sampled_from([9, 31, 361]),
    st.integers(0, 3),
)
def test_polynomials_are_reproduced_with_derivatives_up_to_the_ends(coefficients, window, order):
    u = np.linspace(-1.0, 1.0, 400)
    p = np.polynomial.Polynomial(coefficients)
    found = smooth(p(u), window, len(coefficients) - 1, order, dt=u[1] - u[0])
    size = max(1.0, *map(abs, coefficients))
    rounding = 1e-13 * 100.0**order * (400 / window) ** order * size
    assert np.max(np.abs(found - p.deriv(order)(u))) < max(rounding, 1e-12 * size)


@pytest.mark.parametrize(("window", "degree", "order"), [(5, 2, 0), (35, 3, 1), (41, 4, 2)])
def test_it_is_what_scipy_computes(window, degree, order):
    y = np.random.default_rng(0).standard_normal(100)
    expected = scipy.signal.savgol_filter(y, window, degree, deriv=order, delta=0.1)
    assert smooth(y, window, degree, order, 0.1) == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_weights_of_long_windows_lose_no_digits():
    """They solve J^T G = 1 in exact moments; scipy's newest-sample weights miss that by far."""
    J = np.vander(np.arange(361) / 360.0 - 1.0, 6, increasing=True)
    scale = 360.0 ** np.arange(6)
    assert J.T @ weights(361, 5, 360.0) * scale == pytest.approx(np.eye(6), abs=1e-9)
    scipys = scipy.signal.savgol_coeffs(361, 5, pos=360, use="dot")
    assert kernel(361, 5, position=360.0) != pytest.approx(scipys, abs=1e-7)


def test_own_weights_are_the_diagonal_of_the_smoother():
    smoother = np.array([smooth(row, 9, 3) for row in np.eye(9)]).T
    assert own_weights(9, 3) == pytest.approx(np.diagonal(smoother), abs=1e-14)
    assert np.sum(own_weights(9, 3)) == pytest.approx(4.0), "the trace of a projection on 4"
    assert gain(9, 3) == pytest.approx(0.2554, abs=5e-5)


@settings(deadline=None, max_examples=20)
@given(st.floats(-1e6, 1e6), st.floats(-1e3, 1e3))
def test_shift_and_scale(shift, scale):
    y = np.random.default_rng(1).standard_normal(60)
    found = smooth(shift + scale * y, 15, 3)
    expected = shift + scale * smooth(y, 15, 3)
    assert np.max(np.abs(found - expected)) <= 1e-13 * (1.0 + abs(shift) + abs(scale))


@pytest.mark.parametrize(
    ("given_values", "reason"),
    [
        ({"window": 34}, "an odd number"),
        ({"window": 3}, "degree = 3 is not valid for a window of 3"),
        ({"window": 5, "degree": 9}, "less than the window"),
    ],
)
def test_windows_that_cannot_be(given_values, reason):
    values = resolve(SAVGOL.parameters, given_values, "savgol")
    with pytest.raises(BadInput, match=reason):
        SAVGOL.shortest(values)
    with pytest.raises(BadInput, match=reason):
        SAVGOL.estimate(np.zeros(100), np.ones(100, dtype=bool), values)


def test_a_window_longer_than_the_record_is_refused():
    with pytest.raises(
        BadInput, match="a window of 35 needs at least as many samples, there are 34"
    ):
        smooth(np.zeros(34), 35, 3)
