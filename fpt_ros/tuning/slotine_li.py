"""The tuning of the adaptive Slotine-Li controller by a Lyapunov function (thesis (2.19), (2.20)).

    Theta^' = Gamma^-1 Y(q, q', v, v')^T S

S = (d/dt + Lambda)^2 int e is the combined error, v = q' + S the reference velocity.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.tuning import Seen, TuningLaw

PARAMETERS = (Parameter("gamma", "diagonal of Gamma: slow where it is large", 0.02, above=0.0),)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (gamma,)."""
    return (number(values, "gamma"),)


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """(2.20) by an Euler step; every coordinate is controlled, in the order of Y's rows."""
    Y, error, tracking = seen.Y, seen.error, seen.tracking
    rows, size = len(error), len(values)
    for j in range(size):
        total = 0.0
        for i in range(rows):
            total += Y[i * size + j] * tracking[2 * rows + i]
        values[j] = values[j] + dt * (total / constants[0])


SLOTINE_LI = TuningLaw(PARAMETERS, prepare, update, reference=True, desired=True)
