"""Holding a position: what is commanded in a stop, or where the loop is silent, beside an effort.

A spring and a damper of each coordinate about the position at which it stopped, on top of the safe
effort (what carries the weight, say), within ``limit.effort``.
"""

import math
from typing import NamedTuple

from fpt_ros.errors import BadInput
from fpt_ros.laws import MutableVector, Switch, Vector, helper
from fpt_ros.messages.frames import SECOND, JointStates, Names
from fpt_ros.parameters import Parameter, Values, numbers, word

EFFORT, HOLD = "effort", "hold"

WHEN_STOPPED = Parameter(
    "when_stopped",
    "what is commanded in an emergency stop, and where the loop is silent for command_timeout: "
    "effort: safe_effort, hold: what holds the position where it stopped, while that is measured",
    EFFORT,
    choices=(EFFORT, HOLD),
    live=False,
)

PARAMETERS = (
    WHEN_STOPPED,
    Parameter(
        "hold.stiffness",
        "effort per deviation from the position that is held, per coordinate",
        [],
        minimum=0.0,
    ),
    Parameter(
        "hold.damping",
        "effort per velocity while a position is held, per coordinate; empty: none",
        [],
        minimum=0.0,
    ),
)


class HoldConstants(NamedTuple):
    """``holds``: whether it is asked for; n each where it is: ``stiffness``, ``damping``."""

    holds: Switch
    stiffness: Vector
    damping: Vector


def hold_of(values: Values, coordinates: Names, who: str) -> HoldConstants:
    """What checked parameters ask for.

    Raises:
        BadInput: a list is of another length than the coordinates, or there is no stiffness.
    """
    holds, n = word(values, WHEN_STOPPED.name) == HOLD, len(coordinates)
    stiffness, damping = numbers(values, "hold.stiffness"), numbers(values, "hold.damping")
    for name, given, lengths in (
        ("stiffness", stiffness, (n,) if holds else (0, n)),
        ("damping", damping, (0, n)),
    ):
        if len(given) not in lengths:
            raise BadInput(
                f"{who}.hold.{name}: {len(given)} given, {n} needed ({', '.join(coordinates)})"
            )
    return HoldConstants(int(holds), stiffness or [0.0] * n, damping or [0.0] * n)


@helper
def hold(
    constants: HoldConstants,
    safe: Vector,
    largest: Vector,
    held: MutableVector,
    q: Vector,
    v: Vector,
    out: MutableVector,
) -> None:
    """The effort that holds; ``held``: the position, NaN where it begins to be held.

    A coordinate that is not measured gets its safe effort; a velocity that is not does not damp.
    """
    for i in range(len(out)):
        if math.isnan(held[i]):
            held[i] = q[i]
        acts = safe[i]
        if not math.isnan(q[i]) and not math.isnan(held[i]):
            acts = acts + constants.stiffness[i] * (held[i] - q[i])
            if not math.isnan(v[i]):
                acts = acts - constants.damping[i] * v[i]
        if acts > largest[i]:
            acts = largest[i]
        if acts < -largest[i]:
            acts = -largest[i]
        out[i] = acts


@helper
def let_go(held: MutableVector) -> None:
    """Nothing is held any more."""
    for i in range(len(held)):
        held[i] = math.nan


def with_velocity(measured: JointStates, before: JointStates | None) -> JointStates:
    """A measurement, the velocities that it lacks taken from the one before (within a second)."""
    if before is None or not 0 < measured.stamp - before.stamp < SECOND:
        return measured
    dt = (measured.stamp - before.stamp) / SECOND
    triples = zip(measured.velocity, measured.position, before.position, strict=True)
    v = [(q - past) / dt if math.isnan(x) else x for x, q, past in triples]
    return measured._replace(velocity=v)
