"""The extended state observer of linear active disturbance rejection, ADRC (Han 2009; Gao 2003).

Each coordinate is a mass m with an unknown rest f, which an observer estimates from the position::

    q'' = f + tau / m,   tau = m (r - f^)

All three poles of the observer lie at -w [1/s]. In cycles the force is held, and the estimate of
this cycle already knows its position (current observer; Miklosovic, Radke and Gao 2006)::

    x^ <- Phi x^ + Gamma tau / m,   x^ <- x^ + L (q - q^),   beta = exp(-w dt)
    L = (1 - beta^3,  3 (1 - beta)^2 (1 + beta) / (2 dt),  (1 - beta)^3 / dt^2)

It takes the place of the model's effort. f has to hold all that m lacks.
"""

import math

from fpt_ros.compensators import Compensator, Observed, inertia
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    *inertia.PARAMETERS,
    Parameter("bandwidth", "w: where the observer's poles lie", 300.0, unit="1/s", above=0.0),
)

MASS = 3
"""Constants: the three gains L, then m times the factor, n of them."""


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Gains and inertias."""
    beta = math.exp(-number(values, "compensator.bandwidth") * dt)
    rest = 1.0 - beta
    gains = (
        1.0 - beta * beta * beta,
        1.5 * rest * rest * (1.0 + beta) / dt,
        rest * rest * rest / (dt * dt),
    )
    return (*gains, *inertia.inertias(values, n))


def memory(constants: Vector, n: int) -> int:
    """q^, v^, f^ of each coordinate, and whether there has been a cycle."""
    return 3 * n + 1


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """Predict, correct, and take f away."""
    n = len(out)
    begun = memory[3 * n] != 0.0
    memory[3 * n] = 1.0
    for i in range(n):
        at, m, q = 3 * i, constants[MASS + i], observed.position[i]
        if not begun:
            memory[at], memory[at + 1] = q, observed.velocity[i]
        else:
            a = memory[at + 2] + observed.effort[i] / m
            memory[at] += dt * (memory[at + 1] + 0.5 * dt * a)
            memory[at + 1] += dt * a
            error = q - memory[at]
            for j in range(3):
                memory[at + j] += constants[j] * error
        wanted = observed.desired[i]
        if not math.isnan(wanted):
            out[i] = m * (wanted - memory[at + 2])


STATE_OBSERVER = Compensator(prepare, compensate, memory, PARAMETERS)
