"""A bias of the positions that may drift: q + offset + drift t. Velocities show the drift."""

from fpt_ros.disturbances.sensors import SensorDisturbance
from fpt_ros.laws import Indices, MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number

PARAMETERS = (
    Parameter("offset", "in the unit of the positions", 1e-3),
    Parameter("drift", "growth of the offset, per second", 0.0),
)


def prepare(values: Values, first: float) -> tuple[float, ...]:
    """Constants (offset, drift)."""
    return number(values, "offset"), number(values, "drift")


def spoil(
    constants: Vector,
    state: MutableVector,
    dt: float,
    where: Indices,
    q: MutableVector,
    v: MutableVector,
) -> None:
    """Add it; state[0] is the time since the first sample [s]."""
    state[0] += dt
    for k in range(len(where)):
        q[where[k]] += constants[0] + constants[1] * state[0]
        v[where[k]] += constants[1]


BIASED = SensorDisturbance(prepare, spoil, PARAMETERS, lambda n: 1)
