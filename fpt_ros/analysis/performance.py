"""How well a run follows, in the words of control engineers, taken chunk by chunk.

Rise time, overshoot and settling time are those of the tracking error: what they are after a step
of its initial size, whatever the nominal motion does meanwhile.
"""

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from fpt_ros.analysis import signals
from fpt_ros.analysis.motions import Motion, Motions
from fpt_ros.analysis.sizes import finite
from fpt_ros.messages.frames import SECOND
from fpt_ros.parameters import Values
from fpt_ros.runs.chunks import Chunk, Pieces
from fpt_ros.runs.run import Array, Run

BAND = 0.02
"""An error has settled where it stays within this part of its largest size."""

STAYS = 0.1
"""It has to stay there for this part of the run at least: a motion that repeats itself crosses
zero at its end too."""

RISEN = 0.9, 0.1
"""Parts of the initial error between which the rise time is taken."""

PER_OCTAVE = 64
"""Sizes of the error that are told apart: the band is known to one percent of itself."""

LOWEST, HIGHEST = -1075, 1025
"""Powers of two of all doubles."""

Numbers = Mapping[str, Mapping[str, float | None]]
"""Coordinate -> quantity -> number."""


class Performance:
    """Takes a run chunk by chunk, and keeps its numbers only.

    The numbers do not depend on the sizes of the chunks.

    Args:
        parameters: of every node.
    """

    def __init__(self, parameters: Mapping[str, Values]) -> None:
        about = Run({}, parameters, {})
        self._dt = signals.parameter_number(about, "plant_simulator", "dt")
        cycle = None if self._dt is None else round(self._dt * SECOND)
        self._pieces = Pieces(cycle, self._take)
        self._motions = Motions(about)
        self._errors: dict[str, _Error] = {}
        self._work: dict[str, float] = {}

    def take(self, chunk: Chunk) -> None:
        """Take the next cycles."""
        self._pieces.take(chunk)

    def _take(self, piece: Chunk) -> None:
        for name, motion in self._motions.take(piece).items():
            self._errors.setdefault(name, _Error()).add(motion)
        measured = piece.get("joint_states")
        if measured is None:
            return
        for name in measured.names:
            effort = measured.column("effort", name)
            velocity = measured.column("velocity", name)
            if np.isnan(velocity).all():
                velocity = _estimated(piece, name, len(effort))
            power = np.abs(effort * velocity)
            self._work[name] = self._work.get(name, 0.0) + float(np.nansum(power))

    def result(self) -> Numbers:
        """The run's numbers, once it has ended; ``None`` for what does not exist.

        Of each controlled coordinate, e = q^N - q being its error:

        - ``iae``, ``ise``, ``itae``: sums of abs(e), e^2 and t abs(e) over all cycles, times dt;
        - ``settling_time`` [s]: from when on abs(e) stays within 2 percent of its largest size,
          for the last tenth of the run at least;
        - ``rise_time`` [s]: in which e falls from 90 to 10 percent of what it is in the first
          cycle, and ``overshoot_percent``: its largest size on the other side, in percent of
          that; neither exists for a run that begins inside the band.

        Of each measured coordinate ``energy``: the sum of abs(Q v) over all cycles, times dt.
        """
        self._pieces.finish()
        dt = self._dt if self._dt is not None else math.nan
        found = {name: error.result(dt) for name, error in self._errors.items()}
        for name, sum_ in self._work.items():
            found[name] = {**found.get(name, {}), "energy": finite(sum_ * dt)}
        return found


class _Error:
    """The tracking error of one coordinate so far."""

    def __init__(self) -> None:
        self._absolute = self._squares = self._timed = 0.0
        self._first: float | None = None
        self._below: list[float | None] = [None] * len(RISEN)
        self._other_side = 0.0
        self._largest = 0.0
        self._end = -math.inf
        # when the error was last of a size: sizes are in equal steps of their logarithm
        self._last = np.full((HIGHEST - LOWEST) * PER_OCTAVE, -math.inf)

    def add(self, motion: Motion) -> None:
        """Add what follows."""
        error = motion.error
        known = np.isfinite(error)
        if not known.all():
            error, time = error[known], motion.time[known]
        else:
            time = motion.time
        if not len(error):
            return
        size = np.abs(error)
        self._absolute += float(size.sum())
        self._timed += float((time * size).sum())
        with np.errstate(over="ignore"):
            self._squares += float(np.square(error).sum())
        self._largest = max(self._largest, float(size.max()))
        self._end = float(time[-1])
        some = size > 0.0
        self._last[_level(size[some])] = time[some]  # of equal levels the last one stays
        self._follow_step(time, error)

    def _follow_step(self, time: Array, error: Array) -> None:
        if self._first is None:
            self._first = float(error[0])
        if self._first == 0.0:
            return
        part = error / self._first
        for at, limit in enumerate(RISEN):
            if self._below[at] is None and (part <= limit).any():
                self._below[at] = float(time[int(np.argmax(part <= limit))])
        self._other_side = max(self._other_side, float(-part.min()))

    def result(self, dt: float) -> dict[str, float | None]:
        """Its numbers, by the cycle time [s]."""
        begin, end = self._below
        step = abs(self._first or 0.0) > BAND * self._largest
        rise = end - begin if begin is not None and end is not None else None
        return {
            "iae": finite(self._absolute * dt),
            "ise": finite(self._squares * dt),
            "itae": finite(self._timed * dt),
            "rise_time": rise if step else None,
            "settling_time": self._settled(dt),
            "overshoot_percent": finite(100.0 * self._other_side) if step else None,
        }

    def _settled(self, dt: float) -> float | None:
        """The first cycle behind the last one that was outside the band."""
        if not self._largest:
            return 0.0 if self._first is not None else None
        limit = int(_level(np.array([BAND * self._largest]))[0])
        outside = float(self._last[limit + 1 :].max())
        return finite(outside + dt) if outside <= (1.0 - STAYS) * self._end else None


def _level(sizes: Array) -> NDArray[np.int64]:
    """Number of the step in which positive sizes are."""
    levels = np.floor(PER_OCTAVE * (np.log2(sizes) - LOWEST)).astype(np.int64)
    return np.asarray(levels.clip(0, (HIGHEST - LOWEST) * PER_OCTAVE - 1))


def _estimated(piece: Chunk, name: str, count: int) -> Array:
    """Velocities by the denoiser, of sensors that have none."""
    estimate = piece.get("state_estimate")
    if estimate is None or name not in estimate.names or len(estimate.stamps) != count:
        return np.full(count, np.nan)
    return estimate.column("velocities", name)
