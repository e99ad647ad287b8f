"""The adaptive pair of orders 5 and 4 of Dormand and Prince (1980).

Within a step of the plant, in which the effort is held, it chooses steps of its own: the
difference of the two orders is the estimated error of a step, and has to stay below
``atol + rtol |y|`` in the root mean square over all positions and velocities (Hairer, Norsett and
Wanner 1993, Solving Ordinary Differential Equations I, II.4). After ``MOST`` attempts the motion is
NaN.
"""

import math
from functools import cache

from fpt_ros.integrators import Integrate, Integrator
from fpt_ros.integrators.slopes import START, keep_start, slopes_of, vectors
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.plants import Response

PARAMETERS = (
    Parameter("rtol", "error of a step, relative to the state", 1e-9, above=0.0, maximum=1.0),
    Parameter("atol", "error of a step, in units of the state", 1e-12, above=0.0),
)

STAGES = 7
MOST = 10_000
"""Attempts within one step of the plant."""

SMALLEST = 1e-13
"""Part of a step of the plant that is left out, and below which no step of its own goes."""

# fmt: off
TABLEAU = (
    0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0, 0.0,
    44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0, 0.0,
    19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0, 0.0,
    9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0, 0.0,
    35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84, 0.0,
)
DIFFERENCE = (
    71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40,
)
# fmt: on
"""The last stage is the result of order 5; less that of order 4 it is the estimated error."""


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (rtol, atol)."""
    return number(values, "integrator.rtol"), number(values, "integrator.atol")


@cache
def over(response: Response) -> Integrate:
    """The law for this response."""
    slopes = slopes_of(response, TABLEAU, STAGES)

    def integrate(
        constants: Vector,
        order: int,
        h: float,
        coefficients: Vector,
        effort: Vector,
        q: MutableVector,
        v: MutableVector,
        a: MutableVector,
        work: MutableVector,
    ) -> None:
        n = len(q)
        if order == 0:
            response(coefficients, q, v, effort, a)
            for i in range(n):
                q[i] = a[i]
            return
        begin = (START + 2 * STAGES) * n
        for i in range(n):
            work[begin + i] = q[i]
        left, step, attempts, first = h, h, 0, 0
        while left > SMALLEST * h:
            attempts += 1
            if attempts > MOST or not step > SMALLEST * h:
                for i in range(n):
                    q[i], a[i] = math.nan, math.nan
                return
            if first == 0:
                keep_start(q, v, work)
            slopes(first, STAGES, step, order, coefficients, effort, q, v, a, work)
            error = step * error_per_length(constants, order, q, v, work)
            if error <= 1.0:
                left = left - step
                keep_start(q, v, work)
                for i in range(2 * n):  # the last slope is the first one of the next step
                    work[START * n + i] = work[(START + 2 * STAGES - 2) * n + i]
            else:
                for i in range(n):
                    q[i], v[i] = work[i], work[n + i]
            first = 1
            step = min(left, step * growth(error))
        if order != 2:
            for i in range(n):
                v[i] = (q[i] - work[begin + i]) / h

    return integrate


def error_per_length(constants: Vector, order: int, q: Vector, v: Vector, work: Vector) -> float:
    """Estimated error of a step, as a part of what is allowed, per length of the step [1/s]."""
    n, total = len(q), 0.0
    for i in range(n):
        dq, dv = 0.0, 0.0
        for stage in range(STAGES):
            at = (START + 2 * stage) * n + i
            dq += DIFFERENCE[stage] * work[at]
            dv += DIFFERENCE[stage] * work[at + n]
        x = dq / (constants[1] + constants[0] * max(abs(work[i]), abs(q[i])))
        total += x * x
        if order == 2:
            x = dv / (constants[1] + constants[0] * max(abs(work[n + i]), abs(v[i])))
            total += x * x
    return math.sqrt(total / (2 * n if order == 2 else n))


def growth(error: float) -> float:
    """Factor of the step: 0.9 error^(-1/5), within 0.2 and 10; 0.2 where it is not finite."""
    if not error < math.inf:
        return 0.2
    if error < 1e-9:
        return 10.0
    return min(10.0, max(0.2, 0.9 * math.exp(-0.2 * math.log(error))))


DOPRI5 = Integrator(over, prepare, PARAMETERS, vectors(STAGES) + 1)
