"""Integrators of plants that give their response, one a file: the motion over one step."""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values
from fpt_ros.plants import Response
from fpt_ros.registry import Kind

Integrate = Callable[
    [
        Vector,
        int,
        float,
        Vector,
        Vector,
        MutableVector,
        MutableVector,
        MutableVector,
        MutableVector,
    ],
    None,
]
"""(constants, order, h, coefficients, effort, q, v, a, work)"""


def no_constants(values: Values) -> tuple[float, ...]:
    """Of an integrator without parameters."""
    return ()


@dataclass(frozen=True)
class Integrator:
    """How a plant moves over a step of h [s] in which the effort is held.

    Attributes:
        over: ``over(response)`` is the law for a plant with this response, always the same object
            for the same one: ``integrate(constants, order, h, coefficients, effort, q, v, a,
            work)`` moves q and v on, and writes the response of its last evaluation to a. Of a
            plant of order 1 q is integrated, and v becomes its mean rate over the step; of order
            0 the response is the new q. What it cannot do it writes as NaN.
        prepare: checked parameters, with the prefix ``integrator.``, -> constants.
        parameters: its own.
        vectors: how many vectors of n numbers it needs to work on.
    """

    over: Callable[[Response], Integrate]
    prepare: Callable[[Values], tuple[float, ...]] = no_constants
    parameters: tuple[Parameter, ...] = ()
    vectors: int = 0


INTEGRATORS: Kind[Integrator] = Kind(Integrator, "integrators")
