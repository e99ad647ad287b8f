"""A freeway with an on-ramp: six segments of the macroscopic model METANET (Hegyi 2004).

With densities rho [veh/km/lane], speeds v [km/h], the ramp's flow r [veh/h] into the fifth one::

    rho_i' = (rho_{i-1} v_{i-1} - rho_i v_i + r_i / lanes) / L
    v_i' = (V(rho_i) - v_i) / tau + v_i (v_{i-1} - v_i) / L
           - eta (rho_{i+1} - rho_i) / (tau L (rho_i + kappa))
           - delta r_i v_i / (L lanes (rho_i + kappa))
    V(rho) = v_free exp(-(rho / rho_crit)^a / a)

Vehicles come at a constant flow and at the first segment's speed; behind the last one the road is
free. Explicit Euler with 10 s is the source's own discrete model (Papageorgiou and others 1990).

The model counts vehicles of the fifth segment alone, and takes speeds from its own curve V.
"""

import math

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

SEGMENTS = 6
RAMP = 4
"""The segment that the ramp leads into, counted from 0."""

COORDINATES = (
    *(f"rho{i + 1}" for i in range(SEGMENTS)),
    *(f"v{i + 1}" for i in range(SEGMENTS)),
)

PARAMETERS = (
    Parameter("inflow", "vehicles that come", unit="veh/h", minimum=0.0),
    Parameter("lanes", "lanes", above=0.0),
    Parameter("length", "of a segment", unit="km", above=0.0),
    Parameter("tau", "time in which drivers adapt their speed", unit="s", above=0.0),
    Parameter("eta", "anticipation", unit="km^2/h", minimum=0.0),
    Parameter("kappa", "density that keeps it finite", unit="veh/km/lane", above=0.0),
    Parameter("delta", "slowing down by merging", minimum=0.0),
    Parameter("a", "shape of the speed's curve", above=0.0),
    Parameter("v_free", "speed on a free road", unit="km/h", above=0.0),
    Parameter("rho_crit", "density of the largest flow", unit="veh/km/lane", above=0.0),
)

INFLOW, LANES, LENGTH, TAU, ETA, KAPPA, DELTA, SHAPE, V_FREE, RHO_CRIT = range(10)
HOUR = 3600.0


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """As they are, tau in hours."""
    p = tuple(parameters)
    return (*p[:TAU], p[TAU] / HOUR, *p[ETA:])


@helper
def wanted_speed(c: Vector, rho: float) -> float:
    """V(rho) [km/h]."""
    if rho <= 0.0:
        return c[V_FREE]
    return c[V_FREE] * math.exp(-math.exp(c[SHAPE] * math.log(rho / c[RHO_CRIT])) / c[SHAPE])


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """Rates of densities and speeds, a second."""
    lanes, L, tau = c[LANES], c[LENGTH], c[TAU]
    for i in range(SEGMENTS):
        rho, speed = q[i], q[SEGMENTS + i]
        ramp = effort[i]
        flow_in = q[i - 1] * q[SEGMENTS + i - 1] if i > 0 else c[INFLOW] / lanes
        speed_in = q[SEGMENTS + i - 1] if i > 0 else speed
        ahead = q[i + 1] if i < SEGMENTS - 1 else min(rho, c[RHO_CRIT])
        out[i] = (flow_in - rho * speed + ramp / lanes) / L / HOUR
        rate = (wanted_speed(c, rho) - speed) / tau + speed * (speed_in - speed) / L
        rate -= c[ETA] * (ahead - rho) / (tau * L * (rho + c[KAPPA]))
        rate -= c[DELTA] * ramp * speed / (L * lanes * (rho + c[KAPPA]))
        out[SEGMENTS + i] = rate / HOUR


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The ramp's flow [veh/h] that should cause rho5' = r."""
    for i in range(len(out)):
        out[i] = 0.0
    before, here = q[RAMP - 1], q[RAMP]
    flows = before * wanted_speed(c, before) - here * wanted_speed(c, here)
    out[RAMP] = c[LANES] * (c[LENGTH] * HOUR * r[RAMP] - flows)


PLANT = Plant(
    coordinates=COORDINATES,
    units=("veh/km/lane",) * SEGMENTS + ("km/h",) * SEGMENTS,
    effort_units=("veh/h",) * (2 * SEGMENTS),
    parameters=PARAMETERS,
    coefficients=coefficients,
    response=response,
    order=1,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=(COORDINATES[RAMP],),
    parameters=PARAMETERS,
    coefficient_names=(),
    coefficients=coefficients,
    effort=effort,
)
