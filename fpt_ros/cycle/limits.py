"""Limits of the effort, and what the learning makes of them: parameters and records.

They live where the command is made, so that a robot is safe whoever simulates or drives it. What
they do: :mod:`fpt_ros.cycle.acting`.
"""

import math
from typing import NamedTuple

from fpt_ros.cycle.holding import PARAMETERS as HOLDING
from fpt_ros.cycle.holding import HoldConstants, hold_of
from fpt_ros.cycle.stage import REALTIME
from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Switch, Vector
from fpt_ros.messages.frames import Names
from fpt_ros.parameters import Parameter, Values, flag, number, numbers, word

WINDUP = ("none", "clamp", "acted")
NO_ANTI_WINDUP, CLAMP, ACTED = range(3)

ANTI_WINDUP = Parameter(
    "anti_windup",
    "from which r the learning goes on where the effort was limited: none: the one asked for, "
    "clamp: the last one not limited, acted: what the model makes of the effort that acted",
    WINDUP[NO_ANTI_WINDUP],
    choices=WINDUP,
    live=False,
)

COMMAND_TIMEOUT = Parameter(
    "command_timeout",
    "age of the newest measurement at which the safe effort is commanded, in real time; 0: never",
    0.1,
    unit="s",
    minimum=0.0,
    live=False,
)

STOPPED = Parameter("stopped", "emergency stop: the safe effort is commanded", False)

PARAMETERS = (
    Parameter("limit.effort", "largest effort, per coordinate; empty: none", [], above=0.0),
    Parameter(
        "limit.rate",
        "largest change of the effort in a second, per coordinate; empty: none",
        [],
        above=0.0,
        live=False,
    ),
    ANTI_WINDUP,
    Parameter(
        "effort_tolerance",
        "difference between the effort sent and the one that acted, beyond which it was limited",
        1e-6,
        minimum=0.0,
    ),
    Parameter(
        "take_over",
        "time over which the effort goes from the one that acts to the controller's, at the start "
        "and after a stop",
        0.0,
        unit="s",
        minimum=0.0,
        live=False,
    ),
    Parameter(
        "safe_effort", "of a stop or where nothing is measured, per coordinate; empty: zero", []
    ),
    STOPPED,
    COMMAND_TIMEOUT,
    *HOLDING,
)


class LimitConstants(NamedTuple):
    """``acts``: whether any of this is asked for; ``remembers``: whether cycles depend on others.

    ``effort``, ``rate``: largest ones (n; inf: none); ``windup``: of :data:`WINDUP`; ``tolerance``:
    of the effort that acted; ``take_over``, ``timeout`` [s] (0: none); ``safe`` effort (n),
    commanded while ``stopped``, unless the position is held (``hold``).
    """

    acts: Switch
    remembers: Switch
    effort: Vector
    rate: Vector
    windup: Switch
    tolerance: float
    take_over: float
    timeout: float
    stopped: Switch
    safe: Vector
    hold: HoldConstants


class LimitWork(NamedTuple):
    """n each: ``missing`` efforts, a response ``probe``, the model's ``base`` and ``column``.

    ``jacobian`` (n x c) and ``normal`` equations (c x (c + 1)), row after row.
    """

    missing: MutableVector
    probe: MutableVector
    base: MutableVector
    column: MutableVector
    jacobian: MutableVector
    normal: MutableVector


def limit_work(n: int, c: int) -> LimitWork:
    """For n coordinates, c of them controlled."""
    sizes = (n, n, n, n, n * c, c * (c + 1))
    return LimitWork(*[[0.0] * size for size in sizes])


def limits_of(values: Values, coordinates: Names, who: str) -> LimitConstants:
    """The limits that checked parameters ask for.

    Raises:
        BadInput: a list is of another length than the coordinates.
    """
    n = len(coordinates)

    def each(name: str, default: float) -> list[float]:
        given = numbers(values, name)
        if len(given) not in (0, n):
            raise BadInput(
                f"{who}.{name}: {len(given)} given, {n} needed ({', '.join(coordinates)}), or none"
            )
        return given or [default] * n

    effort, rate = each("limit.effort", math.inf), each("limit.rate", math.inf)
    safe = each("safe_effort", 0.0)
    windup = WINDUP.index(word(values, ANTI_WINDUP.name))
    take_over, timeout = number(values, "take_over"), number(values, COMMAND_TIMEOUT.name)
    stopped = flag(values, STOPPED.name)
    timeout = timeout if flag(values, REALTIME.name) else 0.0
    remembers = windup != NO_ANTI_WINDUP or take_over > 0.0 or any(map(math.isfinite, rate))
    acts = remembers or stopped or timeout > 0.0 or any(map(math.isfinite, effort))
    return LimitConstants(
        acts=int(acts),
        remembers=int(remembers),
        effort=effort,
        rate=rate,
        windup=windup,
        tolerance=number(values, "effort_tolerance"),
        take_over=take_over,
        timeout=timeout,
        stopped=int(stopped),
        safe=safe,
        hold=hold_of(values, coordinates, who),
    )
