"""Where a value stands on a slider: in proportion, or in decades where a range has many of them."""

import math
from typing import NamedTuple

HUGE = 1e300
"""Beyond it a range has no end."""

DECADES = 2.0
"""On both sides of a value whose range has no end."""

MANY = 1e3
"""Ratio of a range's ends from which on a slider counts in decades."""

DIGITS = 4
"""Significant, of what a slider of decades gives."""


class Scale(NamedTuple):
    """A slider from ``start`` to ``end`` in steps; ``sign``: of the values, 0 if not in decades."""

    start: float
    end: float
    step: float
    sign: int = 0

    def place(self, value: float) -> float:
        """Of a value; at an end where it is beyond."""
        at = value
        if self.sign:
            at = math.log10(abs(value)) if self.sign * value > 0.0 else self.start
        return min(max(at, self.start), self.end)

    def value(self, place: float) -> float:
        """At a place of the slider."""
        if not self.sign:
            return float(f"{place:.12g}")
        return float(f"{self.sign * math.pow(10.0, place):.{DIGITS}g}")

    def holds(self, value: float) -> bool:
        """Whether a value lies on the slider, and not at its ends where it could go on."""
        if self.sign and self.sign * value <= 0.0:
            return False
        at = math.log10(abs(value)) if self.sign else value
        return self.start <= at <= self.end


def scale(value: float, low: float, high: float, whole: bool = False) -> Scale:
    """The slider for a value.

    Args:
        value: where it begins.
        low, high: of the valid values; -inf, inf or beyond 1e300: there is no end.
        whole: only whole numbers.
    """
    ends = abs(low) < HUGE, abs(high) < HUGE
    if whole:
        start = low if ends[0] else min(value, 0.0) - 100.0
        end = high if all(ends) and high - start <= MANY else max(2.0 * abs(value), 100.0)
        return Scale(start, min(end, high), 1.0)
    if all(ends) and not (value > 0.0 and low >= 0.0 and high > MANY * max(value, low)):
        return _linear(low, high)
    if value == 0.0:
        return _linear(low if ends[0] and low > -1.0 else -1.0, min(high, 1.0))
    sign = 1 if value > 0.0 else -1
    near, far = sorted((abs(low), abs(high))) if low * high > 0.0 else (0.0, math.inf)
    if low * high <= 0.0:
        far = high if sign > 0 else -low
    at = math.log10(abs(value))
    start = max(at - DECADES, math.log10(near) if near else -math.inf)
    end = min(at + DECADES, math.log10(far) if 0.0 < far < HUGE else math.inf)
    start, end = math.floor(100.0 * start) / 100.0, math.ceil(100.0 * end) / 100.0
    return Scale(start, max(end, start + 0.01), 0.01, sign)


def _linear(low: float, high: float) -> Scale:
    if not low < high:
        high = low + 1.0
    return Scale(low, high, float(f"{(high - low) / 200.0:.3g}"))
