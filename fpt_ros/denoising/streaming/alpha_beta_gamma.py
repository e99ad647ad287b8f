"""Alpha-beta-gamma filter: constant acceleration, corrected by three fixed gains.

With x = q + dt v + dt^2 a / 2 the prediction and r = y - x the residual,

    q = x + alpha r,   v = v + dt a + beta r / dt,   a = a + 2 gamma r / dt^2

The gains follow from one number in [0, 1), the damping theta (critically damped, a fading-memory
polynomial: 0 follows every sample, near 1 is slow):
alpha = 1 - theta^3, beta = 1.5 (1 - theta)^2 (1 + theta), gamma = 0.5 (1 - theta)^3.

Source: E. Brookner, Tracking and Kalman Filtering Made Easy (Wiley 1998), chapter 1.3.
A sample that is not finite is missing: the filter predicts.
"""

import math

from fpt_ros.denoising.streaming import ORDER, Filter
from fpt_ros.denoising.streaming.three_states import response_of, start, state_size
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, number

PARAMETERS = (
    Parameter(
        "time_constant", "memory of the filter: theta = exp(-dt / this)", 0.01, unit="s", above=0.0
    ),
)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: alpha, beta, gamma, order of the response."""
    theta = math.exp(-dt / number(values, "time_constant"))
    rest = 1.0 - theta
    return (
        1.0 - theta * theta * theta,
        1.5 * rest * rest * (1.0 + theta),
        0.5 * rest * rest * rest,
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
    """Predict, and correct by the residual."""
    alpha, beta, gamma, order = constants[0], constants[1], constants[2], constants[3]
    for c in range(len(q)):
        x = 3 * c
        state[x] += dt * (state[x + 1] + 0.5 * dt * state[x + 2])
        state[x + 1] += dt * state[x + 2]
        residual = q[c] - state[x]
        if residual - residual == 0.0:
            state[x] += alpha * residual
            state[x + 1] += beta / dt * residual
            state[x + 2] += 2.0 * gamma / (dt * dt) * residual
        out_q[c], out_v[c] = state[x], state[x + 1]
        out_response[c] = response_of(order, state[x], state[x + 1], state[x + 2])


ALPHA_BETA_GAMMA = Filter(prepare, state_size, start, update, PARAMETERS)
