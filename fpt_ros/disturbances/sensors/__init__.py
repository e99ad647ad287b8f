"""What spoils measurements, one a file: lost samples, impulses, quantisation, bias, lag, bursts.

Several may act, one after the other in the order of ``sensors.kinds``: each finds what those
before it have left. The first sample of a run is as it is, so that the loop knows where it starts.
"""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values
from fpt_ros.registry import Kind

Spoil = Callable[[Vector, MutableVector, float, Indices, MutableVector, MutableVector], None]
"""(constants, state, dt, where, q, v)"""


@dataclass(frozen=True)
class SensorDisturbance:
    """Something that measurements suffer.

    Attributes:
        prepare: ``prepare(values, first)``: its own checked parameters, without prefix -> constants
            (one at least); ``first``: where its chance begins
            (:func:`~fpt_ros.disturbances.chance.uniform`).
        spoil: ``spoil(constants, state, dt, where, q, v)`` changes positions q and velocities v of
            the coordinates at ``where``, dt [s] after the sample before. NaN: lost.
        parameters: its own, with the prefix ``sensors.NAME.`` when they are declared.
        state: ``state(n)`` -> number of state variables for n coordinates, zero at the start.
        start: ``start(state, q, v)`` sets them at the first sample; ``None``: they stay zero.
    """

    prepare: Callable[[Values, float], tuple[float, ...]]
    spoil: Spoil
    parameters: tuple[Parameter, ...] = ()
    state: Callable[[int], int] = lambda n: 0
    start: Callable[[MutableVector, Vector, Vector], None] | None = None


SENSOR_DISTURBANCES: Kind[SensorDisturbance] = Kind(
    SensorDisturbance, "sensor_disturbances", called="disturbances of sensors"
)
