"""Tuning laws, one a file: how what was observed changes the deformer's parameters."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values
from fpt_ros.registry import Kind


class Seen(NamedTuple):
    """What a tuning law is shown of the cycle before, now that its response is known.

    Y: len(error) rows of len(values) numbers, row after row. error: E. tracking: e, e' and the
    combined error s, each for the c controlled coordinates. h: the response error of this cycle,
    for the controlled ones. r: the deformed response of all coordinates, NaN where not controlled.
    """

    Y: Vector
    error: Vector
    tracking: Vector
    h: Vector
    r: Vector


Update = Callable[[Vector, MutableVector, float, MutableVector, Seen], None]
"""(constants, memory, dt, values, seen)"""

COEFFICIENTS = "coefficients"
"""What most laws tune: the coefficients of the approximate model."""

GAIN = "A"
"""The gain of the transformation."""

WEIGHTS = "weights"
"""Diagonal weights of the response error, one per controlled coordinate (thesis (4.10))."""


@dataclass(frozen=True)
class TuningLaw:
    """A law that tunes the model's coefficients, the gain A, or the weights of the response error.

    The modelling error E = Q - Y(q, q', response) Theta^ of a cycle is known in the next one: the
    effort that was exerted less the one that the model would have given for what was observed. In
    the lack of disturbances E = Y (Theta - Theta^) (thesis (2.5), (2.12), (2.21)).

    Attributes:
        parameters: rate, regularisation, ...
        prepare: checked parameters -> constants.
        update: ``update(constants, memory, dt, values, seen)`` changes ``values`` (what is tuned)
            by one cycle of dt [s]; ``seen``: :class:`Seen`.
        tunes: ``coefficients``, ``A`` or ``weights``; empty: nothing, as of ``none``.
        memory: ``memory(constants, size, rows, n)`` -> number of state variables, for ``size``
            tuned values, ``rows`` of Y and n coordinates.
        reference: Y is taken at the reference velocity and the desired response (Slotine and Li)
            instead of the motion and the response observed.
        desired: the law needs the desired response of this cycle, or tracking errors.
        start: initial value of what is tuned, where it is not coefficients.
        signals: names of the first memory variables that are published beside what is tuned.
    """

    parameters: tuple[Parameter, ...]
    prepare: Callable[[Values], tuple[float, ...]]
    update: Update
    tunes: str = COEFFICIENTS
    memory: Callable[[Vector, int, int, int], int] = lambda constants, size, rows, n: 0
    reference: bool = False
    desired: bool = False
    start: float = 0.0
    signals: tuple[str, ...] = ()


TUNING_LAWS: Kind[TuningLaw] = Kind(TuningLaw, "tuning", called="tuning laws")
