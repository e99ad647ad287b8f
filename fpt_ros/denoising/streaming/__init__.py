"""Causal filters, one a file: at every sample, the motion at the newest one."""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values
from fpt_ros.registry import Kind

Update = Callable[
    [Vector, MutableVector, float, Vector, Vector, MutableVector, MutableVector, MutableVector],
    None,
]
"""(constants, state, dt, q, v, out_q, out_v, out_response)"""

ORDER = Parameter(
    "order",
    "derivative that the plant answers with: 2 acceleration, 1 velocity, 0 value",
    2,
    minimum=0,
    maximum=2,
    live=False,
)
"""A parameter of the denoiser: what the observed response is."""


@dataclass(frozen=True)
class Filter:
    """A causal estimator of position, velocity and response of n coordinates.

    Attributes:
        prepare: ``prepare(values, n, dt)``: checked parameters -> constants, for samples dt [s]
            apart.
        state_size: ``state_size(constants, n)`` -> number of state variables.
        start: ``start(constants, state, q, v)`` with the first sample; no response is known yet.
        update: ``update(constants, state, dt, q, v, out_q, out_v, out_response)`` with the sample
            dt [s] after the last one.
        parameters: its own, beside ``order``.
        serves: ``serves(before, now)``: whether what was remembered with the constants before
            serves for others, if it is as much.
        deviation: ``deviation(constants, state, c)`` -> standard deviations of position, velocity
            and response of coordinate c as they are now; None, here or
            as an answer: it does not know.
    """

    prepare: Callable[[Values, int, float], tuple[float, ...]]
    state_size: Callable[[Vector, int], int]
    start: Callable[[Vector, MutableVector, Vector, Vector], None]
    update: Update
    parameters: tuple[Parameter, ...] = ()
    serves: Callable[[Vector, Vector], bool] = lambda before, now: True
    deviation: Callable[[Vector, Vector, int], tuple[float, float, float] | None] | None = None


FILTERS: Kind[Filter] = Kind(Filter, "filters")
