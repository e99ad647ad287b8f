"""Plants and their approximate models, one system a file.

A :class:`Plant` is the exact dynamics that the simulator integrates. A :class:`Model` is what the
controller believes: the same equations solved for the effort, with other numbers. Both compute with
*coefficients*: combinations of the physical parameters in which the equations are linear where they
can be (thesis, Theta of section 2.2), because it is these that identification tunes.
"""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter


@dataclass(frozen=True)
class Plant:
    """Exact dynamics of a system with n coordinates.

    Attributes:
        coordinates: names q1.. in the thesis, length n.
        units: of the positions, length n.
        effort_units: of the generalised forces, length n.
        parameters: physical parameters, in the order in which ``coefficients`` takes them.
        coefficients: physical parameters -> coefficients.
        response: ``response(coefficients, q, v, effort, out)`` writes the n accelerations that the
            efforts cause at (q, v).
    """

    coordinates: tuple[str, ...]
    units: tuple[str, ...]
    effort_units: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    coefficients: Callable[[Vector], tuple[float, ...]]
    response: Callable[[Vector, Vector, Vector, Vector, MutableVector], None]


@dataclass(frozen=True)
class Model:
    """Approximate model of a plant: response wanted -> effort.

    Attributes:
        coordinates: names, length n.
        controlled: those whose response it can prescribe.
        parameters: physical parameters, in the order in which ``coefficients`` takes them.
        coefficient_names: names of the coefficients, as tuning publishes them.
        coefficients: physical parameters -> coefficients.
        effort: ``effort(coefficients, q, v, r, out)`` writes the n efforts that should cause the
            response r (length n; NaN where it is not prescribed) at (q, v).
        regressor: ``regressor(q, v, response, out)`` writes the matrix Y (rows x coefficients, row
            after row) with effort = Y Theta; ``None`` where the model is not linear in them.
        rows: number of rows of Y.
    """

    coordinates: tuple[str, ...]
    controlled: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    coefficient_names: tuple[str, ...]
    coefficients: Callable[[Vector], tuple[float, ...]]
    effort: Callable[[Vector, Vector, Vector, Vector, MutableVector], None]
    regressor: Callable[[Vector, Vector, Vector, MutableVector], None] | None = None
    rows: int = 0
