"""Butterworth low-pass of second order, and backward differences of what it lets pass.

H(s) = 1 / (s^2 / w^2 + sqrt(2) s / w + 1), w = 2 pi ``cutoff``, by the bilinear transformation with
the cut-off kept (pre-warped); velocity and acceleration are its first and second differences.

Source: S. Butterworth, Experimental Wireless 7 (1930) 536; A. V. Oppenheim, R. W. Schafer,
Discrete-Time Signal Processing, 7.1. The delay of a slow motion is sqrt(2) / w.
A sample that is not finite is missing: the last output stands in for it.
"""

import math

from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.denoising.streaming.three_states import response_of
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number

PARAMETERS = (Parameter("cutoff", "frequency of half the power", 20.0, unit="Hz", above=0.0),)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: b0 of b = b0 (1, 2, 1), a1, a2, order of the response."""
    cutoff = number(values, "cutoff")
    if cutoff * dt >= 0.5:
        raise BadInput(f"cutoff = {cutoff:g} Hz is not below half the rate, {0.5 / dt:g} Hz")
    k = math.tan(math.pi * cutoff * dt)
    scale = 1.0 / (1.0 + math.sqrt(2.0) * k + k * k)
    return (
        k * k * scale,
        2.0 * (k * k - 1.0) * scale,
        (1.0 - math.sqrt(2.0) * k + k * k) * scale,
        float(integer(values, ORDER.name)),
    )


def state_size(constants: Vector, n: int) -> int:
    """Two memories of the filter, last output, last velocity."""
    return 4 * n


def start(constants: Vector, state: MutableVector, q: Vector, v: Vector) -> None:
    """At rest where it is."""
    for c in range(len(q)):
        for i in range(4):
            state[4 * c + i] = 0.0
        # the memories of a constant q: both as if it had always been so
        state[4 * c] = (1.0 - constants[0]) * q[c]
        state[4 * c + 1] = (constants[0] - constants[2]) * q[c]
        state[4 * c + 2] = q[c]


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
    """Transposed direct form II, and two differences."""
    b, order = constants[0], constants[3]
    for c in range(len(q)):
        x = 4 * c
        y = q[c]
        if y - y != 0.0:
            y = state[x + 2]
        value = b * y + state[x]
        state[x] = 2.0 * b * y - constants[1] * value + state[x + 1]
        state[x + 1] = b * y - constants[2] * value
        velocity = (value - state[x + 2]) / dt
        acceleration = (velocity - state[x + 3]) / dt
        out_q[c], out_v[c] = value, velocity
        out_response[c] = response_of(order, value, velocity, acceleration)
        state[x + 2], state[x + 3] = value, velocity


BUTTERWORTH = Filter(prepare, state_size, start, update, PARAMETERS)
