"""Robust Fixed Point Transformation: (2.13) and (2.22)."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.parameters import resolve
from fpt_ros.transformations.rfpt import RFPT, sigma

number = st.floats(-1e3, 1e3)
vector = st.lists(number, min_size=2, max_size=2)


def deform(r, h, **given_values):
    constants = RFPT.prepare(resolve(RFPT.parameters, given_values, "test"))
    out = [math.nan] * len(r)
    RFPT.deform(constants, r, h, h, [0.0] * len(r), out)
    return out


@settings(deadline=None)
@given(number, number, st.sampled_from([1.0, -1.0]))
def test_signed_form_is_2_13_to_the_letter(r, h, b):
    a, k = 1e-6, -1e5
    x = a * h
    literal = (r + k) * (1.0 + b * (x / (1.0 + abs(x)))) - k
    assert deform([r], [h], form="signed", A=a, B=b, K=k) == [literal]


@settings(deadline=None)
@given(vector, vector)
def test_norm_form_is_2_22_to_the_letter(r, h):
    a, b, k = 1e-8, 1.0, -1e7
    norm = math.hypot(*h)
    factor = b * a * norm / (1.0 + a * norm)
    if norm < 1e-12:
        expected = r
    else:
        expected = [(1.0 + factor) * x + factor * k * y / norm for x, y in zip(r, h, strict=True)]
    assert deform(r, h, A=a, B=b, K=k) == pytest.approx(expected, rel=1e-12, abs=1e-12)


@settings(deadline=None)
@given(st.floats(-100, 100), st.floats(-100, 100))
def test_the_linearised_step_is_k_a_b_h(r, h):
    """-0.1 h with the constants of section 2.3; r itself and the sigmoid add A h (r + K A h)."""
    small = 1e-6 * abs(h) * (abs(r) + 0.2 * abs(h)) + 1e-9
    for form in ("signed", "norm"):
        (out,) = deform([r], [h], form=form, A=1e-6, B=1.0, K=-1e5)
        assert out - r == pytest.approx(-0.1 * h, abs=small)
        (out,) = deform([r], [h], form=form, A=1e-6, B=-1.0, K=1e5)
        assert out - r == pytest.approx(-0.1 * h, abs=small)


@settings(deadline=None)
@given(vector)
def test_no_response_error_leaves_r_unchanged(r):
    assert deform(r, [0.0, 0.0]) == r
    assert deform(r, [0.0, 5e-13]) == r
    assert deform(r, [0.0, 0.0], form="signed") == pytest.approx(r, abs=3e-11)  # (r + K) - K


def test_the_norm_form_steps_from_its_threshold_on():
    (out,) = deform([0.0], [1e-12], A=1.0, B=1.0, K=-1e5)
    assert out == pytest.approx(-1e-7, rel=1e-9)


def test_the_iteration_converges_to_the_response_that_is_asked_for():
    """Two coordinates, a plant that answers M r + c: h -> 0 from the sign of K that contracts."""
    M, c, desired = np.array([[1.2, 0.3], [0.3, 0.8]]), np.array([1.0, -2.0]), np.array([3.0, 4.0])
    for form in ("norm", "signed"):
        r = desired
        for _ in range(400):
            r = np.array(deform(r, M @ r + c - desired, form=form, A=1e-6, B=1.0, K=-1e5))
        assert M @ r + c == pytest.approx(desired, abs=1e-8)
    r = desired
    for _ in range(100):
        r = np.array(deform(r, M @ r + c - desired, A=1e-6, B=1.0, K=1e5))
    assert np.linalg.norm(M @ r + c - desired) > 100.0


def test_sigma_saturates():
    assert sigma(0.0) == 0.0
    assert sigma(1.0) == 0.5
    assert sigma(-1.0) == -0.5
    assert sigma(1e12) == pytest.approx(1.0)
