"""What the recorder knows of the cycles: the next message of each topic, and no more than that."""

import tracemalloc

import pytest

from fpt_ros.errors import RunFailed
from fpt_ros.nodes.recorded_cycles import MOST, RecordedCycles

TICK = 1_000_000
TOPICS = ("joint_states", "state_estimate", "command")


def lockstep(before=((), (), ())):
    return RecordedCycles(True, [list(each) for each in before])


def fed(recorded, cycles, begin=0):
    for k in range(begin, cycles):
        for index, name in enumerate(TOPICS):
            assert not recorded.is_unexpected(index, k * TICK) or k < 2
            assert recorded.is_next(index, k * TICK, name)
    return recorded


@pytest.mark.parametrize("is_lockstep", [True, False])
def test_a_run_of_any_length_takes_no_more_memory(is_lockstep):
    recorded = fed(RecordedCycles(is_lockstep, [[], [], []]), 3 * MOST)
    tracemalloc.start()
    fed(recorded, 200 * MOST, 3 * MOST)
    grown = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    assert grown < 65_536  # the stamps alone would take ten times that
    assert (recorded.cycles, recorded.done, recorded.newest) == (
        200 * MOST, 200 * MOST, (200 * MOST - 1) * TICK
    )  # fmt: skip
    assert recorded.until == recorded.newest


def test_a_message_that_is_missing_is_named_also_in_a_long_run():
    recorded = fed(lockstep(), 10 * MOST)
    assert recorded.is_next(0, 10 * MOST * TICK, TOPICS[0])
    assert recorded.is_next(0, (10 * MOST + 1) * TICK, TOPICS[0])
    assert recorded.is_within_a_cycle
    assert recorded.is_unexpected(1, (10 * MOST + 1) * TICK)
    with pytest.raises(RunFailed, match=f"message {10 * MOST} of state_estimate"):
        recorded.is_next(1, (10 * MOST + 1) * TICK, TOPICS[1])


def test_what_is_recorded_already_is_not_taken_twice():
    recorded = fed(lockstep(), 10 * MOST)
    for k in (0, 9 * MOST, 10 * MOST - 1):
        assert not recorded.is_next(1, k * TICK, TOPICS[1])


@pytest.mark.parametrize("lag", [0, 1, 48])
def test_it_goes_on_behind_a_killed_one(lag):
    """The topics of a killed recorder may have gone differently far."""
    cycles = 10 * MOST
    stamps = [k * TICK for k in range(cycles)]
    behind = stamps[: cycles - lag]
    recorded = lockstep((stamps, behind, behind))
    assert (recorded.cycles, recorded.done) == (cycles, cycles - lag)
    assert recorded.until == behind[-1]
    for k in range(cycles - lag, cycles):
        for index in (1, 2):
            assert recorded.is_next(index, k * TICK, TOPICS[index])
    fed(recorded, cycles + 5 * MOST, cycles)
    assert recorded.done == cycles + 5 * MOST


def test_in_real_time_the_end_is_seen_though_cycles_are_missing():
    recorded = RecordedCycles(False, [[], [], []])
    for k in range(10 * MOST):
        if k % 7 != 3:
            assert recorded.is_next(0, 5 + k * TICK, TOPICS[0])
    assert recorded.saw_the_end(10 * MOST)
    assert not recorded.saw_the_end(10 * MOST + 1)
