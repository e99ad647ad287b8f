"""Sliding mode with a boundary layer (Slotine and Li 1991, section 7.2), beside a model.

With s = e' + 2 Lambda e + Lambda^2 int e, which the prescription lets decay, an effort drives s
to zero that is linear within the boundary layer phi and of size m K beyond it::

    tau = tau_0(r) + m K sat(s / phi)

Robust without chatter; what is left of s within the layer is phi times disturbance / (m K).
"""

from fpt_ros.compensators import Compensator, Observed, inertia
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    *inertia.PARAMETERS,
    Parameter("K", "size of the switching term, in units of the response", 10.0, minimum=0.0),
    Parameter("phi", "width of the boundary layer, in units of s", 0.1, above=0.0),
)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants (phi, m K of each coordinate)."""
    K = number(values, "compensator.K")
    return (number(values, "compensator.phi"), *(m * K for m in inertia.inertias(values, n)))


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """Add the switching term; s is 0 where a coordinate is not controlled."""
    for i in range(len(out)):
        share = observed.combined[i] / constants[0]
        if share > 1.0:
            share = 1.0
        elif share < -1.0:
            share = -1.0
        out[i] += constants[1 + i] * share


SLIDING_MODE = Compensator(prepare, compensate, parameters=PARAMETERS)
