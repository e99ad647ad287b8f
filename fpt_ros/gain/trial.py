"""A run with the recommended gain: whether it keeps control, and what it does to the errors."""

from typing import Any

from fpt_ros.analysis.metrics import Metrics, summary
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import RunFailed
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.experiments.response_map import Point
from fpt_ros.gain.contraction import bounds
from fpt_ros.gain.limits import Gain
from fpt_ros.gain.motion import along
from fpt_ros.runs.run import Run, describe

METRIC = "rms_settled"
"""By which a recommended gain is compared with the one that was given."""

ATTEMPTS = 6
"""Runs in search of a gain that keeps control."""

ENOUGH = 0.9
"""The model as it was tuned asks for another run where it allows less than this part of A."""


def try_out(experiment: Experiment, found: Gain) -> tuple[list[Point] | None, dict[str, Any]]:
    """Run with the recommended A, with less where it fails or the tuned model asks for less.

    Returns:
        Points of the motion (``None``: no run came to its end), and what the run shows.
    """
    reason, A = "", found.recommended
    for attempt in range(ATTEMPTS if found.sign else 0):
        one = experiment if found.calculated else experiment.with_values("fpt_deformer", A=A)
        loop = one.loop()
        engine = Engine(loop)
        try:
            engine.run()
        except RunFailed as error:
            reason, A = reason or str(error), 0.5 * A
            continue
        points = along(engine, loop)
        there = bounds(one, points)
        less = there.sign == found.sign and abs(there.recommended) < ENOUGH * abs(A)
        if less and not found.calculated and attempt + 1 < ATTEMPTS:
            A = there.recommended
            continue
        numbers = summary(Run(describe(one, "in_process", ""), one.nodes, engine.topics()))
        result = {
            "A": None if found.calculated else A,
            "complete": True,
            "reason": reason,
            "tracking": numbers["tracking"],
            "chatter": numbers["chatter"],
            "eigenvalues": list(there.eigenvalues),
            "linear_limit": there.linear_limit,
        }
        return points, result if found.calculated else _not_worse(experiment, found, result)
    return None, {"A": None, "complete": False, "reason": reason} if found.sign else {}


def _not_worse(experiment: Experiment, found: Gain, tried: dict[str, Any]) -> dict[str, Any]:
    """The given A again where it contracts, too, and its worst settled rms error is smaller."""
    gentle = found.hard_onset is None or abs(found.given) < found.hard_onset
    if not (found.contracts(found.given) and gentle) or found.given == tried["A"]:
        return tried
    engine = Engine(experiment.loop(), consumers=(metrics := Metrics(experiment.nodes),))
    try:
        engine.run()
    except RunFailed:
        return tried
    numbers = metrics.result(describe(experiment, "in_process", ""))
    ratio = _worst_ratio(tried["tracking"], numbers["tracking"])
    if ratio is None or ratio <= 1.0:
        return tried
    return {
        **tried,
        "A": found.given,
        "rejected": tried["A"],
        "tracking": numbers["tracking"],
        "chatter": numbers["chatter"],
        "given": {"metric": METRIC, "ratio": ratio},
    }


def _worst_ratio(one: Any, other: Any) -> float | None:
    """How many times as large the errors are, for the coordinate of which that is the largest."""
    pairs = [(one[name][METRIC], other[name][METRIC]) for name in one if name in other]
    ratios = [a / b for a, b in pairs if a is not None and b]
    return max(ratios, default=None)
