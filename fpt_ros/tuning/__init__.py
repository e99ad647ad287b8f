"""Tuning laws, one a file: how the model's coefficients follow what was observed."""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values


@dataclass(frozen=True)
class Identification:
    """Identification of coefficients in which the model is linear.

    The modelling error E = Q - Y(q, q', response) Theta^ is known in every cycle: the effort that
    was exerted less the one that the model would have given for what was observed. In the lack of
    disturbances E = Y (Theta - Theta^) (thesis (2.5), (2.12), (2.21)).

    Attributes:
        parameters: rate, regularisation, ...
        prepare: checked parameters -> constants.
        rate: ``rate(constants, Y, E, out)`` writes d/dt Theta^ [1/s]. Y has len(E) rows of len(out)
            numbers, row after row.
    """

    parameters: tuple[Parameter, ...]
    prepare: Callable[[Values], tuple[float, ...]]
    rate: Callable[[Vector, Vector, Vector, MutableVector], None]
