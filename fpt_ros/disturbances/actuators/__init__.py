"""What becomes of an effort on its way to the plant, one a file: lag, dead zone, drop-outs.

Several may act, one after the other in the order of ``actuators.kinds``. What comes out is held
over the cycle, and is the effort that ``joint_states`` shows.
"""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values
from fpt_ros.registry import Kind

Actuate = Callable[[Vector, MutableVector, float, Indices, MutableVector], None]
"""(constants, state, dt, where, effort)"""


@dataclass(frozen=True)
class ActuatorDisturbance:
    """Something that stands between the effort commanded and the effort that acts.

    Attributes:
        prepare: ``prepare(values, first)``: its own checked parameters, without prefix -> constants
            (one at least); ``first``: where its chance begins
            (:func:`~fpt_ros.disturbances.chance.uniform`).
        actuate: ``actuate(constants, state, dt, where, effort)`` changes the efforts of the
            coordinates at ``where``, for a cycle of dt [s].
        parameters: its own, with the prefix ``actuators.NAME.`` when they are declared.
        state: ``state(n)`` -> number of state variables for n coordinates, zero at the start.
    """

    prepare: Callable[[Values, float], tuple[float, ...]]
    actuate: Actuate
    parameters: tuple[Parameter, ...] = ()
    state: Callable[[int], int] = lambda n: 0


ACTUATOR_DISTURBANCES: Kind[ActuatorDisturbance] = Kind(
    ActuatorDisturbance, "actuator_disturbances", called="disturbances of actuators"
)
