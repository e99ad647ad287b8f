"""One-euro filter: a low-pass whose cut-off rises with the speed.

Exponential smoothing x = x + a (y - x), a = 1 / (1 + 1 / (2 pi f dt)); f =
``derivative_cutoff`` for the speed, f = ``cutoff`` + ``beta`` |speed| for the position. The
acceleration is the smoothed
difference of the speed.

Source: G. Casiez, N. Roussel, D. Vogel, 1 euro filter, CHI 2012. Made for pointing devices: little
jitter at rest, little lag in motion; it is no estimator of acceleration.
A sample that is not finite is missing: the position goes on with the speed.
"""

import math

from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.denoising.streaming.three_states import response_of
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number

PARAMETERS = (
    Parameter("cutoff", "least cut-off frequency", 5.0, unit="Hz", above=0.0),
    Parameter("beta", "rise of the cut-off with the speed [Hz s per unit]", 10.0, minimum=0.0),
    Parameter("derivative_cutoff", "cut-off of the speed", 10.0, unit="Hz", above=0.0),
)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: 2 pi cutoff, 2 pi beta, 2 pi cut-off of the speed, order of the response."""
    turn = 2.0 * math.pi
    return (
        turn * number(values, "cutoff"),
        turn * number(values, "beta"),
        turn * number(values, "derivative_cutoff"),
        float(integer(values, ORDER.name)),
    )


def state_size(constants: Vector, n: int) -> int:
    """Last reading, position, speed and acceleration."""
    return 4 * n


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    for c in range(len(q)):
        for i in range(4):
            state[4 * c + i] = 0.0
        state[4 * c] = state[4 * c + 1] = q[c]


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
    """Smooth the speed, then the position with the cut-off that the speed asks for."""
    order = constants[3]
    slow = constants[2] * dt / (1.0 + constants[2] * dt)
    for c in range(len(q)):
        x = 4 * c
        y = q[c]
        if y - y != 0.0:
            y = state[x] + dt * state[x + 2]
        speed = state[x + 2] + slow * ((y - state[x]) / dt - state[x + 2])
        state[x + 3] += slow * ((speed - state[x + 2]) / dt - state[x + 3])
        state[x], state[x + 2] = y, speed
        rate = (constants[0] + constants[1] * math.fabs(speed)) * dt
        state[x + 1] += rate / (1.0 + rate) * (y - state[x + 1])
        out_q[c], out_v[c] = state[x + 1], speed
        out_response[c] = response_of(order, state[x + 1], speed, state[x + 3])


ONE_EURO = Filter(prepare, state_size, start, update, PARAMETERS)
