"""Symmetric matrices among the parameters of a tuning law, row after row."""

import math
from collections.abc import Sequence

from fpt_ros.errors import BadInput


def positive_definite(name: str, given: Sequence[float]) -> int:
    """The order of a matrix.

    Raises:
        BadInput: it is not square, symmetric and positive definite.
    """
    import numpy as np

    order = math.isqrt(len(given))
    if order * order != len(given):
        raise BadInput(f"parameter_tuner.{name}: {len(given)} numbers are no square matrix")
    matrix = np.reshape(given, (order, order))
    if not np.array_equal(matrix, matrix.T):
        raise BadInput(f"parameter_tuner.{name} is not symmetric")
    least = float(np.linalg.eigvalsh(matrix)[0])
    if not least > 0.0:
        raise BadInput(
            f"parameter_tuner.{name} is not positive definite: its least eigenvalue is {least:.4g}"
        )
    return order


def inverse(name: str, given: Sequence[float]) -> tuple[float, ...]:
    """Its inverse, row after row; of none nothing.

    Raises:
        BadInput: as :func:`positive_definite`.
    """
    import numpy as np

    if not given:
        return ()
    order = positive_definite(name, given)
    return tuple(np.linalg.inv(np.reshape(given, (order, order))).ravel().tolist())


def check_size(name: str, count: int, size: int) -> None:
    """Raise BadInput where a matrix that is given is not of the order of Theta."""
    if count not in (0, size * size):
        raise BadInput(
            f"parameter_tuner.{name}: {count} numbers given, {size * size} needed for the {size} "
            "coefficients of the model"
        )
