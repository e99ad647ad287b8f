"""The super-twisting algorithm (Levant 1993), beside a model.

A sliding mode of second order: s and s' reach zero in finite time under disturbances of bounded
rate, with an effort that is continuous, because the switching is integrated::

    tau = tau_0(r) + m (k1 sqrt|s| sign s + w),   w' = k2 sign s

Taken at the s of this cycle it would chatter by some k1^2 dt. It is taken at the s that it brings
about within the cycle, s+ = s - dt u, which follows from s alone (implicit Euler; Brogliato,
Polyakov and Efimov 2020)::

    b = s - dt w
    |b| <= dt^2 k2:  u = w = s / dt                               s+ is zero
    otherwise:       w <- w + dt k2 sign b,  u = k1 x sign b + w,
                     x = sqrt|s+| = (sqrt(dt^2 k1^2 + 4 (|b| - dt^2 k2)) - dt k1) / 2
"""

import math

from fpt_ros.compensators import Compensator, Observed, inertia
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    *inertia.PARAMETERS,
    Parameter("k1", "of the root of s", 20.0, minimum=0.0),
    Parameter("k2", "of its sign, integrated", 200.0, minimum=0.0),
)

MASS = 2
"""Constants: k1, k2, then m times the factor, n of them."""


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Gains and inertias."""
    gains = number(values, "compensator.k1"), number(values, "compensator.k2")
    return (*gains, *inertia.inertias(values, n))


def memory(constants: Vector, n: int) -> int:
    """W of each coordinate."""
    return n


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """Add both terms; nothing in the first cycle."""
    if dt == 0.0:
        return
    step, reach = dt * constants[0], dt * dt * constants[1]
    for i in range(len(out)):
        s = observed.combined[i]
        b = s - dt * memory[i]
        far = abs(b) - reach
        if far <= 0.0:
            memory[i] = s / dt
            u = memory[i]
        else:
            sign = 1.0 if b > 0.0 else -1.0
            memory[i] += dt * constants[1] * sign
            root = 0.5 * (math.sqrt(step * step + 4.0 * far) - step)
            u = constants[0] * root * sign + memory[i]
        out[i] += constants[MASS + i] * u


SUPER_TWISTING = Compensator(prepare, compensate, memory, PARAMETERS)
