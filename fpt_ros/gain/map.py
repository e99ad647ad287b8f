"""The iteration along one eigenvector as a scalar map: its two-cycles, chaos, and way out of F.

With J the response's Jacobian and lambda an eigenvalue of it, the response error h along the
eigenvector goes as h' = h + lambda (step of the transformation for h). Every transformation depends
on A h alone, so in u = |A| h there is one parameter, p = |A| lambda::

    u' = u - p G(u),   G(u) = -(step for A = +-1 and h = u),   G(0) = 0, u G(u) > 0

(for lambda > 0; for lambda < 0 both signs change).

In the norm form G is odd; in the signed form of a sigmoid it is not. A two-cycle u1 > 0 > u2 needs
G(u1) = -G(u2) and has p = (u1 - u2) / G(u1): so all of them are known as functions of u1, without
any search. Where u1 -> 0, p = 2 / G'(0) is the linear limit.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

from fpt_ros.laws import Vector
from fpt_ros.transformations import Transformation

FAR = 30.0
"""|u| beyond which nothing new comes: all sigmoids are flat."""

POINTS = 240
"""Points of the two-cycles' branch."""

LYAPUNOV_STEP = 0.01 / 3.1609
"""Grid of the search for chaos, in linear limits (0.01 in p for the thesis's sigmoid)."""


@dataclass(frozen=True)
class TwoCycle:
    """u1 > 0 > u2 that the map with this p exchanges; ``multiplier`` of two steps."""

    p: float
    high: float
    low: float
    multiplier: float


