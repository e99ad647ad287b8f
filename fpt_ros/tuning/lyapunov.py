"""The classical tuning of AIDC by Lyapunov's direct method (thesis (2.6) to (2.10)).

With x = (e, e')^T, x' = A x + B, A = [[0, 1], [-Lambda^2, -2 Lambda]] and A^T P + P A = -Q::

    Theta^_k' = (p12 e + p22 e') Y_k / (m^ R_k)                                            (2.10)

Only the second row of P enters, because B = (0, Y (Theta - Theta^) / m^)^T. m^ is the first
coefficient; Y is taken at the observed response. R and Q may be full matrices, of which the thesis
says that they are "numerous arbitrary parameters": Theta^' = R^-1 Y^T (p12 e + p22 e') / m^.
"""

from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, number, numbers
from fpt_ros.tuning import Seen, TuningLaw
from fpt_ros.tuning.matrices import check_size, inverse, positive_definite

PARAMETERS = (
    Parameter("R", "weight of the parameters' errors: slow where it is large", 5.0, above=0.0),
    Parameter("relaxation", "Lambda of the trajectory generator", 10.0, unit="1/s", above=0.0),
    Parameter("Q", "diagonal of the matrix Q", 100.0, above=0.0),
    Parameter("R_matrix", "in the place of R, row after row; empty: R times the identity", []),
    Parameter("Q_matrix", "in the place of Q, row after row; empty: Q times the identity", []),
)


def second_row(lam: float, q: float) -> tuple[float, float]:
    """(p12, p22) of the solution of A^T P + P A = -q I: closed form of the 2 x 2 equation."""
    p12 = q / (2.0 * lam * lam)
    return p12, (q + 2.0 * p12) / (4.0 * lam)


def second_row_of(lam: float, Q: "list[float]") -> tuple[float, float]:
    """(p12, p22) for a full matrix Q."""
    import numpy as np
    from scipy.linalg import solve_continuous_lyapunov

    A = np.array([[0.0, 1.0], [-lam * lam, -2.0 * lam]])
    P = solve_continuous_lyapunov(A.T, -np.reshape(Q, (2, 2)))
    return float(P[0, 1]), float(P[1, 1])


def prepare(values: Values) -> tuple[float, ...]:
    """Constants (p12, p22, R), then R^-1 where R is a full matrix.

    Raises:
        BadInput: a matrix is not symmetric and positive definite.
    """
    lam, Q, R = number(values, "relaxation"), numbers(values, "Q_matrix"), "R_matrix"
    p12, p22 = second_row(lam, number(values, "Q"))
    if Q:
        if len(Q) != 4:
            raise BadInput(f"parameter_tuner.Q_matrix: {len(Q)} numbers given, 4 needed")
        positive_definite("Q_matrix", Q)
        p12, p22 = second_row_of(lam, Q)
    return p12, p22, number(values, "R"), *inverse(R, numbers(values, R))


def memory(constants: Vector, size: int, rows: int, n: int) -> int:
    """None; the size of R is checked here, where that of Theta is known."""
    check_size("R_matrix", len(constants) - 3, size)
    return 0


def update(
    constants: Vector, memory: MutableVector, dt: float, values: MutableVector, seen: Seen
) -> None:
    """(2.10) for one controlled coordinate, by an Euler step."""
    Y, tracking = seen.Y, seen.tracking
    size = len(values)
    weighted = constants[0] * tracking[0] + constants[1] * tracking[1]
    if len(constants) == 3:
        factor = weighted / (values[0] * constants[2])
        for j in range(size):
            values[j] = values[j] + dt * (factor * Y[j])
        return
    factor = weighted / values[0]
    for j in range(size):
        total = 0.0
        for k in range(size):
            total += constants[3 + j * size + k] * Y[k]
        values[j] = values[j] + dt * (factor * total)


LYAPUNOV = TuningLaw(PARAMETERS, prepare, update, memory=memory, desired=True)
