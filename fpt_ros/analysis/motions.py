"""Nominal and realised motion of the controlled coordinates, of a whole run or chunk by chunk."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fpt_ros.analysis import signals
from fpt_ros.analysis.signals import Stamps
from fpt_ros.analysis.truth import Truth
from fpt_ros.bags import begun_again
from fpt_ros.cycle.noise import Noise
from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.experiments.nominal import sample
from fpt_ros.messages.frames import SECOND
from fpt_ros.runs.chunks import Chunk
from fpt_ros.runs.run import Array, Run


@dataclass(frozen=True)
class Motion:
    """Nominal and realised motion of one controlled coordinate, (N,) each.

    Noise, delay and what else the simulator has put into the measurement are taken out again.

    Attributes:
        time: since the run's first stamp [s].
        nominal, position: in the plant's unit.
        nominal_velocity, velocity: in the plant's unit per second.
    """

    time: Array
    nominal: Array
    position: Array
    nominal_velocity: Array
    velocity: Array

    @property
    def error(self) -> Array:
        """Tracking error, nominal minus realised; with time sharing, in all turns."""
        return self.nominal - self.position


NONE = Motion(*[np.empty(0)] * 5)


def motion(run: Run, coordinate: str) -> Motion:
    """Nominal and realised motion of a coordinate at the stamps that have both."""
    if coordinate not in signals.controlled(run):
        return NONE
    return Motions(run, (coordinate,)).take(run.topics)[coordinate]


class Motions:
    """The motions of a run whose messages come chunk by chunk.

    Each chunk gives the next part of every motion; behind sensors that are late it is as many
    cycles behind as they are.

    Args:
        about: the run; of it the parameters count only.
        names: coordinates; none: all that are controlled at some time.
    """

    def __init__(self, about: Run, names: Sequence[str] | None = None) -> None:
        self._about, self._names = about, names
        self._origin: int | None = None
        late = signals.parameter_number(about, "plant_simulator", "measurement_delay") or 0
        # a nominal motion that is as late is of the same cycle as the measurement already
        shown_late = signals.parameter_number(about, "trajectory_generator", "nominal_delay") or 0
        self._late = max(0, int(late - shown_late))
        self._both_late = int(min(late, shown_late))
        self._sharing = bool(signals.parameter(about, "trajectory_generator", "time_sharing"))
        self._stage: TrajectoryGenerator | None = None
        self._noise = _Noise.of(about)
        self._truth = Truth.of(about)
        self._lines: dict[str, _DelayLine] = {}
        self._true_lines: dict[str, tuple[_Behind, _Behind]] = {}

    def take(self, chunk: Chunk) -> dict[str, Motion]:
        """The next part of the motions, by coordinate: those that are met in the chunk."""
        if self._origin is None and any(len(series.stamps) for series in chunk.values()):
            self._origin = signals.first_stamp(chunk)
        desired, measured = chunk.get("desired"), chunk.get("joint_states")
        if desired is None or measured is None:
            names = () if self._names is None else self._names
            return dict.fromkeys(names, NONE)
        stamps, i, j = _common(desired.stamps, measured.stamps)
        time = (stamps - (self._origin or 0)) / SECOND
        found = {}
        true = {} if self._truth is None else self._truth.take(chunk)
        for name in self._tracked(desired.names):
            if name not in measured.names:
                found[name] = NONE
                continue
            if name in true:
                lines = self._true_lines.setdefault(
                    name, (_Behind(self._both_late), _Behind(self._both_late))
                )
                position, velocity = (
                    line.take(each)[j] for line, each in zip(lines, true[name], strict=True)
                )
            else:
                position, velocity = self._measured(chunk, name, stamps, j)
            if name in desired.names:
                nominal = desired.column("positions", name)[i]
                nominal_velocity = desired.column("velocities", name)[i]
            else:  # it had no turn in this chunk
                nominal, nominal_velocity = (np.full(len(stamps), np.nan) for _ in range(2))
            away = np.isnan(nominal)
            if self._sharing and away.any():
                nominal, nominal_velocity = nominal.copy(), nominal_velocity.copy()
                nominal[away], nominal_velocity[away] = self._nominal(name, time[away])
            one = Motion(time, nominal, position, nominal_velocity, velocity)
            if self._late and name not in true:
                one = self._lines.setdefault(name, _DelayLine(self._late)).take(one)
            found[name] = one
        return found

    def _measured(
        self, chunk: Chunk, name: str, stamps: Stamps, where: "Where"
    ) -> tuple[Array, Array]:
        """Position and velocity as measured, without the noise of the position."""
        measured = chunk["joint_states"]
        position = measured.column("position", name)[where]
        if self._noise is not None:
            position = position - self._noise.of_position(name, stamps - (self._origin or 0))
        velocity = measured.column("velocity", name)[where]
        if np.isnan(velocity).all():  # not measured: what the denoiser makes of it
            velocity = _estimated_velocity(chunk, name, stamps)
        return position, velocity

    def _tracked(self, desired: Sequence[str]) -> Sequence[str]:
        """Coordinates whose error counts; with time sharing also before their first turn."""
        if self._names is not None:
            return self._names
        if not self._sharing:
            return desired
        return tuple(dict.fromkeys((*self._generator().controlled, *desired)))

    def _generator(self) -> TrajectoryGenerator:
        if self._stage is None:
            self._stage = TrajectoryGenerator(self._about.parameters[TrajectoryGenerator.name])
        return self._stage

    def _nominal(self, coordinate: str, time: Array) -> tuple[Array, Array]:
        """Nominal position and velocity while it is another coordinate's turn."""
        stage = self._generator()
        at = stage.controlled.index(coordinate)
        motions = sample(stage, time.tolist())
        return np.array([m[0][at] for m in motions]), np.array([m[1][at] for m in motions])


