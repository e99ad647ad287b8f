"""The bare iteration in as many dimensions as are wanted (thesis (3.9) to (3.12)): f(r) = M r + c.

No dynamics: the response is the value itself, and the "model" hands r over as it is. M may have any
eigenvalues, complex ones and Jordan blocks among them, by which the thesis proves convergence.
"""

from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, integer, numbers
from fpt_ros.plants import Factory, Model, Plant

LARGEST = 64
"""Coordinates at most."""

PLANT_PARAMETERS = (
    Parameter("matrix", "M, row by row", kind="floats", live=False),
    Parameter("offset", "c, one number a coordinate", kind="floats", live=False),
)

MODEL_PARAMETERS = (
    Parameter("size", "number of coordinates", 2, minimum=1, maximum=LARGEST, live=False),
)


def coordinates(size: int) -> tuple[str, ...]:
    """x1, x2, ..."""
    return tuple(f"x{i + 1}" for i in range(size))


def response(c: Vector, q: Vector, v: Vector, effort: Vector, out: MutableVector) -> None:
    """f(r); c: M row by row, then the offset."""
    n = len(effort)
    for i in range(n):
        total = c[n * n + i]
        for j in range(n):
            total += c[n * i + j] * effort[j]
        out[i] = total


def effort(c: Vector, q: Vector, v: Vector, r: Vector, s: Vector, out: MutableVector) -> None:
    """The response wanted, handed over as it is."""
    for i in range(len(r)):
        out[i] = r[i]


def plant(values: Values) -> Plant:
    """The map of a matrix.

    Raises:
        BadInput: the matrix is not square, or has more coordinates than the offset.
    """
    matrix, offset = numbers(values, "matrix"), numbers(values, "offset")
    n = len(offset)
    if not 0 < n <= LARGEST or len(matrix) != n * n:
        raise BadInput(
            f"plant_simulator.exact.matrix: {len(matrix)} numbers given, for an offset of {n} it "
            f"takes {n * n} (1 to {LARGEST} coordinates)"
        )
    constants = (*matrix, *offset)
    return Plant(
        coordinates=coordinates(n),
        units=("",) * n,
        effort_units=("",) * n,
        parameters=(),
        coefficients=lambda parameters: constants,
        response=response,
        order=0,
    )


def model(values: Values) -> Model:
    """The identity."""
    names = coordinates(integer(values, "size"))
    return Model(
        coordinates=names,
        controlled=names,
        parameters=(),
        coefficient_names=(),
        coefficients=tuple,
        effort=effort,
    )


PLANT: Factory[Plant] = Factory(PLANT_PARAMETERS, plant)
MODEL: Factory[Model] = Factory(MODEL_PARAMETERS, model)
