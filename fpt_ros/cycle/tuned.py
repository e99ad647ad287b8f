"""What a ``tuning`` message changes in the deformer: told by the names that it carries."""

from typing import NamedTuple

from fpt_ros.laws import Switch
from fpt_ros.messages.frames import Names
from fpt_ros.parameters import Parameter
from fpt_ros.tuning import GAIN

WEIGHT = "weight."
"""Prefix of a weight's name; the coordinate's name follows."""

FACTOR = "gain_factor"
"""Factor of A by which the precursor guard holds the gain below the onset of chattering."""

PRECURSOR = "precursor"
"""Index of the precursor observer: 1 monotone, -1 oscillation from cycle to cycle."""

NO_VALUES, A_COEFFICIENT, A_GAIN, A_WEIGHT = 0, 1, 2, 3

CONTROLLED = Parameter(
    "controlled",
    "coordinates that the trajectory generator controls, in its order; empty: as its first message",
    [],
    kind="strings",
    live=False,
)
"""Known to deformer and tuner; derived where an experiment is loaded."""


class TunedPlaces(NamedTuple):
    """Where the values stand in a message: ``size`` of them from ``first`` on.

    ``kind``: coefficients of the model, the gain A, or weights; ``factor``: place of the gain's
    factor, -1 where there is none.
    """

    kind: Switch = NO_VALUES
    first: int = 0
    size: int = 0
    factor: int = -1


NOTHING = TunedPlaces()


def tuned_by(names: Names, coefficients: Names) -> TunedPlaces:
    """What a message with these names changes, for a model with these coefficients."""
    factor = names.index(FACTOR) if FACTOR in names else -1
    if coefficients and names[: len(coefficients)] == coefficients:
        return TunedPlaces(A_COEFFICIENT, 0, len(coefficients), factor)
    if GAIN in names:
        return TunedPlaces(A_GAIN, names.index(GAIN), 1, factor)
    weights = [i for i, name in enumerate(names) if name.startswith(WEIGHT)]
    if weights:
        return TunedPlaces(A_WEIGHT, weights[0], len(weights), factor)
    return TunedPlaces(factor=factor)
