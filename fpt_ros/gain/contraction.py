"""The range of the gain A in which the iteration contracts, and what happens outside it.

Asked for r, the plant answers f(r): the exact response to the approximate model's effort for r.
With J = df/dr over the controlled coordinates, their weights W, and the transformation's slope, a
small response error h is multiplied by

    1 + A slope lambda (1 + feedback),   lambda: the eigenvalues of W J

once every ``learning_delay`` cycles. The feedback: what the response did to the state until it is
used, the desired response takes back. A response that is one cycle old has changed q' by dt f, so
that for a PID law feedback = 3 Lambda dt; with a delay of d cycles d times as much. (In a two-cycle
q' itself alternates, and half of that is left: the limit is on the safe side by half the feedback,
4.6575 instead of 4.699 for TORA, where an error of 1e-9 begins to grow.) A filter between plant and
controller is left out.

Beyond the linear limit, and for starts that are not close to the solution, the step's saturation
counts: :mod:`fpt_ros.gain.map`.
"""

import math
import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from fpt_ros.errors import BadInput
from fpt_ros.gain.map import ScalarMap, scalar_map
from fpt_ros.gain.motion import Point, feedback, nominal_points, spectrum
from fpt_ros.parameters import flag
from fpt_ros.runs.run import Array
from fpt_ros.tuning import GAIN

if TYPE_CHECKING:
    from fpt_ros.experiments.experiment import Experiment

MARGIN = 0.8
"""The recommended A as a part of the gain up to which all convergence is monotone."""

RUNS_AWAY = "runs away"
MONOTONE = "monotone"
PRECURSOR = "precursor oscillation"
TWO_CYCLE = "two-cycle"
DOUBLING = "period doubling"
DOUBLING_TO_CHAOS = "period doubling, chaos"
CHAOS = "chaos"
LEAVES = "leaves the domain"
OR_TWO_CYCLE = f" or {TWO_CYCLE}"


@dataclass(frozen=True)
class Band:
    """What the iteration does for |A| between two values; ``end``: inf where that is the last."""

    start: float
    end: float
    name: str


