"""The classical tuning of AIDC by Lyapunov's direct method (thesis (2.6) to (2.10)).

With x = (e, e')^T, x' = A x + B, A = [[0, 1], [-Lambda^2, -2 Lambda]] and A^T P + P A = -Q::

    Theta^_k' = (p12 e + p22 e') Y_k / (m^ R_k)                                            (2.10)

Only the second row of P enters, because B = (0, Y (Theta - Theta^) / m^)^T. m^ is the first
coefficient; Y is taken at the observed response.
"""

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number
from fpt_ros.tuning import Seen, TuningLaw

PARAMETERS = (
    Parameter("R", "weight of the parameters' errors: slow where it is large", 5.0, above=0.0),
    Parameter("relaxation", "Lambda of the trajectory generator", 10.0, unit="1/s", above=0.0),
    Parameter("Q", "diagonal of the matrix Q", 100.0, above=0.0),
)


def second_row(lam: float, q: float) -> tuple[float, float]:
    """(p12, p22) of the solution of A^T P + P A = -q I: closed form of the 2 x 2 equation."""
    p12 = q / (2.0 * lam * lam)
    return p12, (q + 2.0 * p12) / (4.0 * lam)


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (p12, p22, R)."""
    p12, p22 = second_row(number(values, "relaxation"), number(values, "Q"))
    return p12, p22, number(values, "R")


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """(2.10) for one controlled coordinate, by an Euler step."""
    Y, tracking = seen.Y, seen.tracking
    weighted = constants[0] * tracking[0] + constants[1] * tracking[1]
    factor = weighted / (values[0] * constants[2])
    for j in range(len(values)):
        values[j] = values[j] + dt * (factor * Y[j])


LYAPUNOV = TuningLaw(PARAMETERS, prepare, update, desired=True)
