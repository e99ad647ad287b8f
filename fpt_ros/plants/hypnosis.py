"""Depth of hypnosis under propofol: the index WAV_CNS answers the rate of an infusion.

Three compartments (Schnider and others 1998), an effect site and the Hill curve::

    C1' = u / V1 - k10 C1 - k12 (C1 - C2) - k13 (C1 - C3)
    C2' = k21 (C1 - C2),   C3' = k31 (C1 - C3),   Ce' = ke0 (C1 - Ce)
    wav = E0 (1 - H),   H = y^gamma / (1 + y^gamma),   y = Ce / EC50

100 is awake, 40 to 60 is surgery. wav'' is affine in u, so the response is of order 2; the
concentrations are the plant's own state, in equilibrium at the start. No pump takes drug back:
a rate below zero acts as zero. Curves of patients: Hosseinirad and others 2023, as AReS has them
(Hosseinirad, Merlo and others 2025). The monitor's filter is not in it.

The model knows the index alone: it takes C1 and Ce from it, and C2 = C3 = 0.
"""

import math

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.parameters import Parameter
from fpt_ros.plants import Model, Plant

COORDINATES = ("wav",)

PARAMETERS = (
    Parameter("E0", "index of a patient who is awake", above=0.0),
    Parameter("EC50", "concentration of half the effect", unit="mg/l", above=0.0),
    Parameter("gamma", "steepness of the Hill curve", above=0.0),
    Parameter("ke0", "rate of the effect site", unit="1/min", above=0.0),
    Parameter("V1", "volume of the central compartment", unit="l", above=0.0),
    Parameter("k10", "elimination", unit="1/min", minimum=0.0),
    Parameter("k12", "into the fast compartment", unit="1/min", minimum=0.0),
    Parameter("k21", "out of it", unit="1/min", minimum=0.0),
    Parameter("k13", "into the slow compartment", unit="1/min", minimum=0.0),
    Parameter("k31", "out of it", unit="1/min", minimum=0.0),
)

E0, EC50, GAMMA, KE0, V1, K10, K12, K21, K13, K31 = range(10)
LEAST = 1e-9
"""Effects that are smaller count as this one: without drug the curve is flat."""


def coefficients(parameters: Vector) -> tuple[float, ...]:
    """Rates in 1/s; u is in mg/min."""
    p = tuple(parameters)
    return (*p[:KE0], p[KE0] / 60.0, 60.0 * p[V1], *(each / 60.0 for each in p[K10:]))


@helper
def effect(c: Vector, site: float) -> float:
    """H of the concentration at the effect site."""
    if site <= 0.0:
        return LEAST
    power = math.exp(c[GAMMA] * math.log(site / c[EC50]))
    return max(power / (1.0 + power), LEAST)


@helper
def site_of(c: Vector, wav: float) -> float:
    """Concentration at the effect site, for an index."""
    H = min(max(1.0 - wav / c[E0], LEAST), 1.0 - LEAST)
    return c[EC50] * math.exp(math.log(H / (1.0 - H)) / c[GAMMA])


@helper
def slopes(c: Vector, site: float, which: int) -> float:
    """First (1) or second (2) derivative of H."""
    H = effect(c, site)
    first = c[GAMMA] * H * (1.0 - H) / site
    return first if which == 1 else first * (c[GAMMA] * (1.0 - 2.0 * H) - 1.0) / site


@helper
def central_rate(c: Vector, C1: float, C2: float, C3: float, u: float) -> float:
    """C1'."""
    return u / c[V1] - c[K10] * C1 - c[K12] * (C1 - C2) - c[K13] * (C1 - C3)


@helper
def second(c: Vector, C1: float, site: float, C1_dot: float) -> float:
    """Wav''."""
    site_dot = c[KE0] * (C1 - site)
    site_second = c[KE0] * (C1_dot - site_dot)
    bent = slopes(c, site, 2) * site_dot * site_dot + slopes(c, site, 1) * site_second
    return -c[E0] * bent


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """Wav'' with the compartments in equilibrium, for analyses."""
    site = site_of(c, q[0])
    C1 = site - v[0] / (c[E0] * slopes(c, site, 1) * c[KE0])
    out[0] = second(c, C1, site, central_rate(c, C1, C1, C1, effort[0]))


def start(c: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """C1, C2, C3, Ce for an index; all the same where it is at rest."""
    site = site_of(c, q[0])
    C1 = site - v[0] / (c[E0] * slopes(c, site, 1) * c[KE0])
    state[0], state[1], state[2], state[3] = C1, C1, C1, site


def advance(
    c: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    effort: Vector,
    external: Vector,
    q: MutableVector,
    v: MutableVector,
    acted: MutableVector,
) -> None:
    """One step of explicit Euler."""
    acted[0] = max(effort[0], 0.0)
    C1, C2, C3, site = state[0], state[1], state[2], state[3]
    state[0] = C1 + dt * central_rate(c, C1, C2, C3, acted[0] + external[0])
    state[1] = C2 + dt * c[K21] * (C1 - C2)
    state[2] = C3 + dt * c[K31] * (C1 - C3)
    state[3] = site = site + dt * c[KE0] * (C1 - site)
    q[0] = c[E0] * (1.0 - effect(c, site))
    v[0] = -c[E0] * slopes(c, site, 1) * c[KE0] * (state[0] - site) if site > 0.0 else math.nan


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """Infusion [mg/min] that should cause wav'' = r."""
    site = site_of(c, q[0])
    slope = slopes(c, site, 1)
    site_dot = -v[0] / (c[E0] * slope)
    site_second = (-r[0] / c[E0] - slopes(c, site, 2) * site_dot * site_dot) / slope
    C1, C1_dot = site + site_dot / c[KE0], site_dot + site_second / c[KE0]
    out[0] = c[V1] * (C1_dot + (c[K10] + c[K12] + c[K13]) * C1)


def trouble(c: Vector, q: Vector) -> str:
    """An index that no concentration has."""
    if 0.0 < q[0] < c[E0]:
        return ""
    return f"the index {q[0]:g} is not between 0 and E0 = {c[E0]:g}: no concentration has it"


PLANT = Plant(
    coordinates=COORDINATES,
    units=("",),
    effort_units=("mg/min",),
    parameters=PARAMETERS,
    coefficients=coefficients,
    response=response,
    advance=advance,
    state=4,
    start=start,
    trouble=trouble,
)

MODEL = Model(
    coordinates=COORDINATES,
    controlled=COORDINATES,
    parameters=PARAMETERS,
    coefficient_names=(),
    coefficients=coefficients,
    effort=effort,
    trouble=trouble,
)
