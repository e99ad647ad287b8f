"""Fixed point inverse kinematics against the closed form of two links, and at a singularity."""

import math

import numpy as np
import pytest

from fpt_ros.trajectories import TRAJECTORIES

DT = 0.001
LINKS = (0.3, 0.2)


def tip(q, links=LINKS):
    angles = np.cumsum(np.asarray(q), axis=-1)
    return np.array([np.sin(angles) @ links, -np.cos(angles) @ links])


def motion(start, cycles, links=LINKS, **values):
    law, c = TRAJECTORIES["inverse_kinematics"], len(start)
    own = {p.name: p.default for p in law.parameters}
    own |= {"amplitude": [0.05] * c, "frequency": [2.0] * c, "links": list(links), "start": start}
    constants, state, rows = law.prepare(own | values, c), list(law.state), []
    for k in range(cycles):
        out = [0.0] * c, [0.0] * c, [0.0] * c
        law.nominal(constants, state, k * DT, DT if k else 0.0, *out)
        rows.append([list(x) for x in out])
    return np.array(rows).transpose(1, 0, 2)


def path(start, cycles, direction, amplitude=0.05, links=LINKS):
    t = DT * np.arange(cycles)
    along = np.array([math.sin(direction), -math.cos(direction)])
    return tip(start, links) + np.outer(amplitude * (1.0 - np.cos(2.0 * t)), along)


def two_links(x, y):
    """Angles of both links from the law of cosines, the elbow bent as q2 > 0."""
    cosine = (x * x + y * y - LINKS[0] ** 2 - LINKS[1] ** 2) / (2.0 * LINKS[0] * LINKS[1])
    q2 = np.arccos(cosine)
    bend = np.arctan2(LINKS[1] * np.sin(q2), LINKS[0] + LINKS[1] * np.cos(q2))
    return np.arctan2(x, -y) - bend, q2


def test_the_postures_are_those_of_the_law_of_cosines():
    q, v, a = motion([0.3, 1.2], 3000, direction=2.0)
    wanted = path([0.3, 1.2], 3000, 2.0)
    assert pytest.approx(wanted, abs=2e-5) == tip(q).T
    assert q == pytest.approx(np.column_stack(two_links(*wanted.T)), abs=2e-4)
    assert v[1:] == pytest.approx(np.diff(q, axis=0) / DT, abs=1e-9)
    assert np.abs(a).max() < 20.0


def test_a_redundant_arm_follows_with_the_smallest_steps():
    """Three links in the plane: no motion in the null space of J."""
    links, start = (0.3, 0.2, 0.2), [0.3, 0.8, 0.4]
    q, v, _ = motion(start, 1500, links, direction=2.0)
    assert pytest.approx(path(start, 1500, 2.0, links=links), abs=3e-5) == tip(q, links).T
    angles = np.cumsum(q[700])
    J = np.array(
        [
            [np.cos(angles[i:]) @ links[i:] for i in range(3)],
            [np.sin(angles[i:]) @ links[i:] for i in range(3)],
        ]
    )
    null = np.linalg.svd(J)[2][2]
    assert abs(null @ v[700]) < 0.02 * np.linalg.norm(v[700])


def test_at_a_singularity_the_arm_stretches_and_comes_back():
    """The path leaves the circle that the arm can reach, where J^-1 would have no bound."""
    start = [0.0, 0.6]
    outward = math.atan2(tip(start)[0], -tip(start)[1])
    q, v, _ = motion(start, 3141, direction=outward, amplitude=[0.02, 0.02])
    wanted = path(start, 3141, outward, 0.02)
    far = np.linalg.norm(wanted, axis=1)
    assert far.max() > sum(LINKS) + 0.003
    reached = np.linalg.norm(tip(q).T, axis=1)
    assert sum(LINKS) - 0.002 < reached[far > sum(LINKS) + 0.002].min()
    assert np.abs(v).max() < 10.0
    lack = (wanted - tip(q).T) / DT
    angles = np.cumsum(q, axis=1)
    J = np.array(
        [
            [np.cos(angles) @ LINKS, np.cos(angles[:, 1]) * LINKS[1]],
            [np.sin(angles) @ LINKS, np.sin(angles[:, 1]) * LINKS[1]],
        ]
    ).transpose(2, 0, 1)
    by_inverse = np.linalg.norm(np.linalg.solve(J, lack[:, :, None]), axis=(1, 2))
    assert by_inverse.max() > 1000.0  # [rad/s]
    assert tip(q)[:, -1] == pytest.approx(wanted[-1], abs=5e-3)
