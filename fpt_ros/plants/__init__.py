"""Plants and their approximate models, one system a file.

A :class:`Plant` is the exact dynamics that the simulator integrates. A :class:`Model` is what the
controller believes: the same equations solved for the effort, with other numbers. Both compute with
*coefficients*: combinations of the physical parameters in which the equations are linear where they
can be (thesis, Theta of section 2.2), because it is these that identification tunes.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Value, Values
from fpt_ros.registry import Kind

Response = Callable[[Vector, Vector, Vector, Vector, MutableVector], None]
"""(coefficients, q, v, effort, out)"""

Effort = Callable[[Vector, Vector, Vector, Vector, Vector, MutableVector], None]
"""(coefficients, q, v, r, s, out)"""

Regressor = Callable[[Vector, Vector, Vector, Vector, Vector, MutableVector], None]
"""(coefficients, q, v, w, a, out)"""

Advance = Callable[
    [
        Vector,
        MutableVector,
        float,
        float,
        Vector,
        Vector,
        MutableVector,
        MutableVector,
        MutableVector,
    ],
    None,
]
"""(coefficients, state, t, dt, effort, external, q, v, acted)"""

Start = Callable[[Vector, MutableVector, Vector, Vector], None]
"""(coefficients, state, q, v)"""


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
            efforts cause at (q, v): derivatives of order ``order``. The stage integrates them.
        advance: of a plant that integrates itself, in the place of ``response`` (which is then
            for analyses only): ``advance(coefficients, state, t, dt, effort, external, q, v,
            acted)`` moves q and v on by dt [s] from t [s], under the efforts and the external
            forces of a disturbance, and writes the efforts that really acted. ``state`` holds
            ``state`` numbers of its own. What it cannot do it writes as NaN.
        state: number of state variables beside q and v.
        start: ``start(coefficients, state, q, v)`` sets them for the initial motion.
        set_step: of a plant that integrates itself: it is told once how long its steps are [s],
            before the first; ``None``: it need not know.
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
    response: Response | None = None
    order: int = 2
    workspace: Callable[[Vector], tuple[tuple[float, float], ...]] | None = None
    trouble: Callable[[Vector, Vector], str] | None = None
    advance: Advance | None = None
    state: int = 0
    start: Start | None = None
    set_step: Callable[[float], None] | None = None


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
            (:mod:`fpt_ros.relaxations`), 0 where a coordinate is not controlled; only models
            with a feedback of their own use it.
        regressor: ``regressor(coefficients, q, v, w, a, out)`` writes the matrix Y (rows x
            coefficient names, row after row) with effort = Y Theta for the acceleration a; w is the
            second velocity of products of velocities (v itself, or the reference velocity of
            Slotine and Li). Of the coefficients Y may depend on those alone that have no name
            and are not tuned. ``None`` where the model is not linear in its coefficients.
        rows: number of rows of Y.
        trouble: ``trouble(coefficients, q)`` says in words what makes the model unusable at q, with
            its value and the remedy (singular, not positive definite); empty where nothing does.
    """

    coordinates: tuple[str, ...]
    controlled: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    coefficient_names: tuple[str, ...]
    coefficients: Callable[[Vector], tuple[float, ...]]
    effort: Effort
    regressor: Regressor | None = None
    rows: int = 0
    trouble: Callable[[Vector, Vector], str] | None = None


Made = TypeVar("Made", Plant, Model)


@dataclass(frozen=True)
class Factory(Generic[Made]):
    """A plant or model whose coordinates, units or laws depend on parameters, as on a file's name.

    Attributes:
        parameters: all that it takes, words among them.
        make: ``make(values)`` with these, by name, complete and checked. Of the
            plant or model that it gives ``parameters`` may be empty; its coefficients may hold
            whatever the laws need, an address for example.
    """

    parameters: tuple[Parameter, ...]
    make: Callable[[Values], Made]


PLANTS: Kind[Plant | Factory[Plant]] = Kind((Plant, Factory), "plants")
MODELS: Kind[Model | Factory[Model]] = Kind((Model, Factory), "models")


def made(entry: Made | Factory[Made], values: Values, prefix: str) -> Made:
    """The plant or model itself, for the checked parameters ``prefix.NAME``.

    A recording holds no empty lists, which have no type in ROS: what is left out has its default.

    Raises:
        KeyError: a parameter without default is not there.
    """
    if not isinstance(entry, Factory):
        return entry
    own: dict[str, Value] = {}
    for each in entry.parameters:
        name = f"{prefix}.{each.name}"
        own[each.name] = values[name] if each.default is None else values.get(name, each.default)
    return entry.make(own)
