"""Mamdani inference with two inputs and one output (thesis section 5.1.1) on scikit-fuzzy.

Minimum for "and" and for the implication, maximum for the aggregation, centroid of the output on
401 points of [0, 1]. Sets are triangles L M H, shoulders at the ends. Of scikit-fuzzy membership
functions and the defuzzification serve: its ``control`` package would load networkx and matplotlib
for the same arithmetic. simpful gives the same to 1e-3, and takes 10 times as long.
"""

from dataclasses import dataclass

import numpy as np
import skfuzzy

POINTS = 401
UNIVERSE = np.linspace(0.0, 1.0, POINTS)

Triple = tuple[float, float, float]


def triangles(sets: Triple) -> tuple[list[float], list[float], list[float]]:
    """Corners of L (a, a, b), M (a, b, c) and H (b, c, c)."""
    a, b, c = sets
    return [a, a, b], [a, b, c], [b, c, c]


_OUTPUT = [skfuzzy.trimf(UNIVERSE, corners) for corners in ([0, 0, 0.5], [0, 0.5, 1], [0.5, 1, 1])]


def memberships(value: float, sets: Triple) -> dict[str, float]:
    """Degrees of L, M and H at ``value``, which is clipped to [a, c]."""
    x = np.array([min(max(value, sets[0]), sets[2])])
    degrees = (float(skfuzzy.trimf(x, corners)[0]) for corners in triangles(sets))
    return dict(zip("LMH", degrees, strict=True))


@dataclass(frozen=True)
class Rules:
    """A rule base.

    Attributes:
        first: sets (a, b, c) of the first input.
        second: sets of the second.
        text: rules "AB:C", separated by blanks: if the first is A and the second B, then C.
    """

    first: Triple
    second: Triple
    text: str

    def infer(self, first: float, second: float) -> float:
        """The output in (0, 1)."""
        one, two = memberships(first, self.first), memberships(second, self.second)
        cut = dict.fromkeys("LMH", 0.0)
        for rule in self.text.split():
            condition, output = rule.split(":")
            cut[output] = max(cut[output], min(one[condition[0]], two[condition[1]]))
        shape = np.zeros(POINTS)
        for height, triangle in zip(cut.values(), _OUTPUT, strict=True):
            shape = np.fmax(shape, np.fmin(height, triangle))
        return float(skfuzzy.defuzz(UNIVERSE, shape, "centroid"))
