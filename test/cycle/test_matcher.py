"""Messages of one cycle are found by stamp alone."""

import itertools

import pytest

from fpt_ros.cycle.matcher import Matcher, under_way
from fpt_ros.cycle.stage import Input
from fpt_ros.errors import RunFailed
from fpt_ros.messages.frames import Command, Desired, StateEstimate
from fpt_ros.messages.topics import COMMAND, DESIRED, STATE_ESTIMATE

MS = 1_000_000
INPUTS = (Input(STATE_ESTIMATE), Input(DESIRED), Input(COMMAND, lag=1))


def estimate(k):
    return StateEstimate(round(k * MS), ("q",), *[[float(k)]] * 4)


def desired(k):
    return Desired(k * MS, ("q",), *[[float(k)]] * 4)


def command(k):
    return Command(k * MS, ("q",), [float(k)], [float(k)])


def cycle(k):
    """What a tuner needs in cycle k, with the number of its input."""
    rest = [(2, command(k - 1))] if k else []
    return [(0, estimate(k)), (1, desired(k)), *rest]


def test_whatever_the_order_of_arrival_each_cycle_is_complete_once():
    for orders in itertools.product(itertools.permutations(range(3)), repeat=2):
        matcher = Matcher(INPUTS, MS)
        assert [matcher.take(*each) for each in cycle(0)] == [
            None,
            [estimate(0), desired(0), None],
        ]
        for k, order in enumerate(orders, start=1):
            answers = [matcher.take(*cycle(k)[at]) for at in order]
            complete = [each for each in answers if each is not None]
            assert complete == [[estimate(k), desired(k), command(k - 1)]]
            assert matcher.acted == k * MS


def test_no_stamp_is_acted_on_twice():
    matcher = Matcher(INPUTS, MS)
    for each in cycle(0):
        matcher.take(*each)
    assert [matcher.take(*each) for each in cycle(0)] == [None, None]


def test_a_run_that_is_under_way_is_refused():
    matcher = Matcher(INPUTS[:1], MS)
    with pytest.raises(RunFailed, match=r"a run is under way here already \(t = 0.007 s\)"):
        matcher.take(0, estimate(7))
    matcher = Matcher(INPUTS[:1], MS)
    assert matcher.take(0, estimate(0)) is not None
    with pytest.raises(RunFailed, match="under way"):
        matcher.take(0, estimate(2))


def test_where_the_cycle_time_is_not_known_any_later_stamp_goes_on():
    matcher = Matcher(INPUTS[:1])
    assert matcher.take(0, estimate(0)) is not None
    assert matcher.take(0, estimate(5)) is not None


def test_older_messages_never_take_the_place_of_ours():
    matcher = Matcher(INPUTS, MS)
    for k in range(3):
        for each in cycle(k):
            matcher.take(*each)
    assert matcher.take(0, estimate(0)) is None
    for each in cycle(3)[:-1]:
        matcher.take(*each)
    assert matcher.take(2, command(2)) == [estimate(3), desired(3), command(2)]


def test_in_real_time_the_newest_cycle_counts_and_a_lagging_input_may_be_absent():
    matcher = Matcher(INPUTS, MS, realtime=True)
    matcher.take(0, estimate(40))
    assert matcher.newest() is None
    matcher.take(1, desired(40))
    assert matcher.newest() == [estimate(40), desired(40), None]
    assert matcher.newest() is None
    for k in (41, 42, 43, 44):
        matcher.take(0, estimate(k))
    for k in (41, 43):
        matcher.take(1, desired(k))
    assert matcher.newest() == [estimate(43), desired(43), None]


def test_in_real_time_a_lagging_input_is_of_the_cycle_acted_on_last():
    """And not of one that came in between, in the same burst, and was left out."""
    matcher = Matcher(INPUTS, MS, realtime=True)
    found = []
    for burst in ((40,), (41, 42, 43), (44,)):
        for k in burst:
            for index, frame in enumerate((estimate(k), desired(k), command(k))):
                matcher.take(index, frame)
        found.append(matcher.newest())
    assert [frames[0] for frames in found] == [estimate(40), estimate(43), estimate(44)]
    assert [frames[2] for frames in found] == [None, command(40), command(43)]


def test_in_real_time_cycles_come_no_closer_than_a_quarter_of_the_cycle_time():
    matcher = Matcher(INPUTS[:1], 4 * MS, realtime=True)

    def acts(k):
        matcher.take(0, estimate(k))
        return matcher.newest() is not None

    assert [k for k in (0, 4, 4.5, 4.9, 5, 9, 9.25, 9.5, 13) if acts(k)] == [0, 4, 5, 9, 13]


def test_it_goes_on_where_a_node_had_been():
    matcher = Matcher(INPUTS, MS, acted=6 * MS)
    assert [matcher.take(*each) for each in cycle(7)][-1] == [estimate(7), desired(7), command(6)]


def test_stamps_of_wall_time_in_lockstep_are_told_from_another_run():
    assert "set realtime" in str(under_way(1_795_650_000 * 10**9))
    assert "under way here already (t = 3 s)" in str(under_way(3 * 10**9))
