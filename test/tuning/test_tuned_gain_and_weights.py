"""The calculated gain, tuned weights, and the precursor's index."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tuning_strategies import DT, Law, triple

from fpt_ros.tuning.precursor import ALARM, BETA, RATE, guarded, memory_size, observe


@settings(deadline=None)
@given(st.lists(triple, min_size=1, max_size=30), st.floats(0.5, 0.999), st.floats(1e-3, 0.1))
def test_gain_is_3_20_with_the_forgetting_sum_of_3_19(errors, beta, epsilon):
    """The infinite past is filled with the first value: b_1 = ||h_1|| / (1 - beta)."""
    law = Law("gain", size=1, rows=0, beta=beta, epsilon=epsilon)
    b = np.linalg.norm(errors[0]) / (1.0 - beta)
    for k, h in enumerate(errors):
        if k:
            b = beta * b + np.linalg.norm(h)
        (found,) = law([-1.0], h=h)
        assert found == pytest.approx(-0.16 / (epsilon + (1.0 - beta) * b), rel=1e-9)
        assert law.memory[0] == pytest.approx((1.0 - beta) * b, rel=1e-9, abs=1e-12)


def test_the_sign_of_the_gain_is_a_parameter():
    (up,), (down,) = (Law("gain", 1, 0, sign=sign)([0.0], h=[1.0]) for sign in (1.0, -1.0))
    assert up == -down == pytest.approx(0.16 / 1.05)


def weights_by_hand(r, delay, dt, beta=0.99, up=0.5, down=50.0, least=0.1, most=10.0):
    """All weights of a run, a row a cycle, from the whole history of r (cycles x coordinates)."""
    weights, b, rows = np.ones(r.shape[1]), np.zeros(r.shape[1]), []
    for n in range(len(r)):
        if n >= 2 * delay:
            x = (r[n] - r[n - delay]) * (r[n - delay] - r[n - 2 * delay])
            b = beta * b + (1.0 - beta) * x / (np.abs(x) + 1e-12)
            shrunk, grown = weights * (1.0 - down * dt), weights * (1.0 + up * dt)
            weights = np.where(b < 0.0, np.maximum(least, shrunk), np.minimum(most, grown))
        rows.append(weights)
    return np.array(rows)


@pytest.mark.parametrize("delay", [1, 3, 10])
@pytest.mark.parametrize("seed", range(3))
def test_weights_to_the_letter(delay, seed):
    rng = np.random.default_rng(seed)
    t = np.arange(400)[:, None] * DT
    r = np.sin(t * [3.0, 40.0]) + 0.3 * rng.standard_normal((400, 2)) * [1.0, 1e-3]
    law, weights = Law("weights", size=2, rows=0, n=2, delay=delay), np.ones(2)
    expected = weights_by_hand(r, delay, DT)
    for k, each in enumerate(r):
        weights = law(weights, r=each)
        assert weights == pytest.approx(expected[k], rel=1e-12)
    assert (expected[-1] != 1.0).all()


def test_weights_grow_where_r_is_smooth_and_fall_where_it_alternates():
    law, weights = Law("weights", size=2, rows=0, n=3, delay=1), np.ones(2)
    for k in range(20_000):
        weights = law(weights, r=[0.001 * k, math.nan, (-1.0) ** k])
    assert weights.tolist() == [10.0, 0.1]


def test_weights_are_of_controlled_coordinates_only():
    """NaN marks those that are not: the others keep their order."""
    all_of_them, some = Law("weights", 2, 0, 2, delay=2), Law("weights", 2, 0, 4, delay=2)
    a, b = np.ones(2), np.ones(2)
    rng = np.random.default_rng(7)
    for x, y in rng.standard_normal((100, 2)):
        a = all_of_them(a, r=[x, y])
        b = some(b, r=[math.nan, x, math.nan, y])
        assert (a == b).all()


def index_of(r):
    """Index after each row of r (cycles x coordinates)."""
    memory = [0.0] * memory_size(r.shape[1])
    return np.array([observe(memory, each.tolist()) for each in r])


def test_the_index_of_a_smooth_and_of_an_alternating_response():
    k = np.arange(500)[:, None]
    assert index_of(0.01 * k)[-1] == pytest.approx(1.0, abs=1e-4)
    assert index_of((-1.0) ** k)[-1] == pytest.approx(-1.0, abs=1e-4)
    period_four = np.array([[0.0], [1.0], [1.0], [0.0]] * 125)
    assert abs(index_of(period_four)[-1]) < 0.1


def test_the_index_to_the_letter():
    r = np.random.default_rng(3).standard_normal((60, 3))
    d = np.diff(np.vstack([np.zeros(3), r]), axis=0)
    p, expected = 0.0, []
    for k in range(60):
        before = d[k - 1] if k else np.zeros(3)
        size = np.linalg.norm(d[k]) * np.linalg.norm(before)
        if size > 0.0:
            p = BETA * p + (1.0 - BETA) * (d[k] @ before) / size
        expected.append(p)
    assert index_of(r) == pytest.approx(np.array(expected), rel=1e-12)


def test_what_is_not_controlled_does_not_count():
    r = np.random.default_rng(4).standard_normal((60, 2))
    padded = np.column_stack([r[:, 0], np.full(60, np.nan), r[:, 1]])
    assert index_of(padded) == pytest.approx(index_of(r), abs=1e-15)


@given(st.floats(0.01, 1.0), st.floats(-1.0, 1.0))
def test_the_guard_lowers_the_gain_while_there_is_an_alarm(factor, index):
    expected = factor * (1.0 - RATE) if index < ALARM else factor
    assert guarded(factor, index) == expected
