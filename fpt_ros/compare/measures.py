"""What is measured of a run: one number each for all coordinates."""

from collections.abc import Mapping
from contextlib import suppress
from time import perf_counter
from typing import cast

import numpy as np

from fpt_ros.analysis.metrics import Metrics
from fpt_ros.analysis.motions import Motions
from fpt_ros.analysis.overall import error_of_all
from fpt_ros.analysis.sizes import finite
from fpt_ros.cycle.stages import Loop
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import Diverged, RunFailed
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.parameters import Values
from fpt_ros.runs.chunks import Chunk
from fpt_ros.runs.run import Array, Run, describe

POINTS = 130
"""Of the curve of the error over time."""

Whole = Mapping[str, float | None]
"""Over all coordinates: ``error`` (settled, rms), ``max`` (settled), ``effort`` (rms), ``step``
(mean size of the steps of an effort), ``cut`` (part of the cycles in which an effort was cut)."""


class Spent:
    """Takes a run chunk by chunk: steps of the efforts, and cycles in which one was cut."""

    def __init__(self) -> None:
        self._last = np.empty((0, 0))
        self._steps = self._squares = 0.0
        self._count = self._cut = self._cycles = 0

    def take(self, chunk: Chunk) -> None:
        """Take the next cycles, of all topics the same ones."""
        asked, acted = chunk["command"].vectors["effort"], chunk["joint_states"].vectors["effort"]
        if not len(self._last):
            self._last = asked[:0]
        with np.errstate(invalid="ignore", over="ignore"):
            rows = np.concatenate((self._last, asked))
            self._steps += float(np.abs(np.diff(rows, axis=0)).sum())
            self._squares += float(np.square(asked).sum())
            # what acted over a cycle is measured at its end
            before = rows[: len(acted)] if len(self._last) else rows[: len(acted) - 1]
            self._cut += int((acted[len(acted) - len(before) :] != before).any(axis=1).sum())
        self._cycles += len(before)
        self._count += (len(rows) - 1) * rows.shape[1]
        self._last = asked[-1:].copy()

    def result(self, joints: int) -> Whole:
        """``effort``, ``step``, ``cut``."""
        if not self._count:
            return {"effort": None, "step": None, "cut": None}
        return {
            "effort": finite((self._squares / (self._count + joints)) ** 0.5),
            "step": finite(self._steps / self._count),
            "cut": self._cut / max(self._cycles, 1),
        }


class Curve:
    """Takes a run chunk by chunk: its error over time, and the size of its nominal motion."""

    def __init__(self, parameters: Mapping[str, Values], cycles: int) -> None:
        self._motions = Motions(Run({}, parameters, {}))
        self._width = max(1, -(-cycles // POINTS))
        self._squares: list[Array] = []
        self._time: list[Array] = []
        self._nominal: list[Array] = []

    def take(self, chunk: Chunk) -> None:
        """Take the next cycles."""
        found = list(self._motions.take(chunk).values())
        if found and len({len(one.time) for one in found}) == 1:
            with np.errstate(over="ignore"):
                squares = np.square([one.error for one in found])
                self._squares.append(squares.mean(axis=0))
            self._time.append(found[0].time)
            self._nominal.append(np.array([one.nominal for one in found]))

    def result(self) -> tuple[list[float], list[float | None]]:
        """Times [s] and rms errors of windows of the run."""
        if not self._time:
            return [], []
        time, squares = np.concatenate(self._time), np.concatenate(self._squares)
        starts = np.arange(0, len(time), self._width)
        with np.errstate(over="ignore"):
            sums = np.add.reduceat(squares, starts)
        sizes = np.diff([*starts, len(time)])
        return time[starts].round(6).tolist(), [_short(x) for x in np.sqrt(sums / sizes)]

    def deviation(self) -> float | None:
        """Of the nominal motion from its mean: rms over all coordinates."""
        if not self._nominal:
            return None
        whole = np.concatenate(self._nominal, axis=1)
        return finite(float(np.sqrt(np.mean(np.var(whole, axis=1)))))


def simulate(experiment: Experiment, loop: Loop) -> dict[str, object]:
    """The summary of a run as ``fpt simulate`` gives it, ``whole`` and ``diverged_at`` [s]."""
    return _simulate(experiment, loop, None)


def simulate_and_show(experiment: Experiment) -> dict[str, object]:
    """The same with ``curve``, ``deviation`` of the nominal motion, ``cost`` of a cycle [us]."""
    loop = experiment.loop()
    curve = Curve(experiment.nodes, loop.plant.cycles)
    result = _simulate(experiment, loop, curve)
    bare = Engine(experiment.loop(), consumers=[])
    started = perf_counter()
    with suppress(RunFailed):
        bare.run()
    seconds = perf_counter() - started
    return {
        **result,
        "curve": curve.result(),
        "deviation": curve.deviation(),
        "cost": 1e6 * seconds / max(bare.done, 1),
    }


def _simulate(experiment: Experiment, loop: Loop, curve: Curve | None) -> dict[str, object]:
    metrics, spent = Metrics(experiment.nodes), Spent()
    reason, at = "", None
    try:
        Engine(loop, consumers=[metrics, spent, *([curve] if curve else [])]).run()
    except RunFailed as error:
        reason = str(error)
        at = error.time if isinstance(error, Diverged) else None
    summary = metrics.result(describe(experiment, "in_process", reason))
    whole = {
        "error": error_of_all(summary),
        "max": error_of_all(summary, "max_settled"),
        **spent.result(len(loop.plant.coordinates)),
    }
    return {**summary, "whole": whole, "diverged_at": at}


def whole_of(result: Mapping[str, object]) -> Whole:
    """The numbers over all coordinates."""
    return cast("Whole", result["whole"])


def _short(value: float) -> float | None:
    return float(f"{value:.4g}") if np.isfinite(value) else None
