"""Levant's robust exact differentiator of second order, by explicit Euler.

    z0' = v0,  v0 = z1 - 2 L^(1/3) |z0 - y|^(2/3) sign(z0 - y)
    z1' = v1,  v1 = z2 - 1.5 L^(1/2) |z1 - v0|^(1/2) sign(z1 - v0)
    z2' = -1.1 L sign(z2 - v1)

Exact in finite time where |q'''| <= L = ``jerk`` and nothing is noisy; with noise of size d the
error of the acceleration is of the order L^(2/3) d^(1/3).

Source: A. Levant, Higher-order sliding modes, differentiation and output-feedback control, Int. J.
Control 76 (2003) 924, (26) with the gains 1.1, 1.5, 2. The Taylor terms of dt are kept, as in S.
Koch, M. Reichhartinger, Discrete-time equivalents of the super-twisting algorithm (2019).
A sample that is not finite is missing: the differentiator predicts.
"""

import math

from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.denoising.streaming.three_states import response_of, start, state_size
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number

PARAMETERS = (Parameter("jerk", "greatest third derivative of the motion, L", 1000.0, above=0.0),)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: L, L^(1/2), L^(1/3), order of the response."""
    jerk = number(values, "jerk")
    return (jerk, math.sqrt(jerk), jerk ** (1.0 / 3.0), float(integer(values, ORDER.name)))


def update(
    constants: Vector,
    state: MutableVector,
    dt: float,
    q: Vector,
    v: Vector,
    out_q: MutableVector,
    out_v: MutableVector,
    out_response: MutableVector,
) -> None:
    """One step of Euler with its Taylor terms."""
    order = constants[3]
    for c in range(len(q)):
        x = 3 * c
        z0, z1, z2 = state[x], state[x + 1], state[x + 2]
        e = z0 - q[c]
        first = second = third = 0.0
        if e - e == 0.0 and e != 0.0:
            sign = 1.0 if e > 0.0 else -1.0
            root = math.exp(math.log(math.fabs(e)) / 3.0)
            first = 2.0 * constants[2] * root * root * sign
            second = 1.5 * constants[1] * math.sqrt(first * sign) * sign
            third = 1.1 * constants[0] * sign
        out_q[c], out_v[c] = z0, z1
        out_response[c] = response_of(order, z0, z1, z2)
        state[x] = z0 + dt * (z1 - first + 0.5 * dt * z2)
        state[x + 1] = z1 + dt * (z2 - second)
        state[x + 2] = z2 - dt * third


LEVANT = Filter(prepare, state_size, start, update, PARAMETERS)
