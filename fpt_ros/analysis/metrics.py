"""The numbers of a run, taken chunk by chunk: tracking errors, efforts, chatter."""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from fpt_ros.analysis import signals
from fpt_ros.analysis.motions import Motion, Motions
from fpt_ros.analysis.sizes import Size, finite
from fpt_ros.messages.frames import SECOND, Names
from fpt_ros.parameters import Values
from fpt_ros.runs.chunks import Chunk, Pieces, aligned, ordered
from fpt_ros.runs.latency import Latencies
from fpt_ros.runs.run import Run, Series

Summary = Mapping[str, object]
"""What :func:`summary` gives, or the same read back from JSON."""


def summary(run: Run) -> dict[str, object]:
    """The numbers of a whole run: what :class:`Metrics` gives of its chunks, to the last bit."""
    metrics = Metrics(run.parameters)
    metrics.take(ordered(run.topics))
    return metrics.result(run.info, run.latency)


class Metrics:
    """Takes a run chunk by chunk, and keeps its numbers only.

    The numbers do not depend on the sizes of the chunks.

    Args:
        parameters: of every node.
    """

    def __init__(self, parameters: Mapping[str, Values]) -> None:
        self._about = about = Run({}, parameters, {})
        dt = signals.parameter_number(about, "plant_simulator", "dt")
        self._dt = dt
        self._pieces = Pieces(None if dt is None else round(dt * SECOND), self._take)
        self._cycles = 0
        self._motions = Motions(about)
        self._controlled: dict[str, None] = {}
        self._errors: dict[str, _Errors] = {}
        self._efforts: dict[str, Size] = {}
        self._chatter = _Chatter()
        self._commanded = False
        self._tuned: dict[str, float | None] = {}

    def take(self, chunk: Chunk) -> None:
        """Take the next cycles."""
        if "desired" in chunk:
            self._controlled.update(dict.fromkeys(chunk["desired"].names))
        if "command" in chunk:
            self._commanded = True
            for name in chunk["command"].names:
                self._efforts.setdefault(name, Size())
        self._pieces.take(chunk)

    def _take(self, piece: Chunk) -> None:
        if "joint_states" in piece:
            self._cycles += len(piece["joint_states"].stamps)
        for name, motion in self._motions.take(piece).items():
            errors = self._errors.setdefault(name, _Errors(Size(), Size()))
            errors.add(motion, signals.first_settled(self._about, motion.time))
        if "command" in piece:
            command = piece["command"]
            for name in command.names:
                self._efforts[name].add(command.column("effort", name))
            self._chatter.add(command)
        if "tuning" in piece:
            tuning = piece["tuning"]
            last = zip(tuning.names, tuning.vectors["values"][-1].tolist(), strict=True)
            self._tuned = {**dict.fromkeys(self._tuned), **{n: finite(x) for n, x in last}}

    def result(
        self, info: Mapping[str, str], latency: Latencies | None = None
    ) -> dict[str, object]:
        """The run's numbers as a JSON object (design, section 6), once it has ended.

        Lengths of time in [s], errors and efforts in the plant's units. ``tracking`` holds, for
        each controlled coordinate, rms and largest size of e = q^N - q, over all cycles and over
        those with t >= settle_time; with time sharing the turns of the others count too.
        ``chatter`` is the mean of ||r_k - r_(k-1)|| over k >= 1 (section 3.2.2 of the thesis: it
        jumps where the control begins to oscillate). ``real_time`` is of a recording on the wall
        clock, otherwise ``None``: cycles that ended without their command, and latency from sensor
        to command [ms]. A number that does not exist is ``None``, never NaN.

        Args:
            info: experiment, variant, engine, complete, reason.
            latency: of a run in real time.
        """
        self._pieces.finish()
        about, dt, cycles = self._about, self._dt, self._cycles
        seed = signals.parameter_number(about, "plant_simulator", "seed")
        none = _Errors(Size(), Size())
        return {
            "experiment": info.get("experiment", ""),
            "variant": info.get("variant", ""),
            "engine": info.get("engine", ""),
            "adaptive": signals.adaptive(about),
            "cycles": cycles,
            "dt": dt,
            "duration": None if dt is None else cycles * dt,
            "settle_time": signals.settle_time(about),
            "seed": None if seed is None else int(seed),
            "tracking": {n: self._errors.get(n, none).result() for n in self._controlled},
            "effort": {n: {"rms": e.rms, "max": e.largest} for n, e in self._efforts.items()},
            "chatter": self._chatter.mean() if self._commanded else None,
            "final_parameters": self._final_parameters(),
            "real_time": None if latency is None else _real_time(latency),
            "complete": info.get("complete") == "true",
            "reason": info.get("reason", ""),
        }

    def _final_parameters(self) -> dict[str, float | None]:
        """What the controller believed at the end: the model's parameters, and all tuned ones."""
        if set(self._tuned) & signals.coefficient_names(self._about):
            return self._tuned
        prefix = "approximate."
        own: dict[str, float | None] = {}
        for name in self._about.parameters.get("fpt_deformer", {}):
            number = signals.parameter_number(self._about, "fpt_deformer", name)
            if name.startswith(prefix) and number is not None:  # a file's name is none
                own[name.removeprefix(prefix)] = number
        return {**own, **self._tuned}


