"""Spherical pendulum: (4.8) against an energy, fuzzy sine and cosine, three models."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mechanics import derivative, exert, power, respond

from fpt_ros.plants.spherical_pendulum import (
    AFFINE_MODEL,
    COSINES,
    FULLY_FUZZY,
    FUZZY_SIN,
    PLANT,
    SINES,
    fuzzy,
)

rate = st.floats(-3.0, 3.0)
angle = st.floats(0.3, math.pi - 0.3)
torque = st.floats(-20.0, 20.0)
physical = st.tuples(st.floats(0.3, 3.0), st.floats(0.5, 2.0), st.floats(0.0, 20.0))


def energy(parameters, q, v):
    """Of a point mass in space."""
    m, L, g = parameters
    (c1, s1), (c2, s2) = ((math.cos(x), math.sin(x)) for x in q)
    along = np.array([c1 * c2, c1 * s2, s1])
    across = np.array([-s1 * s2, s1 * c2, 0.0])
    velocity = L * (v[0] * along + v[1] * across)
    return 0.5 * m * velocity @ velocity - m * g * L * c1


@settings(deadline=None, max_examples=200)
@given(physical, st.tuples(angle, rate), st.tuples(rate, rate), st.tuples(torque, torque))
def test_energy_changes_by_the_power_of_the_torques(parameters, q, v, effort):
    a = respond(PLANT, parameters, q, v, effort)
    change = derivative(lambda x, y: energy(parameters, x, y), q, v, a)
    scale = 1.0 + abs(energy(parameters, q, v)) * (1.0 + max(map(abs, a))) ** 2
    assert change == pytest.approx(power(effort, v), abs=1e-7 * scale)


@settings(deadline=None, max_examples=100)
@given(physical, st.tuples(angle, rate), st.tuples(rate, rate), torque)
def test_the_angular_momentum_about_the_vertical_changes_by_its_torque(parameters, q, v, drive):
    m, L, _ = parameters
    a = respond(PLANT, parameters, q, v, (drive, 0.7 * drive))
    change = derivative(lambda x, y: m * L * L * math.sin(x[0]) ** 2 * y[1], q, v, a)
    scale = m * L * L * (1.0 + max(map(abs, a))) ** 2
    assert change == pytest.approx(0.7 * drive, abs=1e-8 * scale)


@settings(deadline=None)
@given(physical, rate, st.tuples(rate, rate), st.tuples(torque, torque))
def test_the_fuzzy_model_inverts_the_plant_where_its_functions_are_exact(p, turn, v, effort):
    """sin = 1 and cos = 0 at pi/2."""
    q = (math.pi / 2.0, turn)
    a = respond(PLANT, p, q, v, effort)
    scale = 1.0 + max(map(abs, a)) * p[0] * p[1] ** 2
    assert exert(FULLY_FUZZY, p, q, v, a) == pytest.approx(effort, abs=1e-12 * scale)


@settings(deadline=None)
@given(st.floats(-1.0, 5.0))
def test_fuzzy_functions(x):
    """Linear between the centres, which stand pi/4 apart; clipped to [0, pi]."""
    centres = np.arange(5) * math.pi / 4.0
    for singletons in (SINES, COSINES):
        assert fuzzy(singletons, x) == pytest.approx(np.interp(x, centres, singletons), abs=1e-14)


def test_largest_error_of_the_fuzzy_functions():
    x = np.linspace(0.0, math.pi, 20_001)
    for function, singletons in ((np.sin, SINES), (np.cos, COSINES)):
        errors = np.abs(function(x) - [fuzzy(singletons, each) for each in x])
        assert errors.max() == pytest.approx(0.0739, abs=5e-5)


@settings(deadline=None)
@given(st.tuples(angle, rate), st.tuples(rate, rate), st.tuples(rate, rate))
def test_the_affine_models(q, v, r):
    sin = math.sin(q[0])
    efforts = exert(AFFINE_MODEL, (2.0, 1.5, 0.7), q, v, r)
    assert efforts == pytest.approx([4.5 * r[0] + 0.7, 4.5 * sin**2 * r[1] + 0.7], rel=1e-14)
    sin = fuzzy(SINES, q[0])
    efforts = exert(FUZZY_SIN, (2.0, 1.5, 0.7), q, v, r)
    assert efforts == pytest.approx([4.5 * r[0] + 0.7, 4.5 * sin**2 * r[1] + 0.7], rel=1e-14)


@settings(deadline=None)
@given(st.tuples(angle, rate), st.tuples(rate, rate), st.tuples(rate, rate))
def test_the_fully_fuzzy_model_with_the_numbers_of_the_experiment(q, v, r):
    """Q1 = r1 - mu_s mu_c q2'^2 + 10 mu_s, Q2 = mu_s^2 r2 + 2 mu_s mu_c q1' q2'."""
    s, c = fuzzy(SINES, q[0]), fuzzy(COSINES, q[0])
    expected = [
        r[0] - s * c * v[1] ** 2 + 10.0 * s,
        s * s * r[1] + 2.0 * s * c * v[0] * v[1],
    ]
    assert exert(FULLY_FUZZY, (1.0, 1.0, 10.0), q, v, r) == pytest.approx(expected, abs=1e-12)


def test_the_workspace_is_between_the_singularities():
    (low, high), free = PLANT.workspace(PLANT.coefficients((0.5, 1.5, 9.81)))
    assert (low, high) == (0.0, math.pi)
    assert free == (-math.inf, math.inf)
