"""The frames of a cycle as the engine holds them: a row of numbers a vector, without names.

The field names are those of the frames (:mod:`fpt_ros.messages.frames`), so that a function which
reads ``estimate.positions`` takes either. In a row of ``desired`` all controlled coordinates stand
in their order, NaN where it is not their turn.
"""

from typing import NamedTuple

from fpt_ros.laws import Matrix, MutableVector, Vector
from fpt_ros.messages.frames import Command, Desired, JointStates, Names, StateEstimate, Tuning


class JointStatesRow(NamedTuple):
    """Measured motion, n each, and the effort that acted."""

    position: MutableVector
    velocity: MutableVector
    effort: MutableVector


class StateEstimateRow(NamedTuple):
    """Filtered motion, observed response, and r as the filter shows it, n each."""

    positions: MutableVector
    velocities: MutableVector
    accelerations: MutableVector
    deformed: MutableVector


class DesiredRow(NamedTuple):
    """Nominal motion, desired response and combined error, c each."""

    positions: MutableVector
    velocities: MutableVector
    accelerations: MutableVector
    combined_error: MutableVector


class TuningRow(NamedTuple):
    """What is tuned, signals, precursor and gain factor."""

    values: MutableVector


class CommandRow(NamedTuple):
    """Deformed response and effort, n each."""

    accelerations: MutableVector
    effort: MutableVector


class JointStatesRows(NamedTuple):
    """Rows of ``joint_states``, one a cycle."""

    position: Matrix
    velocity: Matrix
    effort: Matrix


class StateEstimateRows(NamedTuple):
    """Rows of ``state_estimate``, one a cycle."""

    positions: Matrix
    velocities: Matrix
    accelerations: Matrix
    deformed: Matrix


class DesiredRows(NamedTuple):
    """Rows of ``desired``, one a cycle."""

    positions: Matrix
    velocities: Matrix
    accelerations: Matrix
    combined_error: Matrix


class TuningRows(NamedTuple):
    """Rows of ``tuning``, one a cycle."""

    values: Matrix


class CommandRows(NamedTuple):
    """Rows of ``command``, one a cycle."""

    accelerations: Matrix
    effort: Matrix


Measured = JointStates | JointStatesRow
Estimated = StateEstimate | StateEstimateRow
Wanted = Desired | DesiredRow
Commanded = Command | CommandRow
Tuned = Tuning | TuningRow

NO_DESIRED = Desired(0, (), (), (), (), ())
"""For a law that takes no desired response."""


def no_command(names: Names) -> Command:
    """In the place of the command of the cycle before the first one: nothing is known."""
    unknown: Vector = (float("nan"),) * len(names)
    return Command(-1, names, unknown, unknown)


def not_measured(names: Names) -> JointStates:
    """In the place of a measurement that is not there: nothing is known."""
    unknown: Vector = (float("nan"),) * len(names)
    return JointStates(-1, names, unknown, unknown, unknown)
