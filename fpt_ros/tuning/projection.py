"""The modified tuning of AIDC (thesis (2.11), with the deformed response (2.12)).

Only the projection of the coefficients' error onto the row Y is known; it is made to decay with the
rate alpha: Theta^' = alpha E Y^T / (||Y||^2 + epsilon), E = m^ (r - q'') = Y (Theta - Theta^) - d.
For a model of one row. m^ = 0 is absorbing: a disturbance that drags m^ there stops the learning.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.tuning import Seen, TuningLaw

PARAMETERS = (
    Parameter("alpha", "rate at which the known part of the error decays", 1.0, unit="1/s"),
    Parameter("epsilon", "keeps the division defined where Y vanishes", 1e-6, above=0.0),
)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (alpha, epsilon)."""
    return number(values, "alpha"), number(values, "epsilon")


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """(2.11) for the first row of Y, by an Euler step."""
    Y, error = seen.Y, seen.error
    alpha, epsilon = constants[0], constants[1]
    square = epsilon
    for j in range(len(values)):
        square += Y[j] * Y[j]
    factor = alpha * error[0] / square
    for j in range(len(values)):
        values[j] = values[j] + dt * (factor * Y[j])


PROJECTION = TuningLaw(PARAMETERS, prepare, update)
