"""The cases of the protocol (Wiebe et al. 2024, RealAIGym, robustness leaderboard).

There a double pendulum's model parameters vary by a quarter to either side, its velocities are
noisy, its torques are noisy, sluggish or overshoot, its measurements come late, and it is kicked.
Here the same is done with any plant; torques are told in parts of the largest effort of the quiet
run, as the source's 1.1 N m and 5 N m are of its limit of 6 N m.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from fpt_ros.cycle.suffered import ACTUATORS
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.parameters import Value

PLANT = "plant_simulator"
MODEL, NOISE, TORQUE_NOISE, RESPONSE, DELAY, KICKS = (
    "model",
    "measurement noise",
    "torque noise",
    "torque response",
    "delay",
    "kicks",
)
CRITERIA = (MODEL, NOISE, TORQUE_NOISE, RESPONSE, DELAY, KICKS)

VARIATION = 0.25
VELOCITY_NOISE = 0.5
"""Standard deviation of the noisiest velocities [unit/s]; of positions, where only they are
measured, in a thousandth of it [unit]."""

TORQUE_SIGMA = 1.1 / 6.0
RESPONSES = (0.1, 2.0)
LATEST = 0.04
"""Largest delay [s]."""

KICK = 5.0 / 6.0
LARGEST_DELAY = 1000


@dataclass(frozen=True)
class Case:
    """One run of the protocol.

    Attributes:
        criterion: of :data:`CRITERIA`.
        what: what is changed, in words.
        changes: of the plant's parameters.
    """

    criterion: str
    what: str
    changes: dict[str, Value]


def cases(experiment: Experiment, largest_effort: float, points: int) -> Iterator[Case]:
    """All cases for an experiment, ``points`` a row.

    Args:
        largest_effort: of the quiet run.
    """
    values = experiment.nodes[PLANT]
    seed, dt = int(str(values["seed"])), float(str(values["dt"]))
    yield from _models(values, points)
    position = values["measured"] == "position"
    name, most = ("position", 1e-3 * VELOCITY_NOISE) if position else ("velocity", VELOCITY_NOISE)
    for sigma in np.linspace(0.0, most, points).tolist():
        yield Case(NOISE, f"{name}, sigma = {sigma:.3g}", {f"noise.{name}": sigma})
    for part in np.linspace(0.0, TORQUE_SIGMA, points).tolist():
        changes = {"sigma": part * largest_effort, "factor": 1.0}
        yield Case(
            TORQUE_NOISE, f"sigma = {changes['sigma']:.3g}", _with(values, "imprecise", changes)
        )
    for part in np.linspace(*RESPONSES, points).tolist():
        yield Case(RESPONSE, f"part = {part:.3g}", _with(values, "response", {"part": part}))
    for late in np.linspace(0.0, LATEST, points).tolist():
        cycles = min(round(late / dt), LARGEST_DELAY)
        yield Case(DELAY, f"{cycles} cycles", {"measurement_delay": cycles})
    names = experiment.loop().plant.coordinates
    for k in range(points):
        joint = names[k % len(names)]
        changes = {
            "disturbance.kind": "kicks",
            "disturbance.coordinate": joint,
            "disturbance.amplitude": KICK * largest_effort,
            "disturbance.frequency": 1.0,
            "seed": seed + k,
        }
        yield Case(KICKS, f"{joint}, seed {seed + k}", _kicked(values, changes))


def _models(values: dict[str, Value], points: int) -> Iterator[Case]:
    """Each number of the exact plant that is not zero, by itself."""
    for name, value in values.items():
        if not name.startswith("exact.") or not isinstance(value, float) or value == 0.0:
            continue
        for factor in np.linspace(1.0 - VARIATION, 1.0 + VARIATION, points).tolist():
            what = f"{name.removeprefix('exact.')} x {factor:.3g}"
            yield Case(MODEL, what, {name: factor * value})


def _with(values: dict[str, Value], kind: str, own: dict[str, float]) -> dict[str, Value]:
    """One disturbance of the actuators more, in front of those that are there."""
    there = values[ACTUATORS.name]
    assert not isinstance(there, str | bool | int | float)
    others = [str(each) for each in there if each != kind]
    changes: dict[str, Value] = {ACTUATORS.name: [kind, *others]}
    return changes | {f"actuators.{kind}.{name}": value for name, value in own.items()}


def _kicked(values: dict[str, Value], changes: dict[str, Value]) -> dict[str, Value]:
    from fpt_ros.disturbances.kicks import PARAMETERS

    own: dict[str, Value] = {}
    for parameter in PARAMETERS:
        assert parameter.default is not None
        own[f"disturbance.{parameter.name}"] = parameter.default
    length = float(str(values["duration"]))
    own["disturbance.count"] = max(1, min(3, int(length / 2.0)))
    own["disturbance.apart"] = min(1.0, length / 6.0)
    return own | changes


def changed(experiment: Experiment, case: Case) -> Experiment:
    """The experiment with the case's changes; what belonged to another disturbance goes."""
    values = dict(experiment.nodes[PLANT])
    if "disturbance.kind" in case.changes:
        values = {
            name: value for name, value in values.items() if not name.startswith("disturbance.")
        }
    nodes = {**experiment.nodes, PLANT: {**values, **case.changes}}
    return Experiment(experiment.name, experiment.variant, nodes, experiment.source)
