"""LuGre friction: its steady state is the Stribeck curve."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fpt_ros.disturbances import DISTURBANCES
from fpt_ros.disturbances.lugre import PARAMETERS

LUGRE = DISTURBANCES["lugre"]
SIGMA0, SIGMA1, SIGMA2, COULOMB, STATIC, STRIBECK = 1e5, 300.0, 2.0, 40.0, 60.0, 0.05


def constants(amplitude=1.0):
    values = {f"disturbance.{p.name}": p.default for p in PARAMETERS}
    values |= {"disturbance.amplitude": amplitude, "disturbance.frequency": 1.0}
    return LUGRE.prepare(values, 0, 100)


def stribeck(v):
    return COULOMB + (STATIC - COULOMB) * math.exp(-((v / STRIBECK) ** 2))


def test_defaults_are_those_of_the_experiment():
    assert constants() == (1.0, 1.0, SIGMA0, SIGMA1, SIGMA2, COULOMB, STATIC, STRIBECK)
    assert LUGRE.state == 1


@settings(deadline=None, max_examples=40)
@given(st.floats(0.01, 3.0), st.sampled_from([1.0, -1.0]), st.sampled_from([1e-4, 1e-3, 1e-2]))
def test_steady_friction_is_the_stribeck_curve(speed, sign, h):
    """Also with steps far larger than the bristles' time constant: z is implicit."""
    v, state = sign * speed, [0.0]
    for _ in range(30_000):
        force = LUGRE.force(constants(), state, 0.0, h, 0.0, v)
        if math.isclose(state[0], sign * stribeck(v) / SIGMA0, rel_tol=1e-14):
            break
    force = LUGRE.force(constants(), state, 0.0, h, 0.0, v)
    expected = -sign * (stribeck(v) + SIGMA2 * speed)
    assert force == pytest.approx(expected, rel=1e-9)


def test_the_force_uses_the_deflection_before_its_step():
    """F = -(sigma0 z + sigma1 z' + sigma2 v), then z <- (z + h v) / (1 + h sigma0 |v| / G)."""
    z, v, h, state = 1e-4, 0.02, 1e-4, [1e-4]
    force = LUGRE.force(constants(2.5), state, 0.0, h, 0.0, v)
    rate = v - SIGMA0 * v * z / stribeck(v)
    assert force == pytest.approx(-2.5 * (SIGMA0 * z + SIGMA1 * rate + SIGMA2 * v), rel=1e-14)
    assert state[0] == pytest.approx((z + h * v) / (1 + h * SIGMA0 * v / stribeck(v)), rel=1e-14)


def test_at_rest_the_bristles_are_a_spring():
    state = [2e-4]
    assert LUGRE.force(constants(), state, 0.0, 1e-4, 0.0, 0.0) == pytest.approx(-20.0)
    assert state == [2e-4]


def test_friction_takes_energy_from_a_sliding_motion():
    """Over whole periods of a back and forth, about Coulomb friction times the way."""
    h, state, work = 1e-4, [0.0], 0.0
    velocities = np.sin(2.0 * math.pi * np.arange(40_000) * h)  # 4 periods, 1 m/s
    for v in velocities:
        work += h * v * LUGRE.force(constants(), state, 0.0, h, 0.0, float(v))
    way = h * np.abs(velocities).sum()
    assert -62.0 * way < work < -39.0 * way


def test_no_amplitude_is_no_force():
    assert LUGRE.force(constants(0.0), [1e-4], 0.0, 1e-4, 0.0, 1.0) == 0.0
