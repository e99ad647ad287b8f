"""Stamps of a robot, of any clock: what is given for them always goes on."""

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from fpt_ros.cycle.arrivals import Arrivals

MS, DAY = 1_000_000, 86_400 * 10**9
START = 1_800_000_000 * 10**9


def test_a_clock_that_steps_back_or_forth_is_not_followed():
    arrivals, given_ = Arrivals(), []
    for k in range(40):
        jump = {True: 0, 10 <= k < 20: -DAY, 20 <= k < 30: DAY}[True]
        given_.append(arrivals.stamp(START + k * MS + jump, START + k * MS))
    assert [b - a for a, b in pairwise(given_)] == [MS] * 39
    assert arrivals.replaced == 3


def test_where_our_own_clock_steps_back_the_robots_counts():
    arrivals, given_ = Arrivals(), []
    for k in range(20):
        given_.append(arrivals.stamp(START + k * MS, START + k * MS - (DAY if k > 9 else 0)))
    steps = [b - a for a, b in pairwise(given_)]
    assert min(steps) > 0
    assert sum(step == MS for step in steps) == 18


@given(st.lists(st.tuples(st.integers(-(2**62), 2**62), st.integers(0, 2**62)), max_size=30))
def test_no_stamp_goes_back_whatever_the_clocks_say(pairs):
    arrivals, last, before = Arrivals(), -1, None
    for sent, arrived in pairs:
        stamp = arrivals.stamp(sent, arrived)
        assert stamp > last or sent == before
        last, before = stamp, sent
