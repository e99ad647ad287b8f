"""L1 adaptive control with the piecewise constant law (Hovakimyan and Cao 2010, section 3.3).

A predictor of the momentum p = M q' of the approximate model, with poles at -a, and an effort sigma
that in each cycle would make the predictor's error e = p^ - p vanish within the next one; a low
pass of cut-off w of it is taken away::

    p^' = tau + M' q' - h + sigma - a e,   sigma = -a / (exp(a dt) - 1) e
    d'  = w (sigma - d),                   tau = tau_0(r) - d

As sigma undoes all older error, e holds nothing but what the model lacked in the cycle before. So
to rounding the law is::

    sigma = exp(-a dt) (explained - effort),   d <- d + (1 - exp(-w dt)) (sigma - d)

which is the disturbance observer of cut-off w, with a factor of nearly 1.
"""

import math

from fpt_ros.compensators import Compensator, Observed
from fpt_ros.compensators.disturbance_observer import memory
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    Parameter("decay", "a: of the predictor's error", 10.0, unit="1/s", above=0.0),
    Parameter("cutoff", "w of the low pass", 200.0, unit="rad/s", above=0.0),
)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants (exp(-a dt), 1 - exp(-w dt))."""
    a, w = number(values, "compensator.decay"), number(values, "compensator.cutoff")
    return math.exp(-a * dt), -math.expm1(-w * dt)


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """Advance d where a response is known, and take it away."""
    for i in range(len(out)):
        sigma = constants[0] * (observed.explained[i] - observed.effort[i])
        if not math.isnan(sigma):
            memory[i] += constants[1] * (sigma - memory[i])
        out[i] -= memory[i]


L1 = Compensator(prepare, compensate, memory, PARAMETERS)
