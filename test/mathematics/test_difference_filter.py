"""No denoising: the backward difference is the acceleration of an explicit Euler plant."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros import registry

FILTER = registry.streaming_filter("none")
pair = st.tuples(st.floats(-50.0, 50.0), st.floats(-50.0, 50.0))


@settings(deadline=None)
@given(pair, pair, st.lists(pair, min_size=1, max_size=20), st.sampled_from([1e-4, 1e-3, 0.25]))
def test_it_is_exact_for_an_euler_plant(q, v, accelerations, dt):
    q, v = list(q), list(v)
    state = [math.nan] * FILTER.state_size(2)
    FILTER.start(state, q, v)
    for a in accelerations:
        q = [x + dt * y for x, y in zip(q, v, strict=True)]
        v = [x + dt * y for x, y in zip(v, a, strict=True)]
        out_q, out_v, response = [math.nan] * 2, [math.nan] * 2, [math.nan] * 2
        FILTER.update(state, dt, q, v, out_q, out_v, response)
        assert (out_q, out_v) == (q, v)
        rounding = 4.0 * 2.0**-53 * max(map(abs, v), default=0.0) / dt
        assert response == pytest.approx(a, rel=1e-12, abs=rounding + 50 * 2.0**-50 / dt)


def test_the_difference_is_over_the_time_that_really_passed():
    state, out = [math.nan], [[math.nan], [math.nan], [math.nan]]
    FILTER.start(state, [0.0], [1.0])
    FILTER.update(state, 0.5, [0.5], [2.0], *out)
    assert out == [[0.5], [2.0], [2.0]]
    FILTER.update(state, 2.0, [0.5], [1.0], *out)
    assert out[2] == [-0.5]
