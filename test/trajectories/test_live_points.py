"""The law of a live motion: points carried on, held where nothing comes."""

import math

import pytest

from fpt_ros.errors import BadInput
from fpt_ros.trajectories.live import LIVE

GIVEN = {"amplitude": [2.0, 1.0], "frequency": [1.0, 1.0], "hold_after": 0.5}


class Motion:
    def __init__(self):
        self.state = list(LIVE.state)

    def at(self, t, number, positions=(), velocities=(), accelerations=()):
        values = {
            **GIVEN,
            "live.number": number,
            "live.positions": list(positions),
            "live.velocities": list(velocities),
            "live.accelerations": list(accelerations),
        }
        out = [[math.nan] * 2 for _ in range(3)]
        LIVE.nominal(LIVE.prepare(values, 2), self.state, t, 0.1, *out)
        return out


def test_at_rest_until_the_first_point():
    motion = Motion()
    assert motion.at(0.0, 0) == [[0.0, 0.0]] * 3
    assert motion.at(3.0, 0, [0.5, 1.0], [9.0, 9.0]) == [[1.0, 1.0], [0.0, 0.0], [0.0, 0.0]]


def test_a_point_is_carried_on_and_held():
    motion, point = Motion(), ([0.5, 1.0], [1.0, -1.0], [0.0, 4.0])
    motion.at(1.0, 0)
    assert motion.at(2.0, 1, *point) == [[1.0, 1.0], [2.0, -1.0], [0.0, 4.0]]
    q, v, a = motion.at(2.5, 1, *point)
    assert q == pytest.approx([2.0, 1.0])  # 2 (0.5 + 0.5), 1 - 0.5 + 4 / 8
    assert (v, a) == ([2.0, 1.0], [0.0, 4.0])
    for t in (2.6, 9.0):
        q, v, a = motion.at(t, 1, *point)
        assert q == pytest.approx([2.0, 1.0])
        assert (v, a) == ([0.0, 0.0], [0.0, 0.0])
    assert motion.at(9.1, 2, *point)[0] == [1.0, 1.0]  # the next one counts from its own cycle


def test_another_number_of_joints_is_refused():
    with pytest.raises(BadInput, match=r"live\.positions: 1 numbers given, 2 needed"):
        Motion().at(0.0, 1, [0.5])
