"""The tuning of the adaptive Slotine-Li controller by a Lyapunov function (thesis (2.19), (2.20)).

    Theta^' = Gamma^-1 Y(q, q', v, v')^T S

S = (d/dt + Lambda)^2 int e is the combined error, v = q' + S the reference velocity.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number, numbers
from fpt_ros.tuning import Seen, TuningLaw
from fpt_ros.tuning.matrices import check_size, inverse

PARAMETERS = (
    Parameter("gamma", "diagonal of Gamma: slow where it is large", 0.02, above=0.0),
    Parameter(
        "gamma_matrix", "in the place of gamma, row after row; empty: gamma times the identity", []
    ),
)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (gamma,), then Gamma^-1 where it is a full matrix.

    Raises:
        BadInput: it is not symmetric and positive definite.
    """
    name = "gamma_matrix"
    return number(values, "gamma"), *inverse(name, numbers(values, name))


def memory(constants: Vector, size: int, rows: int, n: int) -> int:
    """None; the size of Gamma is checked here, where that of Theta is known."""
    check_size("gamma_matrix", len(constants) - 1, size)
    return 0


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
        if len(constants) == 1:
            values[j] = values[j] + dt * (total / constants[0])
            continue
        for k in range(size):
            values[k] = values[k] + dt * (constants[1 + k * size + j] * total)


SLOTINE_LI = TuningLaw(PARAMETERS, prepare, update, memory=memory, reference=True, desired=True)
