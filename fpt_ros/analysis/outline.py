"""A run in outline: what its figures need, taken chunk by chunk in constant memory."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from fpt_ros.analysis import motions, signals
from fpt_ros.analysis.metrics import Summary, summary
from fpt_ros.analysis.motions import Motion, Motions
from fpt_ros.analysis.performance import Performance
from fpt_ros.analysis.sizes import Size
from fpt_ros.analysis.spectra import Spectra, Spectrum
from fpt_ros.analysis.thinner import CAPACITY, Thinned, Thinner, Window
from fpt_ros.messages.frames import SECOND
from fpt_ros.parameters import Values
from fpt_ros.runs.changes import Change
from fpt_ros.runs.chunks import Chunk, aligned, ordered
from fpt_ros.runs.run import Array, Run, Series

NEAR = 16_384
"""Cycles before and after the settle time of which every response is kept, for the excerpt."""

Key = tuple[str, str, str]
"""Topic, vector and name of a column."""

POSITION = "joint_states", "position"
DESIRED = "desired", "accelerations"
REALISED = "state_estimate", "accelerations"
DEFORMED = "command", "accelerations"
EFFORT = "command", "effort"
TUNED = "tuning", "values"
KEPT = POSITION, DESIRED, REALISED, DEFORMED, EFFORT, TUNED
"""What is drawn over time as it is, REALISED beside the command that caused it."""

RESPONSES = DESIRED, REALISED, DEFORMED


@dataclass(frozen=True)
class Curve:
    """One column of a topic over time.

    Attributes:
        time, values: (M,) [s since the first stamp] and numbers, peaks among them.
        typical: (T,) points in time and numbers that stand for all of them.
    """

    time: Array
    values: Array
    typical: tuple[Array, Array]


NO_CURVE = Curve(np.empty(0), np.empty(0), (np.empty(0), np.empty(0)))


@dataclass(frozen=True)
class Outline(Run):
    """A run whose topics have names but no messages, and curves instead.

    Stamps of changes count from the run's first.

    Attributes:
        end: time of the last measurement [s].
        numbers: the run's summary; ``None`` where nobody has taken it.
        motions: of the controlled coordinates, peaks of the errors kept as well.
        settled_rms: of their errors, exact.
        curves: by topic, vector and name.
        period: longest one of the nominal motions [s].
        near: every point of the responses in a window about the settle time.
        window: of ``near``; ``None`` where the curves are whole themselves.
        spectra: of the positions before and after the denoiser, where there is one.
    """

    end: float = 0.0
    numbers: Summary | None = None
    motions: Mapping[str, Motion] = field(default_factory=dict)
    settled_rms: Mapping[str, float | None] = field(default_factory=dict)
    curves: Mapping[Key, Curve] = field(default_factory=dict)
    period: float | None = None
    near: Mapping[Key, Curve] = field(default_factory=dict)
    window: Window | None = None
    spectra: Mapping[str, Spectrum] = field(default_factory=dict)

    def curve(self, kind: tuple[str, str], name: str, within: Window | None = None) -> Curve:
        """A column over time, all of it or in a window; empty where the run has none."""
        curves = self.curves
        if within is not None and self.window is not None and self.window.covers(within):
            curves = self.near
        one = curves.get((*kind, name), NO_CURVE)
        if within is None:
            return one
        inside = within.inside(one.time)
        return _curve(one.time[inside], one.values[inside])


def _curve(time: Array, values: Array) -> Curve:
    return Curve(time, values, (time, values))


def outline(run: Run) -> Outline:
    """The outline of a whole run; one that is an outline already, as it is."""
    if isinstance(run, Outline):
        return run
    outliner = Outliner(run.parameters)
    outliner.take(ordered(run.topics))
    return outliner.result(run)


def numbers_of(run: Run) -> Summary:
    """The summary of a run, which an outline may bring along."""
    if isinstance(run, Outline) and run.numbers is not None:
        return run.numbers
    return summary(run)


def in_full(run: Run, numbers: Summary, performance: Performance) -> Summary:
    """A run's summary with how well it follows, and what its processes took of the machine."""
    costs = [cost.numbers() for cost in run.costs]
    return {**numbers, "performance": performance.result(), "costs": costs}


def with_numbers(run: Run) -> Outline:
    """The outline of a run with its summary, and how well it follows."""
    if isinstance(run, Outline) and run.numbers is not None:
        return run
    performance = Performance(run.parameters)
    performance.take(ordered(run.topics))
    return replace(outline(run), numbers=in_full(run, summary(run), performance))


