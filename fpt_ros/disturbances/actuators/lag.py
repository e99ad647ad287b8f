"""A lag of first order: T tau' + tau = effort, sampled at the end of a cycle."""

import math

from fpt_ros.disturbances.actuators import ActuatorDisturbance
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (Parameter("time_constant", "T of the actuator", 0.005, unit="s", above=0.0),)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (T,)."""
    return (number(values, "time_constant"),)


def actuate(
    constants: Vector, state: MutableVector, dt: float, where: Indices, effort: MutableVector
) -> None:
    """Tau += (1 - exp(-dt / T)) (effort - tau), from rest."""
    part = 1.0 - math.exp(-dt / constants[0])
    for k in range(len(where)):
        i = where[k]
        effort[i] = state[i] = state[i] + part * (effort[i] - state[i])


LAG = ActuatorDisturbance(prepare, actuate, PARAMETERS, lambda n: n)
