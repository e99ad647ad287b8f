"""Two tones that grow from a posture: derivatives against differences, and the ends of the rise."""

import numpy as np
import pytest

from fpt_ros.parameters import resolve
from fpt_ros.trajectories import TRAJECTORIES

GIVEN = {
    "offset": [0.5, -1.0],
    "phase": [0.3, 1.1],
    "second_amplitude": [0.2, 0.1],
    "second_frequency": [3.1, 5.7],
    "second_phase": [0.5, 2.2],
    "rise": 1.5,
}


def motion(times):
    law = TRAJECTORIES["blended_sines"]
    own = resolve(law.parameters, GIVEN, "test")
    constants = law.prepare({**own, "amplitude": [0.3, 0.4], "frequency": [2.0, 1.3]}, 2)
    rows = []
    for t in times:
        out = [[0.0, 0.0] for _ in range(3)]
        law.nominal(constants, [], t, 0.0, *out)
        rows.append(out)
    return np.array(rows)


def test_velocity_and_acceleration_are_derivatives():
    h = 1e-4
    t = np.arange(0.0, 3.0, h)
    found = motion(t)
    smooth = np.abs(t - GIVEN["rise"]) > 2 * h  # where the acceleration has a corner
    smooth[:2] = smooth[-2:] = False
    for order in (1, 2):
        expected = np.gradient(found[:, order - 1], h, axis=0)
        assert np.abs(found[:, order] - expected)[smooth].max() < 1e-5


def test_it_begins_at_rest_at_the_posture():
    ((q, v, a),) = motion([0.0])
    assert list(q) == GIVEN["offset"]
    assert list(v) == list(a) == [0.0, 0.0]


def test_after_the_rise_it_is_two_tones():
    t = 2.7
    ((q, _, _),) = motion([t])
    for i, (a, w) in enumerate(((0.3, 2.0), (0.4, 1.3))):
        first = a * np.sin(w * t + GIVEN["phase"][i])
        angle = GIVEN["second_frequency"][i] * t + GIVEN["second_phase"][i]
        second = GIVEN["second_amplitude"][i] * np.sin(angle)
        assert q[i] == pytest.approx(GIVEN["offset"][i] + first + second, abs=1e-14)
