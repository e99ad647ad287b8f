"""Model reference adaptive control by a fixed point transformation of the effort (section 2.1).

The approximate model is the reference: the plant is to answer as if it were that model. So not the
response is deformed but the effort. With U^D = H_r q''_d + h_r, what the reference needs for the
desired response, and U^R = H_r q'' + h_r, what it would have needed for the one observed::

    U_{k+1} = G(U_k; U^R_k, U^D_{k+1}),   h = U^R_k - U^D_{k+1}

with the robust transformation (2.22): U' = (1 + b) U + b K h / ||h||, b = B sigma(A ||h||). Where
U^R = U^D the plant behaves as the reference, whatever U is. It takes the place of the model's
effort once a response is known, so ``transformation`` is to be none.
"""

import math

from fpt_ros.compensators import Compensator, Observed
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.transformations import TINY
from fpt_ros.transformations.rfpt import sigma

PARAMETERS = (
    Parameter("A", "gain A_c of the error of the effort", 1e-6),
    Parameter("B", "B_c, +1 or -1", -1.0),
    Parameter("K", "K_c, far larger than the efforts", 1e5),
)


def prepare(values: Values, n: int, dt: float) -> tuple[float, ...]:
    """Constants (A, B, K)."""
    return tuple(number(values, f"compensator.{parameter.name}") for parameter in PARAMETERS)


def compensate(
    constants: Vector, memory: MutableVector, dt: float, observed: Observed, out: MutableVector
) -> None:
    """The deformed effort; ``out`` holds U^D."""
    square = 0.0
    for i in range(len(out)):
        h = observed.explained[i] - out[i]
        if not math.isnan(h):
            square += h * h
    size = math.sqrt(square)
    b = constants[1] * sigma(constants[0] * size)
    for i in range(len(out)):
        h = observed.explained[i] - out[i]
        if not math.isnan(h):
            out[i] = observed.effort[i]
            if size >= TINY:
                out[i] = (1.0 + b) * observed.effort[i] + b * constants[2] * h / size


MRAC = Compensator(prepare, compensate, parameters=PARAMETERS)
