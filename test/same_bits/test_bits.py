"""What same_bits calls the same: every bit of every topic, and what it says of the first other."""

import numpy as np
import pytest
from bits import differences, relaid, state_differences, unequal


def arrays(**changes):
    result = {
        "ended": np.array(""),
        "topic/command/stamps": np.arange(4) * 1_000_000,
        "topic/command/names": np.array(["q1", "q2"]),
        "topic/command/effort": np.arange(8.0).reshape(4, 2),
        "state/denoiser": np.array([1.0, np.nan]),
    }
    return result | {key.replace("__", "/"): value for key, value in changes.items()}


def effort(at, value):
    changed = arrays()["topic/command/effort"]
    changed[at] = value
    return arrays(topic__command__effort=changed)


def test_equal_runs_have_no_difference():
    assert list(differences(arrays(), arrays())) == []
    assert list(state_differences(arrays(), arrays())) == []
    assert list(relaid(arrays(), arrays())) == []


def test_one_bit_is_found_and_told_by_cycle_and_name():
    new = np.nextafter(5.0, 6.0)
    (line,) = differences(arrays(), effort((2, 1), new))
    assert line == "command effort q2: cycle 2, old 5.0, new 5.000000000000001 (1 differ)"


def test_zero_has_a_sign_and_nan_no_payload():
    (payload,) = np.array([0x7FF8000000000001], dtype=np.uint64).view(np.float64)
    old, new = np.array([0.0, np.nan, np.nan]), np.array([-0.0, payload, 1.0])
    assert unequal(old, new).tolist() == [True, False, True]


@pytest.mark.parametrize(
    ("new", "said"),
    [
        (arrays(ended=np.array("Diverged")), "ended: old complete, new Diverged"),
        (arrays(topic__command__force=np.zeros((4, 2))), "command force: only in the new"),
        (arrays(topic__command__names=np.array(["q2", "q1"])), "names: column 0, old 'q1', new"),
        (arrays(topic__command__effort=np.zeros((4, 1))), "old (4, 2), new (4, 1)"),
        (arrays(topic__command__stamps=np.arange(3) * 1_000_000), "old has 4 cycles, new 3"),
        ({"refused": np.array("BadInput: none")}, "the new tree cannot run it: BadInput: none"),
    ],
)
def test_other_shapes_names_lengths_and_ends_are_told(new, said):
    (line,) = differences(arrays(), new)
    assert said in line


def test_states_are_compared_where_their_size_is_the_same():
    (line,) = state_differences(arrays(), arrays(state__denoiser=np.array([2.0, np.nan])))
    assert line == "final state of denoiser[0]: old 1.0, new 2.0 (1 differ)"
    longer = arrays(state__denoiser=np.zeros(3))
    assert list(state_differences(arrays(), longer)) == []
    assert list(relaid(arrays(), longer)) == [("denoiser", "2 -> 3 numbers")]
