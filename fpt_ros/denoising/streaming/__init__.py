"""Causal filters, one a file: at every sample, the motion at the newest one."""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import MutableVector, Vector


@dataclass(frozen=True)
class Filter:
    """A causal estimator of position, velocity and response of n coordinates.

    Attributes:
        state_size: n -> number of state variables.
        start: ``start(state, q, v)`` with the first sample; no response is known yet.
        update: ``update(state, dt, q, v, out_q, out_v, out_response)`` with the sample dt [s] after
            the last one.
    """

    state_size: Callable[[int], int]
    start: Callable[[MutableVector, Vector, Vector], None]
    update: Callable[
        [MutableVector, float, Vector, Vector, MutableVector, MutableVector, MutableVector], None
    ]
