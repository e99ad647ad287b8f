"""Compensators, one a file: laws with a memory that add to the model's effort.

An observer of the disturbance is one: what the effort of the cycle before caused, less what the
approximate model says that it should have caused, is what somebody else exerted, and is taken away.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values
from fpt_ros.registry import Kind


class Observed(NamedTuple):
    """What a compensator is shown, for all n coordinates.

    position, velocity: filtered, of this cycle. response: observed, to the effort of the cycle
    before; NaN where not known yet. explained: the effort that the approximate model gives for that
    response at the motion of the cycle before. effort: that of the cycle before, as commanded.
    desired: the desired response of this cycle, deformed: r_k; NaN where not controlled. combined:
    the combined error s of :mod:`fpt_ros.relaxations`, 0 where not controlled.
    """

    position: Vector
    velocity: Vector
    response: Vector
    explained: Vector
    effort: Vector
    desired: Vector
    deformed: Vector
    combined: Vector


Compensate = Callable[[Vector, MutableVector, float, Observed, MutableVector], None]
"""(constants, memory, dt, observed, out)"""


@dataclass(frozen=True)
class Compensator:
    """A law that adds to the effort.

    Attributes:
        prepare: ``prepare(values, n, dt)``: checked parameters -> constants, for n coordinates and
            cycles of dt [s].
        compensate: ``compensate(constants, memory, dt, observed, out)`` adds to the n efforts of
            ``out``, which holds the model's.
        memory: ``memory(constants, n)`` -> number of state variables, zero at the start.
        parameters: its own, with the prefix ``compensator.`` when they are declared.
        acts: whether it does anything; of ``none`` alone it does not.
    """

    prepare: Callable[[Values, int, float], tuple[float, ...]]
    compensate: Compensate
    memory: Callable[[Vector, int], int] = lambda constants, n: 0
    parameters: tuple[Parameter, ...] = ()
    acts: bool = True


COMPENSATORS: Kind[Compensator] = Kind(Compensator, "compensators")
