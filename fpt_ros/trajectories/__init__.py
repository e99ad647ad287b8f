"""Nominal trajectories, one a file: functions of time with their derivatives."""

from collections.abc import Callable
from dataclasses import dataclass

from fpt_ros.laws import MutableVector, Vector
from fpt_ros.parameters import Parameter, Values, numbers
from fpt_ros.registry import Kind

Nominal = Callable[
    [Vector, MutableVector, float, float, MutableVector, MutableVector, MutableVector], None
]
"""(constants, state, t, dt, out_q, out_v, out_a)"""


class Constants(tuple[float, ...]):
    """Constants with addresses among them: what they point to lives as long as they do."""

    memory: tuple[object, ...] = ()


@dataclass(frozen=True)
class Trajectory:
    """Nominal motion of the controlled coordinates.

    Attributes:
        prepare: ``prepare(values, c)``: checked parameters -> constants, for c coordinates.
            ``amplitude`` (in the unit of the coordinate) and ``frequency`` (a factor of time,
            [rad/s] for harmonic shapes) are parameters of every trajectory, lists of c numbers.
            :class:`Constants` where addresses of C are among them.
        nominal: ``nominal(constants, state, t, dt, out_q, out_v, out_a)`` writes position, velocity
            and acceleration of each controlled coordinate at t [s], dt [s] after the cycle before
            (0 in the first): whatever the order of the plant, from which the stage takes the
            nominal response.
        parameters: its own, beside amplitude and frequency.
        state: initial state, of a motion that is integrated.
        coarse: whether steps of 50 ms show where an integrated motion goes, too.
    """

    prepare: Callable[[Values, int], tuple[float, ...]]
    nominal: Nominal
    parameters: tuple[Parameter, ...] = ()
    state: tuple[float, ...] = ()
    coarse: bool = False


TRAJECTORIES: Kind[Trajectory] = Kind(Trajectory, "trajectories")


def scales(values: Values, c: int) -> tuple[float, ...]:
    """The constants that most shapes begin with: c amplitudes, then c frequencies."""
    return (*numbers(values, "amplitude"), *numbers(values, "frequency"))


def per_coordinate(values: Values, name: str, c: int) -> list[float]:
    """A list of c numbers; zeros where it is empty.

    Raises:
        BadInput: of another length.
    """
    from fpt_ros.errors import BadInput

    given = numbers(values, name)
    if given and len(given) != c:
        raise BadInput(f"trajectory_generator.{name}: {len(given)} numbers given, {c} needed")
    return given or [0.0] * c
