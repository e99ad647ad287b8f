"""The messages of a control cycle as plain values.

Every frame has ``stamp``, the time t_k of its cycle [ns], and ``names``; then its vectors, one
number per name. In a vector over all coordinates NaN marks what is not known or not prescribed.
"""

from typing import NamedTuple

from fpt_ros.laws import Vector

Names = tuple[str, ...]

SECOND = 1_000_000_000
"""Nanoseconds in a second: stamps are whole numbers of them."""


class JointStates(NamedTuple):
    """What the plant shows: measured motion, and the effort that acted up to t_k."""

    stamp: int
    names: Names
    position: Vector
    velocity: Vector
    effort: Vector


class StateEstimate(NamedTuple):
    """Filtered motion; ``accelerations`` is the observed response to r_{k-1}, NaN in cycle 0.

    ``deformed`` is r as the filter shows it, NaN where the deformation is not synchronised.
    """

    stamp: int
    names: Names
    positions: Vector
    velocities: Vector
    accelerations: Vector
    deformed: Vector


class Desired(NamedTuple):
    """Nominal motion and, as ``accelerations``, the desired response; ``names``: controlled now.

    ``combined_error`` is s of :mod:`fpt_ros.relaxations`.
    """

    stamp: int
    names: Names
    positions: Vector
    velocities: Vector
    accelerations: Vector
    combined_error: Vector


class Tuning(NamedTuple):
    """Parameters of the deformer in force in this cycle."""

    stamp: int
    names: Names
    values: Vector


class Command(NamedTuple):
    """Deformed response (``accelerations``, NaN where not controlled) and the model's effort."""

    stamp: int
    names: Names
    accelerations: Vector
    effort: Vector


Frame = JointStates | StateEstimate | Desired | Tuning | Command
