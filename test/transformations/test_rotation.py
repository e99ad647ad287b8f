"""Abstract rotations against the matrix exponential, and what holds of them by construction."""

import math

import numpy as np
import pytest
from engine_runs import settled_rms, topics_of
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from fpt_ros.transformations.rotation import ROTATION

RADIUS = 10.0
SMALL = st.lists(st.floats(-4.0, 4.0), min_size=3, max_size=3)
ANY = st.lists(st.floats(-50.0, 50.0), min_size=3, max_size=3)


def rotated(r, f, desired, part):
    h, out = [a - b for a, b in zip(f, desired, strict=True)], [0.0] * len(r)
    ROTATION.deform((part, RADIUS), r, h, f, desired, out)
    return np.array(out)


def lifted(x):
    return np.array([*x, math.sqrt(RADIUS**2 - np.dot(x, x))])


@given(SMALL, SMALL, SMALL, st.floats(-1.0, 1.0))
def test_it_is_the_exponential_of_the_plane_of_both_responses(r, f, desired, part):
    a, b, c = map(lifted, (r if f == desired else f, desired, r))
    a = lifted(f)
    u = a / RADIUS
    across = b - (u @ b) * u
    if np.linalg.norm(across) < 1e-6:
        return
    v = across / np.linalg.norm(across)
    angle = math.acos(min(1.0, max(-1.0, a @ b / RADIUS**2)))
    turned = expm(part * angle * (np.outer(v, u) - np.outer(u, v))) @ c
    assert rotated(r, f, desired, part) == pytest.approx(turned[:3], abs=1e-6)


@given(ANY, ANY, ANY, st.floats(-2.0, 2.0))
def test_no_response_is_longer_than_the_radius(r, f, desired, part):
    if np.linalg.norm(np.subtract(f, desired)) < 1e-9:
        return
    assert np.linalg.norm(rotated(r, f, desired, part)) <= RADIUS * (1.0 + 1e-12)


def test_the_solution_is_a_fixed_point_and_the_whole_angle_takes_f_to_it():
    r, f, desired = [1.0, 2.0, -1.0], [3.0, -1.0, 0.5], [0.5, 0.2, 4.0]
    assert rotated(r, desired, desired, 0.7).tolist() == r
    assert rotated(f, f, desired, 1.0) == pytest.approx(desired, abs=1e-12)


def test_small_errors_are_multiplied_by_the_gain():
    r, desired = [1.0, 2.0, -1.0], [1e-3, -2e-3, 1e-3]
    out = [0.0] * 3
    f = [2e-3, 1e-3, -1e-3]
    h = np.subtract(f, desired)
    ROTATION.deform((0.3, 1e6), r, h.tolist(), f, desired, out)
    slope = ROTATION.slope((0.3, 1e6))
    assert np.subtract(out, r) == pytest.approx(0.3 * slope * h, abs=1e-9)


@pytest.mark.parametrize(("name", "settle"), [("tora", 4.0), ("duffing", 3.0)])
def test_it_makes_up_for_a_wrong_model(name, settle):
    turned = settled_rms(topics_of(name, "rotation"), settle)
    without = settled_rms(topics_of(name, "nonadaptive"), settle)
    assert all(turned[joint] < without[joint] / 2.0 for joint in turned)
