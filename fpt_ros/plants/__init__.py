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

RESPONSE = "vvvvv-"
EFFORT = "vvvvvv-"
REGRESSOR = "vvvvv-"


@dataclass(frozen=True)
class Plant:
    """Exact dynamics of a system with n coordinates.

    Attributes:
        coordinates: names q1.. in the thesis, length n.
        units: of the positions, length n.
        effort_units: of the generalised forces, length n.
        parameters: physical parameters, in the order in which ``coefficients`` takes them.
        coefficients: physical parameters -> coefficients.
        response: ``response(coefficients, q, v, effort, out)`` writes the n responses that the
            efforts cause at (q, v): derivatives of order ``order``.
        order: 2 for mechanical systems, whose response is the acceleration; 1 where it is the first
            derivative; 0 where it is the value itself (a bare iteration).
        workspace: coefficients -> (lowest, highest) position of each coordinate that a nominal
            motion may ask for; ``None``: no limit.
        trouble: ``trouble(coefficients, q)`` says in words why there is no response at q, with the
            value and the remedy; empty where there is one.
    """

    coordinates: tuple[str, ...]
    units: tuple[str, ...]
    effort_units: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    coefficients: Callable[[Vector], tuple[float, ...]]
    response: Callable[[Vector, Vector, Vector, Vector, MutableVector], None]
    order: int = 2
    workspace: Callable[[Vector], tuple[tuple[float, float], ...]] | None = None
    trouble: Callable[[Vector, Vector], str] | None = None


@dataclass(frozen=True)
class Model:
    """Approximate model of a plant: response wanted -> effort.

    Attributes:
        coordinates: names, length n.
        controlled: those whose response it can prescribe.
        parameters: physical parameters, in the order in which ``coefficients`` takes them.
        coefficient_names: names of the coefficients, as tuning publishes them.
        coefficients: physical parameters -> coefficients.
        effort: ``effort(coefficients, q, v, r, s, out)`` writes the n efforts that should cause the
            response r (length n; NaN where it is not prescribed) at (q, v). s is the combined error
            (:mod:`fpt_ros.error_relaxation`), 0 where a coordinate is not controlled; only models
            with a feedback of their own use it.
        regressor: ``regressor(q, v, w, a, out)`` writes the matrix Y (rows x coefficients, row
            after row) with effort = Y Theta for the acceleration a; w is the second velocity of
            products of velocities (v itself, or the reference velocity of Slotine and Li);
            ``None`` where the model is not linear in its coefficients.
        rows: number of rows of Y.
        trouble: ``trouble(coefficients, q)`` says in words what makes the model unusable at q, with
            its value and the remedy (singular, not positive definite); empty where nothing does.
    """

    coordinates: tuple[str, ...]
    controlled: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    coefficient_names: tuple[str, ...]
    coefficients: Callable[[Vector], tuple[float, ...]]
    effort: Callable[[Vector, Vector, Vector, Vector, Vector, MutableVector], None]
    regressor: Callable[[Vector, Vector, Vector, Vector, MutableVector], None] | None = None
    rows: int = 0
    trouble: Callable[[Vector, Vector], str] | None = None
