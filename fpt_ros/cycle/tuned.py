"""What a ``tuning`` message changes in the deformer: told by the names that it carries."""

from dataclasses import dataclass

from fpt_ros.laws import MutableVector, Vector, helper
from fpt_ros.messages.frames import Names
from fpt_ros.tuning import GAIN

WEIGHT = "weight."
"""Prefix of a weight's name; the coordinate's name follows."""

FACTOR = "gain_factor"
"""Factor of A by which the precursor guard holds the gain below the onset of chattering."""

PRECURSOR = "precursor"
"""Index of the precursor observer: 1 monotone, -1 oscillation from cycle to cycle."""

NO_VALUES, A_COEFFICIENT, A_GAIN, A_WEIGHT = 0, 1, 2, 3


@helper
def apply_tuning(
    kind: int,
    first: int,
    size: int,
    factor: int,
    tuning: Vector,
    gain: float,
    constants: MutableVector,
    coefficients: MutableVector,
    weights: MutableVector,
) -> None:
    """Put ``size`` tuned values, the first at ``first``, and the gain's factor into force."""
    a = gain
    for i in range(size):
        value = tuning[first + i]
        if kind == A_COEFFICIENT:
            coefficients[i] = value
        elif kind == A_WEIGHT:
            weights[i] = value
        else:
            a = value
    if factor >= 0:
        a = a * tuning[factor]
    constants[0] = a


@dataclass(frozen=True)
class Tuned:
    """Where the values stand in a message: see :func:`apply_tuning`."""

    kind: int = NO_VALUES
    first: int = 0
    size: int = 0
    factor: int = -1

    def apply(
        self,
        tuning: Vector,
        gain: float,
        constants: MutableVector,
        coefficients: MutableVector,
        weights: MutableVector,
    ) -> None:
        """Put a message's values into force; ``gain`` is A as it is without a tuner."""
        where = self.kind, self.first, self.size, self.factor
        apply_tuning(*where, tuning, gain, constants, coefficients, weights)


NOTHING = Tuned()


def tuned_by(names: Names, coefficients: Names) -> Tuned:
    """What a message with these names changes, for a model with these coefficients."""
    factor = names.index(FACTOR) if FACTOR in names else -1
    if coefficients and names[: len(coefficients)] == coefficients:
        return Tuned(A_COEFFICIENT, 0, len(coefficients), factor)
    if GAIN in names:
        return Tuned(A_GAIN, names.index(GAIN), 1, factor)
    weights = [i for i, name in enumerate(names) if name.startswith(WEIGHT)]
    if weights:
        return Tuned(A_WEIGHT, weights[0], len(weights), factor)
    return Tuned(factor=factor)
