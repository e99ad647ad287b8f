"""Modified tuning by Gram-Schmidt orthogonalisation (thesis, section 2.4.2).

The known terms a_i = z_i (Theta - Theta^) give as many projections of the coefficients' error as Y
has rows z_i. The rows are orthogonalised one after the other, the known terms with them; along each
the error is made to decay with the rate alpha::

    for j < i:  f = z_i . z_j / (||z_j||^2 + epsilon),  z_i -= f z_j,  a_i -= f a_j
    Theta^' = alpha sum_i a_i z_i / (||z_i||^2 + epsilon)

epsilon is not to be tiny: where the excitation is poor, a small one lets noise and friction drag
the estimated inertia out of the range in which the iteration contracts.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.tuning import Seen, TuningLaw

PARAMETERS = (
    Parameter("alpha", "rate at which the known part of the error decays", 1.0, unit="1/s"),
    Parameter("epsilon", "keeps the divisions defined where a row vanishes", 1.0, above=0.0),
)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (alpha, epsilon)."""
    return number(values, "alpha"), number(values, "epsilon")


def memory(constants: Vector, size: int, rows: int, n: int) -> int:
    """Work space: the orthogonal rows, their known terms and squares."""
    return rows * (size + 2)


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """One Euler step."""
    Y, error = seen.Y, seen.error
    alpha, epsilon = constants[0], constants[1]
    rows, size = len(error), len(values)
    known, squares = rows * size, rows * size + rows
    for i in range(rows):
        for j in range(size):
            memory[i * size + j] = Y[i * size + j]
        memory[known + i] = error[i]
        for k in range(i):
            product = 0.0
            for j in range(size):
                product += memory[i * size + j] * memory[k * size + j]
            f = product / (memory[squares + k] + epsilon)
            for j in range(size):
                memory[i * size + j] -= f * memory[k * size + j]
            memory[known + i] -= f * memory[known + k]
        square = 0.0
        for j in range(size):
            square += memory[i * size + j] * memory[i * size + j]
        memory[squares + i] = square
    for j in range(size):
        rate = 0.0
        for i in range(rows):
            rate += memory[known + i] * memory[i * size + j] / (memory[squares + i] + epsilon)
        values[j] = values[j] + dt * (alpha * rate)


GRAM_SCHMIDT = TuningLaw(PARAMETERS, prepare, update, memory=memory)
