"""The limits of the gain A: what :func:`fpt_ros.gain.contraction.bounds` finds."""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from fpt_ros.gain.bands import (
    CHAOS,
    CIRCLES,
    DOUBLING,
    DOUBLING_TO_CHAOS,
    LEAVES,
    MONOTONE,
    OR_TWO_CYCLE,
    PRECURSOR,
    RUNS_AWAY,
    SPIRAL,
    TWO_CYCLE,
    Band,
)
from fpt_ros.gain.interval import Interval, holds, interval
from fpt_ros.gain.map import ScalarMap
from fpt_ros.runs.run import Array

MARGIN = 0.8
"""The recommended A as a part of the gain up to which all convergence is monotone."""


@dataclass(frozen=True)
class Gain:
    """The analysis; all limits are magnitudes |A|, ``sign`` is that of the A that contracts.

    Attributes:
        given: A of the experiment.
        calculated: a tuner gives A, the parameter file's is not used.
        sign: 0 where no A contracts, because eigenvalues of both signs occur.
        eigenvalues: least and greatest (real parts) along the motion.
        turn: largest angle of an eigenvalue with the real axis [rad]. Where there is one, response
            errors turn as they decay: monotone is then the gain with which they decay fastest, and
            what follows from the scalar map (hard onset, doubling, ...) is not there.
        feedback: of the desired response within the learning delay.
        slope: of the transformation's step.
        step_limit: largest step of r; inf: none.
        reach: |A| h at which a response error is out of the transformation's domain at once; inf.
        monotone: up to here no response error changes its sign.
        linear_limit: up to here small response errors decay.
        loosest_limit: the linear limit at the point of the motion where it is largest.
        bare_limit: the linear limit without the feedback, the desired response held.
        hard_onset: from here on a finite two-cycle lies beside the solution; ``None``: nowhere.
        doubling: here the two-cycle that the solution has given way to doubles its period.
        chaos: first chaotic gain on a grid, where it was looked for.
        domain_limit: beyond it the iteration leaves the transformation's domain from any start.
        recommended: ``MARGIN`` of the least of monotone and hard_onset, with two digits.
        scale: |A| of the scalar map with p = 1.
        scalar: that map.
    """

    given: float
    calculated: bool
    sign: int
    eigenvalues: tuple[float, float]
    turn: float
    feedback: float
    slope: float
    step_limit: float
    reach: float
    monotone: float
    linear_limit: float
    loosest_limit: float
    bare_limit: float
    hard_onset: float | None
    doubling: float | None
    chaos: float | None
    domain_limit: float | None
    recommended: float
    scale: float
    scalar: ScalarMap

    @property
    def range(self) -> Interval:
        """The open interval of A in which the iteration contracts; empty where ``sign`` is 0."""
        return interval(self.sign, self.linear_limit)

    @property
    def signed_scale(self) -> float:
        """``scale`` with the sign of the eigenvalues: ``fpt_deformer.gain_scale``; 0: no A."""
        return -math.copysign(self.scale, self.slope) * self.sign

    def contracts(self, A: float) -> bool:
        """Whether small response errors decay with this gain."""
        return holds(A, self.range)

    @property
    def hard_step(self) -> float:
        """The step of r in the two-cycle of the hard onset; NaN: there is none."""
        cycle = self.scalar.hard_onset()
        return self.scalar.step(cycle.high) if cycle is not None else math.nan

    @property
    def bands(self) -> tuple[Band, ...]:
        """Behaviour over |A| with the right sign, from 0 on."""
        if self.sign == 0:
            return (Band(0.0, math.inf, RUNS_AWAY),)
        limit, hard, domain = self.linear_limit, self.hard_onset, self.domain_limit
        if self.turn:
            return Band(0.0, limit, SPIRAL), Band(limit, math.inf, CIRCLES)
        ends = {0.0, self.monotone, limit, hard, self.doubling, self.chaos, domain}
        marks = sorted(end for end in ends if end is not None)
        pairs = zip(marks, [*marks[1:], math.inf], strict=True)
        return tuple(Band(start, end, self._name(start)) for start, end in pairs)

    def _name(self, start: float) -> str:
        """The behaviour from ``start``, one of the limits, to the next one."""
        if self.domain_limit is not None and start >= self.domain_limit:
            return LEAVES
        if start < self.linear_limit:
            name = MONOTONE if start < self.monotone else PRECURSOR
            beside = self.hard_onset is not None and start >= self.hard_onset
            return name + OR_TWO_CYCLE if beside else name
        if self.doubling is None or start < self.doubling:
            return TWO_CYCLE
        if self.chaos is None:
            return DOUBLING_TO_CHAOS
        return CHAOS if start >= self.chaos else DOUBLING

    def multipliers(self, A: float, eigenvalues: Iterable[float]) -> Array:
        """What a small response error is multiplied by, for these eigenvalues."""
        rate = A * self.slope * (1.0 + self.feedback)
        return 1.0 + rate * np.asarray(eigenvalues, dtype=np.float64)

    def behaviour(self, A: float) -> str:
        """Name of what the iteration does with this gain."""
        if A == 0.0:
            return "learns nothing"
        if A * self.sign <= 0.0:
            return RUNS_AWAY
        return next(band.name for band in self.bands if band.start <= abs(A) < band.end)

    def with_chaos(self) -> "Gain":
        """The same with ``chaos`` looked for, which takes a second."""
        if self.turn:
            return self
        p = self.scalar.chaos(times(self.doubling, 1.0 / self.scale), self.end_of_map)
        return replace(self, chaos=times(p, self.scale))

    @property
    def end_of_map(self) -> float | None:
        """The p of the domain limit."""
        return times(self.domain_limit, 1.0 / self.scale)


def times(number: float | None, factor: float) -> float | None:
    """The product; ``None`` stays what it is."""
    return number * factor if number is not None else None