@dataclass(frozen=True)
class Gain:
    """The analysis; all limits are magnitudes |A|, ``sign`` is that of the A that contracts.

    Attributes:
        given: A of the experiment.
        calculated: a tuner gives A, the parameter file's is not used.
        sign: 0 where no A contracts, because eigenvalues of both signs occur.
        eigenvalues: least and greatest (real parts) along the motion.
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
    def range(self) -> tuple[float, float]:
        """The open interval of A in which the iteration contracts; empty where ``sign`` is 0."""
        return (-self.linear_limit, 0.0) if self.sign < 0 else (0.0, self.linear_limit)

    def contracts(self, A: float) -> bool:
        """Whether small response errors decay with this gain."""
        low, high = self.range
        return low < A < high

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
        p = self.scalar.chaos(_times(self.doubling, 1.0 / self.scale), self.end_of_map)
        return replace(self, chaos=_times(p, self.scale))

    @property
    def end_of_map(self) -> float | None:
        """The p of the domain limit."""
        return _times(self.domain_limit, 1.0 / self.scale)


def bounds(experiment: "Experiment", points: Sequence[Point] | None = None) -> Gain:
    """The range of A of an experiment, without running it.

    Args:
        experiment: with a transformation.
        points: of a motion (:func:`fpt_ros.gain.motion.along`); default: the nominal
            one, the coordinates that are not controlled as they are at the start.

    Raises:
        BadInput: it has no transformation, or the model is not defined along the motion.
    """
    loop = experiment.loop()
    deformer = loop.deformer
    transformation = deformer.transformation
    if not transformation.adapts:
        raise BadInput(
            f"{experiment.name} {experiment.variant} has no fixed point transformation "
            "(fpt_deformer.transformation: none): there is no gain to choose"
        )
    found = spectrum(loop, nominal_points(loop) if points is None else points)
    found = found[np.isfinite(found).any(axis=1)]
    if not len(found):
        raise BadInput(
            f"{experiment.name} {experiment.variant}: the approximate model or the plant is not "
            "defined anywhere along the nominal motion"
        )
    real = found.real
    least, greatest = float(np.nanmin(real)), float(np.nanmax(real))
    size = max(abs(least), abs(greatest))
    tiny = 1e-9 * size
    side = 1.0 if least >= -tiny else -1.0
    one_sign = size > 0.0 and (least >= -tiny or greatest <= tiny)
    constants = deformer.constants.transformation
    scalar = scalar_map(transformation, constants, side)
    # the circle |1 - a lambda| = 1 is left at a = 2 Re lambda / |lambda|^2
    steepness = np.zeros(real.shape)
    np.divide(np.abs(found) ** 2, np.abs(real), out=steepness, where=np.abs(real) > tiny)
    of_points = steepness.max(axis=1)
    steepest, flattest = float(of_points.max()), float(of_points.min())
    fed_back = feedback(loop)
    scale = 1.0 / (steepest * (1.0 + fed_back)) if steepest > 0.0 else 1.0
    slope = transformation.slope(constants)
    sign = int(-math.copysign(1.0, slope * side)) if one_sign else 0
    hard = scalar.hard_onset()
    hard_onset = hard.p * scale if hard is not None and one_sign else None
    linear = scalar.linear * scale if one_sign else 0.0
    best = MARGIN * min(0.5 * linear, hard_onset if hard_onset is not None else math.inf)
    low, high = scalar.edges
    return Gain(
        given=deformer.gain,
        calculated=loop.tuner.active and loop.tuner.law.tunes == GAIN,
        sign=sign,
        eigenvalues=(least, greatest),
        feedback=fed_back,
        slope=slope,
        step_limit=transformation.step_limit(constants),
        reach=min(-low, high),
        monotone=0.5 * linear,
        linear_limit=linear,
        loosest_limit=linear * steepest / flattest if flattest > 0.0 else math.inf,
        bare_limit=linear * (1.0 + fed_back),
        hard_onset=hard_onset,
        doubling=_times(scalar.doubling(), scale) if one_sign else None,
        chaos=None,
        domain_limit=_times(scalar.domain_limit(), scale) if one_sign else None,
        recommended=sign * _rounded_down(best),
        scale=scale,
        scalar=scalar,
    )


def _times(number: float | None, factor: float) -> float | None:
    return number * factor if number is not None else None


def _rounded_down(x: float) -> float:
    """To two digits."""
    if not 0.0 < x < math.inf:
        return 0.0
    exponent = 1 - math.floor(math.log10(x))
    return round(math.floor(x * 10.0**exponent + 1e-9) / 10.0**exponent, max(exponent, 0))


def warning(experiment: "Experiment") -> str:
    """What is to be said, in one line, of an experiment's A before a run; empty: nothing."""
    loop = experiment.loop()
    if not loop.deformer.transformation.adapts or loop.tuner.law.tunes == GAIN:
        return ""
    try:
        gain = bounds(experiment)
    except BadInput:
        return ""
    A, sign = gain.given, gain.sign
    more = shlex.join(["fpt", "gain", *(experiment.source or (experiment.name,))])
    low, high = gain.range
    interval = f"({low:.4g}, {high:.4g})"
    hard = gain.hard_onset
    onset = f"hard onset of chattering at {sign * hard:.4g}" if hard is not None else ""
    if sign == 0:
        least, greatest = gain.eigenvalues
        return (
            "no fpt_deformer.A contracts along the nominal motion, where the response's "
            f"eigenvalues are between {least:.4g} and {greatest:.4g} ({more})"
        )
    if flag(loop.tuner.values, "precursor_guard") and A * sign > 0.0:
        return ""  # the precursor guard lowers |A| by itself
    if not gain.contracts(A):
        part = (
            "in a part of the nominal motion "
            if abs(A) < gain.loosest_limit and A * sign > 0.0
            else ""
        )
        what = f"{part}it {_verb(gain.behaviour(A))}"
        if onset and A * sign > 0.0:
            more = f"a {onset}; {more}"
        return (
            f"fpt_deformer.A = {A:g} is outside the range {interval} in which the iteration "
            f"contracts: {what} ({more})"
        )
    if hard is not None and abs(A) >= hard:
        return (
            f"fpt_deformer.A = {A:g} may chatter: beyond the {onset} a large response error ends "
            f"in a two-cycle, while small ones decay in {interval} ({more})"
        )
    return ""


def _verb(behaviour: str) -> str:
    return {
        TWO_CYCLE: "chatters in a two-cycle",
        DOUBLING: "chatters, its period doubled",
        DOUBLING_TO_CHAOS: "chatters, periodically or in chaos",
        CHAOS: "is chaotic",
    }.get(behaviour, behaviour)
