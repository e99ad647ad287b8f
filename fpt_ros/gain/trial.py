"""A run with the recommended gain: whether it keeps control, and what it does to the errors."""

from typing import Any

from fpt_ros.analysis.metrics import summary
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import RunFailed
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.gain.contraction import bounds
from fpt_ros.gain.limits import Gain
from fpt_ros.gain.motion import Point, along
from fpt_ros.runs.run import Run, describe

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
        return points, {
            "A": None if found.calculated else A,
            "complete": True,
            "reason": reason,
            "tracking": numbers["tracking"],
            "chatter": numbers["chatter"],
            "eigenvalues": list(there.eigenvalues),
            "linear_limit": there.linear_limit,
        }
    return None, {"A": None, "complete": False, "reason": reason} if found.sign else {}