@dataclass(frozen=True)
class ScalarMap:
    """u' = u - p G(u).

    Attributes:
        step: G; NaN outside its domain.
        slope: G'(0) > 0.
    """

    step: Callable[[float], float]
    slope: float

    @property
    def linear(self) -> float:
        """The linear limit of p: the multiplier 1 - p G'(0) is -1."""
        return 2.0 / self.slope

    @cached_property
    def edges(self) -> tuple[float, float]:
        """Between which G is defined; infinite where it is everywhere."""
        return -self._edge(-1.0), self._edge(1.0)

    def _edge(self, side: float) -> float:
        inside, outside = 0.0, math.inf
        for k in range(1, 61):
            u = FAR * k / 60.0
            if math.isnan(self.step(side * u)):
                outside = u
                break
            inside = u
        if outside == math.inf:
            return math.inf
        while inside < (middle := 0.5 * (inside + outside)) < outside:
            if math.isnan(self.step(side * middle)):
                outside = middle
            else:
                inside = middle
        return inside

    def two_cycle(self, high: float) -> TwoCycle | None:
        """The two-cycle whose upper point this is; ``None``: there is none for any p."""
        up = self.step(high)
        if not up > 0.0:
            return None
        low = -high
        if abs(self.step(low) + up) > 1e-12 * up:
            far = max(self.edges[0], -FAR)
            if not self.step(far) <= -up:
                return None
            near = 0.0
            while far < (low := 0.5 * (far + near)) < near:
                if self.step(low) <= -up:
                    far = low
                else:
                    near = low
        p = (high - low) / up
        multiplier = (1.0 - p * self.derivative(high)) * (1.0 - p * self.derivative(low))
        return TwoCycle(p, high, low, multiplier)

    def derivative(self, u: float) -> float:
        """G'(u), by differences."""
        d = 1e-6 * (1.0 + abs(u))
        return (self.step(u + d) - self.step(u - d)) / (2.0 * d)

    @cached_property
    def branch(self) -> list[TwoCycle]:
        """All two-cycles, from the smallest one on."""
        end = min(self.edges[1], FAR)
        tops = [end * (1e-3) ** (1.0 - k / POINTS) for k in range(POINTS)]
        found = []
        for top in tops:
            cycle = self.two_cycle(top)
            if cycle is None:
                break
            found.append(cycle)
        return found

    def hard_onset(self) -> TwoCycle | None:
        """The two-cycle with the smallest p, where that is below the linear limit.

        From there on a finite two-cycle holds those that come near it, while the solution is
        still attractive: chattering sets in all at once, and the start decides whether it does.
        ``None``: two-cycles grow out of the solution at the linear limit, or none is stable.
        """
        branch = self.branch
        if len(branch) < 3:
            return None
        at = min(range(len(branch)), key=lambda k: branch[k].p)
        if not 0 < at < len(branch) - 1 or branch[at].p > self.linear * (1.0 - 1e-3):
            return None
        low, high = branch[at - 1].high, branch[at + 1].high
        best = golden(lambda top: self._p(top), low, high)
        return self.two_cycle(best)

    def _p(self, top: float) -> float:
        cycle = self.two_cycle(top)
        return cycle.p if cycle is not None else math.inf

    def doubling(self) -> float | None:
        """The p at which the two-cycle's multiplier is -1, and a four-cycle takes its place."""
        for one, next_one in zip(self.branch, self.branch[1:], strict=False):
            if one.multiplier > -1.0 >= next_one.multiplier:
                inside, outside = one.high, next_one.high
                while inside < (middle := 0.5 * (inside + outside)) < outside:
                    cycle = self.two_cycle(middle)
                    if cycle is not None and cycle.multiplier > -1.0:
                        inside = middle
                    else:
                        outside = middle
                return self._p(inside)
        return None

    def domain_limit(self) -> float | None:
        """The p beyond which the map leads out of the domain of G; ``None``: it never does.

        u - p G(u) passes the edge e for some u where p > (u - e) / G(u): the least of these.
        """
        low, high = self.edges
        found = []
        if high < math.inf:
            found.append(self._least(lambda u: (high + u) / -self.step(-u), min(-low, FAR)))
        if low > -math.inf:
            found.append(self._least(lambda u: (u - low) / self.step(u), min(high, FAR)))
        return max(min(found), self.linear) if found else None

    @staticmethod
    def _least(p: Callable[[float], float], end: float) -> float:
        grid = [end * (1e-3) ** (1.0 - k / POINTS) for k in range(POINTS)]
        at = min(range(POINTS), key=lambda k: p(grid[k]))
        best = golden(p, grid[max(at - 1, 0)], grid[min(at + 1, POINTS - 1)])
        return min(p(best), p(grid[at]))

    def orbit(self, p: float, u: float) -> Iterator[float]:
        """The points after u; it ends where it leaves the domain."""
        while math.isfinite(u):
            u = u - p * self.step(u)
            yield u

    def attractor(self, p: float, start: float, skip: int, keep: int) -> list[float]:
        """Where the orbit from ``start`` is in the end; empty: it has left the domain."""
        points = []
        for k, u in enumerate(self.orbit(p, start)):
            if not math.isfinite(u):
                return []
            if k >= skip:
                points.append(u)
            if len(points) == keep:
                break
        return points

    def lyapunov(self, p: float, skip: int = 300, count: int = 1000) -> float:
        """Mean of log |1 - p G'(u)| along the orbit; positive: chaos; NaN: it left the domain."""
        total, points = 0.0, self.attractor(p, 0.01, skip, count)
        for u in points:
            total += math.log(max(abs(1.0 - p * self.derivative(u)), 1e-300))
        return total / count if len(points) == count else math.nan

    def chaos(self, doubling: float | None, end: float | None) -> float | None:
        """The first p of a grid between ``doubling`` and ``end`` with a chaotic orbit."""
        if doubling is None:
            return None
        step = LYAPUNOV_STEP * self.linear
        p = math.ceil(doubling / step) * step
        last = min(end if end is not None else math.inf, 2.0 * doubling)
        while p < last:
            if self.lyapunov(p) > 0.01:
                return p
            p += step
        return None


def scalar_map(transformation: Transformation, constants: Vector, eigenvalue: float) -> ScalarMap:
    """The map of a transformation, for the sign of A that contracts.

    Args:
        transformation: any; its step for r = 0 is taken.
        constants: of its ``prepare``.
        eigenvalue: of the response's Jacobian; only its sign counts.
    """
    side = math.copysign(1.0, eigenvalue)
    slope = transformation.slope(constants)
    own = [-math.copysign(1.0, slope * side), *constants[1:]]

    def step(u: float) -> float:
        out = [0.0]
        try:
            transformation.deform(own, [0.0], [u], [u], [0.0], out)
        except (ArithmeticError, ValueError):
            return math.nan
        return -side * out[0]

    return ScalarMap(step, abs(slope))


def golden(function: Callable[[float], float], low: float, high: float) -> float:
    """Where a function with one minimum between two points has it."""
    ratio = 0.5 * (math.sqrt(5.0) - 1.0)
    left, right = high - ratio * (high - low), low + ratio * (high - low)
    at_left, at_right = function(left), function(right)
    for _ in range(80):
        if at_left <= at_right:
            high, right, at_right = right, left, at_left
            left = high - ratio * (high - low)
            at_left = function(left)
        else:
            low, left, at_left = left, right, at_right
            right = low + ratio * (high - low)
            at_right = function(right)
    return 0.5 * (low + high)
