"""The order of events, from topics that come in any order of their own."""

from hypothesis import given
from hypothesis import strategies as st

from fpt_ros.cycle.turns import Turns


@given(st.lists(st.integers(0, 3), max_size=60))
def test_items_are_given_in_turn_as_soon_as_all_before_them_have_come(topics):
    turns, counts, given_out = Turns(4), [0] * 4, []
    for topic in topics:
        given_out += turns.add(topic, (counts[topic], topic))
        counts[topic] += 1
        whole = min(counts)
        # of the cycle that is not whole: the topics before the first that has not come
        more = next(i for i, count in enumerate(counts) if count == whole)
        expected = [(k, i) for k in range(whole) for i in range(4)]
        assert given_out == expected + [(whole, i) for i in range(more)]
    rest = list(turns.rest())
    everything = sorted((k, i) for i, count in enumerate(counts) for k in range(count))
    assert given_out + rest == everything
    assert list(turns.rest()) == []
