"""Joints by name at the entrance of a stage."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fpt_ros.cycle.joints import Entrance
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import Desired, JointStates

NAMES = ("shoulder", "elbow", "wrist")


def states(names, **vectors):
    full = {"position": (), "velocity": (), "effort": (), **vectors}
    return JointStates(7, tuple(names), **full)


@given(st.permutations([*NAMES, "gripper", "mast"]))
def test_any_order_and_more_joints_meet_the_right_numbers(names):
    numbers = {name: float(i + 1) for i, name in enumerate((*NAMES, "gripper", "mast"))}
    frame = states(
        names,
        position=[numbers[name] for name in names],
        velocity=[-numbers[name] for name in names],
        effort=[10 * numbers[name] for name in names],
    )
    taken = Entrance("denoiser, joint_states", NAMES).take(frame)
    assert (taken.stamp, taken.names) == (7, NAMES)
    assert [list(each) for each in taken[2:]] == [[1, 2, 3], [-1, -2, -3], [10, 20, 30]]


def test_what_a_sender_leaves_out_is_not_known():
    taken = Entrance("denoiser", NAMES).take(states(NAMES, position=[1.0, 2.0, 3.0]))
    assert taken.position == [1.0, 2.0, 3.0]
    assert all(map(math.isnan, [*taken.velocity, *taken.effort]))


def test_names_may_change_from_message_to_message():
    entrance = Entrance("denoiser", ("a", "b"))
    for names in (("a", "b"), ("b", "a"), ("x", "b", "a"), ("a", "b")):
        place = {name: float(ord(name)) for name in names}
        vector = [place[name] for name in names]
        taken = entrance.take(states(names, position=vector, velocity=vector, effort=vector))
        assert list(taken.position) == [97.0, 98.0]


def test_the_first_frame_decides_where_no_names_are_given():
    entrance = Entrance("denoiser", ())
    entrance.take(states(("b", "a"), position=[2.0, 1.0]))
    assert entrance.names == ("b", "a")
    assert entrance.take(states(("a", "b"), position=[1.0, 2.0])).position == [2.0, 1.0]


@pytest.mark.parametrize(
    ("frame", "message"),
    [
        (states(("shoulder", "elbow"), position=[1.0, 2.0]), "the joint 'wrist' is not there, on"),
        (states((), position=[]), "the joint 'shoulder' is not there, only none at all"),
        (states((*NAMES, "elbow"), position=[1.0] * 4), "the joint 'elbow' is named twice"),
        (states(NAMES, position=[1.0, 2.0]), "position holds 2 numbers for 3 joints"),
        (states(NAMES, position=[1.0] * 3, velocity=[1.0] * 4), "velocity holds 4 numbers for 3"),
    ],
)
def test_what_cannot_be_used_is_refused_by_name(frame, message):
    with pytest.raises(BadInput, match=message) as caught:
        Entrance("denoiser, joint_states", NAMES).take(frame)
    assert str(caught.value).startswith("denoiser, joint_states: ")


def test_coordinates_whose_turn_it_is_not_may_be_absent():
    entrance = Entrance("fpt_deformer, desired", ("q1", "q2"), partial=True)
    taken = entrance.take(Desired(0, ("q2",), [1.0], [2.0], [3.0], [4.0]))
    assert taken.names == ("q1", "q2")
    assert [each[1] for each in taken[2:]] == [1.0, 2.0, 3.0, 4.0]
    assert all(math.isnan(each[0]) for each in taken[2:])
    with pytest.raises(BadInput, match="the joint 'q1' is not there"):
        entrance.take(Desired(0, ("q3",), [1.0], [2.0], [3.0], [4.0]))
