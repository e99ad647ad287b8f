"""Spherical pendulum, both angles driven (thesis, section 4.3, (4.8)).

q1 [rad] from the hanging position, q2 [rad] about the vertical; singular at sin q1 = 0. Three
approximate models: affine with the exact sine (4.3.3), affine with a fuzzy sine (4.3.4), and the
equations of motion with fuzzy sine and cosine (4.3.5).
"""

import math
from collections.abc import Callable

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("q1", "q2")

PARAMETERS = (
    Parameter("m", "mass", unit="kg", above=0.0),
    Parameter("L", "length", unit="m", above=0.0),
    Parameter("g", "gravitational acceleration", unit="m/s^2"),
)

AFFINE = (
    *PARAMETERS[:2],
    Parameter("h", "constant in the place of all forces but the inertial", 1.0, unit="N m"),
)

SINES = (0.0, 0.7, 1.0, 0.7, 0.0)
COSINES = (1.0, 0.7, 0.0, -0.7, -1.0)
"""Singletons of the five triangular sets, whose centres stand pi/4 apart over [0, pi]."""


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """(m, L, g) -> (m L^2, m g L)."""
    m, L, g = parameters
    return m * L * L, m * g * L


def affine_coefficients(parameters: Vector) -> tuple[float, ...]:
    """(m, L, h) -> (m L^2, h)."""
    m, L, h = parameters
    return m * L * L, h


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """Accelerations caused by the torques (4.8)."""
    cos, sin = math.cos(q[0]), math.sin(q[0])
    out[0] = (effort[0] + c[0] * sin * cos * v[1] * v[1] - c[1] * sin) / c[0]
    out[1] = (effort[1] - 2.0 * c[0] * sin * cos * v[0] * v[1]) / (c[0] * sin * sin)


@helper
def fuzzy(singletons: tuple[float, ...], x: float) -> float:
    """Weighted mean of the singletons by the membership of x in their sets."""
    x = min(max(x, 0.0), math.pi)
    total, weight = 0.0, 0.0
    for k in range(5):
        membership = max(0.0, 1.0 - abs(x - k * math.pi / 4.0) / (math.pi / 4.0))
        total += membership * singletons[k]
        weight += membership
    return total / weight


def affine(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """Q1 = I r1 + h, Q2 = I sin^2 q1 r2 + h."""
    sin = math.sin(q[0])
    out[0], out[1] = c[0] * r[0] + c[1], c[0] * sin * sin * r[1] + c[1]


def fuzzy_sin(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The affine model with the fuzzy sine."""
    sin = fuzzy(SINES, q[0])
    out[0], out[1] = c[0] * r[0] + c[1], c[0] * sin * sin * r[1] + c[1]


def fully_fuzzy(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """(4.8) with fuzzy sine and cosine."""
    sin, cos = fuzzy(SINES, q[0]), fuzzy(COSINES, q[0])
    out[0] = c[0] * r[0] - c[0] * sin * cos * v[1] * v[1] + c[1] * sin
    out[1] = c[0] * sin * sin * r[1] + 2.0 * c[0] * sin * cos * v[0] * v[1]


def workspace(c: Vector) -> tuple[tuple[float, float], ...]:
    """q1 strictly between the hanging and the upright position [rad]."""
    return (0.0, math.pi), (-math.inf, math.inf)


def trouble(c: Vector, q: Vector) -> str:
    """At sin q1 = 0 the pendulum has no moment of inertia about the vertical."""
    sin = math.sin(q[0])
    if abs(sin) > 1e-3:
        return ""
    return (
        f"sin q1 = {sin:.3g}: the plant is singular at 0 (plant_simulator.initial_position and the "
        "nominal motion have to keep q1 between 0 and pi)"
    )


PLANT = Plant(
    coordinates=COORDINATES,
    units=("rad", "rad"),
    effort_units=("N m", "N m"),
    parameters=PARAMETERS,
    coefficients=coefficients,
    response=response,
    workspace=workspace,
    trouble=trouble,
)


def _affine(effort: Callable[..., None]) -> Model:
    return Model(
        coordinates=COORDINATES,
        controlled=COORDINATES,
        parameters=AFFINE,
        coefficient_names=("inertia", "h"),
        coefficients=affine_coefficients,
        effort=effort,
    )


AFFINE_MODEL = _affine(affine)
FUZZY_SIN = _affine(fuzzy_sin)
FULLY_FUZZY = Model(
    coordinates=COORDINATES,
    controlled=COORDINATES,
    parameters=PARAMETERS,
    coefficient_names=("inertia", "gravity"),
    coefficients=coefficients,
    effort=fully_fuzzy,
)
