"""What the watcher makes of the pieces that nodes tell: no ROS needed."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import Command, Desired, JointStates, StateEstimate, Tuning
from fpt_ros.messages.topics import BY_NAME
from fpt_ros.watch.curves import Wanted, curves, joints_of
from fpt_ros.watch.heard import Heard
from fpt_ros.watch.ring import Ring
from fpt_ros.watch.scales import scale
from fpt_ros.watch.thin import thin

MS = 1_000_000
NAN = math.nan


def told(topic, *frames):
    return BY_NAME[topic], [Codec(BY_NAME[topic]).encode(frame) for frame in frames]


@given(some.lists(some.integers(0, 7), max_size=30))
def test_a_ring_holds_the_last_rows(lengths):
    ring, all_rows = Ring(1, 5), []
    for length in lengths:
        new = np.arange(len(all_rows), len(all_rows) + length)
        ring.extend(new, new[:, None] / 2)
        all_rows += new.tolist()
        assert ring.stamps.tolist() == all_rows[-5:]
        assert ring.rows[:, 0].tolist() == [x / 2 for x in all_rows[-5:]]


def test_the_extremes_of_chatter_and_of_a_single_peak_are_shown():
    x = np.arange(10_000.0)
    rows = np.stack([np.where(x % 2, 1.0, -1.0), np.where(x == 5_003, 9.0, 0.0)], axis=1)
    _, seen = thin(x, rows, 100)
    assert len(seen) <= 200
    assert (np.sort(seen[:, 0].reshape(-1, 2)) == (-1.0, 1.0)).all()
    assert seen[:, 1].max() == 9.0


def test_what_is_shown_does_not_tremble_while_rows_come():
    x = np.arange(10_000.0)
    rows = np.random.default_rng(0).normal(size=(10_000, 1))
    first, before = thin(x[:8_000], rows[:8_000], 100, first=0)
    later, after = thin(x[37:8_037], rows[37:8_037], 100, first=37)
    common = np.intersect1d(first, later)
    assert len(common) >= 190
    assert np.array_equal(before[np.isin(first, common)], after[np.isin(later, common)])


def test_errors_are_of_the_same_cycle_and_lost_pieces_do_not_shift_them():
    heard = Heard()
    heard.take(
        *told("desired", *[Desired(k * MS, ("b",), (2.0 * k,), (0,), (1,), (0,)) for k in range(9)])
    )
    measured = [JointStates(k * MS, ("a", "b"), (0, k), (0, 0), (0, 0)) for k in (2, 3, 7)]
    heard.take(*told("joint_states", *measured))
    (error,) = curves(heard, Wanted(("a", "b"), 1.0, ()))["error"]
    assert error.x.tolist() == [0.002, 0.003, 0.007]
    assert list(error.y) == ["b"]
    assert error.y["b"].tolist() == [2.0, 3.0, 7.0]


def test_a_robot_shows_its_estimated_motion_and_the_gain_of_the_parameter():
    heard = Heard()
    stamps = [1_700_000_000 * 1000 * MS + k * MS for k in range(3)]
    heard.take(
        *told(
            "state_estimate", *[StateEstimate(t, ("a",), (5,), (0,), (1,), (NAN,)) for t in stamps]
        )
    )
    heard.take(*told("command", *[Command(t, ("a",), (1,), (2,)) for t in stamps]))
    assert joints_of(heard) == (("a",), ())
    found = curves(heard, Wanted(("a",), 1.0, ((0, -0.5), (stamps[2], -0.7))))
    assert found["motion"][1].y["a"].tolist() == [5.0] * 3
    assert np.allclose(found["motion"][1].x, [0.0, 0.001, 0.002])
    assert found["gain"][0].y["A"].tolist() == [-0.5, -0.5, -0.7]


def test_the_gain_that_acts_is_tuned_and_guarded():
    heard = Heard()
    names = ("A", "precursor", "gain_factor", "mass")
    heard.take(*told("tuning", *[Tuning(k * MS, names, (-2.0, 0.5, 0.25, 7)) for k in range(2)]))
    found = curves(heard, Wanted((), 1.0, ((0, -9.0),)))
    assert found["gain"][0].y["A"].tolist() == [-0.5] * 2
    assert found["precursor"][0].y["precursor"].tolist() == [0.5] * 2
    assert list(found["tuned"][0].y) == ["mass"]


def test_pieces_told_again_are_nothing_new_and_another_run_begins_anew():
    heard = Heard()
    piece = told("command", *[Command(k * MS, ("a",), (1,), (2,)) for k in range(10)])
    assert heard.take(*piece)
    assert not heard.take(*piece)
    assert heard.take(*told("command", Command(10 * MS, ("a",), (1,), (3,))))
    assert heard.tracks["command"].column("effort", "a").tolist() == [2.0] * 10 + [3.0]
    runs = heard.runs
    assert heard.take(*told("command", Command(0, ("b",), (1,), (4,))))
    assert heard.runs == runs + 1
    assert heard.tracks["command"].names == ("b",)


def test_bytes_of_something_else_are_left_out():
    heard = Heard()
    topic, messages = told("command", Command(0, ("a",), (1,), (2,)))
    assert heard.take(topic, [b"", b"nonsense", messages[0], messages[0][:20]])
    assert heard.tracks["command"].column("effort", "a").tolist() == [2.0]
    assert not heard.take(topic, [b"nonsense"])


def test_coordinates_that_take_turns_have_columns_of_their_own():
    heard = Heard()
    heard.take(*told("desired", Desired(0, ("a",), (1,), (1,), (1,), (1,))))
    heard.take(*told("desired", Desired(MS, ("b",), (2,), (2,), (2,), (2,))))
    track = heard.tracks["desired"]
    assert np.array_equal(track.column("positions", "a"), [1.0, NAN], equal_nan=True)
    assert np.array_equal(track.column("positions", "b"), [NAN, 2.0], equal_nan=True)


ENDS = some.one_of(
    some.sampled_from([(-math.inf, math.inf), (0.0, math.inf), (0.0, 1.0), (1e-9, 1e3)]),
    some.tuples(some.floats(-1e6, 0.0), some.floats(1e-3, 1e6)),
)


@given(some.floats(-1e12, 1e12), ENDS)
def test_a_slider_holds_its_value_and_gives_only_valid_ones(value, ends):
    low, high = ends
    value = min(max(value, low), high)
    if 0.0 < abs(value) < 1e-12:
        value = 0.0
    own = scale(value, low, high)
    assert own.start < own.end
    assert own.holds(value)
    back = own.value(own.place(value))
    assert back == pytest.approx(value, rel=1e-3, abs=1e-9)


def test_many_decades_are_a_scale_of_decades_and_one_keeps_the_sign():
    own = scale(-2e-10, -math.inf, math.inf)
    assert own.sign == -1
    assert own.value(own.start) == pytest.approx(-2e-12, rel=0.03)
    assert own.value(own.end) == pytest.approx(-2e-8, rel=0.03)
    assert scale(0.5, 0.0, 2.0).sign == 0
    assert scale(5, 1, 1000, whole=True).step == 1.0