class Outliner:
    """Takes a run chunk by chunk, and keeps what its figures need.

    Args:
        parameters: of every node.
        capacity: points of a curve that are kept at most.
    """

    def __init__(self, parameters: Mapping[str, Values], capacity: int = CAPACITY) -> None:
        self._capacity = capacity
        self._about = about = Run({}, parameters, {})
        settled = signals.settle_time(about)
        span = NEAR * (signals.parameter_number(about, "plant_simulator", "dt") or 1e-3)
        first = max(settled - span, 0.0)
        self._window = Window(first, first + 2 * span)
        self._motions = Motions(about)
        self._spectra = Spectra(parameters)
        self._thinners: dict[str, Thinner] = {}
        self._errors: dict[str, Size] = {}
        self._curves: dict[Key, Thinner] = {}
        self._topics: dict[str, Series] = {}
        self._origin: int | None = None
        self._command_time = np.empty(0)
        self._end = 0.0

    def take(self, chunk: Chunk) -> None:
        """Take the next cycles."""
        for name, series in chunk.items():
            self._name(name, series)
        if self._origin is None:
            if not any(len(series.stamps) for series in chunk.values()):
                return
            self._origin = signals.first_stamp(chunk)
        self._spectra.take(chunk)
        for name, motion in self._motions.take(chunk).items():
            self._take_motion(name, motion)
        for topic, vector in KEPT:
            if topic in chunk and len(chunk[topic].stamps):
                self._take_curves(topic, vector, chunk[topic])
        measured = chunk.get("joint_states")
        if measured is not None and len(measured.stamps):
            self._end = (int(measured.stamps[-1]) - self._origin) / SECOND

    def _name(self, topic: str, series: Series) -> None:
        """Remember the names of a topic's columns, without its numbers."""
        known = self._topics.get(topic)
        if known is not None and known.names == series.names:
            return
        names = tuple(dict.fromkeys((*(known.names if known else ()), *series.names)))
        vectors = {key: np.empty((0, len(names))) for key in series.vectors}
        self._topics[topic] = Series(np.empty(0, dtype=np.int64), names, vectors)

    def _take_motion(self, name: str, motion: Motion) -> None:
        late = signals.first_settled(self._about, motion.time)
        error = motion.error
        self._errors.setdefault(name, Size()).add(error[late:])
        self._thinners.setdefault(name, Thinner(5, self._window, self._capacity)).take(
            motion.time,
            motion.nominal,
            motion.position,
            motion.nominal_velocity,
            motion.velocity,
            error,
        )

    def _take_curves(self, topic: str, vector: str, series: Series) -> None:
        time = (series.stamps - (self._origin or 0)) / SECOND
        names = self._topics[topic].names
        numbers = aligned(series, vector, names)
        if (topic, vector) == REALISED:
            # the estimate of cycle k + 1 holds the response to the command of cycle k
            time, after = np.concatenate((self._command_time, time[:-1])), time[-1:]
            numbers = numbers[len(series.stamps) - len(time) :]
            self._command_time = after
        window = self._window if (topic, vector) in RESPONSES else None
        for column, name in enumerate(names):
            key = topic, vector, name
            self._curves.setdefault(key, Thinner(1, window, self._capacity)).take(
                time, numbers[:, column]
            )

    def result(self, about: Run, numbers: Summary | None = None) -> Outline:
        """The outline of the run, once it has ended; ``about`` gives all but the topics."""
        controlled = self._topics["desired"].names if "desired" in self._topics else ()
        taken = {name: self._thinners.get(name, Thinner(5)) for name in controlled}
        found = {name: thinner.result() for name, thinner in taken.items()}
        curves = {key: thinner.result() for key, thinner in self._curves.items()}
        whole = all(each.whole for each in (*found.values(), *curves.values()))
        near: dict[Key, Curve] = {}
        close: dict[str, Thinned] = {}
        if not whole:
            close = {name: thinner.near() for name, thinner in taken.items()}
            for key, thinner in self._curves.items():
                if key[:2] in RESPONSES:
                    points = thinner.near()
                    near[key] = _curve(points.time, points.signals[0])
        moved = {name: _motion(thinned) for name, thinned in found.items()}
        return Outline(
            about.info,
            self._about.parameters,
            self._topics,
            about.latency,
            tuple(self._since_start(about.changes)),
            about.costs,
            end=self._end,
            numbers=numbers,
            motions=moved,
            settled_rms={name: self._errors.get(name, Size()).rms for name in controlled},
            curves={key: _thinned_curve(thinned) for key, thinned in curves.items()},
            period=motions.period(map(_motion, close.values())) or motions.period(moved.values()),
            near=near,
            window=None if whole else self._window,
            spectra=self._spectra.result(),
        )

    def _since_start(self, changes: Sequence[Change]) -> Iterator[Change]:
        for change in changes:
            yield replace(change, stamp=change.stamp - (self._origin or 0))


def _motion(thinned: Thinned) -> Motion:
    return Motion(thinned.time, *thinned.signals[:4])


def _thinned_curve(thinned: Thinned) -> Curve:
    values, at = thinned.signals[0], thinned.typical
    return Curve(thinned.time, values, (thinned.time[at], values[at]))
