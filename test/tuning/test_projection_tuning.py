"""The modified tuning (2.11): only what is known is corrected."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from fpt_ros.errors import BadInput
from fpt_ros.parameters import resolve
from fpt_ros.tuning import Seen
from fpt_ros.tuning.projection import PROJECTION

row = st.lists(st.floats(-10.0, 10.0), min_size=6, max_size=6)


def rate(Y, error, **given_values):
    constants = PROJECTION.prepare(resolve(PROJECTION.parameters, given_values, "test"))
    values = [0.0] * len(Y)
    PROJECTION.update(constants, [], 1.0, values, Seen(list(Y), [error], [], [], []))
    return np.array(values)


@settings(deadline=None)
@given(row, row, st.floats(0.1, 10.0))
def test_the_known_component_decays_by_one_minus_alpha_dt(Y, deviation, alpha):
    """E = Y (Theta - Theta^) after a step of dt with the same Y."""
    Y, deviation, dt, epsilon = np.array(Y), np.array(deviation), 1e-3, 1e-6
    square = float(Y @ Y)
    assume(square > 1e-2)
    known = float(Y @ deviation)
    after = deviation - dt * rate(Y, known, alpha=alpha, epsilon=epsilon)
    exact = known * (1.0 - alpha * dt)
    off = abs(known) * alpha * dt * epsilon / square
    assert Y @ after == pytest.approx(exact, abs=off + 1e-12 * (1 + abs(known)))
    with_epsilon = known * (1.0 - alpha * dt * square / (square + epsilon))
    assert Y @ after == pytest.approx(with_epsilon, abs=1e-12 * (1 + abs(known)))


@settings(deadline=None)
@given(row, row, st.floats(-100.0, 100.0))
def test_nothing_changes_orthogonally_to_the_row(Y, other, error):
    Y, other = np.array(Y), np.array(other)
    assume(Y @ Y > 1e-2)
    orthogonal = other - Y * (Y @ other) / (Y @ Y)
    change = rate(Y, error)
    assert orthogonal @ change == pytest.approx(0.0, abs=1e-10 * (1 + np.linalg.norm(change)))


def test_a_vanishing_row_is_no_division_by_zero():
    assert rate([0.0] * 6, 5.0).tolist() == [0.0] * 6


def test_defaults_and_range():
    assert PROJECTION.prepare(resolve(PROJECTION.parameters, {}, "test")) == (1.0, 1e-6)
    with pytest.raises(BadInput, match=r"epsilon: 0\.0 is not valid, it takes a number > 0"):
        resolve(PROJECTION.parameters, {"epsilon": 0.0}, "test")
