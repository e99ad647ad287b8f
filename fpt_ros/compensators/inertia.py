"""Inertias of single coordinates: what a law knows of a plant that it has no model of."""

from fpt_ros.errors import BadInput
from fpt_ros.parameters import Parameter, Values, number, numbers

PARAMETERS = (
    Parameter("inertia", "m, one a coordinate", [], above=0.0),
    Parameter("factor", "of all of them", 1.0, above=0.0),
)


def inertias(values: Values, n: int) -> tuple[float, ...]:
    """M times the factor, n of them.

    Raises:
        BadInput: of another number.
    """
    given, factor = numbers(values, "compensator.inertia"), number(values, "compensator.factor")
    if len(given) != n:
        raise BadInput(f"fpt_deformer.compensator.inertia: {len(given)} given, {n} needed")
    return tuple(factor * m for m in given)