class _Errors(NamedTuple):
    """Tracking errors of a coordinate, before and after the settle time."""

    early: Size
    late: Size

    def add(self, motion: Motion, settled: int) -> None:
        """Add the errors of a piece, which are settled from an index on."""
        error = motion.error
        self.early.add(error[:settled])
        self.late.add(error[settled:])

    def result(self) -> dict[str, float | None]:
        whole, late = self.early.merged(self.late), self.late
        return {
            "rms": whole.rms,
            "max": whole.largest,
            "rms_settled": late.rms,
            "max_settled": late.largest,
        }


class _Chatter:
    """Mean step of the deformed response; where a coordinate is not controlled it makes none."""

    def __init__(self) -> None:
        self._names: Names = ()
        self._last = np.empty((0, 0))
        self._sum = 0.0
        self._steps = 0
        self._any = False

    def add(self, command: Series) -> None:
        """Add the commands that follow."""
        if command.names != self._names:
            self._widen(command.names)
        rows = aligned(command, "accelerations", self._names)
        squares = np.zeros(len(rows) - 1 + len(self._last))
        with np.errstate(invalid="ignore", over="ignore"):
            for at in range(len(self._names)):
                steps = np.diff(np.concatenate((self._last[:, at], rows[:, at])))
                if np.isnan(steps.max(initial=-np.inf)):
                    known = ~np.isnan(steps)
                    steps[~known] = 0.0
                    self._any = self._any or bool(known.any())
                else:
                    self._any = self._any or len(steps) > 0
                squares += np.square(steps, out=steps)
            self._sum += float(np.sqrt(squares, out=squares).sum())
        self._steps += len(squares)
        self._last = rows[-1:].copy()

    def _widen(self, names: Names) -> None:
        every = tuple(dict.fromkeys((*self._names, *names)))
        last = np.full((len(self._last), len(every)), np.nan)
        last[:, : len(self._names)] = self._last
        self._names, self._last = every, last

    def mean(self) -> float | None:
        """``None`` where there is no step, or where it is not finite."""
        return finite(self._sum / self._steps) if self._any else None


def _real_time(latency: Latencies) -> dict[str, float | int | None]:
    ms = {
        "median": latency.quantile(0.5),
        "p99": latency.quantile(0.99),
        "max": latency.largest if latency.total else math.nan,
    }
    return {
        "cycles": latency.cycles,
        "missed_deadlines": latency.missed,
        **{f"latency_{name}_ms": finite(1e3 * value) for name, value in ms.items()},
    }
