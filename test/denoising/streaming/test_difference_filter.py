"""No denoising: the backward difference is the acceleration of an explicit Euler plant."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.denoising.streaming import FILTERS

FILTER, OF_POSITIONS = FILTERS["none"], FILTERS["finite_difference"]
SECOND_ORDER, FIRST_ORDER, ZEROTH_ORDER = (
    FILTER.prepare({"order": order}, 2, 1e-3) for order in (2, 1, 0)
)
pair = st.tuples(st.floats(-50.0, 50.0), st.floats(-50.0, 50.0))


@settings(deadline=None)
@given(pair, pair, st.lists(pair, min_size=1, max_size=20), st.sampled_from([1e-4, 1e-3, 0.25]))
def test_it_is_exact_for_an_euler_plant(q, v, accelerations, dt):
    q, v = list(q), list(v)
    state = [math.nan] * FILTER.state_size(SECOND_ORDER, 2)
    FILTER.start(SECOND_ORDER, state, q, v)
    for a in accelerations:
        q = [x + dt * y for x, y in zip(q, v, strict=True)]
        v = [x + dt * y for x, y in zip(v, a, strict=True)]
        out_q, out_v, response = [math.nan] * 2, [math.nan] * 2, [math.nan] * 2
        FILTER.update(SECOND_ORDER, state, dt, q, v, out_q, out_v, response)
        assert (out_q, out_v) == (q, v)
        rounding = 4.0 * 2.0**-53 * max(map(abs, v), default=0.0) / dt
        assert response == pytest.approx(a, rel=1e-12, abs=rounding + 50 * 2.0**-50 / dt)


def test_the_difference_is_over_the_time_that_really_passed():
    state, out = [math.nan], [[math.nan], [math.nan], [math.nan]]
    FILTER.start(SECOND_ORDER, state, [0.0], [1.0])
    FILTER.update(SECOND_ORDER, state, 0.5, [0.5], [2.0], *out)
    assert out == [[0.5], [2.0], [2.0]]
    FILTER.update(SECOND_ORDER, state, 2.0, [0.5], [1.0], *out)
    assert out[2] == [-0.5]


def test_the_response_of_a_plant_of_order_one_is_the_difference_of_its_positions():
    state, out = [math.nan] * 2, [[math.nan] * 2, [math.nan] * 2, [math.nan] * 2]
    FILTER.start(FIRST_ORDER, state, [1.0, 2.0], [9.0, 9.0])
    FILTER.update(FIRST_ORDER, state, 0.5, [2.0, 0.0], [7.0, 8.0], *out)
    assert out == [[2.0, 0.0], [7.0, 8.0], [2.0, -4.0]]
    FILTER.update(FIRST_ORDER, state, 0.25, [2.0, 1.0], [7.0, 8.0], *out)
    assert out[2] == [0.0, 4.0]


def test_the_response_of_a_plant_of_order_zero_is_its_value():
    state, out = [math.nan] * 2, [[math.nan] * 2, [math.nan] * 2, [math.nan] * 2]
    FILTER.start(ZEROTH_ORDER, state, [1.0, 2.0], [0.0, 0.0])
    FILTER.update(ZEROTH_ORDER, state, 0.5, [3.0, -4.0], [0.0, 0.0], *out)
    assert out[2] == [3.0, -4.0]


gap = st.floats(1e-4, 1e-2)


@settings(deadline=None)
@given(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0), gap, st.lists(gap, min_size=2, max_size=20))
def test_of_positions_it_is_exact_at_unequal_distances_too(v, a, first, gaps):
    """A parabola's velocity in the middle of two samples, and its acceleration."""
    t, state = 0.0, [math.nan] * OF_POSITIONS.state_size((), 1)
    out_q, out_v, response = [math.nan], [math.nan], [math.nan]
    OF_POSITIONS.start((), state, [-v * first + 0.5 * a * first * first], [0.0])
    for k, dt in enumerate([first, *gaps]):
        t += dt if k else 0.0
        q = v * t + 0.5 * a * t * t
        OF_POSITIONS.update((), state, dt, [q], [math.nan], out_q, out_v, response)
        assert out_q == [q]
        assert out_v[0] == pytest.approx(v + a * (t - 0.5 * dt), abs=1e-10)
        if k:
            assert response[0] == pytest.approx(a, abs=2e-5)  # 2^-52 |q| / dt^2
