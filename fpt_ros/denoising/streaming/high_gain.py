"""High-gain observer of a chain of integrators.

    q' = v + 3 e / eps,   v' = a + 3 e / eps^2,   a' = e / eps^3,   e = y - q

Its three poles lie at -1 / eps; here they are placed exactly in discrete time, at exp(-dt / eps),
so that any eps is stable. The smaller eps, the less lag and the more noise.

Source: H. K. Khalil, High-Gain Observers in Nonlinear Feedback Control (SIAM 2017), 2.1. Without
saturation it peaks at the start, as 1 / eps^2, when it begins away from the motion.
A sample that is not finite is missing: the observer predicts.
"""

import math

from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.denoising.streaming.three_states import response_of, start, state_size
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number

PARAMETERS = (Parameter("eps", "time constant of the three poles", 0.01, unit="s", above=0.0),)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: three gains of the scaled states, order of the response."""
    pole = math.exp(-dt / number(values, "eps"))
    rest = 1.0 - pole
    # of the predictor: poles of A - L C for the chain sampled exactly
    return (
        3.0 * rest,
        0.5 * rest * rest * (5.0 + pole),
        rest * rest * rest,
        float(integer(values, ORDER.name)),
    )


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
    """Correct the prediction of the last step, and advance."""
    order = constants[3]
    for c in range(len(q)):
        x = 3 * c
        e = q[c] - state[x]
        if e - e != 0.0:
            e = 0.0
        value, velocity, acceleration = state[x], state[x + 1], state[x + 2]
        out_q[c], out_v[c] = value, velocity
        out_response[c] = response_of(order, value, velocity, acceleration)
        state[x] = value + dt * (velocity + 0.5 * dt * acceleration) + constants[0] * e
        state[x + 1] = velocity + dt * acceleration + constants[1] / dt * e
        state[x + 2] = acceleration + constants[2] / (dt * dt) * e


HIGH_GAIN = Filter(prepare, state_size, start, update, PARAMETERS)
