"""Variable structure with a sliding mode, smoothed by tanh: second order plants.

    q''_d = q''_N + 2 Lambda e' + Lambda^2 e + K tanh(S / w),   S = e' + 2 Lambda e + Lambda^2 int e

Beside the linear decay a term of size K drives the error metric S to zero, linear within the
boundary layer w (Slotine and Li 1991, chapter 7; krisztiankosi/Control, VSSM_SISO).
"""

import math

from fpt_ros.laws import Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.relaxations import Relaxation, combined_error, decay_rate

PARAMETERS = (
    Parameter("sliding.K", "size of the switching term, in units of the response", 500.0),
    Parameter("sliding.w", "width of the boundary layer, in units of S", 1.0, above=0.0),
)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (Lambda, K, w)."""
    return (*decay_rate(values), number(values, "sliding.K"), number(values, "sliding.w"))


def prescribe(
    constants: Vector, nominal: float, e: float, e_dot: float, e_integral: float
) -> float:
    """Return q''_d."""
    lam, K, w = constants[0], constants[1], constants[2]
    S = combined_error(lam, e, e_dot, e_integral)
    return nominal + lam * (2.0 * e_dot + lam * e) + K * math.tanh(S / w)


VSSM = Relaxation(prescribe, order=2, parameters=PARAMETERS, prepare=prepare)
