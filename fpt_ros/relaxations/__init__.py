"""Kinematic prescriptions of how the tracking error decays, one a file.

(d/dt + Lambda)^n of the tracking error e = q^N - q, or of its integral, is to vanish; solved for
the highest derivative it gives the desired response. Purely kinematic: no model, no force. Beside
it stands the combined error s = (d/dt + Lambda)^(n-1) of the same, of which adaptive laws make use
(thesis, section 2.4).
"""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import Vector, helper
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.registry import Kind

Prescribe = Callable[[Vector, float, float, float, float], float]
"""(constants, nominal response, e, e', integral of e [s]) -> desired response"""


def decay_rate(values: Values) -> tuple[float, ...]:
    """The constant that every relaxation has first: (Lambda [1/s],)."""
    return (number(values, "lambda"),)


@dataclass(frozen=True)
class Relaxation:
    """How the tracking error of one coordinate is to decay.

    Attributes:
        prescribe: ``prescribe(constants, nominal, e, e_dot, e_integral)`` gives the desired
            response.
        order: of the derivative that it prescribes: 2 acceleration, 1 velocity, 0 value.
        parameters: its own, beside ``lambda``.
        prepare: checked parameters -> constants, Lambda first.
    """

    prescribe: Prescribe
    order: int
    parameters: tuple[Parameter, ...] = ()
    prepare: Callable[[Values], tuple[float, ...]] = decay_rate


RELAXATIONS: Kind[Relaxation] = Kind(Relaxation, "relaxations")


@helper
def combined_error(lam: float, e: float, e_dot: float, e_integral: float) -> float:
    """Return s = e' + 2 Lambda e + Lambda^2 int e, (2.17) (the print lacks a derivative)."""
    return e_dot + 2.0 * lam * e + lam * lam * e_integral
