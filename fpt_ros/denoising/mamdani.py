"""Mamdani inference with two inputs and one output (thesis section 5.1.1), offline and in the loop.

Minimum for "and" and for the implication, maximum for the aggregation, centroid over [0, 1], in
closed form. Sets are triangles L M H, shoulders at the ends; those of the output are at 0, 1/2, 1.
scikit-fuzzy gives the same to 4e-6 on 401 points, but takes arrays, and the filters of the loop
plain numbers.
"""

from dataclasses import dataclass

from fpt_ros.laws import Vector, helper

Triple = tuple[float, float, float]

OUTPUTS = "LMH"
SIZE = 15
"""Numbers of a rule base as constants of a law: six corners, and the output of nine rules."""


@dataclass(frozen=True)
class Rules:
    """A rule base.

    Attributes:
        first: sets (a, b, c) of the first input: L is 1 at a, M at b, H at c.
        second: sets of the second.
        text: rules "AB:C", separated by blanks: if the first is A and the second B, then C.
    """

    first: Triple
    second: Triple
    text: str

    def constants(self) -> tuple[float, ...]:
        """The corners, then 0, 1 or 2 for the output L, M or H of LL, LM, LH, ML, ..; -1: none."""
        said = dict(rule.split(":") for rule in self.text.split())
        outputs = (said.get(a + b) for a in OUTPUTS for b in OUTPUTS)
        return (
            *self.first,
            *self.second,
            *(float(OUTPUTS.index(o)) if o else -1.0 for o in outputs),
        )

    def infer(self, first: float, second: float) -> float:
        """The output in (0, 1)."""
        return infer(self.constants(), 0, first, second)


@helper
def membership(sets: Vector, at: int, which: int, value: float) -> float:
    """Degree of L (0), M (1) or H (2) of the triple at ``at``; beyond its ends as at them."""
    low, middle, high = sets[at], sets[at + 1], sets[at + 2]
    above = value > middle
    share = (value - middle) / (high - middle) if above else (value - low) / (middle - low)
    share = 0.0 if share < 0.0 else 1.0 if share > 1.0 else share
    if which == 1:
        return 1.0 - share if above else share
    if above:
        return share if which == 2 else 0.0
    return 1.0 - share if which == 0 else 0.0


@helper
def infer(rules: Vector, at: int, first: float, second: float) -> float:
    """The output in (0, 1) of the rule base whose constants begin at ``at``."""
    low = middle = high = 0.0
    for i in range(3):
        one = membership(rules, at, i, first)
        for j in range(3):
            two = membership(rules, at + 3, j, second)
            cut = one if one < two else two
            output = rules[at + 6 + 3 * i + j]
            if output == 0.0 and cut > low:
                low = cut
            elif output == 1.0 and cut > middle:
                middle = cut
            elif output == 2.0 and cut > high:
                high = cut
    left, left_moment = half(low, middle), half_moment(low, middle)
    right, right_moment = half(high, middle), half_moment(high, middle)
    area = left + right
    if area == 0.0:  # no rule says anything
        return 0.5
    # u = 2 x on the left, 2 - 2 x on the right
    return 0.5 * (left_moment + 2.0 * right - right_moment) / area


@helper
def crossing(outer: float, inner: float) -> float:
    """Where max(min(outer, 1 - u), min(inner, u)) goes from the one to the other."""
    if outer >= 0.5 and inner >= 0.5:
        return 0.5
    return outer if outer <= inner else 1.0 - inner


@helper
def half(outer: float, inner: float) -> float:
    """Area under max(min(outer, 1 - u), min(inner, u)) for u from 0, an end, to 1, the middle."""
    u = crossing(outer, inner)
    flat = 1.0 - outer if 1.0 - outer < u else u
    area = outer * flat + 0.5 * (u - flat) * (2.0 - flat - u)
    flat = inner if inner > u else u
    return area + 0.5 * (flat - u) * (flat + u) + inner * (1.0 - flat)


@helper
def half_moment(outer: float, inner: float) -> float:
    """The integral of u times the same."""
    u = crossing(outer, inner)
    flat = 1.0 - outer if 1.0 - outer < u else u
    moment = 0.5 * outer * flat * flat
    moment += 0.5 * (u * u - flat * flat) - (u * u * u - flat * flat * flat) / 3.0
    flat = inner if inner > u else u
    return moment + (flat * flat * flat - u * u * u) / 3.0 + 0.5 * inner * (1.0 - flat * flat)
