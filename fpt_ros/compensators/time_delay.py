"""Time delay control (Youcef-Toumi and Ito 1990; Hsia 1989): the last effort is the model.

What the effort of the cycle before caused is known, so only the change of the response is asked of
a constant diagonal inertia::

    tau_k = tau_{k-1} + m (r_k - response_k)

It takes the place of the model's effort once a response is known; where one is lost later, the
effort stays. For m below the true inertia's smallest eigenvalue it is stable; an m of the true size
is not where joints are coupled.
"""

from fpt_ros.compensators import Compensator, Observed
from fpt_ros.compensators.incremental import go_on, memory
from fpt_ros.compensators.inertia import PARAMETERS, inertias
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Values


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants: m times the factor, n of them."""
    return inertias(values, n)


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """The effort of the cycle before, and m times what the response lacks."""
    for i in range(len(out)):
        step = constants[i] * (observed.desired[i] - observed.response[i])
        go_on(memory, i, step, observed, out)


TIME_DELAY = Compensator(prepare, compensate, memory, PARAMETERS)
