"""The swing: (4.2), (4.3) against the energy of two point masses."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mechanics import derivative, exert, power, respond

from fpt_ros.plants.swing import MODEL, PLANT

EXACT = (2.0, 1.0, 1.0, 2.0, 9.81)
APPROXIMATE = (2.2, 0.8, 1.0, 2.0, 10.0)

angle = st.floats(-math.pi, math.pi)
rate = st.floats(-3.0, 3.0)
torque = st.floats(-50.0, 50.0)
mass = st.floats(0.3, 5.0)
physical = st.tuples(mass, mass, st.floats(0.3, 2.0), st.floats(0.3, 2.0), st.floats(0.0, 20.0))
pair = st.tuples(rate, rate)


def energy(parameters, q, v):
    """Of the two masses, at their positions in the plane."""
    m1, m2, L1, L2, g = parameters
    first = L1 * np.array([math.sin(q[0]), -math.cos(q[0])])
    upper = L1 * v[0] * np.array([math.cos(q[0]), math.sin(q[0])])
    both = q[0] + q[1]
    second = first + L2 * np.array([math.sin(both), -math.cos(both)])
    lower = upper + L2 * (v[0] + v[1]) * np.array([math.cos(both), math.sin(both)])
    kinetic = 0.5 * m1 * upper @ upper + 0.5 * m2 * lower @ lower
    return kinetic + g * (m1 * first[1] + m2 * second[1])


@settings(deadline=None, max_examples=200)
@given(physical, st.tuples(angle, angle), pair, st.tuples(torque, torque))
def test_energy_changes_by_the_power_of_the_torques(parameters, q, v, effort):
    a = respond(PLANT, parameters, q, v, effort)
    assume(max(map(abs, a)) < 1e4)
    change = derivative(lambda x, y: energy(parameters, x, y), q, v, a)
    scale = 1.0 + abs(energy(parameters, q, v)) * (1.0 + max(map(abs, a))) ** 2
    assert change == pytest.approx(power(effort, v), abs=1e-7 * scale)


@settings(deadline=None, max_examples=200)
@given(physical, st.tuples(angle, angle), pair, torque, st.sampled_from([0, 1]))
def test_an_exact_model_inverts_the_plant_for_the_coordinate_of_the_turn(
    parameters, q, v, drive, active
):
    _, m2, L1, L2, _ = parameters
    coupling = m2 * L2 * (L2 + L1 * math.cos(q[1]))
    assume(active == 1 or abs(coupling) > 0.05)  # the torque cannot turn q1 at H12 = 0
    a = respond(PLANT, parameters, q, v, (0.0, drive))
    wanted = [math.nan, math.nan]
    wanted[active] = a[active]
    effort = exert(MODEL, parameters, q, v, wanted)
    assert effort[0] == 0.0
    scale = (1.0 + abs(drive) + max(map(abs, a))) / min(abs(coupling), 1.0)
    assert effort[1] == pytest.approx(drive, abs=1e-9 * scale)


@settings(deadline=None)
@given(st.tuples(angle, angle), pair, rate, st.sampled_from([0, 1]))
def test_a_wrong_model_asks_for_another_response(q, v, r, active):
    """With Table 4.1: the drive still has an effect of the right sign, so A < 0 converges."""
    wanted = [[math.nan, math.nan], [math.nan, math.nan]]
    wanted[0][active], wanted[1][active] = r, r + 1.0
    answers = [
        respond(PLANT, EXACT, q, v, exert(MODEL, APPROXIMATE, q, v, each))[active]
        for each in wanted
    ]
    assert 0.2 < answers[1] - answers[0] < 5.0


def test_natural_frequency_of_the_straight_pendulum():
    """Sqrt(49.05 / 11) = 2.1117 rad/s: q2 stays 0 where a torque holds it there."""
    (a1, a2) = respond(PLANT, EXACT, (1e-6, 0.0), (0.0, 0.0), (0.0, 0.0))
    held = exert(MODEL, EXACT, (1e-6, 0.0), (0.0, 0.0), (math.nan, 0.0))
    straight = respond(PLANT, EXACT, (1e-6, 0.0), (0.0, 0.0), held)
    assert straight[1] == pytest.approx(0.0, abs=1e-18)
    assert math.sqrt(-straight[0] / 1e-6) == pytest.approx(math.sqrt(49.05 / 11.0), rel=1e-9)
    assert a1 < 0.0
    assert a2 != 0.0