class _Behind:
    """Numbers so many cycles behind, as a nominal motion is that is late; the first one waits."""

    def __init__(self, late: int) -> None:
        self._late = late
        self._held: Array | None = None

    def take(self, new: Array) -> Array:
        held = np.repeat(new[:1], self._late) if self._held is None else self._held
        whole = np.concatenate((held, new))
        self._held = whole[len(new) :]
        return whole[: len(new)]


class _DelayLine:
    """Pairs what was measured late with the nominal motion of the cycle that it is of."""

    def __init__(self, late: int) -> None:
        self._ahead = late
        self._held = NONE

    def take(self, new: Motion) -> Motion:
        held = self._held
        time = np.concatenate((held.time, new.time))
        nominal = np.concatenate((held.nominal, new.nominal))
        nominal_velocity = np.concatenate((held.nominal_velocity, new.nominal_velocity))
        drop = min(self._ahead, len(new.position))
        self._ahead -= drop
        position, velocity = new.position[drop:], new.velocity[drop:]
        n = len(position)
        empty = NONE.time
        self._held = Motion(
            time[n:].copy(), nominal[n:].copy(), empty, nominal_velocity[n:].copy(), empty
        )
        return Motion(time[:n], nominal[:n], position, nominal_velocity[:n], velocity)


class _Noise:
    """The noise that the simulator added to positions: errors are those of the plant itself."""

    def __init__(self, sigma: float, noise: Noise, names: Sequence[str], cycle_time: int) -> None:
        self._sigma, self._noise, self._names = sigma, noise, names
        self._cycle_time = cycle_time
        self._stamps: Stamps | None = None
        self._rows = np.empty((0, 0))

    @classmethod
    def of(cls, about: Run) -> "_Noise | None":
        """Of a run that has any, and was not reset: the cycle tells the noise."""

        def value(name: str) -> float:
            return signals.parameter_number(about, "plant_simulator", name) or 0.0

        if not value("noise.position") or about.info.get(begun_again.TOPIC):
            return None
        plant = signals.plant_of(about)
        if plant is None:
            return None
        names = plant.coordinates
        dt = value("dt")
        noise = Noise(int(value("seed")), 2 * len(names))
        return cls(value("noise.position"), noise, names, round(dt * SECOND))

    def of_position(self, name: str, stamps: Stamps) -> Array:
        """(N,) noise of a coordinate, ``stamps`` [ns] after the start of the run."""
        if self._stamps is None or not np.array_equal(stamps, self._stamps):
            self._stamps, self._rows = stamps, self._noise.at(stamps // self._cycle_time)
        noise: Array = self._sigma * self._rows[:, self._names.index(name)]
        return noise


Where = NDArray[np.intp] | slice
"""Some entries of an array."""


def _common(a: Stamps, b: Stamps) -> tuple[Stamps, Where, Where]:
    """Stamps that are in both, ascending, and where they are; mostly both have all of them."""
    if len(a) == len(b) and bool((a == b).all()) and bool((a[1:] > a[:-1]).all()):
        return a, slice(None), slice(None)
    stamps, i, j = np.intersect1d(a, b, return_indices=True)
    return stamps, i, j


def _estimated_velocity(chunk: Chunk, coordinate: str, stamps: Stamps) -> Array:
    found = np.full(len(stamps), np.nan)
    estimate = chunk.get("state_estimate")
    if estimate is not None:
        _, i, j = _common(stamps, estimate.stamps)
        found[i] = estimate.column("velocities", coordinate)[j]
    return found


def period(motions: Iterable[Motion]) -> float | None:
    """Longest period of the nominal motions [s], from where they cross their middle.

    ``None`` where none of them crosses it twice.
    """
    found = []
    for one in motions:
        known = np.isfinite(one.nominal)
        time, nominal = one.time[known], one.nominal[known]
        if len(nominal) < 3 or np.ptp(nominal) == 0.0:
            continue
        above = nominal > (nominal.max() + nominal.min()) / 2
        crossings = time[1:][above[1:] != above[:-1]]
        if len(crossings) >= 2:
            found.append(2.0 * float(np.mean(np.diff(crossings))))
    return max(found, default=None)
