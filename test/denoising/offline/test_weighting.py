"""Weights of (6.14) to (6.16) by distance."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising.offline.weighting import average_around, dombi, gms, shepard

relative = st.lists(st.floats(0.02, 0.98), min_size=2, max_size=15).map(np.array)
exponent = st.floats(0.1, 4.0)
SEVEN = np.array([0.5, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0]) / 4.0


def printed_dombi(u, power):
    """(6.16) as it is printed: the exponent 2 outside of the sum, and the sum over all j."""
    return 1.0 / (1.0 + (u / (1.0 - u)) ** 2 * np.sum(((1.0 - u) / u) ** power))


@given(relative, exponent)
@settings(deadline=None)
def test_dombi_is_shepard(u, power):
    assert dombi(u, power) == pytest.approx(shepard(u, power), rel=1e-13)
    assert np.sum(dombi(u, power)) == pytest.approx(1.0, abs=1e-14)


@given(relative, st.floats(0.1, 50.0))
@settings(deadline=None)
def test_gms_is_shepard_with_the_exponent_2(u, radius):
    assert gms(radius * u, radius) == pytest.approx(shepard(u, 2.0), rel=1e-12)


def test_by_hand():
    """(1 - u)/u = 3, 1, 1/3 at u = 1/4, 1/2, 3/4; squares 9, 1, 1/9 with the sum 91/9."""
    assert dombi(np.array([0.25, 0.5, 0.75])) == pytest.approx([81 / 91, 9 / 91, 1 / 91])


@pytest.mark.parametrize("power", [1.7, 2.0])
def test_the_printed_weights_do_not_sum_to_one(power):
    assert abs(np.sum(printed_dombi(SEVEN, power)) - 1.0) > 0.03
    assert np.sum(dombi(SEVEN, power)) == pytest.approx(1.0, abs=1e-14)


def test_a_greater_exponent_trusts_the_nearer_samples_more():
    u = np.array([0.2, 0.5, 0.8])
    nearest = [dombi(u, power)[0] for power in (0.5, 1.0, 2.0, 4.0)]
    assert nearest == sorted(nearest)


def test_only_the_samples_around_the_extrema_change():
    y = np.random.default_rng(0).standard_normal(50)
    out = average_around(y, np.array([0, 30]), 3)
    changed = np.flatnonzero(out != y)
    assert changed.tolist() == [0, 1, 2, 3, *range(27, 34)]
    assert np.all(out >= y.min())
    assert np.all(out <= y.max())


def test_constants_and_inner_lines_remain():
    line = np.arange(40.0)
    assert average_around(np.full(40, 7.0), np.array([1, 20]), 4) == pytest.approx(7.0)
    assert average_around(line, np.array([20]), 4) == pytest.approx(line)
